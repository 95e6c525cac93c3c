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
        seen = np.isfinite(tracks)
        mean = np.where(seen, tracks, 0).sum(axis=2) / np.where(seen.any(axis=2), seen.sum(axis=2), np.nan)
        points = mean if node == "mean" else tracks[:, :, nodes.index(node)]
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


def trackmate(path):
    """By spots and edges; the individuals are the maximal chains without a branching."""
    root = xml.parse(path).getroot()
    spots = {s.get("ID"): (int(s.get("FRAME")), float(s.get("POSITION_X")), float(s.get("POSITION_Y"))) for s in root.iter("Spot")}
    order = {s.get("ID"): k for k, s in enumerate(root.iter("Spot"))}
    kept = {t.get("TRACK_ID") for t in root.iter("TrackID")}
    rows = []
    for track in root.iter("Track"):
        if track.get("TRACK_ID") not in kept:
            continue
        after, before = {}, {}
        for edge in track.iter("Edge"):
            a, b = sorted((edge.get("SPOT_SOURCE_ID"), edge.get("SPOT_TARGET_ID")), key=lambda s: spots[s][0])
            after.setdefault(a, []).append(b)
            before.setdefault(b, []).append(a)
        goes_on = lambda s: len(before.get(s, [])) == 1 and len(after[before[s][0]]) == 1
        heads = sorted((s for s in {*after, *before} if not goes_on(s)), key=lambda s: (spots[s][0], order[s]))
        for number, spot in enumerate(heads, 1):
            name = track.get("TRACK_ID") if len(heads) == 1 else f"{track.get('TRACK_ID')}-{number}"
            rows.append((name, *spots[spot]))
            while len(after.get(spot, [])) == 1 and goes_on(after[spot][0]):
                spot = after[spot][0]
                rows.append((name, *spots[spot]))
    return rows, 1 / float(root.find(".//ImageData").get("timeinterval")), "px"


def trex(path, x, y):
    with np.load(path) as file:
        seen = np.isfinite(file[x]) & np.isfinite(file[y])
        frames = np.rint(file["time"][seen] / 0.04).astype(int)  # 25 Hz, as its first differences say
        return [("fish0", int(f), float(a), float(b)) for f, a, b in zip(frames, file[x][seen], file[y][seen])], 25, "cm"


def slp(path, node):
    with h5py.File(path) as file:
        meta = json.loads(file["metadata"].attrs["json"])
        nodes = [meta["nodes"][n["id"]]["name"] for n in meta["skeletons"][0]["nodes"]]
        tracks = [json.loads(t)[1] for t in file["tracks_json"][:]]
        shift = 0 if file["metadata"].attrs["format_id"] >= 1.1 else -0.5
        frames = dict(zip(file["frames"]["frame_id"].tolist(), file["frames"]["frame_idx"].tolist()))
        points = file["pred_points"][:]
        rows = []
        for i in file["instances"][:]:
            p = points[i["point_id_start"]:i["point_id_end"]][nodes.index(node)]
            if np.isfinite(p["x"]) and np.isfinite(p["y"]):
                rows.append((tracks[i["track"]], frames[int(i["frame_id"])], float(p["x"]) + shift, float(p["y"]) + shift))
        return rows, None, "px"


def deeplabcut(path, node):
    with h5py.File(path) as file:
        # The names by Python's own reader of pickles' opcodes, which runs none of them.
        kind = file["df_with_missing/table"].attrs["values_block_0_kind"]
        texts, memo, order = [], {}, []
        for opcode, value, _ in pickletools.genops(kind):
            if opcode.name == "UNICODE":
                order.append(value)
            elif opcode.name == "PUT" and order and value not in memo:
                memo[value] = order[-1]
            elif opcode.name == "GET":
                order.append(memo[value])
        names = [n for n in order if n not in (order[0],)]
        column = [k for k in range(0, len(names) - 1, 2) if names[k] == node and names[k + 1] == "x"][0] // 2
        values = file["df_with_missing/table"]["values_block_0"]
        index = file["df_with_missing/table"]["index"]
        return [("1", int(f), float(v[column]), float(v[column + 1])) for f, v in zip(index, values) if np.isfinite(v[column])], None, "px"


