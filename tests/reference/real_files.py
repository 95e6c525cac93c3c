#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every file of a collection of real recordings: what swarmfit reads in it, and whether a reader that shares no code with it reads the same rows.

    python3 real_files.py FOLDER PROGRAM      a Markdown table on standard output; exit 1 when a file differs

FOLDER is not part of the repository. Text is read by Python's csv, containers as in read_formats.py; where they are installed, scipy reads
MATLAB files, and sleap-io and pedpy read what is theirs. Positions must be the same to 1e-12 (those projected from degrees: to 0.1 mm), times
to the frame. Exit 77 (skipped) when FOLDER is absent.
"""

import csv
import datetime
import io
import json
import math
import statistics
import subprocess
import sys
from pathlib import Path

import numpy as np

import read_formats as containers

NAN = float("nan")


def number(text):
    try:
        return float(text)
    except ValueError:
        return NAN


def lines(path, encoding="utf-8"):
    return [line for line in Path(path).read_text(encoding, errors="replace").splitlines() if line.strip() and not line.lstrip().startswith(("#", "%"))]


def text(path, who, when, x, y, z=None, delimiter=",", keep=lambda row: True):
    """Rows of delimited text; columns by name, where there is a line of names, or by number. `who` None: one individual."""
    body = lines(path)
    split = (lambda s: s.split()) if delimiter == " " else (lambda s: next(csv.reader([s], delimiter=delimiter)))
    rows = [split(line) for line in body]
    names = [] if isinstance(x, int) else rows.pop(0)
    at = lambda column: column if isinstance(column, int) else names.index(column)
    out = []
    for row in rows:
        if keep(dict(zip(names, row)) if names else row):
            out.append(("1" if who is None else row[at(who)], " ".join(row[at(c)] for c in when) if isinstance(when, tuple) else row[at(when)],
                        *(number(row[at(c)]) for c in (x, y, z) if c is not None)))
    return out


def wide(path, pairs, delimiter=",", when=0, header=1):
    rows = [next(csv.reader([line], delimiter=delimiter)) for line in lines(path)]
    return [(name, row[when], number(row[x]), number(row[x + 1])) for row in rows[header:] for name, x in pairs(rows[0])]


def pickled(positions, first):
    """positions: frame x individual x axis, as Python unpickles them."""
    return [(str(first + k), f, *map(float, positions[f, k])) for f in range(positions.shape[0]) for k in range(positions.shape[1])]


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
            out += [(name[c], row[0], *(number(v) for v in row[c:c + 3])) for row in rows[names + 1:] if len(row) > c + 2]
    return out


def mat(path, variable):
    from scipy.io import loadmat
    return [(str(int(r[0])), repr(float(r[4])), *map(float, r[1:4])) for r in loadmat(path)[variable] if math.isfinite(r[1])]


def drives(path):
    """Sheep, dog and shepherd, event after event; the frame within the event is all there is of time."""
    from scipy.io import loadmat
    held = loadmat(path)
    names = [*(f"sheep {k:02}" for k in range(1, 15)), "dog", "shepherd"]
    out = []
    for k, event in enumerate(held["events"][0], 1):
        first, last = held[f"ev_st_{event}"][0], held[f"ev_et_{event}"][0]
        frames = [10000 * int(event) + f for a, b in zip(first, last) for f in range(int(a), int(b) + 1)]
        positions = held[f"pos_ev_{k}"]
        out += [(names[i], str(f), *map(float, positions[i, :, n])) for n, f in enumerate(frames) for i in range(16)]
    return out


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
BIRD = ["--columns", "t,x,y,z,vx,vy,vz,ax,ay,az,_", "--time-unit", "0.01s", "--unit", "m"]
petrack = lambda p: text(p, 0, 1, 2, 3, delimiter=" ")
goat = lambda p: text(p, None, ("date", "time"), "lon", "lat")
pigeon = lambda p: text(p, None, 0, 1, 2, 3)

# file, independent reader (None: it is to be refused), flags that say what the file does not
TEXTS = [
    ("goats-gps-2d/01.csv", None, []),  # a time of 25:00:34
    *[(f"goats-gps-2d/{k:02}.csv", goat, []) for k in range(2, 10)],
    ("goats-gps-2d/10.csv", None, []),  # two positions at one time
    *[(f"goats-gps-2d/{k:02}.csv", goat, []) for k in range(11, 17)],
    *[(f"pigeons-gps-3d/hf1_{k}_new.csv", None if k == "H" else pigeon, BIRD) for k in "ACDFGHIJKL"],  # H: its clock falls back
    ("midge-lab-3d/BiologicalSwarmTimeSeries.txt", lambda p: text(p, 0, 4, 1, 2, 3), ["--columns", "id,x,y,z,t,vx,vy,vz,ax,ay,az", "--unit", "mm"]),
    ("pedestrians-2d/040_c_56_h-.txt", petrack, []),
    ("pedestrians-2d/bi_corr_400_b_03.txt", petrack, []),
    ("pedestrians-2d/traj_UNI_CORR_500_01.txt", petrack, ["--unit", "m"]),
    ("pedestrians-2d/uo-100-180-180.txt", petrack, ODD),
    ("pedestrians-2d/uo-180-180-070.txt", petrack, ODD),
    *[(f"jackdaw-flocks-3d/{name}.mat", lambda p: mat(p, "tracks_filt"), ["--var", "tracks_filt", "--unit", "m"])
      for name in ("mob_04_p1", "mob_04_p2", "mob_05_p1", "mob_05_p2", "mob_10", "transit_02", "transit_05")],
    ("sheep-dog-2d/drives_data.mat", drives, ["--unit", "m"]),
    ("grevys-zebra-drone-2d/tracks027_final.npy", lambda p: pickled(np.moveaxis(np.load(p, allow_pickle=True), 0, 1), 0),
     ["--columns", "id,frame,x,y", "--fps", "30", "--unit", "px"]),
    *[(f"zebrafish-2d/{name}.npy", lambda p: pickled(np.load(p, allow_pickle=True).item()["trajectories"], 1), [])
      for name in ("test_trajectories_idtrackerai_with_border", "trajectories_with_points")],
    ("formats/animalta/single_individual_multi_arena.csv",
     lambda p: wide(p, lambda names: [(n[2:], k) for k, n in enumerate(names) if n.startswith("X_")], ";"), PIXELS),
    ("formats/animalta/variable_individuals_single_arena.csv", lambda p: text(p, "Ind", "Frame", "X", "Y", delimiter=";"), FAST),
    ("formats/celltrack/t-cells.txt", lambda p: text(p, 1, 2, 3, 4, 5, delimiter=" "), ["--columns", "_,id,t,x,y,z", "--unit", "um"]),
    ("formats/deeplabcut/mouse_multi.csv", lambda p: dlc(p, "snout"), ["--node", "snout", "--fps", "30"]),
    ("formats/deeplabcut/mouse_single.csv", lambda p: dlc(p, "snout"), ["--node", "snout", "--fps", "30"]),
    ("formats/deeplabcut/wasp_single.csv", lambda p: dlc(p, "head"), ["--node", "head", "--fps", "30"]),
    ("formats/ethovision/day1_0001_00.csv", ethovision_3, ["--unit", "cm"]),
    ("formats/fasttrack/tracking.txt", lambda p: text(p, "id", "imageNumber", "xBody", "yBody", delimiter="\t"), ["--fps", "25"]),
    ("formats/gpx/cerknicko-jezero.gpx", gpx, ["--fps", "1"]),
    ("formats/gpx/cerknicko-without-times.gpx", None, []),
    ("formats/gpx/track-with-empty-segment.gpx", gpx, []),
    ("formats/idtrackerai/trajectories_csv/trajectories.csv",
     lambda p: wide(p, lambda names: [(n[1:], k) for k, n in enumerate(names) if n.startswith("x")]), []),
    ("formats/juelich/n34_cam2.csv", lambda p: text(p, "ID", "Frame", "x", "y"), ["--fps", "25", "--unit", "m"]),
    ("formats/mat/detected_sample_vid.mat", None, []),
    ("formats/motive/motive_sample.csv", motive, []),
    ("formats/movebank/bats.csv",
     lambda p: text(p, "individual-local-identifier", "timestamp", "location-long", "location-lat", keep=lambda row: row["visible"] == "true"), ["--fps", "1"]),
    ("formats/pathfinder/pathfinder.csv", lambda p: text(p, "id", "t", "x", "y", keep=lambda row: row["t"] != "s"), []),
    ("formats/sleap/minimal_instance.000_centered_pair_low_quality.analysis.csv", lambda p: text(p, None, "frame_idx", "A.x", "A.y"), ["--node", "A", "--fps", "25"]),
    ("formats/trackdf/01.csv", lambda p: text(p, "track_fixed", "frame", "x", "y", keep=lambda row: row["ignore"] == "FALSE" and row["track_fixed"] != "NA"), ["--fps", "25"]),
    ("formats/trex/beetle.csv", lambda p: text(p, None, "frame", "X#wcentroid (cm)", "Y#wcentroid (cm)"), []),
    *[(f"formats/trex/test_fish{k}.csv", None, []) for k in range(8)],  # exported without Y
]


def moment(when):
    """Seconds, or frames, of a number, a date and time, or a time of day."""
    try:
        return float(when)
    except ValueError:
        pass
    day, _, clock = when.replace("T", " ").rstrip("Z").partition(" ")
    hours, minutes, seconds = clock.split(":")
    return 86400 * datetime.date.fromisoformat(day).toordinal() + 3600 * int(hours) + 60 * int(minutes) + float(seconds)


def ellipsoid(latitude, longitude, centre):
    """Metres east and north on WGS 84 in the azimuthal equidistant projection, by Vincenty's inverse formula (Survey Review 23:88, 1975)."""
    a, f = 6378137.0, 1 / 298.257223563
    b = a * (1 - f)
    u1, u2 = (math.atan((1 - f) * math.tan(math.radians(v))) for v in (centre[0], latitude))
    span = turn = math.radians(longitude - centre[1])
    for _ in range(100):
        east = math.cos(u2) * math.sin(turn)
        north = math.cos(u1) * math.sin(u2) - math.sin(u1) * math.cos(u2) * math.cos(turn)
        sine, cosine = math.hypot(east, north), math.sin(u1) * math.sin(u2) + math.cos(u1) * math.cos(u2) * math.cos(turn)
        if sine == 0:
            return 0.0, 0.0
        arc, alpha = math.atan2(sine, cosine), math.cos(u1) * math.cos(u2) * math.sin(turn) / sine
        middle = cosine - 2 * math.sin(u1) * math.sin(u2) / (1 - alpha**2)
        c = f / 16 * (1 - alpha**2) * (4 + f * (4 - 3 * (1 - alpha**2)))
        before, turn = turn, span + (1 - c) * f * alpha * (arc + c * sine * (middle + c * cosine * (2 * middle**2 - 1)))
        if abs(turn - before) < 1e-15:
            break
    u = (1 - alpha**2) * (a**2 / b**2 - 1)
    big = 1 + u / 16384 * (4096 + u * (u * (320 - 175 * u) - 768))
    small = u / 1024 * (256 + u * (u * (74 - 47 * u) - 128))
    bend = small * sine * (middle + small / 4 * (cosine * (2 * middle**2 - 1) - small / 6 * middle * (4 * sine**2 - 3) * (4 * middle**2 - 3)))
    distance = b * big * (arc - bend)
    return distance * east / sine, distance * north / sine


