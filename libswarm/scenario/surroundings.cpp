// SPDX-License-Identifier: MIT
#include "libswarm/scenario/surroundings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libswarm/scenario/mesh_file.h"
#include "libswarm/scenario/read.h"
#include "libtrack/error.h"
#include "libtrack/file.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Words = std::vector<std::string_view>;

Bounds::Wall wall_of(Table& table) { return table.choice("wall", "reflect") == "slip" ? Bounds::Wall::slip : Bounds::Wall::reflect; }

// The bytes of a mesh's file, and what errors call it.
struct MeshFile {
  std::string name, bytes;
};

MeshFile mesh_file(const Table& table, const std::string& file) {
  const std::string beside = table.beside(file);
  try {
    return {beside, read_file(beside)};
  } catch (const InputError&) {
    for (const ScenarioFile& own : scenario_meshes())
      if (own.name == file) return {file, std::string(own.text)};
    table.refuse("file", fmt::format("= '{}' is not there; expected a mesh beside {}", file, table.path()));
  }
}

std::shared_ptr<const Mesh> mesh_of(Table& table, int dims) {
  const MeshFile file = mesh_file(table, table.text("file", std::nullopt));
  const double scale = table.number("scale", 1);
  return read_mesh(file.name, file.bytes, scale, table.place("at", Array3d::Zero(), dims));
}

}  // namespace

void read_corners(Table& table, int dims, Array3d& lower, Array3d& upper) {
  lower = table.place("lower", std::nullopt, dims);
  upper = table.place("upper", std::nullopt, dims);
  for (Index axis = 0; axis < dims; ++axis)
    if (!(lower[axis] < upper[axis]))
      table.refuse("upper", fmt::format("is {:g} on axis {}, where lower is {:g}; expected more", upper[axis], "xyz"[axis], lower[axis]));
}

Bounds read_bounds(Table table, int dims) {
  Bounds bounds;
  const auto shape = table.choice("shape", std::nullopt);
  if (shape == "box" || shape == "periodic") {
    bounds.kind = shape == "box" ? Bounds::Kind::box : Bounds::Kind::periodic;
    read_corners(table, dims, bounds.lower, bounds.upper);
  } else if (shape == "sphere") {
    bounds.kind = Bounds::Kind::sphere;
    bounds.centre = table.place("centre", Array3d::Zero(), dims);
    bounds.radius = table.number("radius", std::nullopt);
  }
  if (shape == "box" || shape == "sphere") bounds.wall = wall_of(table);
  table.finish();
  return bounds;
}

Obstacle read_obstacle(Table table, int dims) {
  static const Words kFlat{"sphere", "box", "plane"};
  Obstacle o;
  const auto shape = dims == 3 ? table.choice("shape", std::nullopt) : table.choice("shape", kFlat, std::nullopt);
  if (shape == "box") {
    o.shape = Obstacle::Shape::box;
    read_corners(table, dims, o.lower, o.upper);
  } else if (shape == "cylinder") {
    o.shape = Obstacle::Shape::cylinder;
    o.lower = table.place("lower", std::nullopt, dims);
    o.upper = table.place("upper", std::nullopt, dims);
    if ((o.lower == o.upper).all()) table.refuse("upper", "is lower; expected the other end of the cylinder's axis");
  } else if (shape == "plane") {
    o.shape = Obstacle::Shape::plane;
    o.normal = table.place("normal", std::nullopt, dims);
    const double length = std::sqrt(o.normal.square().sum());
    if (!(length > 0)) table.refuse("normal", "is zero; expected the direction to the side where agents are");
    o.normal /= length;
  } else if (shape == "mesh") {
    o.shape = Obstacle::Shape::mesh;
    o.mesh = mesh_of(table, dims);
  }
  if (shape == "sphere" || shape == "plane") o.centre = table.place("centre", std::nullopt, dims);
  if (shape == "sphere" || shape == "cylinder") o.radius = table.number("radius", std::nullopt);
  o.wall = wall_of(table);
  table.finish();
  return o;
}

Surroundings read_surroundings(const std::string& path, const std::string& text, int dims) {
  const Node file = parse_toml(path, text);
  Table root(path, file, "");
  Surroundings around;
  if (auto table = root.table("bounds")) around.bounds = read_bounds(*table, dims);
  for (const Table& table : root.tables("obstacle")) around.obstacles.push_back(read_obstacle(table, dims));
  root.finish();
  return around;
}

}  // namespace swarmfit
