// SPDX-License-Identifier: MIT
#include "libtrack/write/write.h"

#include <array>
#include <charconv>

#include "libtrack/file.h"

namespace swarmfit {
namespace {

template <class Number>
void append(std::string& out, Number value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  out.append(text.data(), end);
}

// A name with a delimiter, a quote or a comment sign in it is quoted.
std::string quoted(const std::string& name) {
  if (!name.empty() && name.find_first_of(",;\t\" #%") == std::string::npos) return name;
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

void append_facts(std::string& out, const Tracks& tracks) {
  const auto& meta = tracks.meta();
  if (meta.from.synthetic) out += "# synthetic: made by a simulator\n";
  for (std::size_t k = 0; k < meta.kinds.size(); ++k) {
    out += k == 0 ? "# kinds: " : "; ";
    out += meta.kinds[k];
  }
  if (!meta.kinds.empty()) out += '\n';
  if (!meta.unit.empty()) out += "# unit: " + meta.unit + '\n';
  out += "# fps: ";
  append(out, 1 / meta.dt);
  out += "\n# frame interval: ";
  append(out, meta.dt);
  out += " s\n# time of frame 0: ";
  append(out, meta.t0);
  out += " s\n";
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

void write_csv(const std::string& path, const Tracks& tracks) { write_file_atomically(path, to_csv(tracks)); }

}  // namespace swarmfit