def projected(rows):
    centre = statistics.median(row[3] for row in rows), statistics.median(row[2] for row in rows)
    return [(who, when, *ellipsoid(latitude, longitude, centre)) for who, when, longitude, latitude in rows]


def ordered(rows):
    """By individual and time, without repeated rows and those not seen."""
    seen = {(who, moment(str(when)), *position) for who, when, *position in rows if all(map(math.isfinite, position))}
    return sorted(seen)


def by_program(program, path, flags):
    text = subprocess.run([program, "convert", path, *flags, "-o", "-"], capture_output=True, text=True, check=True).stdout
    rows = csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#"))
    return sorted((row["id"], float(row["t"]), *(float(row[axis]) for axis in "xyz" if axis in row)) for row in rows)


def off_the_line(theirs, ours):
    """How far [s] times are from a straight line over times or frames: a slope and an offset are all that a unit and a first frame can change."""
    if len({row[1] for row in ours}) < 2:
        return 0
    slope, offset = statistics.linear_regression([row[1] - ours[0][1] for row in ours], [row[1] - theirs[0][1] for row in theirs])
    return max(abs(a[1] - theirs[0][1] - slope * (b[1] - ours[0][1]) - offset) for a, b in zip(theirs, ours))


def differences(program, path, flags, rows, dt):
    """What differs, as words."""
    degrees = path.suffix == ".gpx" or "gps-2d" in str(path) or "movebank" in str(path)
    ours, theirs = ordered(projected(rows) if degrees else rows), by_program(program, path, flags)
    if len(ours) != len(theirs):
        return f"{len(theirs)} rows, expected {len(ours)}"
    if len({row[0] for row in ours}) == 1 == len({row[0] for row in theirs}):
        ours = [(theirs[0][0], *row[1:]) for row in ours]
    absolute, relative = (1e-4, 0) if degrees else (1e-12, 1e-12)
    for a, b in zip(theirs, ours):
        if a[0] != b[0] or not all(math.isclose(u, v, rel_tol=relative, abs_tol=absolute) for u, v in zip(a[2:], b[2:])):
            return f"{a} read, {b} expected"
    off = off_the_line(theirs, ours)
    return f"times are off by {off} s" if off > 0.51 * dt else ""


