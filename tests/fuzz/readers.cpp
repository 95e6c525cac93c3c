// SPDX-License-Identifier: MIT
// Every reader of recordings, by the name of its format, and `any`: the one that knows the content. What is read is written and read again.
#include <algorithm>
#include <array>
#include <cstring>

#include "libtrack/error.h"
#include "libtrack/read/read.h"
#include "libtrack/write/write.h"
#include "tests/fuzz/fuzz.h"

namespace swarmfit::fuzz {
namespace {

bool same(const Rows& a, const Rows& b) {
  if (a.rows() != b.rows()) return false;
  for (Index axis = 0; axis < 3; ++axis)
    for (Index row = 0; row < a.rows(); ++row)
      if (a(row, axis) != b(row, axis)) return false;
  return true;
}

// What convert writes is the recording.
void must_come_back(const Tracks& tracks) {
  const std::string csv = to_csv(tracks);
  Tracks again;
  try {
    again = read_tracks_bytes("again.csv", csv);
  } catch (const InputError& error) {
    broken(std::string("our own CSV is refused: ") + error.what());
  }
  if (!std::equal(again.frame().begin(), again.frame().end(), tracks.frame().begin(), tracks.frame().end())) broken("other frames");
  if (!same(again.pos(), tracks.pos())) broken("other positions");
  if (again.dt() != tracks.dt() || again.meta().unit != tracks.meta().unit) broken("another frame interval or unit");
}

// Without flags, and with those that files of this format lack.
std::array<ReadOptions, 3> options(const std::string& format) {
  ReadOptions plain, bare, full;
  plain.format = bare.format = full.format = format;
  bare.fps = full.fps = 25;
  bare.unit = "px";
  full.unit = "m";
  full.node = "mean";
  full.fill_gaps = 2;
  full.missing = -1;
  full.wide = true;
  return {plain, bare, full};
}

void read(const std::string& format, const std::string& bytes) {
  for (const ReadOptions& how : options(format)) contract([&] { must_come_back(read_tracks_bytes("file", bytes, how)); });
}

bool in_a_child(std::string_view format) {
  constexpr std::array names = {"mat", "swarmfit-h5", "idtracker", "sleap", "slp", "pedestrian-h5", "deeplabcut-h5", "nwb", "hdf5"};
  return std::find(names.begin(), names.end(), format) != names.end();
}

}  // namespace

std::vector<Target> targets() {
  std::vector<Target> all;
  for (const Format& format : formats()) {
    const std::string name(format.name);
    all.push_back({name, [name](const std::string& bytes) { read(name, bytes); }, in_a_child(name)});
  }
  all.push_back({"any", [](const std::string& bytes) { read("", bytes); }, true});
  return all;
}

}  // namespace swarmfit::fuzz
