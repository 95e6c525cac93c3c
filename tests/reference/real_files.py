#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every file of a collection of real recordings: what swarmfit reads in it, and what a reader that shares no code with it finds.

    python3 real_files.py FOLDER PROGRAM      a Markdown table on standard output; exit 1 when a file differs

FOLDER is not part of the repository. Text is read by Python's csv, containers as in read_formats.py; where they are installed, the tools'
own packages read them as well: sleap-io, pedpy, scipy (for MATLAB files) and movement. Exit 77 (skipped) when FOLDER is absent.
"""

import csv
import json
import math
import subprocess
import sys
from pathlib import Path

import read_formats as containers

NAN = float("nan")


def number(text):
    try:
        return float(text)
    except ValueError:
        return NAN


def lines(path, encoding="utf-8"):
    return [line for line in Path(path).read_text(encoding, errors="replace").splitlines() if line.strip() and not line.lstrip().startswith(("#", "%"))]


def text(path, who, when, x, y, delimiter=",", skip=0, keep=lambda row: True):
    """Rows of delimited text; columns by name, where there is a line of names after `skip` others, or by number. `who` None: one individual."""
    body = lines(path)[skip:]
    split = (lambda s: s.split()) if delimiter == " " else (lambda s: next(csv.reader([s], delimiter=delimiter)))
    rows = [split(line) for line in body]
    names = [] if isinstance(x, int) else rows.pop(0)
    at = lambda column: column if isinstance(column, int) else names.index(column)
    out = []
    for row in rows:
        if keep(dict(zip(names, row)) if names else row):
            out.append(("1" if who is None else row[at(who)], " ".join(row[at(c)] for c in when) if isinstance(when, tuple) else row[at(when)],
                        number(row[at(x)]), number(row[at(y)])))
    return out


def wide(path, pairs, delimiter=",", when=0, header=1):
    rows = [next(csv.reader([line], delimiter=delimiter)) for line in lines(path)]
    return [(name, row[when], number(row[x]), number(row[x + 1])) for row in rows[header:] for name, x in pairs(rows[0])]


def dlc(path, node):
    rows = [next(csv.reader([line])) for line in lines(path)]
    depth = next(k for k, row in enumerate(rows) if row[0] == "coords") + 1
    head = {row[0]: row for row in rows[:depth]}
    out = []
    for c in range(1, len(rows[0])):
        if head["bodyparts"][c] == node and head["coords"][c] == "x":
            out += [(head.get("individuals", rows[0])[c], row[0], number(row[c]), number(row[c + 1])) for row in rows[depth:]]
    return out


def ethovision_3(path):
    body = Path(path).read_text("latin-1").splitlines()
    start = next(k for k, line in enumerate(body) if line.startswith("Sample no."))
    return [("1", row[1], number(row[2]), number(row[3])) for row in csv.reader(body[start + 1:]) if len(row) > 3 and number(row[1]) == number(row[1])]


def motive(path):
    rows = list(csv.reader(Path(path).read_text("utf-8-sig").splitlines()))
    names = next(k for k, row in enumerate(rows) if row[:2] == ["Frame", "Time"] or (row and row[0] == "Frame"))
    kind, name, quantity, axis = (rows[k] for k in (next(k for k, r in enumerate(rows) if "Rigid Body" in r), names - 3, names - 1, names))
    if name[2] == "" or all(c.startswith('"') for c in name[2:4]):
        name = rows[names - 4]
    out = []
    for c, what in enumerate(axis):
        if what == "X" and quantity[c] == "Position" and kind[c] == "Rigid Body":
            out += [(name[c], row[0], number(row[c]), number(row[c + 2])) for row in rows[names + 1:] if len(row) > c + 2]
    return out


def mat(path, variable):
    from scipy.io import loadmat
    return [(str(int(r[0])), repr(r[4]), r[1], r[2]) for r in loadmat(path)[variable] if math.isfinite(r[1])]


def gpx(path):
    import xml.etree.ElementTree as xml
    tag = lambda e: e.tag.split("}")[-1]
    out = []
    for k, track in enumerate(e for e in xml.parse(path).getroot() if tag(e) == "trk"):
        name = next((e.text for e in track if tag(e) == "name"), str(k + 1))
        for point in (e for e in track.iter() if tag(e) == "trkpt"):
            out.append((name, next(e.text for e in point if tag(e) == "time"), float(point.get("lon")), float(point.get("lat"))))
    return out


PIXELS = ["--unit", "px"]
FAST = ["--fps", "25", *PIXELS]
ODD = ["--columns", "id,frame,x,y,_", "--fps", "16", "--unit", "cm"]
VISIBLE = lambda row: row["visible"] == "true"

# file, independent reader (None: refused, and why), flags that say what the file does not
TEXTS = [
    *[(f"goats-gps-2d/{k:02}.csv", lambda p: text(p, None, ("date", "time"), "lon", "lat"), []) for k in range(1, 17)],
    *[(f"pigeons-gps-3d/hf1_{k}_new.csv", lambda p: text(p, None, 0, 1, 2), ["--columns", "t,x,y,z,vx,vy,vz,ax,ay,az,_", "--time-unit", "ms", "--unit", "m"])
      for k in "ACDFGHIJKL"],
    ("midge-lab-3d/BiologicalSwarmTimeSeries.txt", lambda p: text(p, 0, 4, 1, 2), ["--columns", "id,x,y,z,t,vx,vy,vz,ax,ay,az", "--unit", "mm"]),
    ("pedestrians-2d/040_c_56_h-.txt", lambda p: text(p, 0, 1, 2, 3, " "), []),
    ("pedestrians-2d/bi_corr_400_b_03.txt", lambda p: text(p, 0, 1, 2, 3, " "), []),
    ("pedestrians-2d/traj_UNI_CORR_500_01.txt", lambda p: text(p, 0, 1, 2, 3, " "), []),
    ("pedestrians-2d/uo-100-180-180.txt", lambda p: text(p, 0, 1, 2, 3, " "), ODD),
    ("pedestrians-2d/uo-180-180-070.txt", lambda p: text(p, 0, 1, 2, 3, " "), ODD),
    *[(f"jackdaw-flocks-3d/{name}.mat", lambda p: mat(p, "tracks_filt"), ["--var", "tracks_filt", "--unit", "m"])
      for name in ("mob_04_p1", "mob_04_p2", "mob_05_p1", "mob_05_p2", "mob_10", "transit_02", "transit_05")],
    ("sheep-dog-2d/drives_data.mat", None, ["--unit", "m"]),
    ("grevys-zebra-drone-2d/tracks027_final.npy", None, []),
    ("zebrafish-2d/test_trajectories_idtrackerai_with_border.npy", None, []),
    ("zebrafish-2d/trajectories_with_points.npy", None, []),
    ("formats/animalta/single_individual_multi_arena.csv",
     lambda p: wide(p, lambda names: [(n[2:], k) for k, n in enumerate(names) if n.startswith("X_")], ";"), PIXELS),
    ("formats/animalta/variable_individuals_single_arena.csv", lambda p: text(p, "Ind", "Frame", "X", "Y", ";"), FAST),
    ("formats/celltrack/t-cells.txt", lambda p: text(p, 1, 2, 3, 4, " "), ["--columns", "_,id,t,x,y,z", "--unit", "um"]),
    ("formats/deeplabcut/mouse_multi.csv", lambda p: dlc(p, "snout"), ["--node", "snout", "--fps", "30"]),
    ("formats/deeplabcut/mouse_single.csv", lambda p: dlc(p, "snout"), ["--node", "snout", "--fps", "30"]),
    ("formats/deeplabcut/wasp_single.csv", lambda p: dlc(p, "head"), ["--node", "head", "--fps", "30"]),
    ("formats/ethovision/day1_0001_00.csv", ethovision_3, ["--unit", "cm"]),
    ("formats/fasttrack/tracking.txt", lambda p: text(p, "id", "imageNumber", "xBody", "yBody", "\t"), ["--fps", "25"]),
    ("formats/gpx/cerknicko-jezero.gpx", gpx, ["--fps", "1"]),
    ("formats/gpx/cerknicko-without-times.gpx", None, []),
    ("formats/gpx/track-with-empty-segment.gpx", gpx, ["--fps", "1"]),
    ("formats/idtrackerai/trajectories_csv/trajectories.csv",
     lambda p: wide(p, lambda names: [(n[1:], k) for k, n in enumerate(names) if n.startswith("x")]), []),
    ("formats/juelich/n34_cam2.csv", lambda p: text(p, "ID", "Frame", "x", "y"), ["--fps", "30", "--unit", "m"]),
    ("formats/mat/detected_sample_vid.mat", None, []),
    ("formats/motive/motive_sample.csv", motive, []),
    ("formats/movebank/bats.csv", lambda p: text(p, "individual-local-identifier", "timestamp", "location-long", "location-lat", keep=VISIBLE), ["--resample", "0.1"]),
    ("formats/pathfinder/pathfinder.csv", lambda p: text(p, "id", "t", "x", "y", skip=0, keep=lambda row: row["t"] != "s"), []),
    ("formats/sleap/minimal_instance.000_centered_pair_low_quality.analysis.csv", None, ["--node", "A", "--fps", "25"]),
    ("formats/trackdf/01.csv", lambda p: text(p, "track_fixed", "frame", "x", "y", keep=lambda row: row["ignore"] == "FALSE" and row["track_fixed"] != "NA"), ["--fps", "25"]),
    *[(f"formats/trex/{name}.csv", lambda p: text(p, None, "frame", "X#wcentroid (cm)", "Y#wcentroid (cm)"), []) for name in ("beetle", *[f"test_fish{k}" for k in range(8)])],
]


def facts(rows):
    seen = {row for row in rows if math.isfinite(row[2]) and math.isfinite(row[3])}
    return {"tracks": len({row[0] for row in seen}), "rows": len(seen), "frames": len({str(row[1]) for row in seen})}


def packages(path):
    """(package, facts) by the tools' own readers, where they are installed and know the file."""
    name, found = str(path), []
    try:
        if name.endswith(".slp"):
            import sleap_io
            labels = sleap_io.load_slp(name)
            frames = [f for f in labels if any(i.track is not None for i in f.instances)]
            found.append(("sleap-io", {"tracks": len({i.track.name for f in frames for i in f.instances if i.track}), "frames": len(frames)}))
        elif "jupedsim" in name or name.endswith("juelich/00_01a.h5"):
            import pedpy
            load = pedpy.load_trajectory_from_jupedsim_sqlite if "jupedsim" in name else pedpy.load_trajectory_from_ped_data_archive_hdf5
            data = load(trajectory_file=path)
            found.append(("pedpy", {"tracks": data.data.id.nunique(), "rows": len(data.data), "frames": data.data.frame.nunique(), "fps": data.frame_rate}))
        elif name.endswith(".analysis.h5") or name.endswith("mouse_single.csv") or name.endswith("mouse_multi.csv"):
            from movement.io import load_poses
            data = load_poses.from_file(path, source_software="SLEAP" if name.endswith("h5") else "DeepLabCut", fps=25)
            found.append(("movement", {"individuals": data.sizes.get("individuals", data.sizes.get("individual")), "time": data.sizes["time"]}))
    except ImportError:
        pass
    return found


