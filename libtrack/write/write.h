// SPDX-License-Identifier: MIT
// Tracks in formats that other programs read, and ours without flags and without losing a bit. Notes, which say what was done to the
// recording, are kept in all of them.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "libtrack/polyhedron.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// CSV with the header id,frame,t,x,y[,z][,vx,vy[,vz]][,ax,ay[,az]][,kind], sorted by individual and time. Unit, frame interval and
// provenance stand in '#' lines before it, so that read_tracks() needs no flags. Numbers are written with as many digits as it takes to
// get the same bits back. Individuals without a row are left out, and reading numbers individuals in natural order of their names (2, 10,
// a), as all readers do.
std::string to_csv(const Tracks& tracks);

// HDF5: columns track, frame, t, x, y[, z][, vx, ...][, kind] of one number per row, sorted by frame; `names` of the tracks that `track`
// counts from 0; `notes`; attributes of the root: swarmfit "tracks/1", unit, dt [s], t0 [s].
std::string to_hdf5(const Tracks& tracks);

// NumPy's .npz with the same arrays; swarmfit, unit, dt and t0 are arrays of one value.
std::string to_npz(const Tracks& tracks);

// SQLite as JuPedSim writes it, version 2: what PedPy and JuPedSim's own viewer read. Ids are numbers: other names stand in the table
// track_names. The geometry is the smallest rectangle round all positions. Recorded velocities are left out. Throws InputError for
// three-dimensional recordings and those that are not in metres, which is what the format can hold.
std::string to_jupedsim(const Tracks& tracks);

// Tracks, and what was around them for formats that hold it.
struct Surrounded {
  const Tracks& tracks;
  std::span<const Polyhedron> bodies = {};  // that stand still
  const Tracks* marks = nullptr;            // stimuli and goals; null: none
};
using PutFile = std::function<void(const std::string& path, const std::string& bytes)>;

// A series of files for ParaView: `path`, which ends on .pvd, and a folder of that name without the ending with a .vtp for every frame.
// Points have id (a number of the track), kind, velocity [unit/s] and speed. `put` writes a file; that of `path` comes last. Throws
// InputError for another ending.
void to_vtk(const Surrounded& all, const std::string& path, const PutFile& put);

struct WrittenFormat {
  std::string_view name, summary, endings;
  std::string (*write)(const Tracks&) = nullptr;  // one file; null: several
  void (*write_several)(const Surrounded&, const std::string& path, const PutFile& put) = nullptr;
};
std::span<const WrittenFormat> written_formats();

// By name, or else by the ending of the path; CSV where that says nothing. Throws InputError for a name that is not there.
const WrittenFormat& written_format(std::string_view name, std::string_view path);

// Writes to_csv() atomically. Throws RunError.
void write_csv(const std::string& path, const Tracks& tracks);

}  // namespace swarmfit
