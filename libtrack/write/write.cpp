// SPDX-License-Identifier: MIT
#include "libtrack/write/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "libtrack/error.h"
#include "libtrack/file.h"
#include "libtrack/read/text_header.h"
#include "libtrack/write/append.h"

namespace swarmfit {
namespace {

// A name with a delimiter, a quote or a comment sign in it is quoted, and one that would count as missing.
std::string quoted(const std::string& name) {
  if (!is_missing(name) && name.find_first_of(",;\t\" #%") == std::string::npos) return name;
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

// Words that a blank or a quote would end are put between quotes; there are no control characters in what was read.
std::string one_word(const std::string& text) {
  if (!text.empty() && text.find_first_of(" \t\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : c == '\n' || c == '\r' ? " " : std::string(1, c);
  return out + '"';
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

void append_facts(std::string& out, const Tracks& tracks) {
  const auto& meta = tracks.meta();
  if (meta.from.synthetic) out += "# synthetic: made by a simulator\n";
  for (std::size_t k = 0; k < meta.kinds.size(); ++k) {
    out += k == 0 ? "# kinds: " : "; ";
    out += one_line(meta.kinds[k]);
  }
  if (!meta.kinds.empty()) out += '\n';
  if (!meta.unit.empty()) out += "# unit: " + one_word(meta.unit) + '\n';
  out += "# fps: ";
  append(out, 1 / meta.dt);
  out += "\n# frame interval: ";
  append(out, meta.dt);
  out += " s\n# time of frame 0: ";
  append(out, meta.t0);
  out += " s\n";
  for (const auto& note : meta.from.notes) out += "# note: " + one_line(note) + '\n';
  if (tracks.episodes().empty()) return;
  out += "# episodes:";
  for (const auto frame : tracks.episodes()) {
    out += ' ';
    append(out, frame);
  }
  out += '\n';
}

void append_header(std::string& out, const Tracks& tracks, bool kinds) {
  const bool deep = tracks.dims() == 3;
  out += deep ? "id,frame,t,x,y,z" : "id,frame,t,x,y";
  if (tracks.has_velocity()) out += deep ? ",vx,vy,vz" : ",vx,vy";
  if (tracks.has_acceleration()) out += deep ? ",ax,ay,az" : ",ax,ay";
  out += kinds ? ",kind\n" : "\n";
}

void append_vector(std::string& out, const Rows& rows, Index row, int dims) {
  for (int axis = 0; axis < dims; ++axis) {
    out += ',';
    append(out, rows(row, axis));
  }
}

bool has_kinds(const Tracks& tracks) {
  for (Index row = 0; row < tracks.rows(); ++row)
    if (tracks.kind(row) != 0) return true;
  return false;
}

}  // namespace

std::string to_csv(const Tracks& tracks) {
  const bool kinds = has_kinds(tracks);
  std::string out;
  append_facts(out, tracks);
  append_header(out, tracks, kinds);
  for (std::uint32_t track = 0; track < tracks.track_count(); ++track) {
    const auto name = quoted(tracks.names()[track]);
    for (const Index row : tracks.rows_of(track)) {
      const auto frame = tracks.frame()[static_cast<std::size_t>(row)];
      out += name;
      out += ',';
      append(out, frame);
      out += ',';
      append(out, tracks.time(frame));
      append_vector(out, tracks.pos(), row, tracks.dims());
      if (tracks.has_velocity()) append_vector(out, tracks.vel(), row, tracks.dims());
      if (tracks.has_acceleration()) append_vector(out, tracks.acc(), row, tracks.dims());
      if (kinds) {
        out += ',';
        append(out, static_cast<int>(tracks.kind(row)));
      }
      out += '\n';
    }
  }
  return out;
}

std::span<const WrittenFormat> written_formats() {
  static constexpr std::array list = {WrittenFormat{"csv", "delimited text with a header", ".csv", to_csv},
                                      WrittenFormat{"hdf5", "HDF5, one column per dataset", ".h5 .hdf5", to_hdf5},
                                      WrittenFormat{"npz", "NumPy arrays, one per column", ".npz", to_npz},
                                      WrittenFormat{"jupedsim", "JuPedSim's SQLite; metres, two dimensions", ".sqlite", to_jupedsim},
                                      WrittenFormat{"vtk", "a series for ParaView; not read back", ".pvd", nullptr, to_vtk}};
  return list;
}

const WrittenFormat& written_format(std::string_view name, std::string_view path) {
  const auto all = written_formats();
  if (!name.empty()) {
    const auto hit = std::find_if(all.begin(), all.end(), [&](const auto& f) { return f.name == name; });
    if (hit == all.end()) throw InputError(fmt::format("'{}' is not known; expected csv, hdf5, npz, jupedsim or vtk", name));
    return *hit;
  }
  for (const auto& format : all)
    for (const std::string_view ending :
         {format.endings.substr(0, format.endings.find(' ')), format.endings.substr(format.endings.rfind(' ') + 1)})
      if (path.ends_with(ending)) return format;
  return all.front();
}

void write_csv(const std::string& path, const Tracks& tracks) { write_file_atomically(path, to_csv(tracks)); }

}  // namespace swarmfit
