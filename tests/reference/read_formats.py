#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What recordings in other programs' containers hold, by readers that share no code with swarmfit: h5py, NumPy and Python's own sqlite3,
zipfile and xml.

    python3 read_formats.py FOLDER             prints a row per file: tracks, rows, frames, first and last position
    python3 read_formats.py FOLDER PROGRAM     compares each with what PROGRAM (swarmfit) reads; exit 1 when one differs

FOLDER is not part of the repository: real files of real trackers, under the names in CASES. Exit 77 (skipped), loudly, when it is absent.
"""

import csv
import io
import json
import math
import pickletools
import sqlite3
import subprocess
import sys
import xml.etree.ElementTree as xml
import zipfile
from pathlib import Path

SKIPPED = 77

try:
    import h5py
    import numpy as np
except ImportError as error:
    print(f"SKIPPED: {error}; the comparison of readers needs Debian's python3-numpy and python3-h5py", file=sys.stderr)
    sys.exit(SKIPPED)


def rows_of_wide(names, positions):
    """positions: track x frame x axis; NaN: not seen."""
    return [(str(names[k]), f, *map(float, positions[k, f]))
            for k in range(positions.shape[0]) for f in range(positions.shape[1]) if np.isfinite(positions[k, f]).all()]


def idtracker(path):
    with h5py.File(path) as file:
        names = [n if isinstance(n, str) else n.decode() for n in file.attrs["identities_labels"]]
        return rows_of_wide(names, np.moveaxis(file["trajectories"][:], 1, 0)), file.attrs["frames_per_second"], "px"


def sleap(path, node):
    with h5py.File(path) as file:
        tracks = file["tracks"][:]  # track, axis, node, frame
        nodes = [n.decode() for n in file["node_names"][:]]
        names = [n.decode() if isinstance(n, bytes) else n for n in file["track_names"][:]] or range(tracks.shape[0])
        points = np.nanmean(tracks, axis=2) if node == "mean" else tracks[:, :, nodes.index(node)]
        return rows_of_wide(names, np.moveaxis(points, 1, 2)), None, "px"


def pedestrian(path):
    with h5py.File(path) as file:
        table = file["trajectory"]
        return [(str(r["id"]), int(r["frame"]), float(r["x"]), float(r["y"])) for r in table[:]], table.attrs["fps"], "m"


def jupedsim(path):
    db = sqlite3.connect(f"file:{path}?mode=ro&immutable=1", uri=True)
    fps = float(db.execute("select value from metadata where key = 'fps'").fetchone()[0])
    return [(str(i), f, x, y) for f, i, x, y in db.execute("select frame, id, pos_x, pos_y from trajectory_data")], fps, "m"


def fasttrack(path):
    db = sqlite3.connect(f"file:{path}?mode=ro&immutable=1", uri=True)
    return [(str(i), f, x, y) for f, i, x, y in db.execute("select imageNumber, id, xBody, yBody from tracking")], None, "px"


# file, reader, flags of the program
CASES = [
    ("idtrackerai/trajectories.h5", idtracker, []),
    ("sleap/SLEAP_single-mouse_EPM.analysis.h5", lambda p: sleap(p, "centroid"), ["--node", "centroid", "--fps", "30"]),
    ("sleap/SLEAP_single-mouse_EPM.analysis.h5", lambda p: sleap(p, "mean"), ["--node", "mean", "--fps", "30"]),
    ("sleap/SLEAP_three-mice_Aeon_mixed-labels.analysis.h5", lambda p: sleap(p, "centroid"), ["--fps", "50"]),
    ("sleap/small_robot.000_small_robot_3_frame.analysis.h5", lambda p: sleap(p, "mean"), ["--node", "mean", "--fps", "10"]),
    ("juelich/00_01a.h5", pedestrian, []),
    ("jupedsim/trajectories.sqlite", jupedsim, []),
    ("fasttrack/tracking.db", fasttrack, ["--fps", "25"]),
]


def facts(rows):
    """Sorted as swarmfit writes them: by frame, then by track in natural order."""
    order = lambda name: (0, len(name), name) if name.isdigit() else (1, 0, name)
    rows = sorted(rows, key=lambda r: (r[1], order(r[0])))
    return {"tracks": len({r[0] for r in rows}), "rows": len(rows), "frames": len({r[1] for r in rows}), "first": rows[0], "last": rows[-1]}


def run(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(arguments)}: {done.stderr.strip()}")
    return done.stdout


def read_by(program, path, flags):
    described = json.loads(run(program, "describe", str(path), "--json", *flags))
    text = run(program, "convert", str(path), "-o", "-", *flags)
    rows = [(r["id"], int(r["frame"]), float(r["x"]), float(r["y"]), *([float(r["z"])] if "z" in r else []))
            for r in csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#"))]
    return rows, described


def same(a, b):
    return len(a) == len(b) and a[:2] == b[:2] and all(math.isclose(u, v, rel_tol=1e-12, abs_tol=1e-12) for u, v in zip(a[2:], b[2:]))


def compare(program, path, flags, rows, fps, unit):
    """What differs, as lines."""
    theirs, described = read_by(program, path, flags)
    ours, other = facts(rows), facts(theirs)
    wrong = [f"{key}: {other[key]} read, {ours[key]} expected" for key in ("tracks", "rows", "frames") if ours[key] != other[key]]
    wrong += [f"{key} row: {other[key]} read, {ours[key]} expected" for key in ("first", "last") if not same(ours[key], other[key])]
    order = lambda r: (r[1], r[0])
    if not wrong:
        wrong = [f"{b} read, {a} expected" for a, b in zip(sorted(rows, key=order), sorted(theirs, key=order)) if not same(a, b)][:3]
    recording = described["data"]
    if fps and not math.isclose(1 / recording["dt"], fps, rel_tol=1e-6):
        wrong.append(f"{1 / recording['dt']} frames per second read, {fps} expected")
    if recording["unit"] != unit:
        wrong.append(f"unit {recording['unit']} read, {unit} expected")
    return wrong


def main(folder, program=None):
    folder = Path(folder)
    if not folder.is_dir():
        print(f"SKIPPED: {folder} is not on this machine; readers were not compared on real files", file=sys.stderr)
        return SKIPPED
    failures = 0
    for name, reader, flags in CASES:
        path = folder / name
        if not path.exists():
            print(f"SKIPPED: {path} is not on this machine", file=sys.stderr)
            continue
        rows, fps, unit = reader(path)
        found = facts(rows)
        wrong = compare(program, path, flags, rows, fps, unit) if program else []
        failures += bool(wrong)
        verdict = "DIFFERS: " + "; ".join(wrong) if wrong else "same" if program else ""
        print(f"{' '.join([name, *flags])}: {found['tracks']} tracks, {found['rows']} rows, {found['frames']} frames, "
              f"first {found['first']}, last {found['last']} {verdict}")
    return 1 if failures else 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