def nwb(path, node):
    with h5py.File(path) as file:
        series = file[f"processing/behavior/PoseEstimation/{node}"]
        scale, offset = series["data"].attrs["conversion"], series["data"].attrs["offset"]
        step = float(np.median(np.diff(series["timestamps"][:])))
        frames = np.rint(series["timestamps"][:] / step).astype(int)
        return [("1", int(f), float(x * scale + offset), float(y * scale + offset)) for f, (x, y) in zip(frames, series["data"][:])], 1 / step, "px"


def ethovision(path, node):
    space = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
    with zipfile.ZipFile(path) as book:
        shared = ["".join(t.text or "" for t in s.iter(space + "t")) for s in xml.fromstring(book.read("xl/sharedStrings.xml"))]
        sheet = xml.fromstring(book.read("xl/worksheets/sheet1.xml"))
    value = lambda c: "" if c.find(space + "v") is None else shared[int(c.find(space + "v").text)] if c.get("t") == "s" else c.find(space + "v").text
    table = [{c.get("r").rstrip("0123456789"): value(c) for c in row} for row in sheet.iter(space + "row")]
    header = int(table[0]["B"])
    column = {name: letter for letter, name in table[header - 2].items()}
    subject = next(row["B"] for row in table if row.get("A") == "Subject name")
    rows = []
    for row in table[header:]:
        x, y = row[column[f"X {node}"]], row[column[f"Y {node}"]]
        if x != "-" and y != "-":
            rows.append((subject, round(float(row[column["Trial time"]]) * 15000 / 1001), float(x), float(y)))
    return rows, None, "cm"


# file, reader, flags of the program
CASES = [
    ("idtrackerai/trajectories.h5", idtracker, []),
    ("sleap/SLEAP_single-mouse_EPM.analysis.h5", lambda p: sleap(p, "centre"), ["--node", "centre", "--fps", "30"]),
    ("sleap/SLEAP_single-mouse_EPM.analysis.h5", lambda p: sleap(p, "mean"), ["--node", "mean", "--fps", "30"]),
    ("sleap/SLEAP_three-mice_Aeon_mixed-labels.analysis.h5", lambda p: sleap(p, "centroid"), ["--fps", "50"]),
    ("sleap/small_robot.000_small_robot_3_frame.analysis.h5", lambda p: sleap(p, "mean"), ["--node", "mean", "--fps", "10"]),
    ("juelich/00_01a.h5", pedestrian, []),
    ("jupedsim/trajectories.sqlite", jupedsim, []),
    ("trackmate/FakeTracks.xml", trackmate, []),
    ("trackmate/FakeTracks_splits.xml", trackmate, []),
    ("trex/30_fish.MOV_fish0.npz", lambda p: trex(p, "X#wcentroid", "Y#wcentroid"), []),
    ("trex/30_fish.MOV_fish0.npz", lambda p: trex(p, "X", "Y"), ["--node", "head"]),
    ("sleap/centered_pair_predictions.slp", lambda p: slp(p, "thorax"), ["--node", "thorax", "--fps", "100"]),
    ("deeplabcut/m3v1mp4DeepCut_resnet50_openfieldOct30shuffle1_15001.h5", lambda p: deeplabcut(p, "snout"), ["--node", "snout", "--fps", "30"]),
    ("nwb/0.3.0_poseestimation_one_camera.nwb", lambda p: nwb(p, "front_left_paw"), ["--node", "front_left_paw"]),
    ("ethovision/xt_export.xlsx", lambda p: ethovision(p, "center"), []),
    ("ethovision/xt_export.xlsx", lambda p: ethovision(p, "nose"), ["--node", "nose"]),
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
