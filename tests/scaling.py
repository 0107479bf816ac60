"""Strong and weak scaling of the iterative kind: tables in Markdown.

Usage: scaling.py ROLLWAVE FILE.prm [RANKS]    (from 1 to RANKS by doubling; default 2)

Each rank has one core and no threads, also a single one. Cases run in turn, five times; the fastest run
counts. Runs "apart" do not communicate: if they are slower than one run alone, the cores share a
resource such as memory bandwidth. Seconds are those of summary.json. "of the solve" is the speed-up of the
phases space, assembly, preconditioner and contact together.
"""

import json
import os
import subprocess
import sys
import tempfile

SOLVE = ["space", "assembly", "preconditioner", "contact"]
PHASES = ["mesh"] + SOLVE + ["certificate"]


def start(program, scene, ranks, degree, radial, angular, directory):
    settings = {"Mesh/Degree": degree, "Mesh/Radial cells": radial // degree,
                "Mesh/Angular cells": angular // degree, "Solver/Kind": "iterative",
                "Output/Files": "summary"}
    command = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    if ranks > os.cpu_count():
        command.insert(1, "--oversubscribe")  # which costs: ranks that wait yield their core
    command += [program, scene, "--output", directory]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OPENBLAS_NUM_THREADS="1",
                       DEAL_II_NUM_THREADS="1")
    return subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)


def total(summary):
    return summary["seconds"]["total"]


def run(program, scene, runs, ranks, degree, radial, angular):
    """The slowest summary of runs side by side."""
    with tempfile.TemporaryDirectory() as directory:
        places = [os.path.join(directory, str(k)) for k in range(runs)]
        for process in [start(program, scene, ranks, degree, radial, angular, place)
                        for place in places]:
            if process.wait() != 0:
                sys.exit("a run has failed")
        summaries = []
        for place in places:
            with open(os.path.join(place, "summary.json")) as file:
                summaries.append(json.load(file))
        return max(summaries, key=total)


def table(title, program, scene, cases):
    """Of cases (name, runs side by side, ranks of each, radial cells, angular cells)."""
    print(f"\n{title}\n")
    columns = ["ranks", "degree", "unknowns", "CG iterations"] + PHASES + \
        ["total", "speed-up", "of the solve", "MiB of a rank"]
    print("| " + " | ".join(columns) + " |")
    print("|" + "---|" * len(columns))
    for degree in (1, 2):
        first = None
        turns = [[run(program, scene, *numbers, degree, radial, angular)
                  for _, *numbers, radial, angular in cases] for _ in range(5)]
        for (name, runs, *_), *of_case in zip(cases, *turns):
            summary = min(of_case, key=total)
            seconds = summary["seconds"]
            dofs = runs * summary["mesh"]["dofs"]
            rates = [dofs / seconds["total"], dofs / sum(seconds[phase] for phase in SOLVE)]
            first = first or rates
            row = [name, degree, dofs, summary["iterations"]["linear"]] + \
                [f"{seconds.get(phase, 0):.2f}" for phase in PHASES] + \
                [f"{seconds['total']:.2f}"] + \
                [f"{rate / one:.2f}" for rate, one in zip(rates, first)] + \
                [f"{summary['peak_memory_mib']:.0f}"]
            print("| " + " | ".join(str(entry) for entry in row) + " |", flush=True)


def main():
    program, scene = sys.argv[1:3]
    most = int(sys.argv[3]) if len(sys.argv) > 3 else 2
    ranks = [1 << k for k in range(most.bit_length()) if 1 << k <= most]
    strong = []
    for n in ranks:
        strong.append((n, 1, n, 256, 3584))
        if n > 1:
            strong.append((f"{n} apart", n, 1, 256, 3584 // n))
    table("Strong scaling; apart: as many runs of one process each, side by side", program, scene,
          strong)
    table("Weak scaling: speed-up is that of unknowns per second", program, scene,
          [(n, 1, n, 128, 1792 * n) for n in ranks])


main()
