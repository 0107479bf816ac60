#!/usr/bin/env python3
"""Measures the numbers of the documents: writes doc/results/NAME.md with the commands, fills the tables
between "<!-- measured: NAME -->" and "<!-- end -->" in README.md and doc/, draws doc/pictures/.

Usage, in the root of the repository: tests/measure.py [--rollwave build/rollwave] [NAME...]
All names take a quarter of an hour on two quiet cores.
"""
import argparse
import csv
import decimal
import itertools
import json
import math
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
arguments.add_argument('--rollwave', default='build/rollwave')
arguments.add_argument('names', nargs='*')
arguments = arguments.parse_args()
root = pathlib.Path(__file__).resolve().parent.parent
rollwave = pathlib.Path(arguments.rollwave).resolve()
work = pathlib.Path(tempfile.mkdtemp())
environment = {**os.environ, 'OMPI_ALLOW_RUN_AS_ROOT': '1', 'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1'}
commands = []  # of the current measurement, as a reader would type them


def call(prm, settings, options=(), launcher=()):
    """Runs the program; returns the directory of its files."""
    directory = work / str(len(list(work.iterdir())))
    line = [*options, f'prm/{prm}.prm']
    for key, value in settings.items():
        line += ['--set', f'{key}={value}']
    command = shlex.join([*launcher, 'build/rollwave', *line])
    if command not in commands:
        commands.append(command)
    ended = subprocess.run([*launcher, rollwave, *line, '--output', directory], cwd=root, env=environment,
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    (directory / 'screen.txt').write_text(ended.stdout)
    return directory


def scene(prm, settings=None, repeats=1, **how):
    """The summary of the fastest of several runs."""
    runs = [json.loads((call(prm, settings or {}, **how) / 'summary.json').read_text())
            for _ in range(repeats)]
    return min(runs, key=lambda run: run['seconds']['total'])


def study(prm, settings=None, pictures=None):
    """The rows of study.csv; pictures by their names here and in doc/pictures."""
    directory = call(prm, settings or {})
    for source, target in (pictures or {}).items():
        if (directory / source).exists():
            shutil.copy(directory / source, root / 'doc/pictures' / target)
        else:
            print('  missing:', source)
    with open(directory / 'study.csv', newline='') as file:
        return [{key: number(value) for key, value in row.items()} for row in csv.DictReader(file)]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def shown(value):
    if not isinstance(value, float):
        return str(value)
    return str(int(value)) if abs(value) < 1e9 and value == int(value) else f'{value:.3g}'


def rounded_up(value, digits=3):
    """A bound with this number of digits."""
    if not isinstance(value, float) or not math.isfinite(value):
        return value
    return float(decimal.Context(prec=digits, rounding=decimal.ROUND_CEILING).create_decimal(value))


def table(titles, rows):
    lines = [titles, ['---'] * len(titles)]
    for row in rows:
        lines.append([shown(rounded_up(cell) if title == 'certified' else cell)
                      for title, cell in zip(titles, row)])
    return ''.join('| ' + ' | '.join(line) + ' |\n' for line in lines)


def order(rows, x, error):
    """The slope of log(error) over log(x) in the last four rows that have the error."""
    points = [(math.log(row[x]), math.log(row[error])) for row in rows if row[error] != ''][-4:]
    x_mean, y_mean = (sum(column) / len(points) for column in zip(*points))
    return (sum((x - x_mean) * (y - y_mean) for x, y in points) /
            sum((x - x_mean) ** 2 for x, _ in points))


def largest_residual(run):
    values = [run[name] for name in run if name.startswith('residuals.')]
    return max(values) if all(value != '' for value in values) else ''


def spread(values):
    values = [value for value in values if value != '']
    return f'{min(values):.2f} to {max(values):.2f}'


def printed(script, *options):
    """The tables that another script prints."""
    commands.append(shlex.join([script, 'build/rollwave', *options]))
    return subprocess.run([root / script, rollwave, *options], cwd=root, stdout=subprocess.PIPE,
                          text=True, check=True).stdout


def figures():
    rows = []
    for figure in range(4, 9):
        name = f'figure-{figure}'
        run = scene(name, options=['--verify'], repeats=2)
        error = run['error']
        rows.append([name, run['mesh']['dofs'], error['exact_force'] / run['contact']['force'],
                     error['exact_relative'], error['certified_relative'],
                     run['seconds']['total'] - run['seconds']['verification']])
    return [table(['scene', 'unknowns', 'relative error of F', 'relative error, energy norm', 'certified',
                   'seconds'], rows)] * 2


def orders():
    short, rows = [], []
    for name in ('regular', 'critical', 'cut'):
        runs = study(f'studies/order-{name}', pictures={'study-h.svg': f'order-{name}.svg'})
        for degree in (1, 2):
            own = [run for run in runs if run['Mesh/Degree'] == degree]
            expected = own[-1]['error.expected_order']
            in_h1 = '' if name == 'critical' else f'{order(own, "mesh.h_max", "error.exact_h1_norm"):.2f}'
            short.append([name, f'Q{degree}', own[-1]['mesh.dofs'], own[-1]['error.exact_relative'],
                          f'{order(own, "mesh.h_max", "error.exact_relative"):.2f}', in_h1, expected])
            rows += [[name, f'Q{degree}', run['mesh.dofs'], run['iterations.contact'], run['error.exact_relative'],
                      run['error.exact_h1_norm'], run['error.exact_l2_norm'], run['error.exact_pressure'], run['error.exact_force'],
                      run['error.exact_energy']] for run in own]
    return (table(['contact', 'elements', 'finest, unknowns', 'its error', 'order in h', 'in the H1 norm',
                   'expected'],
                  short),
            table(['contact', 'elements', 'unknowns', 'steps', 'energy norm, relative', 'H1 norm', 'L2 norm',
                   'pressure', 'F', 'J'], rows))


def adaptive():
    short, rows = [], []
    for name in ('regular', 'critical', 'cut'):
        runs = study(f'studies/adaptive-{name}', pictures={'study-time.svg': f'adaptive-{name}.svg'})
        for degree, marking in itertools.product((1, 2, 4), ('all', 'bulk')):
            own = [run for run in runs
                   if (run['Mesh/Degree'], run['Mesh/Marking']) == (degree, marking)]
            kind = 'uniform' if marking == 'all' else 'adaptive'
            last = own[-1]
            short.append([name, f'Q{degree}', kind, last['mesh.dofs'], last['error.exact_relative'],
                          f'{-2 * order(own, "mesh.dofs", "error.exact_relative"):.2f}',
                          last['error.expected_order'], last['error.certified_relative'],
                          spread([run['error.effectivity'] for run in own]), last['seconds.total']])
            rows += [[name, f'Q{degree}', kind, run['mesh.dofs'], run['iterations.contact'],
                      run['error.exact_relative'], run['error.certified_relative'], run['error.effectivity'],
                      run['seconds.total']] for run in own]
    return (table(['contact', 'elements', 'mesh', 'unknowns', 'error', 'order', 'expected',
                   'certified', 'bound / error, all meshes', 'seconds'], short),
            table(['contact', 'elements', 'mesh', 'unknowns', 'steps', 'error', 'certified',
                   'bound / error', 'seconds'], rows))


def extremes():
    runs = study('studies/extremes', {'Study/True errors': 'false'})
    chosen = ['omega b = 1 - 1e-2', 'omega b = 1 - 1e-8', 'omega b = 1', 'thin ring, b - a = 1e-2 b',
              'thin ring, b - a = 1e-4 b', 'thin ring, b - a = 1e-6 b', 'thin ring at omega b = 1',
              'small hub, a = 1e-2 b', 'small hub, a = 1e-6 b', 'hairline contact, b - c = 1e-4 b',
              'hairline contact, b - c = 1e-14 b',
              'hairline contact at omega b = 1, b - c = 1e-14 b', 'road beyond b',
              'road 1e-9 above the hub', 'b = 1e-150', 'b = 1e150', 'f = -1e8', 'f = 1e8',
              'zone cut on one side', 'zone of one node', 'touching in one point', '1 x 3 cells',
              'cells 1e4 times longer than high, Q1', 'cells 1e4 times higher than long, Q1',
              'Uzawa, rho = 3.4', 'Uzawa, rho = 100']
    rows = []
    for run in runs:
        outcome = ('solved' if run['failure'] == '' else
                   'less than wanted' if run['solved'] else 'not solved')
        rows.append([run['scene'], run['mesh.dofs'], run['iterations.contact'],
                     f'{run["contact.force"]:.9g}' if run['solved'] else '', run['error.certified_relative'],
                     largest_residual(run), run['seconds.total'], outcome])
    titles = ['scene', 'unknowns', 'steps', 'F', 'certified', 'largest residual', 'seconds', 'outcome']
    return table(titles, [row for row in rows if row[0] in chosen]), table(titles, rows)


def wanted():
    rows = []
    for name in ('figure-4', 'figure-5'):
        for error in ('1e-2', '1e-3', '1e-4', '1e-5'):
            settings = {'Mesh/Radial cells': 2, 'Mesh/Angular cells': 24,
                        'Mesh/Wanted relative error': error, 'Output/Files': 'summary'}
            run = scene(name, settings, options=['--verify'])
            rows.append([name, error, run['mesh']['dofs'], len(run['cycles']),
                         run['error']['certified_relative'], run['error']['exact_relative'] or '-',
                         run['error']['exact_force'] / run['contact']['force'],
                         run['seconds']['total'] - run['seconds']['verification']])
    return [table(['scene', 'wanted', 'unknowns', 'meshes', 'certified', 'true error',
                   'relative error of F', 'seconds'], rows)] * 2


def verified(settings):
    """The summary of figure 4, and for each quantity of the comparison with the exact solution its
    computed and exact value."""
    directory = call('figure-4', settings, options=['--verify'])
    pairs = re.findall(r'^ *(\D+?) +([-.\de]+) +([-.\de]+) .*$',
                       (directory / 'screen.txt').read_text().split('Verification')[1], re.M)
    return (json.loads((directory / 'summary.json').read_text()),
            {name: (float(computed), float(exact)) for name, computed, exact in pairs})


def accuracy():
    meshes = {'5 x 120': {'Mesh/Radial cells': 5, 'Mesh/Angular cells': 120},
              '10 x 240': {'Mesh/Radial cells': 10, 'Mesh/Angular cells': 240}, '20 x 480': {},
              'adaptive, 1e-3': {'Mesh/Radial cells': 2, 'Mesh/Angular cells': 24,
                                 'Mesh/Wanted relative error': '1e-3'}}
    columns = []
    for settings in meshes.values():
        run, values = verified(settings)
        error, loads = run['error'], run['contact']
        half_width = (loads['vertical_load_upper_bound'] - loads['vertical_load_lower_bound']) / 2
        columns.append([run['mesh']['dofs'],
                        f'{rounded_up(error["certified_relative"], 2):.2g}', f'{error["exact_relative"]:.2g}',
                        f'{rounded_up(half_width / loads["vertical_load"], 2):.2g}',
                        *(f'{abs(computed / exact - 1):.2g}' for computed, exact in (
                            values[name] for name in ('vertical load', 'half-width', 'peak pressure',
                                                      'vertical stiffness', 'energy J')))])
    names = ['unknowns', 'certified, energy norm', 'true error, energy norm',
             'vertical load, guaranteed', 'vertical load, true error', 'half-width', 'peak pressure',
             'vertical stiffness', 'energy J']
    return [table(['mesh', *meshes], zip(names, *columns))] * 2


def exact_numbers():
    """The exact numbers of each scene of the study, by the names of their columns."""
    text = (root / 'prm/studies/uncertainties.prm').read_text().replace('\\\n', ' ')
    numbers = {}
    for line in re.search(r'set Scenes = (.*)', text)[1].split(';'):
        name, settings = line.split(':')
        _, values = verified(dict(re.split(r' *= *', setting.strip()) for setting in settings.split('&')))
        exact = {words: value[1] for words, value in values.items()}
        numbers[name.strip()] = {
            'contact.length': exact['contact length (nip)'], 'contact.half_width': exact['half-width'],
            'contact.left_end': 1.5 * math.pi - exact['half-width'],
            'contact.right_end': 1.5 * math.pi + exact['half-width'],
            'contact.peak_pressure': exact.get('peak pressure'),  # infinite if the zone cuts contact
            'contact.stiffness.vertical_load': exact['vertical stiffness']}
    return numbers


def uncertainties():
    exact = exact_numbers()
    runs = study('studies/uncertainties') + study('studies/uncertainties', {
        'Study/Vary': 'Mesh/Degree = 1 | 2 | 4; Mesh/Adaptive cycles = 2 | 4 | 6 | 8'})
    words = {'contact.length': 'nip', 'contact.half_width': 'half-width', 'contact.left_end': 'left end',
             'contact.right_end': 'right end', 'contact.peak_pressure': 'peak pressure',
             'contact.stiffness.vertical_load': 'vertical stiffness'}

    def row(name, kind, chosen):
        pairs = [(run[name + '_uncertainty'], abs(run[name] - exact[run['scene']][name])) for run in chosen
                 if exact[run['scene']][name] is not None and run[name + '_uncertainty'] != '']
        round_off = 1e-11
        covered = sum(error <= estimate + round_off for estimate, error in pairs) / len(pairs)
        ratios = sorted(estimate / error for estimate, error in pairs if error > round_off)
        return [words[name], *kind, len(pairs), f'{100 * covered:.1f} %', f'{ratios[len(ratios) // 2]:.1f}']

    titles = ['runs', 'covered', 'estimate / true error, median']
    meshes = {'uniform': lambda run: 'Mesh/Adaptive cycles' not in run,
              'adaptive': lambda run: 'Mesh/Adaptive cycles' in run}
    return [table(['quantity', *titles], [row(name, [], runs) for name in words]),
            table(['quantity', 'elements', 'meshes', *titles],
                  [row(name, [f'Q{degree}', mesh], [run for run in runs if is_of_mesh(run) and
                                                    run['Mesh/Degree'] == degree])
                   for name in words for degree in (1, 2, 4) for mesh, is_of_mesh in meshes.items()])]


def uniform(degree, radial, angular):
    return {'Mesh/Degree': degree, 'Mesh/Radial cells': radial, 'Mesh/Angular cells': angular}


def phases():
    rows = []
    for degree, radial, angular in ((1, 88, 1112), (2, 44, 556), (1, 282, 3544), (2, 141, 1772)):
        run = scene('figure-4', {**uniform(degree, radial, angular),
                                 'Output/Files': 'summary, contact, solution'}, repeats=2)
        seconds = run['seconds']
        rows.append([f'Q{degree}', run['mesh']['dofs'],
                     *[sum(seconds.get(phase) or 0. for phase in group) for group in (
                         ['mesh', 'space'], ['assembly'], ['ordering', 'factorisation'], ['contact'],
                         ['back-substitution', 'measurement'], ['certificate'], ['output'],
                         ['total'])], round(run['peak_memory_mib'])])
    return [table(['elements', 'unknowns', 'mesh', 'assembly', 'factorisation', 'contact',
                   'back-substitution', 'certificate', 'files', 'total', 'MiB'], rows)] * 2


def sweep():
    rows = []
    for degree, radial, angular in ((1, 88, 1112), (2, 44, 556)):
        runs = study('figure-4', {**uniform(degree, radial, angular), 'Output/Files': 'summary',
                                  'Study/Vary': 'Road/Distance = 0.78 | 0.79 | 0.8 | 0.81 | 0.82 | 0.83'})
        others = sorted(run['seconds.total'] for run in runs[1:])
        rows.append([f'Q{degree}', runs[0]['mesh.dofs'], runs[0]['seconds.total'],
                     others[len(others) // 2]])
    return [table(['elements', 'unknowns', 'first distance, seconds', 'a further one, seconds'],
                  rows)] * 2


def processes():
    return [printed('tests/scaling.py', 'prm/figure-4.prm', '4')] * 2


def calibration():
    short, full = printed('tests/calibration.py').split('\n\n')
    return short + '\n', full


def pictures():
    for name in ('examples/two-patches', 'figure-4'):
        directory = call(name, {})
        shutil.copy(directory / 'scene.svg',
                    root / 'doc/pictures' / f'{pathlib.Path(name).name}.svg')
    roller = re.search(r'```prm\n(.*?)```', (root / 'doc/manual.md').read_text(), re.S)[1]
    (work / 'roller.prm').write_text(roller)
    subprocess.run([rollwave, work / 'roller.prm', '--output', work / 'roller'],
                   stdout=subprocess.DEVNULL)
    shutil.copy(work / 'roller/scene.svg', root / 'doc/pictures/roller.svg')
    if shutil.which('xvfb-run'):
        subprocess.run(['xvfb-run', '-a', '/usr/bin/python3', root / 'tests/screenshot.py',
                        directory, root / 'doc/pictures/paraview.png'])
    study('examples/load-deflection', pictures={'study-curves.svg': 'load-deflection.svg'})
    study('examples/speed-to-critical', pictures={'study-profiles.svg': 'speed-to-critical.svg'})
    study('examples/map-load', pictures={'study-map.svg': 'map-load.svg'})
    study('examples/drum', pictures={'study-profiles.svg': 'drum.svg'})
    study('figure-9', pictures={'study.svg': 'figure-9.svg'})


def fill(name, text):
    """Puts a table to its places in the documents."""
    place = re.compile(rf'(<!-- measured: {name} -->\n).*?(<!-- end -->)', re.S)
    for page in (root / 'README.md', *(root / 'doc').rglob('*.md')):
        before = page.read_text()
        after = place.sub(lambda match: match[1] + text + match[2], before)
        if after != before:
            page.write_text(after)


for measurement in (figures, orders, adaptive, extremes, wanted, accuracy,
                    uncertainties, phases, sweep, processes,
                    calibration, pictures):
    name = measurement.__name__
    if arguments.names and name not in arguments.names:
        continue
    print(name, flush=True)
    commands.clear()
    tables = measurement()
    if tables:
        short, full = tables
        fill(name, short)
        (root / 'doc/results' / f'{name}.md').write_text(
            f'# {name.capitalize()}\n\nWritten by `tests/measure.py {name}`, which runs\n\n```sh\n' +
            '\n'.join(commands) + '\n```\n\n' + (short + '\n' if short != full else '') + full)
shutil.rmtree(work)
