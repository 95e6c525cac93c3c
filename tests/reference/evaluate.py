#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Seven motion metrics, their discrete densities, energies and entropy weights, in plain loops.

    python3 evaluate.py REAL.csv SIM.csv [--normalisation reference|separate|none] [--bins M] [--interval LOWER UPPER] [--dt SECONDS] [--json]
    python3 evaluate.py weigh TABLE.csv [--json]

REAL and SIM have the header id,frame,t,x,y[,z]; lines that begin with '#' are comments. TABLE has a header whose first column names the
models and whose further columns are energies. Standard library only. See README.md for where this comes from and what it is for.
"""

import argparse
import csv
import json
import math
import sys

METRICS = ("v", "a", "omega", "alpha", "mu", "d", "eta")
STANDARD = {  # normalisation: (lower, upper, bins, samples outside count in the end bins)
    "reference": (-5.0, 10.0, 150, True),
    "separate": (-5.0, 5.0, 100, False),
    "none": (-5.0, 5.0, 100, True),
}


# ---- reading -------------------------------------------------------------------------------------------------------------------

def read_table(path):
    """Rows of a CSV file as dictionaries, comments left out."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if line.strip() and not line.startswith("#")))


def read_tracks(path):
    """{id: {frame: (x, y, z)}} in the order of the file, and the frame interval."""
    tracks, first, last = {}, None, None
    for row in read_table(path):
        frame, t = int(row["frame"]), float(row["t"])
        tracks.setdefault(row["id"], {})[frame] = (float(row["x"]), float(row["y"]), float(row.get("z") or 0.0))
        first = min(first, (frame, t)) if first else (frame, t)
        last = max(last, (frame, t)) if last else (frame, t)
    if first is None or last[0] == first[0]:
        raise SystemExit(f"{path}: no frame interval; expected at least two frames")
    return tracks, (last[1] - first[1]) / (last[0] - first[0])


# ---- metrics -------------------------------------------------------------------------------------------------------------------

def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(sum(x * x for x in a))


def turning(a, b):
    return math.atan2(norm(cross(a, b)), sum(x * y for x, y in zip(a, b)))


