// SPDX-License-Identifier: MIT
// Is a set of triangles the surface of a body? Parts of Mesh.
#pragma once

#include "libswarm/mesh.h"

namespace swarmfit {

struct MeshSurface {
  std::vector<Eigen::Array3d> corners;
  std::vector<Triangle> triangles;
  double volume = 0;
};

// As Mesh wants them, or InputError.
MeshSurface closed_surface(const std::vector<Eigen::Array3d>& corners, const std::vector<Triangle>& triangles);

std::vector<Eigen::Array3d> face_normals(const std::vector<Eigen::Array3d>& corners, const std::vector<Triangle>& triangles);  // unit

// Sum of the normals of both faces at an edge; edge k goes from corner k to the next.
std::vector<std::array<Eigen::Array3d, 3>> edge_normals(const std::vector<Triangle>& triangles, const std::vector<Eigen::Array3d>& faces);

// Sum of the normals of all faces at a corner, weighted by their angles there.
std::vector<Eigen::Array3d> corner_normals(const std::vector<Eigen::Array3d>& corners, const std::vector<Triangle>& triangles,
                                           const std::vector<Eigen::Array3d>& faces);

}  // namespace swarmfit
