// SPDX-License-Identifier: MIT
// VTK's XML: a .pvd that lists the times, and a .vtp (PolyData) for every frame in a folder beside it, as ParaView, VisIt and PyVista read
// them. Numbers are text, with as many digits as it takes to get the same bits back.
#include <array>
#include <charconv>
#include <map>

#include "libtrack/error.h"
#include "libtrack/kinematics.h"
#include "libtrack/write/append.h"
#include "libtrack/write/write.h"

namespace swarmfit {
namespace {

template <class Number>
void append_field(std::string& out, Number value) {
  append(out, value);
  out += ' ';
}

constexpr std::string_view kHead =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n";
constexpr std::string_view kFoot = "</Piece>\n</PolyData>\n</VTKFile>\n";

template <class Fill>
void array(std::string& out, std::string_view type, std::string_view name, int components, Fill&& fill) {
  out += "<DataArray type=\"";
  out += type;
  out += "\" Name=\"";
  out += name;
  out += "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"ascii\">\n";
  fill();
  out += "\n</DataArray>\n";
}

std::string piece(std::size_t points, std::size_t verts, std::size_t polys) {
  return "<Piece NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfVerts=\"" + std::to_string(verts) +
         "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(polys) + "\">\n";
}

// Velocities as far as they are known: recorded, to the next frame, or from the one before; 0 of somebody who is seen only once.
Rows velocities(const Tracks& tracks) {
  if (tracks.has_velocity()) return tracks.vel();
  Rows v = forward_velocity(tracks);
  for (Index row = 0; row < tracks.rows(); ++row)
    if (const Index next = tracks.next()[static_cast<std::size_t>(row)]; next >= 0 && !v.row(next).isFinite().all())
      v.row(next) = v.row(row);
  for (Index row = 0; row < tracks.rows(); ++row)
    if (!v.row(row).isFinite().all()) v.row(row).setZero();
  return v;
}

std::string vtp_of_frame(const Tracks& tracks, const FrameRange& frame, const Rows& velocity) {
  const auto n = static_cast<std::size_t>(frame.count);
  const Index end = frame.first + frame.count;
  std::string out(kHead);
  out += piece(n, n, 0) + "<PointData Scalars=\"speed\" Vectors=\"velocity\">\n";
  array(out, "Int64", "id", 1, [&] {
    for (Index row = frame.first; row < end; ++row) append_field(out, tracks.track()[static_cast<std::size_t>(row)]);
  });
  array(out, "UInt8", "kind", 1, [&] {
    for (Index row = frame.first; row < end; ++row) append_field(out, static_cast<int>(tracks.kind(row)));
  });
  array(out, "Float64", "velocity", 3, [&] {
    for (Index row = frame.first; row < end; ++row)
      for (Index axis = 0; axis < 3; ++axis) append_field(out, velocity(row, axis));
  });
  array(out, "Float64", "speed", 1, [&] {
    for (Index row = frame.first; row < end; ++row) append_field(out, std::sqrt(velocity.row(row).square().sum()));
  });
  out += "</PointData>\n<Points>\n";
  array(out, "Float64", "position", 3, [&] {
    for (Index row = frame.first; row < end; ++row)
      for (Index axis = 0; axis < 3; ++axis) append_field(out, tracks.pos()(row, axis));
  });
  out += "</Points>\n<Verts>\n";
  array(out, "Int64", "connectivity", 1, [&] {
    for (std::size_t k = 0; k < n; ++k) append_field(out, k);
  });
  array(out, "Int64", "offsets", 1, [&] {
    for (std::size_t k = 1; k <= n; ++k) append_field(out, k);
  });
  out += "</Verts>\n";
  return out += kFoot;
}

std::string vtp_of_bodies(std::span<const Polyhedron> bodies) {
  std::size_t corners = 0, faces = 0;
  for (const Polyhedron& body : bodies) corners += body.corners.size(), faces += body.faces.size();
  std::string out(kHead);
  out += piece(corners, 0, faces) + "<Points>\n";
  array(out, "Float64", "position", 3, [&] {
    for (const Polyhedron& body : bodies)
      for (const auto& corner : body.corners)
        for (Eigen::Index axis = 0; axis < 3; ++axis) append_field(out, corner[axis]);
  });
  out += "</Points>\n<Polys>\n";
  array(out, "Int64", "connectivity", 1, [&] {
    int first = 0;
    for (const Polyhedron& body : bodies) {
      for (const auto& face : body.faces)
        for (const int corner : face) append_field(out, first + corner);
      first += static_cast<int>(body.corners.size());
    }
  });
  array(out, "Int64", "offsets", 1, [&] {
    std::size_t end = 0;
    for (const Polyhedron& body : bodies)
      for (const auto& face : body.faces) append_field(out, end += face.size());
  });
  out += "</Polys>\n";
  return out += kFoot;
}

std::string in_xml(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string numbered(const char* what, std::int64_t frame) {
  std::string digits = std::to_string(frame < 0 ? -frame : frame);
  digits.insert(0, digits.size() < 6 ? 6 - digits.size() : 0, '0');
  return std::string(what) + (frame < 0 ? "-" : "") + digits + ".vtp";
}

}  // namespace

void to_vtk(const Surrounded& all, const std::string& path, const PutFile& put) {
  constexpr std::string_view kEnding = ".pvd";
  if (!path.ends_with(kEnding) || path.size() == kEnding.size())
    throw InputError("'" + path + "' cannot be a series of VTK files; expected a name that ends on .pvd");
  const std::string folder = path.substr(0, path.size() - kEnding.size());
  const std::string within = in_xml(folder.substr(folder.find_last_of('/') + 1)) + "/";
  std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
  const auto add = [&](double t, int part, const std::string& name) {
    list += "<DataSet timestep=\"";
    append_field(list, t);
    list.back() = '"';
    list += " part=\"" + std::to_string(part) + "\" file=\"" + within + name + "\"/>\n";
  };
  const auto add_tracks = [&](const Tracks& tracks, int part, const char* what) {
    const Rows velocity = velocities(tracks);
    for (const FrameRange& frame : tracks.frames()) {
      const std::string name = numbered(what, frame.number);
      std::string file = folder;
      put(file.append("/").append(name), vtp_of_frame(tracks, frame, velocity));
      add(tracks.time(frame.number), part, name);
    }
  };
  add_tracks(all.tracks, 0, "frame");
  if (!all.bodies.empty()) {
    put(folder + "/bodies.vtp", vtp_of_bodies(all.bodies));
    for (const FrameRange& frame : all.tracks.frames()) add(all.tracks.time(frame.number), 1, "bodies.vtp");
  }
  if (all.marks && all.marks->rows() > 0) add_tracks(*all.marks, 2, "marks");
  put(path, list + "</Collection>\n</VTKFile>\n");  // last: it lists what is there
}

}  // namespace swarmfit
