// SPDX-License-Identifier: MIT
// Every reader of meshes. What is taken for a body must be one: it has a volume, and its own corners are on its surface.
#include <cmath>

#include "libswarm/mesh.h"
#include "libswarm/scenario/mesh_file.h"
#include "tests/fuzz/fuzz.h"

namespace swarmfit::fuzz {
namespace {

constexpr std::size_t kTriangles = 16;  // that are asked about
constexpr double kRounding = 1e-6;      // of the diagonal

void must_be_a_body(const Mesh& mesh) {
  if (!(mesh.volume() > 0 && std::isfinite(mesh.volume()))) broken("a body without a volume");
  const double diagonal = mesh.skin() * 1e9;
  const Eigen::Array3d middle = (mesh.lower() + mesh.upper()) / 2;
  if (!std::isfinite(mesh.nearest(middle).distance)) broken("no distance from its middle");
  for (std::size_t t = 0; t < std::min(kTriangles, mesh.triangles().size()); ++t) {
    const Eigen::Array3d& corner = mesh.corners()[mesh.triangles()[t][0]];
    if (!(std::abs(mesh.nearest(corner).distance) <= kRounding * diagonal)) broken("a corner off its surface");
    const auto hit = mesh.first_hit(middle, corner - middle);
    if (hit && !hit->place.allFinite()) broken("a way that ends nowhere");
  }
}

Target target(const std::string& ending) {
  return {"mesh-" + ending,
          [name = "file." + ending](const std::string& bytes) { contract([&] { must_be_a_body(*read_mesh(name, bytes)); }); }};
}

}  // namespace

std::vector<Target> targets() { return {target("obj"), target("stl"), target("ply")}; }

}  // namespace swarmfit::fuzz
