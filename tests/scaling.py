"""Strong and weak scaling of the iterative kind: tables in Markdown.

Usage: scaling.py ROLLWAVE FILE.prm [RANKS]    (from 1 to RANKS by doubling; default 2)

Ratios are of runs in turn, the better of two each. Seconds are those of summary.json, without the
start of the processes. The solve is all from the degrees of freedom to the displacement.
"""

import json
import os
import subprocess
import sys
import tempfile

SOLVE = ["space", "assembly", "preconditioner", "contact"]
PHASES = ["mesh"] + SOLVE + ["certificate"]


def run(program, scene, ranks, degree, radial, angular):
    """The summary of the faster of two runs."""
    best = None
    for _ in range(2):
        with tempfile.TemporaryDirectory() as directory:
            settings = {"Mesh/Degree": degree, "Mesh/Radial cells": radial // degree,
                        "Mesh/Angular cells": angular // degree, "Solver/Kind": "iterative",
                        "Output/Files": "summary"}
            command = ["mpirun", "--oversubscribe", "-np", str(ranks), program, scene,
                       "--output", directory]
            for key, value in settings.items():
                command += ["--set", f"{key}={value}"]
            environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1",
                               OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OPENBLAS_NUM_THREADS="1")
            subprocess.run(command, check=True, env=environment, stdout=subprocess.DEVNULL)
            with open(os.path.join(directory, "summary.json")) as file:
                summary = json.load(file)
        if best is None or summary["seconds"]["total"] < best["seconds"]["total"]:
            best = summary
    return best


def table(title, program, scene, ranks, cells):
    print(f"\n{title}\n")
    columns = ["ranks", "degree", "unknowns", "CG iterations"] + PHASES + \
        ["total", "speed-up", "of the solve", "MiB of a rank"]
    print("| " + " | ".join(columns) + " |")
    print("|" + "---|" * len(columns))
    for degree in (1, 2):
        first = None
        for n in ranks:
            summary = run(program, scene, n, degree, *cells(n))
            seconds = summary["seconds"]
            dofs = summary["mesh"]["dofs"]
            rates = [dofs / seconds["total"], dofs / sum(seconds[phase] for phase in SOLVE)]
            first = first or rates
            row = [n, degree, summary["mesh"]["dofs"], summary["iterations"]["linear"]] + \
                [f"{seconds.get(phase, 0):.2f}" for phase in PHASES] + \
                [f"{seconds['total']:.2f}"] + \
                [f"{rate / one:.2f}" for rate, one in zip(rates, first)] + \
                [f"{summary['peak_memory_mib']:.0f}"]
            print("| " + " | ".join(str(entry) for entry in row) + " |", flush=True)


def main():
    program, scene = sys.argv[1:3]
    most = int(sys.argv[3]) if len(sys.argv) > 3 else 2
    ranks = [1 << k for k in range(most.bit_length()) if 1 << k <= most]
    table("Strong scaling", program, scene, ranks, lambda n: (256, 3584))
    table("Weak scaling: speed-up is that of unknowns per second", program, scene, ranks,
          lambda n: (128, 1792 * n))


main()
