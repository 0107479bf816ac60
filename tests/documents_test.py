#!/usr/bin/env python3
"""The documents keep their promises: links and named files exist, commands of README and manual run,
tables are those of doc/results, and doc/parameters.md and doc/quantities.md are what the program prints.

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
pages = [readme, *own, *cookbook, *sorted((doc / 'results').glob('*.md'))]

for page in pages:
    for target in re.findall(r'\]\(([^)\s]+)\)', page.read_text()):
        if re.match(r'[a-z]+:', target):
            continue
        path, _, anchor = target.partition('#')
        file = (page.parent / path).resolve() if path else page
        require(file.exists(), f'{page.name}: {target} is not there')
        if anchor and file.exists():
            require(anchor in anchors(file), f'{page.name}: {target} has no such heading')

for page in (readme, *own, *cookbook):
    for file in set(re.findall(r'(?<![\w/.$-])prm/[\w/-]+\.prm', page.read_text())):
        require((root / file).exists(), f'{page.name}: {file} is not there')

for page in (doc / 'theory.md', doc / 'architecture.md'):
    for name in set(re.findall(r'`([a-z_]+/[a-z_]+)`', page.read_text())) - {'module/file'}:
        require((root / f'include/rollwave/{name}.h').exists(), f'{page.name}: {name} is not there')

require(len(readme.read_text().splitlines()) <= 110, 'README.md has more than 110 lines')
require(len((doc / 'theory.md').read_text().splitlines()) <= 250, 'theory.md is longer than 250 lines')

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

with tempfile.TemporaryDirectory() as place:
    (pathlib.Path(place) / 'prm').symlink_to(root / 'prm')
    for page in (readme, doc / 'manual.md'):
        for block in re.findall(r'```sh\n(.*?)```', page.read_text(), re.S):
            for line in block.replace('\\\n', ' ').splitlines():
                if line.startswith('build/rollwave'):
                    command = shlex.quote(rollwave) + line.removeprefix('build/rollwave')
                    run = subprocess.run(command, shell=True, cwd=place, capture_output=True)
                    require(run.returncode == 0, f'{page.name}: this fails: {line}')

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
