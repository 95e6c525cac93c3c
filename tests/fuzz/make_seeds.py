#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""make_seeds.py FOLDER   small inputs of every format, made here: FOLDER/TARGET/NAME. Two individuals, a few frames, every part of a layout once.

Containers are made by h5py, NumPy and Python's own sqlite3 and zipfile. The same bytes every time, as far as these libraries let us.
"""

import gzip
import hashlib
import io
import json
import pickle
import sqlite3
import struct
import sys
import tempfile
import zipfile
import zlib
from pathlib import Path

import h5py
import numpy as np

NAN = float("nan")
POSITIONS = np.array([[[0.5, 1], [2, 3]], [[1, 1.5], [NAN, NAN]], [[1.5, 2], [2.5, 4]], [[2, 2.5], [3, 5]]])  # frame, individual, axis


def text(*lines, end="\n"):
    return (end.join(lines) + end).encode()


def csv(header, row):
    lines = [header] if header else []
    for frame in range(4):
        for k in range(2):
            x, y = POSITIONS[frame, k]
            lines.append(row(frame, k, "nan" if np.isnan(x) else x, "nan" if np.isnan(y) else y))
    return text(*lines)


def npy(array):
    out = io.BytesIO()
    np.save(out, array)
    return out.getvalue()


def packed(members):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as zip:
        for name, data in members.items():
            zip.writestr(zipfile.ZipInfo(name), data)
    return out.getvalue()


def hdf5(fill):
    out = io.BytesIO()
    with h5py.File(out, "w", track_order=False) as file:
        fill(file)
    return out.getvalue()


def database(script):
    with tempfile.NamedTemporaryFile(suffix=".db") as file:
        db = sqlite3.connect(file.name)
        db.executescript(script)
        db.commit()
        db.close()
        return Path(file.name).read_bytes()


# ---- MATLAB 5, by the layout that The MathWorks publishes -----------------------------------------------------------------------


def element(kind, data):
    return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)


def matrix(name, array_class, dims, body):
    flags = element(6, struct.pack("<II", array_class, 0))
    return element(14, flags + element(5, struct.pack(f"<{len(dims)}i", *dims)) + element(1, name.encode()) + body)


def doubles(name, array):
    array = np.asarray(array, float)
    return matrix(name, 6, array.shape, element(9, array.tobytes("F")))


def structure(name, fields, elements):
    names = b"".join(f.encode().ljust(32, b"\0") for f in fields)
    body = element(5, struct.pack("<i", 32)) + element(1, names)
    for values in elements:
        body += b"".join(doubles("", value) for value in values)
    return matrix(name, 2, (1, len(elements)), body)


def mat5(*variables, compressed=False):
    head = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<HH", 0x0100, 0x4D49)
    body = b"".join(variables)
    return head + (element(15, zlib.compress(body))[:8 + len(zlib.compress(body))] if compressed else body)


def mat_seeds():
    rows = [[k + 1, f / 10, *np.nan_to_num(POSITIONS[f, k])] for k in range(2) for f in range(4)]
    table = doubles("tracks", np.array(rows)[:, [0, 2, 3, 1]])
    trx = structure("trx", ["x", "y", "firstframe", "fps", "id"], [[[[1.0, 2, 3]], [[4.0, 5, 6]], [[1.0]], [[25.0]], [[k + 1.0]]] for k in range(2)])
    event = doubles("pos_ev_1", np.nan_to_num(POSITIONS).transpose(1, 2, 0))
    drives = [event, doubles("dt", [[0.1]]), doubles("ev_st_1", [[1.0]]), doubles("ev_et_1", [[4.0]]), doubles("events", [[1.0]])]
    return {"table": mat5(table), "packed": mat5(table, compressed=True), "trx": mat5(trx), "drives": mat5(*drives)}


# ---- C3D, by the user guide of Motion Lab Systems ---------------------------------------------------------------------------------


def c3d(order, machine, floating, labels):
    """Two points, four frames; the second one is not seen in the second frame. `order` of bytes, '<' or '>'."""
    real = lambda v: dec(v) if machine == 85 else struct.pack(order + "f", v)
    short = lambda *v: struct.pack(f"{order}{len(v)}h", *v)

    def dec(v):
        word = struct.unpack("<2H", struct.pack("<f", v * 4))
        return struct.pack("<2H", word[1], word[0]) if v else b"\0" * 4

    def record(number, name, body, last=False):
        return struct.pack("bb", len(name), number) + name.encode() + short(0 if last else len(body) + 2) + body

    scale = -1.0 if floating else 0.5
    values = [("USED", b"\2\0" + short(2)), ("SCALE", b"\4\0" + real(scale)), ("RATE", b"\4\0" + real(50.0)), ("FRAMES", b"\2\0" + short(4)),
              ("UNITS", b"\xff\1\2mm"), ("LABELS", b"\xff\2\6\2" + b"".join(n.ljust(6).encode() for n in labels))]
    section = record(-1, "POINT", b"\0") + b"".join(record(1, name, body + b"\0", name == "LABELS") for name, body in values)
    section = (bytes([1, 0x50, 1, machine]) + section).ljust(512, b"\0")
    header = (bytes([2, 0x50]) + short(2, 0, 1, 4, 10) + real(scale) + short(3, 0) + real(50.0)).ljust(512, b"\0")
    frames = b""
    for frame in range(4):
        for k in range(2):
            unseen = k == 1 and frame == 1
            frames += b"".join(map(real, (frame / 2, k + 1, 3, -1 if unseen else 0))) if floating else short(frame, 2 * k + 2, 6, -1 if unseen else 0)
    return header + section + frames


# ---- HDF5 layouts -----------------------------------------------------------------------------------------------------------------


def idtracker(file):
    file["trajectories"] = POSITIONS
    file["id_probabilities"] = np.ones((4, 2, 1))
    file.attrs["frames_per_second"] = 25.0
    file.attrs["body_length"] = 10.0
    file.attrs["identities_labels"] = ["a", "b"]


def sleap(file):
    tracks = np.stack([POSITIONS, POSITIONS + 1], axis=2)  # frame, individual, node, axis
    file["tracks"] = tracks.transpose(1, 3, 2, 0)
    file["point_scores"] = np.full((2, 2, 4), 0.9)
    file["node_names"] = [b"nose", b"tail"]
    file["track_names"] = [b"a", b"b"]


def slp(file):
    skeleton = {"nodes": [{"id": 0}, {"id": 1}], "links": []}
    meta = {"version": "2.0.0", "nodes": [{"name": "nose"}, {"name": "tail"}], "skeletons": [skeleton]}
    group = file.create_group("metadata")
    group.attrs["format_id"] = 1.2
    group.attrs["json"] = np.bytes_(json.dumps(meta))
    file["tracks_json"] = [np.bytes_(json.dumps([0, name])) for name in ("a", "b")]
    file["videos_json"] = [np.bytes_("{}")]
    point = np.dtype([("x", "f8"), ("y", "f8"), ("visible", "?"), ("complete", "?"), ("score", "f8")])
    instance = np.dtype([("instance_id", "i8"), ("instance_type", "u1"), ("frame_id", "u8"), ("skeleton", "u4"), ("track", "i4"), ("from_predicted", "i8"),
                         ("score", "f4"), ("point_id_start", "u8"), ("point_id_end", "u8")])
    frame = np.dtype([("frame_id", "u8"), ("video", "u4"), ("frame_idx", "u8"), ("instance_id_start", "u8"), ("instance_id_end", "u8")])
    file["frames"] = np.array([(f, 0, f, 2 * f, 2 * f + 2) for f in range(4)], frame)
    file["instances"] = np.array([(i, 1, i // 2, 0, i % 2, -1, 0.9, 2 * i, 2 * i + 2) for i in range(8)], instance)
    file["pred_points"] = np.array([(i, i + 1, True, True, 0.9) for i in range(16)], point)
    file["points"] = np.array([], point)


def pedestrian(file):
    row = np.dtype([("id", "i4"), ("frame", "i4"), ("x", "f8"), ("y", "f8"), ("z", "f8")])
    file["trajectory"] = np.array([(k + 1, f, f, k, 1.7) for k in range(2) for f in range(4)], row)
    file["trajectory"].attrs["fps"] = 25.0
    for axis in "xyz":
        file["trajectory"].attrs[axis] = f"pedestrian {axis}-coordinate (meter [m])"
    file.attrs["wkt_geometry"] = "POLYGON ((0 0, 1 0, 1 1, 0 0))"


def deeplabcut(file):
    names = [("scorer", body, coord) for body in ("nose", "tail") for coord in ("x", "y", "likelihood")]
    row = np.dtype([("index", "i8"), ("values_block_0", "f8", (6,))])
    table = file.create_dataset("df_with_missing/table", data=np.array([(f, [f, 1, 0.9, f, 2, 0.8]) for f in range(4)], row))
    kind = pickle.dumps(names, protocol=0)
    table.attrs["values_block_0_kind"] = np.bytes_(kind)
    file["df_with_missing"].attrs["non_index_axes"] = np.bytes_(pickle.dumps([(1, names)], protocol=0))


def nwb(file):
    group = file.create_group("processing/behavior/PoseEstimation")
    group.attrs["neurodata_type"] = "PoseEstimation"
    group.attrs["namespace"] = "ndx-pose"
    for node in ("nose", "tail"):
        series = group.create_group(node)
        series.attrs["neurodata_type"] = "PoseEstimationSeries"
        series["data"] = np.nan_to_num(POSITIONS[:, 0])
        series["data"].attrs["unit"] = "pixels"
        series["data"].attrs["conversion"] = 1.0
        series["data"].attrs["offset"] = 0.0
        series["timestamps"] = np.arange(4) / 25
        series["confidence"] = np.ones(4)
    group["nodes"] = ["nose", "tail"]


def columns(file):
    for name, values in {"id": [1, 1, 2], "frame": [0, 1, 0], "x": [1.0, 2, 3], "y": [1.0, 2, 3]}.items():
        file[name] = values


def own(file):
    file.attrs["swarmfit"] = "tracks/1"
    file.attrs["unit"] = "mm"
    file.attrs["dt"], file.attrs["t0"] = 0.04, 0.5
    file["names"], file["notes"] = ["a", "b"], ["smoothed"]
    file["episodes"] = [2]
    for name, values in {"track": [0, 1, 0, 1], "frame": [0, 0, 1, 1], "x": [0, 1, 2, 3.5], "y": [1, 1, 1, 1]}.items():
        file[name] = values


# ---- text -------------------------------------------------------------------------------------------------------------------------

PLAIN = csv("id,frame,t,x [mm],y [mm]", lambda f, k, x, y: f"{k},{f},{f / 25},{x},{y}")

TEXTS = {
    "plain": PLAIN,
    "comments": text("# unit: mm", "# fps: 25", "# frame interval: 0.04 s", "# time of frame 0: 1 s", "# note: smoothed", "# episodes: 2", "id,frame,x,y",
                     '"a b",0,1,2', '"a b",1,2,3', '"a b",2,2,3'),
    "clock": text("id;date;time;x;y", "1;3/4/2021;11:59:00 PM;1,5;2", "1;3/4/2021;11:59:01 PM;1,6;2", "1;3/4/2021;11:59:02 PM;1,7;2"),
    "iso": text("id,timestamp,lon,lat", "1,2021-03-04T00:00:00.5Z,8.1,47.2", "1,2021-03-04T00:00:01.5Z,8.1001,47.2", "1,2021-03-04T00:00:02.5Z,8.1002,47.2"),
    "utf16": "id,frame,x,y\n1,0,1,2\n1,1,2,3\n".encode("utf-16"),
    "r": text('"id" "t" "x" "y" "z"', '"1" "7" 0 1 2 3', '"2" "7" 24 2 3 4', '"3" "7" 48 2 3 5'),
    "frames": text("particle\tframe\tx\ty", "0\t0\t1.5\t-1", "0\t1\t1.6\t-1e0", "0\t3\t#N/A\t."),
    "cr": text("id,frame,x,y", "1,0,1,2", "1,1,2,3", end="\r"),
}

TRACKMATE = text('<?xml version="1.0" encoding="UTF-8"?>', '<TrackMate version="6.0.1"><Model spatialunits="pixel" timeunits="sec"><AllSpots>', *[
    f'<SpotsInFrame frame="{f}"><Spot ID="{2 * f}" FRAME="{f}" POSITION_X="{f}" POSITION_Y="1" POSITION_Z="0"/>'
    f'<Spot ID="{2 * f + 1}" FRAME="{f}" POSITION_X="{f}" POSITION_Y="2" POSITION_Z="0"/></SpotsInFrame>' for f in range(3)
], '</AllSpots><AllTracks><Track TRACK_ID="0"><Edge SPOT_SOURCE_ID="0" SPOT_TARGET_ID="2"/><Edge SPOT_SOURCE_ID="2" SPOT_TARGET_ID="4"/>',
                 '<Edge SPOT_SOURCE_ID="2" SPOT_TARGET_ID="5"/></Track></AllTracks><FilteredTracks><TrackID TRACK_ID="0"/></FilteredTracks></Model>',
                 '<Settings><ImageData timeinterval="0.04" pixelwidth="1"/></Settings></TrackMate>')
SIMPLE = text('<Tracks nTracks="1" spaceUnits="micron" frameInterval="0.5" timeUnits="s"><particle nSpots="2"><detection t="0" x="1" y="2" z="0"/>',
              '<detection t="1" x="2" y="3" z="0"/></particle></Tracks>')
GPX = text('<?xml version="1.0"?><gpx version="1.1"><trk><name>a</name><trkseg>', *[
    f'<trkpt lat="50.{777 + s}" lon="6.08"><ele>7</ele><time>2013-07-06T14:59:0{s}Z</time></trkpt>' for s in range(4)], "</trkseg><trkseg/></trk></gpx>")

SHEET_HEAD = '<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>'


def sheet(rows):
    cell = lambda v: f'<c t="inlineStr"><is><t>{v}</t></is></c>' if isinstance(v, str) else f"<c><v>{v}</v></c>"
    return SHEET_HEAD + "".join("<row>" + "".join(cell(v) for v in row) + "</row>" for row in rows) + "</sheetData></worksheet>"


def xlsx(rows):
    relation = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    return packed({
        "xl/workbook.xml": f'<workbook xmlns:r="{relation}"><sheets><sheet name="One" sheetId="1" r:id="rId1"/></sheets></workbook>',
        "xl/_rels/workbook.xml.rels": '<Relationships><Relationship Id="rId1" Target="worksheets/sheet1.xml"/></Relationships>',
        "xl/sharedStrings.xml": "<sst><si><t>id</t></si><si><r><t>x</t></r></si></sst>",
        "xl/worksheets/sheet1.xml": sheet(rows)})


ETHOVISION_ROWS = [["Number of header lines:", "6"], ["Trial name", "Trial 1"], ["Arena name", "Arena 1"], ["Subject name", "Subject 1"],
                   ["Trial time", "X center", "Y center", "X nose", "Y nose"], ["s", "cm", "cm", "cm", "cm"],
                   *[[f / 25, f, 1, f, 2] for f in range(4)], [0.16, "-", "-", "-", "-"]]
ETHOVISION = text(*[";".join(f'"{v}"' if isinstance(v, str) else str(v) for v in row) for row in ETHOVISION_ROWS])

FASTTRACK = "xHead yHead tHead xTail yTail tTail xBody yBody tBody curvature areaBody perimeterBody headMajorAxisLength headMinorAxisLength " \
            "headExcentricity tailMajorAxisLength tailMinorAxisLength tailExcentricity bodyMajorAxisLength bodyMinorAxisLength bodyExcentricity " \
            "imageNumber id".split()
FASTTRACK_ROWS = [[1 + f, 2, 0, 1, 2, 0, 1.5 + f, 2 + k, *[0.5] * 13, f, k] for k in range(2) for f in range(3)]

TREX = {"frame": np.arange(4.0), "time": np.arange(4) / 25, "missing": np.zeros(4), "X#wcentroid": np.array([1, 2, np.inf, 3]), "Y#wcentroid": np.ones(4),
        "X": np.arange(4.0), "Y": np.ones(4)}

JUPEDSIM = "create table trajectory_data (frame integer, id integer, pos_x real, pos_y real, ori_x real, ori_y real);" \
           "create table metadata (key text, value text); insert into metadata values ('version', '2'), ('fps', '25.0');" \
           "create table track_names (id integer, name text); insert into track_names values (0, 'a'), (1, 'b');" + \
           "".join(f"insert into trajectory_data values ({f}, {k}, {f}, {k}, 1, 0);" for f in range(4) for k in range(2))
FASTTRACK_DB = f"create table tracking ({', '.join(n + ' real' for n in FASTTRACK[:-2])}, imageNumber integer, id integer);" + \
               "".join(f"insert into tracking values ({', '.join(map(str, row))});" for row in FASTTRACK_ROWS)

MOTIVE = text("Format Version,1.23,Take Name,one,Capture Frame Rate,100.000000,Export Frame Rate,100.000000,Rotation Type,Quaternion,Length Units,Meters", "",
              ",Type,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body", ",Name,a,a,a,a,a,a,a", ',ID,"0","0","0","0","0","0","0"',
              ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position", "Frame,Time,X,Y,Z,W,X,Y,Z", *[f"{f},{f / 100},0,0,0,1,{f},1,2" for f in range(4)])


def pickled(value, protocol, header=True):
    head = npy(np.array(0.0))[:10] + b"{'descr': '|O', 'fortran_order': False, 'shape': (), }".ljust(117) + b"\n"
    return (head if header else b"") + pickle.dumps(np.array(value, object) if header else value, protocol)


IDTRACKER = {"trajectories": POSITIONS, "id_probabilities": np.ones((4, 2, 1)), "git_commit": "0", "frames_per_second": 25, "body_length": np.float64(10),
             "setup_points": {"border": np.array([[1, 2], [3, 4]])}, "identities_labels": ["a", "b"], "stats": (None, True, -70000, 1.5, 2**40)}


def swarmfit_npz():
    return packed({f"{name}.npy": npy(np.array(value)) for name, value in {
        "swarmfit": "tracks/1", "unit": "mm", "dt": 0.04, "t0": 0.5, "names": ["a", "b"], "notes": ["smoothed"], "episodes": [2], "track": [0, 1, 0, 1],
        "frame": [0, 0, 1, 1], "x": [0, 1, 2, 3.5], "y": [1.0, 1, 1, 1]}.items()})


def readers():
    keypoints = csv("frame,individual,keypoint,x,y,confidence", lambda f, k, x, y: f"{f},{k},nose,{x},{y},0.9")
    all = {
        "mat": mat_seeds(),
        "c3d": {"intel": c3d("<", 84, True, ["a", "b"]), "dec": c3d("<", 85, True, ["a", "b"]), "mips": c3d(">", 86, True, ["a:nose", "a:tail"]),
                "integers": c3d("<", 84, False, ["a", ""])},
        "swarmfit-h5": {"own": hdf5(own)}, "idtracker": {"h5": hdf5(idtracker)}, "sleap": {"h5": hdf5(sleap)}, "slp": {"slp": hdf5(slp)},
        "pedestrian-h5": {"h5": hdf5(pedestrian)}, "deeplabcut-h5": {"h5": hdf5(deeplabcut)}, "nwb": {"nwb": hdf5(nwb)},
        "hdf5": {"h5": hdf5(columns)},
        "jupedsim": {"db": database(JUPEDSIM)}, "fasttrack-db": {"db": database(FASTTRACK_DB)},
        "trackmate": {"model": TRACKMATE, "simple": SIMPLE}, "gpx": {"gpx": GPX},
        "ethovision-xlsx": {"xlsx": xlsx(ETHOVISION_ROWS)},
        "xlsx": {"xlsx": xlsx([["id", "frame", "x", "y"], [1, 0, 1.5, 2], [1, 1, 1.6, 2], [2, 0, 3, 3]]), "wide": xlsx([["frame", "x1", "y1", "x2", "y2"], [0, 1, 2, 3, 4], [1, 2, 3, 4, 5]])},
        "idtracker-npy": {f"protocol{k}": pickled(IDTRACKER, k) for k in (2, 3, 4, 5)},
        "pickle": {"array": pickled(np.array([[1.0, 0, 2, 3], [1, 1, 3, 4]]), 4, False), "fortran": pickled(np.asfortranarray(POSITIONS), 5, False),
                   "columns": pickled({"id": np.array([1, 1]), "frame": np.array([0, 1]), "x": np.float32([1, 2]), "y": np.array([1, 2], ">i2")}, 4, False)},
        "swarmfit-npz": {"npz": swarmfit_npz()},
        "trex": {"fish0": packed({f"{n}.npy": npy(np.float32(v)) for n, v in TREX.items()})},
        "numpy": {"columns": packed({f"{n}.npy": npy(np.array(v)) for n, v in {"id": [1, 1, 2], "frame": [0, 1, 0], "x": [1.0, 2, 3], "y": [1.0, 2, 3]}.items()}),
                  "array": npy(POSITIONS)},
        "ethovision": {"xt": ETHOVISION, "utf16": ETHOVISION.decode().encode("utf-16")},
        "imaris": {"csv": text("", "Position", "====", "Position X,Position Y,Position Z,Unit,Category,Collection,Time,TrackID,ID,",
                               *[f"{f},1,2,um,Spot,Position,{f + 1},1000000000,{f}," for f in range(4)])},
        "trackmate-csv": {"one": text("LABEL,ID,TRACK_ID,POSITION_X,POSITION_Y,POSITION_Z,POSITION_T,FRAME", *[f"a,{f},0,{f},1,0,{f / 25},{f}" for f in range(4)]),
                          "four": text("LABEL,ID,TRACK_ID,POSITION_X,POSITION_Y,POSITION_Z,POSITION_T,FRAME", "Label,Spot ID,Track ID,X,Y,Z,T,Frame",
                                       "Label,Spot ID,Track ID,X,Y,Z,T,Frame", ",,,(micron),(micron),(micron),(sec),", *[f"a,{f},0,{f},1,0,{f / 25},{f}" for f in range(4)])},
        "motive": {"csv": MOTIVE},
        "deeplabcut-csv": {"one": text("scorer,s,s,s", "bodyparts,nose,nose,nose", "coords,x,y,likelihood", *[f"{f},{f},1,0.9" for f in range(4)]),
                           "many": text("scorer,s,s,s,s,s,s", "individuals,a,a,a,b,b,b", "bodyparts,nose,nose,nose,nose,nose,nose",
                                        "coords,x,y,likelihood,x,y,likelihood", *[f"{f},{f},1,0.9,{f},,0.1" for f in range(4)])},
        "fasttrack-text": {"txt": text("\t".join(FASTTRACK), *["\t".join(map(str, row)) for row in FASTTRACK_ROWS])},
        "trex-csv": {"csv": text("frame,X#wcentroid (cm),Y#wcentroid (cm),X (cm),Y (cm),missing,time", *[f"{f},{f},1,{f},2,0,{f / 25}" for f in range(4)], "4,inf,inf,inf,inf,1,0.16")},
        "trackr": {"csv": text("id,x,y,size,frame,track,ignore,track_fixed", *[f"{f},{f},{k},9,{f},{k},FALSE,{k}" for k in range(2) for f in range(4)])},
        "movebank": {"csv": text("event-id,visible,timestamp,location-long,location-lat,individual-local-identifier",
                                 *[f'{f},{"true" if f else "false"},2020-01-01 00:00:0{f}.000,8.1,47.{2 + f},"a"' for f in range(4)])},
        "idtracker-csv": {"csv": csv("seconds,x1,y1,x2,y2", lambda f, k, x, y: f"{f / 25},{x},{y},{x},{y}")},
        "animalta": {"csv": text("Frame;Time;Arena;Ind;X;Y", *[f"{f};{f / 25};0;{k};{f};{k}" for f in range(4) for k in range(2)])},
        "toxtrac": {"real": text("Time (sec)\tArena\tTrack\tPos. X (mm)\tPos. Y (mm)\tLabel", *[f"{f / 25}\t1\t{k + 1}\t{f}\t{k}\t{f % 4}" for k in range(2) for f in range(6)]),
                    "pixels": text(*[f"{f}\t0\t{k + 1}\t{f}\t{k}\t1" for k in range(2) for f in range(4)])},
        "petrack": {"txt": text("# PeTrack version: 0.9", "# framerate: 25 fps", "# id frame x/m y/m z/m", *[f"{k + 1} {f} {f} {k} 1.7" for k in range(2) for f in range(4)])},
        "mot": {"txt": text(*[f"{f + 1},{k + 1},{10 * f},20,5,6,1,-1,-1,-1" for f in range(4) for k in range(2)])},
        "keypoints": {"csv": keypoints},
        "wide": {"pairs": text("frame,x1,y1,x2,y2", *[f"{f},{f},1,,2" for f in range(4)]), "sleap": text("track,frame_idx,instance.score,nose.x,nose.y,nose.score",
                 *[f"a,{f},1,{f},2,0.9" for f in range(4)])},
        "text": TEXTS,
    }
    all["any"] = {f"{target}-{name}": data for target, seeds in all.items() for name, data in list(seeds.items())[:1]}
    all["any"] |= {"gzip": gzip.compress(PLAIN, mtime=0), "zip": packed({"a.csv": PLAIN}), "pickle": pickle.dumps([1]), "rtf": b"{\\rtf1}", "empty": b""}
    return all


# ---- meshes: a tetrahedron ---------------------------------------------------------------------------------------------------------

CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


def ply(order):
    head = ["ply", f"format {order} 1.0", "comment made by hand", "element vertex 4", "property float x", "property double y", "property uchar red",
            "property int z", "element face 4", "property list uchar ushort vertex_indices", "element other 1", "property list int short junk", "end_header"]
    if order == "ascii":
        return text(*head, *[f"{x} {y} 9 {z}" for x, y, z in CORNERS], *["3 {} {} {}".format(*face) for face in FACES], "2 7 7")
    end = ">" if order == "binary_big_endian" else "<"
    return text(*head) + b"".join(struct.pack(end + "fdBi", x, y, 9, z) for x, y, z in CORNERS) + \
        b"".join(struct.pack(end + "B3H", 3, *face) for face in FACES) + struct.pack(end + "i2h", 2, 7, 7)


def meshes():
    facet = lambda face: ["facet normal 0 0 0", "outer loop", *["vertex {} {} {}".format(*CORNERS[k]) for k in face], "endloop", "endfacet"]
    soup = b"".join(struct.pack("<12fH", 0, 0, 0, *[v for k in face for v in CORNERS[k]], 0) for face in FACES)
    square = text("v 0 0 0", "v 1 0 0", "v 1 1 0", "v 0 1 0", "v .5 .5 1", "f 4 3 2 1", "f 1 2 5", "f 2 3 5", "f 3 4 5", "f 4 1 5")
    return {"mesh-obj": {"body": text("# a comment", "o body", *["v {} {} {}".format(*c) for c in CORNERS], "vn 0 0 1", "f 1/1/1 3 2", "f 1 2 4", "f 2//1 3 4",
                                      "f -4 -1 -2"), "pyramid": square},
            "mesh-stl": {"text": text("solid body", *[line for face in FACES for line in facet(face)], "endsolid body"),
                         "binary": b"made by hand".ljust(80) + struct.pack("<I", 4) + soup},
            "mesh-ply": {order: ply(order) for order in ("ascii", "binary_little_endian", "binary_big_endian")}}


# ---- what the program reads back from itself -----------------------------------------------------------------------------------------


def checkpoint():
    head = f"swarmfit checkpoint 1\nversion 0\nrecording recording\nconfig {hashlib.sha256(b'config').hexdigest()}\n".encode()
    seal, out = hashlib.sha256(head).hexdigest(), head
    for value in (b"one", b"two" * 20):
        payload = hashlib.sha256(value).hexdigest().encode() + value
        seal = hashlib.sha256(seal.encode() + payload).hexdigest()
        out += struct.pack("<I", len(payload)) + payload + seal.encode()
    return out


def kept():
    words = struct.pack("<I", 1) + struct.pack("<I", 3) + b"abc"
    return b"\1" + struct.pack("<I", 4) + b"name" + struct.pack("<I2d", 2, 1.5, -1) + b"\1" + words


def settings():
    fit = text("[fit]", 'DATA = ["a, \\"b\\".csv"]', 'model = ["bswarm[noise=white]"]', "replicates = 3", 'bounds = ["radius=1:2"]', "fps = 25.0", "join = true",
               'columns = "id=object,x=X"', 'seed = "18446744073709551615"', "max-time = 60")
    return {"config.toml": {"fit": fit, "compare": fit.replace(b"[fit]", b"[compare]").replace(b"bswarm[noise=white]", b"boids,brownian"),
                            "convert": text("[convert]", 'DATA = "a.csv"', 'out = "b.csv"', "stride = 2", 'scale = "0.05mm/px"', 'tracks = ["a", "b"]', 'unwrap = "10,20"')},
            "words": {name: word.encode() for name, word in {"number": "1e-3", "time": "1.5h", "whole": "18446744073709551615", "choice": "noise", "scale": "0.05,1mm/px"}.items()},
            "checkpoint": {"two": checkpoint()}, "kept": {"part": kept()}}


def main(folder):
    for target, seeds in {**readers(), **meshes(), **settings()}.items():
        at = Path(folder) / target
        at.mkdir(parents=True, exist_ok=True)
        for name, data in seeds.items():
            (at / name).write_bytes(data)


if __name__ == "__main__":
    main(*sys.argv[1:])
