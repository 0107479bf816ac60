#!/usr/bin/env python3
"""Time and memory of the same scenes on more processes: a table in Markdown.

Usage: tests/scaling.py ROLLWAVE FILE.prm [PROCESSES]    (from 1 to PROCESSES by doubling; default 4)

Every process has one thread. Runs take turns, three times each, and the fastest one counts. "seconds" are
those of summary.json; "wall" is the time of the whole command, with the start of the program and of MPI.
Where there are more processes than cores, wall times are not those of as many cores: see the processor
seconds of all processes together and of the busiest one. A process that waits for messages counts as busy.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import time

SCENES = [
    ('adaptive to 1e-5', {'Mesh/Radial cells': 2, 'Mesh/Angular cells': 24,
                          'Mesh/Wanted relative error': 1e-5}),
    ('96 x 1194 cells', {'Mesh/Radial cells': 96, 'Mesh/Angular cells': 1194}),
    ('288 x 3456 linear cells', {'Mesh/Degree': 1, 'Mesh/Radial cells': 288, 'Mesh/Angular cells': 3456}),
    ('29 x 272 cells, 3 refinements', {'Mesh/Radial cells': 29, 'Mesh/Angular cells': 272,
                                       'Mesh/Global refinements': 3}),
]


def processor_seconds(file):
    """The processor time of a process by the last line of what a shell's "times" has written."""
    with open(file) as lines:
        parts = re.findall(r'(\d+)m([\d.]+)s', list(lines)[-1])
    return sum(60 * int(minutes) + float(seconds) for minutes, seconds in parts)


def run(program, scene, processes, settings):
    """Wall time, processor seconds of all processes and of the busiest one, and summary.json."""
    command = ['mpirun', '-np', str(processes), '--bind-to', 'none', '--oversubscribe'] if processes > 1 else []
    command += ['sh', '-c', '"$@"; code=$?; times > $TIMES/${OMPI_COMM_WORLD_RANK:-0}; exit $code', 'sh']
    command += [program, scene]
    for key, value in {**settings, 'Output/Files': 'summary'}.items():
        command += ['--set', f'{key}={value}']
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1',
                       OPENBLAS_NUM_THREADS='1', OMP_NUM_THREADS='1')
    with tempfile.TemporaryDirectory() as directory, tempfile.TemporaryDirectory() as times:
        environment['TIMES'] = times
        begin = time.monotonic()
        subprocess.run([*command, '--output', directory], env=environment, stdout=subprocess.DEVNULL, check=True)
        wall = time.monotonic() - begin
        busy = [processor_seconds(os.path.join(times, rank)) for rank in os.listdir(times)]
        with open(os.path.join(directory, 'summary.json')) as file:
            return wall, sum(busy), max(busy), json.load(file)


def main():
    program, scene = sys.argv[1:3]
    most = int(sys.argv[3]) if len(sys.argv) > 3 else 4
    counts = [1 << k for k in range(most.bit_length()) if 1 << k <= most]
    titles = ['scene', 'processes', 'unknowns', 'seconds', 'wall', 'wall, times that of one',
              'processor seconds of all', 'of the busiest', 'MiB of the largest process', 'times that of one']
    print('| ' + ' | '.join(titles) + ' |\n|' + ' --- |' * len(titles))
    for name, settings in SCENES:
        turns = [[run(program, scene, n, settings) for n in counts] for _ in range(3)]
        fastest = [min(runs, key=lambda timed: timed[0]) for runs in zip(*turns)]
        wall_of_one, memory_of_one = fastest[0][0], fastest[0][-1]['peak_memory_mib']
        for n, (wall, busy, busiest, summary) in zip(counts, fastest):
            memory = summary['peak_memory_mib']
            print(f'| {name} | {n} | {summary["mesh"]["dofs"]} | {summary["seconds"]["total"]:.2f} | {wall:.2f} | '
                  f'{wall / wall_of_one:.2f} | {busy:.1f} | {busiest:.1f} | {memory:.0f} | {memory / memory_of_one:.2f} |', flush=True)


main()
