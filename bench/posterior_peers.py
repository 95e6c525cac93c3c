#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How near do posteriors come to the truth, for how many simulations? swarmfit --posterior beside pyABC (from PyPI), on recordings of tests/independent, which no simulator here has made.

    python3 posterior_peers.py PROGRAM [--truths langevin,rayleigh] [--seeds 1:2] [--simulations 1800] [--out DIR]

The peer simulates by `PROGRAM simulate` from the recording's first frame, under the prior that swarmfit uses, and sees summary statistics that a
careful user might choose: spreads of positions, velocities and accelerations, their tails, and correlations in time. The row exact is the
likelihood, where the model has one. A table row: simulations, mean |ln(median / true)| over parameters and seeds, mean width of 95 %
intervals in ln, and how many hold the truth."""
import argparse
import json
import logging
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
LAGS = (1, 3, 8, 20, 40, 80)  # frames


def columns(path):
    """Track, frame and place of every row."""
    rows = [line for line in pathlib.Path(path).read_text().splitlines() if line and not line.startswith("#")]
    head = rows[0].split(",")
    index = [next(head.index(name) for name in names if name in head) for names in (("id",), ("frame",), ("x",), ("y",), ("z",))]
    table = np.array([row.split(",") for row in rows[1:]])
    names, track = np.unique(table[:, index[0]], return_inverse=True)
    return len(names), track, table[:, index[1:]].astype(float)


def paths(path):
    count, track, table = columns(path)
    return [table[track == t][np.argsort(table[track == t][:, 0])][:, 1:] for t in range(count)]


def features(tracks, dt):
    """Of a recording or a simulation, the same for both."""
    middle = np.mean([p.mean(0) for p in tracks], 0)
    x = [p[1:-1] - middle for p in tracks]
    v = [(p[2:] - p[:-2]) / (2 * dt) for p in tracks]
    a = [(p[2:] - 2 * p[1:-1] + p[:-2]) / dt**2 for p in tracks]
    square = lambda q: np.mean([np.mean(s**2) for s in q])
    out = [np.log(square(q)) for q in (x, v, a)]
    speed = np.concatenate([np.linalg.norm(s, axis=1) for s in v])
    out += [speed.std() / speed.mean(), np.mean(speed**4) / np.mean(speed**2) ** 2]
    out += [np.mean([np.mean(s[lag:] * s[:-lag]) for s in v]) / square(v) for lag in LAGS]
    out += [np.mean([np.mean(s[lag:] * s[:-lag]) for s in a]) / square(a) for lag in LAGS[:3]]
    out.append(np.mean([np.mean(p * q) for p, q in zip(x, a)]) / square(v))
    return np.array(out)


class Problem:
    """A recording, its true model, and a simulator on the unit cube of what swarmfit searches."""

    def __init__(self, program, name, seed, out):
        self.program, self.folder = program, out / name / str(seed)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.recording, truth = self.folder / "recording.csv", self.folder / "truth.json"
        subprocess.run([sys.executable, ROOT / "tests/independent/truths.py", name, "--seed", str(seed), "--out", self.recording, "--truth",
                        truth], check=True)
        truth = json.loads(truth.read_text())
        self.model = truth["model"]
        results = self.folder / "fit" / "results.json"
        if not results.exists():
            likelihood = ["--likelihood"] if name == "langevin" else []
            subprocess.run([program, "fit", self.recording, "-m", self.model, "--budget", "quick", "--posterior", *likelihood, "--out",
                            results.parent, "-q"], check=True, stdout=subprocess.DEVNULL)
        self.fit = json.loads(results.read_text())["models"][0]
        found = self.fit["parameters"]
        self.names = [n for n, p in found.items() if p["fitted"] and truth["parameters"].get(n)]
        self.other = [n for n, p in found.items() if p["fitted"] and n not in self.names]
        self.truth = np.array([truth["parameters"][n] for n in self.names])
        self.rows = [found[n] for n in self.names + self.other]
        self.tracks = paths(self.recording)
        rows = self.recording.read_text()
        self.fps = float(next(line for line in rows.splitlines() if line.startswith("# fps")).split(":")[1])
        self.observed = features(self.tracks, 1 / self.fps)
        self.scene = self.folder / "scene.toml"
        self.scene.write_text(
            f'title = "a peer\'s simulation"\nmodel = "{self.model}"\nagents = {len(self.tracks)}\nframes = {len(self.tracks[0])}\n'
            f'fps = {self.fps:g}\nunit = "mm"\n[bounds]\nshape = "open"\n[start]\nshape = "recorded"\nfile = "{self.recording.resolve()}"\n')

    def values(self, u):
        """Parameters at a point of the cube: on logarithmic, root or linear axes, as swarmfit's search and prior have them."""
        out = []
        for at, row in zip(u, self.rows):
            low, high = row["lower"], row["upper"]
            out.append(low * (high / low) ** at if row["log"] and low > 0 else low + (at * at if low == 0 else at) * (high - low))
        return np.array(out)

    def simulate(self, u, seed):
        """Features of one run; NaN if it blew up."""
        with tempfile.NamedTemporaryFile(suffix=".csv", dir=self.folder) as file:
            settings = [f"--set={n}={v:.17g}" for n, v in zip(self.names + self.other, self.values(u))]
            done = subprocess.run([self.program, "simulate", self.scene, *settings, "--seed", str(seed), "-o", file.name, "-q"],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            with np.errstate(all="ignore"):
                return features(paths(file.name), 1 / self.fps) if done.returncode == 0 else np.full(len(self.observed), np.nan)


def quantiles(sample, weight):
    """Weighted 2.5 %, 50 % and 97.5 % points, a row per column of the sample."""
    out = []
    for column in sample.T:
        order = np.argsort(column)
        share = np.cumsum(weight[order]) / weight.sum()
        out.append([column[order][min(np.searchsorted(share, q), len(column) - 1)] for q in (0.025, 0.5, 0.975)])
    return np.array(out)


def swarmfit(problem, _):
    rows = [problem.fit["parameters"][n] for n in problem.names]
    return problem.fit["posterior"]["simulations"], np.array([[p["ci"][0], p["median"], p["ci"][1]] for p in rows])


def exact(problem, _):
    rows = [problem.fit["parameters"][n].get("likelihood") for n in problem.names]
    return (0, np.array([[low, value, high] for value, low, high in rows])) if all(rows) else None


def pyabc(problem, simulations):
    try:
        import pyabc as peer
    except ImportError:
        return None
    count = [0]

    def model(p):
        count[0] += 1
        seen = problem.simulate([p[n] for n in problem.names + problem.other], count[0])
        return {str(k): v if np.isfinite(v) else 1e6 for k, v in enumerate(seen)}

    prior = peer.Distribution(**{n: peer.RV("uniform", 0, 1) for n in problem.names + problem.other})
    search = peer.ABCSMC(model, prior, peer.AdaptivePNormDistance(p=1), population_size=100, sampler=peer.SingleCoreSampler())
    search.new("sqlite://", {str(k): v for k, v in enumerate(problem.observed)})
    history = search.run(max_total_nr_simulations=simulations, max_nr_populations=30)
    frame, weight = history.get_distribution()
    cube = frame[problem.names + problem.other].to_numpy()
    return count[0], quantiles(np.array([problem.values(u) for u in cube]), weight)[: len(problem.names)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--truths", default="langevin,rayleigh")
    parser.add_argument("--seeds", default="1:2")
    parser.add_argument("--simulations", default="1800", help="of the peer")
    parser.add_argument("--methods", default="exact,swarmfit,pyabc")
    parser.add_argument("--out", default="posterior_peers")
    a = parser.parse_args()
    logging.disable(logging.INFO)
    first, last = (int(s) for s in a.seeds.split(":"))
    print("| truth | method | simulations | mean abs. ln(median / true) | mean width, ln | hold the truth |\n|---|---|---|---|---|---|", flush=True)
    for name in a.truths.split(","):
        problems = [Problem(a.program, name, seed, pathlib.Path(a.out)) for seed in range(first, last + 1)]
        for method in a.methods.split(","):
            for budget in [int(s) for s in a.simulations.split(",")] if method == "pyabc" else [0]:
                found = [(p, globals()[method](p, budget)) for p in problems]
                if any(f is None for _, f in found):
                    continue
                off, width, held = [], [], []
                for problem, (_, q) in found:
                    with np.errstate(all="ignore"):
                        off += list(np.abs(np.log(q[:, 1] / problem.truth)))
                        width += list(np.log(q[:, 2] / q[:, 0]))
                    held += list((q[:, 0] <= problem.truth) & (problem.truth <= q[:, 2]))
                used = np.mean([f[0] for _, f in found])
                print(f"| {name} | {method} | {used:.0f} | {np.nanmean(off):.2f} | {np.nanmean(width):.2f} | {sum(held)} of {len(held)} |", flush=True)


if __name__ == "__main__":
    main()
