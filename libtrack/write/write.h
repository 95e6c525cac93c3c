// SPDX-License-Identifier: MIT
// Tracks as delimited text that every reader of tables, ours included, understands.
#pragma once

#include <string>

#include "libtrack/tracks.h"

namespace swarmfit {

// CSV with the header id,frame,t,x,y[,z][,vx,vy[,vz]][,ax,ay[,az]][,kind], sorted by individual and time. Unit, frame interval and
// provenance stand in '#' lines before it, so that read_tracks() needs no flags. Numbers are written with as many digits as it takes to
// get the same bits back. Individuals without a row are left out, and reading numbers individuals in natural order of their names (2, 10,
// a), as all readers do.
std::string to_csv(const Tracks& tracks);

// Writes to_csv() atomically. Throws RunError.
void write_csv(const std::string& path, const Tracks& tracks);

}  // namespace swarmfit
