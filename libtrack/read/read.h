// SPDX-License-Identifier: MIT
// Reading recordings of any known format into Tracks.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "libtrack/tracks.h"

namespace swarmfit {

// first <= value <= last.
struct Interval {
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();
  bool contains(double value) const { return first <= value && value <= last; }
};

// "a:b" with either side open: "100:200", "100:", ":200". Throws InputError naming the setting.
Interval parse_interval(std::string_view setting, std::string_view text);

// What the user says about a file. Frame rate and unit are taken from the file or from here, never guessed.
struct ReadOptions {
  std::string columns{};                   // "id,x,y,z,t,_,_" by position, or "id=object,t=time,x=X" by header name
  std::optional<char> delimiter{};         // of delimited text; ' ' stands for runs of blanks
  std::optional<double> fps{};             // frames per second, > 0
  std::string unit{};                      // length unit
  std::string variable{};                  // name inside a container file
  std::string time_unit{};                 // of bare numbers in a time column: ms, min, ...; empty: the header's, else seconds
  std::string dates{};                     // "day-first", "month-first"; empty: found out
  std::string decimal{};                   // "comma", "point"; empty: found out
  bool join = false;                       // the path is a folder, or a pattern with * and ?: its files are one recording
  std::vector<std::string> joined{};       // with join: these files, and the path is what the recording is called
  bool wide = false;                       // several pairs of columns x, y are individuals, not points of one
  std::optional<double> missing{};         // positions with this value in x and y were not seen
  std::string format{};                    // name of a format; empty: found out
  std::string node{};                      // of a posture: the point that stands for the individual, or "mean"; empty: the only one
  std::optional<double> min_confidence{};  // points that the tracker is less sure of, 0 to 1, are not seen
  std::optional<Interval> frames{};        // inclusive, in the file's own numbering
  std::optional<Interval> times{};         // inclusive [s]
  std::optional<double> resample{};        // frames per second of the result, > 0: positions between the recorded ones, see resample.h
  int fill_gaps = 0;                       // gaps of at most this many frames are filled by linear interpolation
};

// Reads a recording, with options.join that of several files, whose names are those of the individuals. Harmless defects are repaired and
// counted in meta().from.notes; everything else throws InputError with one line "file:line:column: what is wrong; what was expected".
Tracks read_tracks(const std::string& path, const ReadOptions& options = {});

// The same for bytes that are in memory already (standard input); `name` stands for the path in messages.
Tracks read_tracks_bytes(const std::string& name, std::string bytes, const ReadOptions& options = {});

// A file format, for listings.
struct Format {
  std::string_view name;     // as --format takes it
  std::string_view summary;  // one line
  std::string_view endings;  // usual file endings, separated by blanks
};

// All formats that can be read, in the order in which they are tried.
std::span<const Format> formats();

}  // namespace swarmfit
