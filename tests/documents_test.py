#!/usr/bin/env python3
"""Checks the documents: links and named files exist, commands run and print what the
documents quote, options of all commands are accepted, tables are those of doc/results, and
doc/parameters.md and doc/quantities.md are what the program prints.

Usage: documents_test.py ROOT ROLLWAVE [--write]      (--write renews these two)
"""
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

root, rollwave = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())
doc = root / 'doc'
readme, parameters, quantities = root / 'README.md', doc / 'parameters.md', doc / 'quantities.md'
faults = []


def require(holds, fault):
    if not holds:
        faults.append(fault)


def anchors(path):
    headings = re.findall(r'^#+ (.*)$', path.read_text(), re.M)
    return {re.sub(r'[^\w -]', '', heading.lower()).replace(' ', '-') for heading in headings}


own = [path for path in doc.glob('*.md') if path not in (parameters, quantities)]
cookbook = sorted((doc / 'cookbook').glob('*.md'))
installed = [root / name for name in
             ('README.md', 'LICENSE', 'CITATION.cff', 'doc', 'prm', 'tests/README.md')]
pages = [readme, *own, *cookbook, *sorted((doc / 'results').glob('*.md'))]

for page in pages:
    for target in re.findall(r'\]\(([^)\s]+)\)', page.read_text()):
        if re.match(r'[a-z]+:', target):
            continue
        path, _, anchor = target.partition('#')
        file = (page.parent / path).resolve() if path else page
        require(file.exists(), f'{page.name}: {target} is not there')
        require(any(file == place or place in file.parents for place in installed),
                f'{page.name}: {target} is not installed')
        if anchor and file.exists():
            require(anchor in anchors(file), f'{page.name}: {target} has no such heading')

for page in (readme, *own, *cookbook):
    for file in set(re.findall(r'(?<![\w/.$-])prm/[\w/-]+\.prm', page.read_text())):
        require((root / file).exists(), f'{page.name}: {file} is not there')

for page in (doc / 'theory.md', doc / 'architecture.md', doc / 'contributing.md'):
    names = set(re.findall(r'`([a-z_]+/[a-z_]+)`', page.read_text()))
    for name in names - {'module/file', 'doc/results', 'doc/pictures'}:
        require((root / f'include/rollwave/{name}.h').exists(), f'{page.name}: {name} is not there')

require(len(readme.read_text().splitlines()) <= 110, 'README.md has more than 110 lines')
require(len((doc / 'theory.md').read_text().splitlines()) <= 420, 'theory.md is longer than 420 lines')

for file in sorted((root / 'prm').rglob('*.prm')):
    name = file.relative_to(root).as_posix()
    require(any(name in page.read_text() for page in cookbook), f'no page of the cookbook has {name}')
    require(file.read_text().startswith('#'), f'{name} does not begin with a comment')

for page in (readme, *own):
    measured = r'<!-- measured: (\w+) -->\n(.*?)\n<!-- end -->'
    for name, table in re.findall(measured, page.read_text(), re.S):
        results = doc / f'results/{name}.md'
        require(results.exists() and table in results.read_text(),
                f'{page.name}: its table is not that of {results.name}; renew it by tests/measure.py')

for picture in (doc / 'pictures').iterdir():
    require(f'(pictures/{picture.name})' in (doc / 'gallery.md').read_text(),
            f'gallery.md does not show {picture.name}')


def call(command, place):
    return subprocess.run(command.replace('build/rollwave', shlex.quote(rollwave), 1), shell=True,
                          cwd=place, capture_output=True, text=True)


number = re.compile(r'[+-]?\b\d[\d.]*(?:e[+-]?\d+)?\b')


def is_quoted(quoted, printed):
    """True if a quoted line is the beginning of a printed one, with numbers that agree to 1 %. Residuals
    are round-off, and versions differ. "..." stands for the rest, and # begins an explanation."""
    quoted = re.split(r'\.\.\.|\s#\s', quoted)[0]
    words, printed_words = (' '.join(number.sub('0', line).split()) for line in (quoted, printed))
    pairs = list(zip(number.findall(quoted), number.findall(printed)))
    return printed_words.startswith(words) and (
        words.startswith(('Residuals', 'Rollwave')) or
        all(abs(float(one) - float(other)) <= 0.01 * abs(float(one)) for one, other in pairs))


def quoted_lines_missing(quoted, printed):
    """The lines of a quoted screen that the printed one does not have."""
    return [line for line in quoted.splitlines()
            if not any(is_quoted(line, printed_line) for printed_line in printed.splitlines())]


def quick(command):
    """A shipped study may take minutes: only its options are tried."""
    return command + ' --parameters' if 'prm/studies/' in command else command


def try_page(page, place):
    """Does as a reader: keeps the parameter files, runs the commands, compares the screen."""
    screen = ''
    for kind, block in re.findall(r'^```(\w*)\n(.*?)^```$', page.read_text(), re.S | re.M):
        if kind == 'prm':  # its first line names the file, which the block is appended to
            with open(place / re.match(r'# ([\w-]+\.prm)', block)[1], 'a') as file:
                file.write(block)
        elif kind == 'python':
            run = subprocess.run([sys.executable, '-c', block], cwd=place, capture_output=True)
            require(run.returncode == 0, f'{page.name}: this fails:\n{block}')
        elif kind == 'text':
            for line in quoted_lines_missing(block, screen):
                require(False, f'{page.name}: the program does not print: {line}')
        elif kind == 'sh':
            for line in block.replace('\\\n', ' ').splitlines():
                if line.startswith(('build/rollwave', 'touch')):
                    run = call(quick(line), place)
                    screen = run.stdout
                    require(run.returncode == 0 and 'not drawn' not in screen,
                            f'{page.name}: this fails: {line}')


tried = (readme, doc / 'manual.md', doc / 'cookbook/tutorial.md')
with tempfile.TemporaryDirectory() as directory:
    place = pathlib.Path(directory)
    (place / 'prm').symlink_to(root / 'prm')
    for page in tried:
        try_page(page, place)
    for page in {*own, *cookbook} - set(tried):  # studies may take minutes: their options only
        for command in re.findall(r'build/rollwave [^`\n]*\.prm(?: [^`\n]*)?',
                                  page.read_text().replace('\\\n', ' ')):
            if 'FILE' not in command:
                run = call(command + ' --parameters', place)
                require(run.returncode == 0, f'{page.name}: {command}: {run.stderr}')


def require_printed(page, title, option, fence):
    printed = subprocess.run([rollwave, option], capture_output=True, text=True, check=True).stdout
    current = (f'# {title}\n\nThe program prints this page by\n\n```sh\nbuild/rollwave {option}\n```\n\n'
               + fence + printed.strip() + '\n' + fence).rstrip() + '\n'
    if '--write' in sys.argv:
        page.write_text(current)
    require(page.exists() and page.read_text() == current,
            f'{page.name} is not what the program prints; renew it by '
            'python3 tests/documents_test.py . build/rollwave --write')


require_printed(parameters, 'Parameters', '--parameters', '```\n')
require_printed(quantities, 'Quantities', '--quantities', '')

print('\n'.join(faults))
sys.exit(len(faults) > 0)