def packages(path):
    """What the tools' own packages read, where they are installed and know the file."""
    name = str(path)
    try:
        if name.endswith(".slp"):
            import sleap_io
            seen = [i.track.name for f in sleap_io.load_slp(name) for i in f.instances if i.track and math.isfinite(i["thorax"]["xy"][0])]
            return "sleap-io", {"tracks": len(set(seen)), "rows": len(seen)}
        if "jupedsim" in name or name.endswith("juelich/00_01a.h5"):
            import pedpy
            load = pedpy.load_trajectory_from_jupedsim_sqlite if "jupedsim" in name else pedpy.load_trajectory_from_ped_data_archive_hdf5
            data = load(trajectory_file=path).data
            return "pedpy", {"tracks": data.id.nunique(), "rows": len(data), "frames": data.frame.nunique()}
    except ImportError:
        pass
    return "", {}


def row(program, path, name, flags, compare, refused):
    """One line of the table; whether it is as expected."""
    done = subprocess.run([program, "describe", path, *flags, "--json"], capture_output=True, text=True)
    shown = f"{name} | {' '.join(flags)}"
    if done.returncode != 0:
        why = done.stderr.strip().removeprefix("swarmfit: ").replace(f"{path.parent}/", "")
        print(f"| {shown} | – | | | | | | {'' if refused else 'DIFFERS: '}refused: {why.split('; expected')[0]} |", flush=True)
        return refused and done.returncode == 2
    seen = json.loads(done.stdout)
    data = seen["data"]
    wrong = "read, but is to be refused" if refused else compare(data["dt"])
    package, found = packages(path)
    if wrong is not None:
        wrong = wrong or "; ".join(f"{package}: {value} {key}" for key, value in found.items() if seen[key] != value)
    verdict = f"DIFFERS: {wrong}" if wrong else "no reader here" if wrong is None else f"same{' (and ' + package + ')' if package else ''}"
    print(f"| {shown} | {data['format']} | {seen['tracks']} | {seen['rows']} | {seen['frames']} | {1 / data['dt']:.6g} | {data['unit']} | {verdict} |", flush=True)
    return not wrong


def texts(program, folder):
    good = True
    for name, reader, flags in TEXTS:
        def compare(dt):
            try:
                return differences(program, folder / name, flags, reader(folder / name), dt)
            except ImportError:
                return None
        good = row(program, folder / name, name, flags, compare, reader is None) and good
    return good


def main(folder, program):
    folder = Path(folder)
    if not folder.is_dir():
        print(f"SKIPPED: {folder} is not on this machine", file=sys.stderr)
        return containers.SKIPPED
    print("| file | flags | format | individuals | rows | frames | frames/s | unit | an independent reader |\n|---|---|---|---|---|---|---|---|---|")
    good = texts(program, folder)
    for name, reader, flags in containers.CASES:
        path = folder / "formats" / name
        compare = lambda dt: "; ".join(containers.compare(program, path, flags, *reader(path)))
        good = row(program, path, f"formats/{name}", flags, compare, False) and good
    return 0 if good else 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
