#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Is the model that made a recording found again? Every truth against its rivals, several data seeds each, as a table.

    python3 table.py PROGRAM [--truths brownian,boids] [--seeds 1:10] [--budget quick] [--jobs 2] [--make '--steps 40'] [--out DIR]
    python3 table.py PROGRAM --intervals ...
    python3 table.py PROGRAM --regression ...

A row says in how many recordings the true model is in the best group, alone there, and rejected (fit p <= .05), and the median of
|fitted / true - 1| of every parameter. With --intervals the true model alone is fitted, with its posterior, and the row says of every
parameter how often it is called identified, and how often its 95 % interval holds the truth. With --regression its parameters come from regression
of accelerations, and the row says the median of |value / true - 1|, and how many of the 95 % intervals hold the truth. DIR keeps the recordings and results; what
is in it is not computed again.
"""
import argparse
import concurrent.futures
import json
import pathlib
import shlex
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent

# Whom each truth is compared with, beside its own model.
RIVALS = {
    "brownian": ["langevin", "bswarm"],
    "rayleigh": ["langevin", "boids"],
    "langevin": ["brownian", "boids"],
    "bswarm_white": ["brownian", "langevin"],
    "bswarm_curl": ["bswarm[noise=white,avoidance=none]", "langevin"],
    "boids": ["zonal", "brownian"],
    "couzin": ["boids", "vicsek"],
    "vicsek": ["zonal", "boids"],
    "vicsek_periodic": ["zonal", "boids"],
    "rvo": ["boids", "langevin"],
    "noise_aware": ["langevin", "brownian"],
    "random_walk": ["zonal", "brownian", "langevin", "boids"],
    "crowd": ["brownian", "langevin", "rvo"],
    "mixture": ["brownian", "langevin", "boids"],
}


def make_truth(name, seed, directory, options=""):
    """The recording and what made it."""
    recording, truth = directory / "recording.csv", directory / "truth.json"
    if not truth.exists():
        subprocess.run([sys.executable, HERE / "truths.py", name, "--seed", str(seed), "--out", recording, "--truth", truth,
                        *shlex.split(options)], check=True)
    return recording, json.loads(truth.read_text())


def compare(program, recording, models, directory, budget, seed=1, options=""):
    """results.json of a comparison, or of a fit of one model."""
    results = directory / "results.json"
    if not results.exists():
        command = "compare" if len(models) > 1 else "fit"
        subprocess.run([program, command, recording, "-m", ",".join(models), "--budget", budget, "--seed", str(seed), "--out", directory,
                        "--quiet", *shlex.split(options)], check=True, stdout=subprocess.DEVNULL)
    return json.loads(results.read_text())


def one(a, name, seed):
    """A truth, and the result of comparing its model with its rivals or, with --intervals, of fitting it alone."""
    directory = pathlib.Path(a.out) / a.budget / name / str(seed)
    directory.mkdir(parents=True, exist_ok=True)
    recording, truth = make_truth(name, seed, directory, a.make)
    own = [truth["model"]] if truth["model"] else []
    if a.intervals:
        return truth, compare(a.program, recording, own, directory / "intervals", a.budget, seed, "--posterior " + a.options)
    if a.regression:
        searched_hardly = "--regression --max-evaluations 1 --holdout no "
        return truth, compare(a.program, recording, own, directory / "regression", a.budget, seed, searched_hardly + a.options)
    return truth, compare(a.program, recording, own + RIVALS[name], directory / "run", a.budget, seed, a.options)


def entry_of(results, model):
    return next(m for m in results["models"] if m["name"] == model)


def errors(truth, entry):
    """|fitted / true - 1| of the parameters that were searched and are not zero."""
    out = {}
    for name, value in truth["parameters"].items():
        found = entry["parameters"].get(name)
        if found and found["lower"] < found["upper"] and value:
            out[name] = abs(found["value"] / value - 1)
    return out


def summary(cases):
    """One row: counts, and medians over the recordings."""
    own = [entry_of(results, truth["model"]) for truth, results in cases]
    names = {name for (truth, _), entry in zip(cases, own) for name in errors(truth, entry)}
    off = {n: statistics.median(errors(truth, entry)[n] for (truth, _), entry in zip(cases, own)) for n in sorted(names)}
    first = [results["models"][0]["name"] == truth["model"] for truth, results in cases]
    return {"recordings": len(cases), "first": sum(first), "best_group": sum(e["group"] == 1 for e in own),
            "alone": sum(f and sum(m["group"] == 1 for m in r["models"]) == 1 for f, (_, r) in zip(first, cases)),
            "rejected": sum(e["gof_p"] <= 0.05 for e in own), "off": off, "steps": sorted({e["n_sub"] for e in own})}


def print_row(name, cases):
    if cases[0][0]["model"] is None:
        winners = [(r["models"][0]["name"], r["models"][0]["gof_p"], r["models"][0]["skill"]) for _, r in cases]
        rejected = sum(p <= 0.05 for _, p, _ in winners)
        print(f"| {name} | {len(cases)} | none of ours | – | all rejected in {rejected} | winners: "
              + ", ".join(sorted({w for w, _, _ in winners})) + " |")
        return
    s = summary(cases)
    off = ", ".join(f"{n} {100 * v:.3g} %" for n, v in s["off"].items())
    steps = ", ".join(str(n) for n in s["steps"])
    print(f"| {name} | {s['recordings']} | {s['best_group']} | {s['alone']} | {s['rejected']} | {steps} | {off} |", flush=True)


def print_intervals(name, cases):
    """Of every searched parameter: identified in how many recordings, and truth within the interval in how many."""
    searched = {}
    for truth, results in cases:
        for parameter, found in entry_of(results, truth["model"])["parameters"].items():
            value = truth["parameters"].get(parameter)
            if found.get("ci") and value is not None:
                lowest = found["lower"] if found["verdict"] == "one-sided" else found["ci"][0]  # "less than"
                searched.setdefault(parameter, []).append((found["verdict"] == "identified", lowest <= value <= found["ci"][1]))
    cells = [f"{parameter} {sum(i for i, _ in seen)}, {sum(w for _, w in seen)}" for parameter, seen in searched.items()]
    off = sum(i and not w for seen in searched.values() for i, w in seen)
    print(f"| {name} | {len(cases)} | {'; '.join(cells)} | {off} of {sum(i for seen in searched.values() for i, _ in seen)} |", flush=True)


def print_regression(name, cases):
    """Of every parameter: how far off in the median, and how many intervals hold the truth, of those that there are."""
    seen = {}
    for truth, results in cases:
        for parameter, found in entry_of(results, truth["model"])["parameters"].items():
            if "regression" in found and parameter in truth["parameters"]:
                seen.setdefault(parameter, []).append((truth["parameters"][parameter], *found["regression"]))
    cells = []
    for parameter, values in seen.items():
        off = f" {100 * statistics.median(abs(v / t - 1) for t, v, *_ in values):.2g} %" if values[0][0] else ""
        ends = [(low <= t <= high) for t, _, low, high in values if low is not None]
        cells.append(f"{parameter}{off}" + (f", {sum(ends)} of {len(ends)}" if ends else ""))
    solved = sum("regression" in entry_of(results, truth["model"]) for truth, results in cases)
    print(f"| {name} | {solved} of {len(cases)} | {'; '.join(cells)} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--truths", help="default: all, or with --regression those with forces and simple noise")
    parser.add_argument("--seeds", default="1:10")
    parser.add_argument("--budget", default="quick")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--make", default="", help="further options of truths.py")
    parser.add_argument("--options", default="", help="further options of the program")
    parser.add_argument("--intervals", action="store_true", help="of fits of the true model: do they hold the truth?")
    parser.add_argument("--regression", action="store_true", help="of the true model's accelerations: are its parameters found?")
    parser.add_argument("--out", default="independent")
    a = parser.parse_args()
    truths = a.truths or (",".join(RIVALS) if not a.regression else "brownian,rayleigh,langevin,bswarm_white")
    first, last = (int(s) for s in a.seeds.split(":"))
    if a.regression:
        print("| truth | solved | parameters: median error, intervals that hold the truth |\n|---|---|---|", flush=True)
    elif a.intervals:
        print("| truth | recordings | identified, interval holds the truth | identified and off |\n|---|---|---|---|", flush=True)
    else:
        print("| truth | recordings | in the best group | alone | rejected | steps per frame | median error of fitted parameters |")
        print("|---|---|---|---|---|---|---|", flush=True)
    with concurrent.futures.ThreadPoolExecutor(a.jobs) as pool:
        for name in truths.split(","):
            runs = [pool.submit(one, a, name, seed) for seed in range(first, last + 1)]
            cases = [run.result() for run in runs]
            (print_regression if a.regression else print_intervals if a.intervals else print_row)(name, cases)


if __name__ == "__main__":
    main()