def median(values):
    ordered = sorted(values)
    n = len(ordered)
    return (ordered[(n - 1) // 2] + ordered[n // 2]) / 2 if n else math.nan


def velocities(tracks, dt):
    """{id: {frame: velocity}} wherever the next frame exists."""
    return {
        name: {k: tuple(s / dt for s in minus(path[k + 1], p)) for k, p in path.items() if k + 1 in path}
        for name, path in tracks.items()
    }


def nearest(tracks):
    """{(id, frame): (distance, id of the nearest other)}; of equally near ones the first in the file."""
    present = {}
    for name, path in tracks.items():
        for k, p in path.items():
            present.setdefault(k, []).append((name, p))
    found = {}
    for k, group in present.items():
        for name, p in group:
            others = [(norm(minus(q, p)), i, other) for i, (other, q) in enumerate(group) if other != name]
            if others:
                distance, _, who = min(others)
                found[name, k] = (distance, who)
    return found


def metrics(tracks, dt):
    """{metric: list of defined values}."""
    out = {name: [] for name in METRICS}
    velocity = velocities(tracks, dt)
    slow = 1e-9 * median([norm(v) for path in velocity.values() for v in path.values()])

    def omega(v, k):
        """Angular velocity at frame k, None where it is undefined."""
        speeds = (norm(v[k]), norm(v[k + 1]))
        return None if min(speeds) < slow or min(speeds) == 0 else turning(v[k], v[k + 1]) / dt

    for v in velocity.values():
        for k in sorted(v):
            out["v"].append(norm(v[k]))
            if k + 1 not in v:
                continue
            out["a"].append(norm(minus(v[k + 1], v[k])) / dt)
            now = omega(v, k)
            if now is not None:
                out["omega"].append(now)
            if k + 2 not in v:
                continue
            later = omega(v, k + 1)
            if now is not None and later is not None:
                out["alpha"].append((later - now) / dt)
            out["mu"].append(norm(minus(minus(v[k + 2], v[k + 1]), minus(v[k + 1], v[k]))) / dt**2)

    for (name, k), (distance, who) in nearest(tracks).items():
        out["d"].append(distance)
        if k in velocity[name] and k in velocity[who] and distance >= 1e-9:
            out["eta"].append(abs(norm(velocity[who][k]) - norm(velocity[name][k])) / distance)
    return out


def natural_scales(values, dt):
    """What the mean speed, the mean distance and the frame interval make of each metric's unit."""
    v, d = mean(values["v"]), mean(values["d"])
    return dict(zip(METRICS, (v, v / dt, 1 / dt, 1 / dt**2, v / dt**2, d, v / d if d > 0 else 0.0)))


# ---- densities and energies ----------------------------------------------------------------------------------------------------

def mean(values):
    return math.fsum(values) / len(values) if values else math.nan


def deviation(values):
    middle = mean(values)
    return math.sqrt(math.fsum((x - middle) ** 2 for x in values) / len(values)) if values else math.nan


def percentile(values, share):
    ordered = sorted(values)
    place = share * (len(ordered) - 1)
    low = math.floor(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def varies(values, natural):
    """Is there a spread beyond rounding?"""
    return bool(values) and deviation(values) > 0 and deviation(values) >= 1e-9 * natural


def z_score(values):
    """Shift and scale."""
    return mean(values), max(deviation(values), 0.01 * abs(mean(values)))


def density(values, shift, scale, lower, upper, bins, clip):
    """Q_i = S_i M / (S (u2 - u1)) of z = (x - shift)/scale, and how many samples lie outside."""
    counts, outside = [0] * bins, 0
    for x in values:
        z = (x - shift) / scale
        if lower <= z <= upper:
            counts[min(math.floor((z - lower) * bins / (upper - lower)), bins - 1)] += 1
        else:
            outside += 1
            if clip:
                counts[0 if z < lower else bins - 1] += 1
    return [n * bins / (len(values) * (upper - lower)) for n in counts], outside


def energy(real, sim, natural_real, natural_sim, normalisation, lower, upper, bins, clip):
    """Energy of one metric and the samples outside; NaN where it is undefined."""
    undefined = math.nan, (0, 0)
    if not varies(real, natural_real) or not sim:
        return undefined
    of_real = of_sim = z_score(real)
    if normalisation == "separate":
        if not varies(sim, natural_sim):
            return undefined
        of_sim = z_score(sim)
    if normalisation == "none":  # the recording's 0.5 % .. 99.5 % range is laid on [lower, upper]
        low, high = percentile(real, 0.005), percentile(real, 0.995)
        if high == low:
            return undefined
        scale = (high - low) / (upper - lower)
        of_real = of_sim = (low - scale * lower, scale)
    q_real, out_real = density(real, *of_real, lower, upper, bins, clip)
    q_sim, out_sim = density(sim, *of_sim, lower, upper, bins, clip)
    return math.fsum(abs(a - b) for a, b in zip(q_real, q_sim)), (out_real, out_sim)


def evaluate(real_path, sim_path, normalisation="reference", bins=None, interval=None, dt=None):
    lower, upper, standard_bins, clip = STANDARD[normalisation]
    lower, upper = interval or (lower, upper)
    bins = bins or standard_bins
    sets = []
    for path in (real_path, sim_path):
        tracks, own = read_tracks(path)
        values = metrics(tracks, dt or own)
        sets.append((values, natural_scales(values, dt or own)))
    (real, natural_real), (sim, natural_sim) = sets
    energies, outside = {}, {}
    for name in METRICS:
        energies[name], outside[name] = energy(
            real[name], sim[name], natural_real[name], natural_sim[name], normalisation, lower, upper, bins, clip)

    def both(what):
        return {"real": {m: what(real[m]) for m in METRICS}, "sim": {m: what(sim[m]) for m in METRICS}}

    return {
        "normalisation": normalisation,
        "interval": [lower, upper],
        "bins": bins,
        "raw_energies": energies,
        "samples": both(len),
        "mean": both(mean),
        "sd": both(deviation),
        "outside": {"real": {m: outside[m][0] for m in METRICS}, "sim": {m: outside[m][1] for m in METRICS}},
    }


# ---- entropy weights and score -------------------------------------------------------------------------------------------------

def entropy_weights(table):
    """Weights, p1, p2 and entropies of the columns of a table of energies (rows: models)."""
    models, columns = len(table), len(table[0])
    weights, p1, p2, entropies, usable = [0.0] * columns, [math.nan] * columns, [math.nan] * columns, [math.nan] * columns, []
    for j in range(columns):
        x = [row[j] for row in table]
        if not all(map(math.isfinite, x)):
            continue
        usable.append(j)
        p1[j], p2[j] = min(x), max(x) - min(x)
        if models == 1:
            continue
        r = [1 - ((value - p1[j]) / p2[j] if p2[j] else 0.0) for value in x]
        g = [value / math.fsum(r) for value in r]
        entropies[j] = -math.fsum(value * math.log(value) for value in g if value > 0) / math.log(models) if p2[j] else 1.0
        weights[j] = 1 - entropies[j]
    total = math.fsum(weights)
    for j in usable:
        weights[j] = weights[j] / total if total else 1 / len(usable)
    return weights, p1, p2, entropies


def score(row, weights, p1, p2):
    if not any(weights):
        return math.nan
    return 1 - math.fsum(w * ((x - low) / width if width else 0.0) for x, w, low, width in zip(row, weights, p1, p2) if w)


def weigh(path):
    rows = read_table(path)
    names = list(rows[0])
    label, columns = names[0], names[1:]
    table = [[float(row[c] or "nan") for c in columns] for row in rows]
    weights, p1, p2, entropies = entropy_weights(table)
    return {
        "weights": dict(zip(columns, weights)),
        "p1": dict(zip(columns, p1)),
        "p2": dict(zip(columns, p2)),
        "entropy": dict(zip(columns, entropies)),
        "models": [
            {"name": row[label], "score": score(x, weights, p1, p2), "energies": dict(zip(columns, x))} for row, x in zip(rows, table)
        ],
    }


# ---- the program ---------------------------------------------------------------------------------------------------------------

def without_nan(value):
    """JSON knows no NaN: null instead."""
    if isinstance(value, dict):
        return {k: without_nan(v) for k, v in value.items()}
    if isinstance(value, list):
        return [without_nan(v) for v in value]
    return None if isinstance(value, float) and math.isnan(value) else value


def print_plain(result, indent=""):
    for key, value in result.items():
        if isinstance(value, dict):
            print(f"{indent}{key}")
            print_plain(value, indent + "  ")
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for entry in value:
                print_plain(entry, indent + "  ")
        else:
            print(f"{indent}{key:<14} {value}")


def main(arguments):
    weighing = arguments[:1] == ["weigh"]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    if weighing:
        parser.add_argument("table")
    else:
        parser.add_argument("real")
        parser.add_argument("sim")
        parser.add_argument("--normalisation", choices=list(STANDARD), default="reference")
        parser.add_argument("--bins", type=int)
        parser.add_argument("--interval", type=float, nargs=2)
        parser.add_argument("--dt", type=float, help="frame interval [s]; default: from the column t")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args(arguments[1:] if weighing else arguments)
    if weighing:
        result = weigh(options.table)
    else:
        result = evaluate(options.real, options.sim, options.normalisation, options.bins, options.interval, options.dt)
    if options.json:
        json.dump(without_nan(result), sys.stdout, indent=2)
        print()
    else:
        print_plain(result)


if __name__ == "__main__":
    main(sys.argv[1:])