def described(program, path, flags):
    done = subprocess.run([program, "describe", path, *flags, "--json"], capture_output=True, text=True)
    return (json.loads(done.stdout), "") if done.returncode == 0 else (None, done.stderr.strip().split(": ", 1)[-1].removeprefix(f"{path}: "))


def verdict(seen, reason, expected, name, flags):
    if expected is None:
        return ("refused" if seen is None else f"{seen['tracks']} individuals (no other reader)"), True
    if seen is None:
        return f"REFUSED: {reason}", False
    keys = ("tracks",) if "--resample" in flags else ("tracks", "rows") if name.endswith(".gpx") else ("tracks", "rows", "frames")
    wrong = [f"{key} {seen[key]}, expected {expected[key]}" for key in keys if seen[key] != expected[key]]
    return ("DIFFERS: " + "; ".join(wrong) if wrong else "same"), not wrong


def row(program, folder, name, flags, expected):
    seen, reason = described(program, folder / name, flags)
    said, good = verdict(seen, reason, expected, name, flags)
    others = ", ".join(f"{package}: " + ", ".join(f"{v:g} {k}" for k, v in found.items()) for package, found in packages(folder / name))
    if seen:
        data = seen["data"]
        read = f"{data['format']} | {seen['tracks']} | {seen['rows']} | {seen['frames']} | {1 / data['dt']:.6g} | {data['unit']}"
    else:
        read = f"– | | | | | {reason.split(';')[0][:90]}"
    print(f"| {name} | {' '.join(flags)} | {read} | {said}{'; ' + others if others else ''} |", flush=True)
    return good


def main(folder, program):
    folder = Path(folder)
    if not folder.is_dir():
        print(f"SKIPPED: {folder} is not on this machine", file=sys.stderr)
        return containers.SKIPPED
    print("| file | flags | format | individuals | rows | frames | frames/s | unit, or why not | beside an independent reader |\n|---|---|---|---|---|---|---|---|---|")
    good = True
    for name, reader, flags in TEXTS:
        try:
            expected = facts(reader(folder / name)) if reader else None
        except ImportError:
            expected = None
        good = row(program, folder, name, flags, expected) and good
    for name, reader, flags in containers.CASES:
        rows, _, _ = reader(folder / "formats" / name)
        good = row(program, folder, f"formats/{name}", flags, containers.facts(rows)) and good
    return 0 if good else 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
