#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Are planted forces found again by regression (swarmfit measure)? As a table.

    python3 forces.py PROGRAM [--seeds 1:20]

Per truth and camera: median of found / true of drag and stiffness, and how many intervals of +- 1.96 standard errors hold the truth.
"""
import argparse
import csv
import pathlib
import shlex
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent

# Truth, its options, what its drag is at a speed, its stiffness.
CASES = [
    ("brownian", "", lambda v: 1.67, 5),
    ("brownian", "--error 0.04", lambda v: 1.67, 5),
    ("brownian", "--fps 25 --seconds 10", lambda v: 1.67, 5),
    ("brownian", "--gaps 0.005 --presence irregular", lambda v: 1.67, 5),
    ("langevin", "", lambda v: 1 / 0.6, 5),
    ("langevin", "--error 0.04", lambda v: 1 / 0.6, 5),
    ("langevin", "--fps 25 --seconds 10", lambda v: 1 / 0.6, 5),
    ("langevin", "--gaps 0.005 --presence irregular", lambda v: 1 / 0.6, 5),
    ("rayleigh", "", lambda v: 5e-5 * v * v - 2, 5),
    ("rayleigh", "--error 0.04", lambda v: 5e-5 * v * v - 2, 5),
]


def curve(path):
    """x, value and standard error of the middle of a curve."""
    rows = list(csv.reader(path.read_text().splitlines()))[1:]
    return [float(x) for x in rows[len(rows) // 2]]


def one(program, name, options, seed):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        subprocess.run([sys.executable, HERE / "truths.py", name, "--seed", str(seed), "--out", folder / "recording.csv", *shlex.split(options)],
                       check=True, stdout=subprocess.DEVNULL)
        subprocess.run([program, "measure", folder / "recording.csv", "--out", folder / "run"], check=True, stdout=subprocess.DEVNULL)
        return curve(folder / "run/tables/drag.csv"), curve(folder / "run/tables/stiffness.csv")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seeds", default="1:20")
    a = parser.parse_args()
    first, last = (int(s) for s in a.seeds.split(":"))
    print("| truth | camera | drag | holds the truth | stiffness | holds the truth |\n|---|---|---|---|---|---|")
    for name, options, drag, stiffness in CASES:
        found = [one(a.program, name, options, seed) for seed in range(first, last + 1)]
        ratios, holds = [[], []], [0, 0]
        for curves in found:
            for k, (x, value, se) in enumerate(curves):
                true = drag(x) if k == 0 else stiffness
                ratios[k].append(value / true)
                holds[k] += abs(value - true) <= 1.96 * se
        n = len(found)
        print(f"| `{name}` | {options or '-'} | {statistics.median(ratios[0]):.2f} | {holds[0]} of {n} "
              f"| {statistics.median(ratios[1]):.2f} | {holds[1]} of {n} |", flush=True)


if __name__ == "__main__":
    main()
