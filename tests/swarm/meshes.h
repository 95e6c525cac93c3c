// SPDX-License-Identifier: MIT
// Meshes of known bodies.
#pragma once

#include <cmath>
#include <map>
#include <numbers>

#include "libswarm/mesh.h"

namespace swarmfit {

struct RawMesh {
  std::vector<Eigen::Array3d> corners;
  std::vector<Triangle> triangles;
  Mesh mesh() const { return {corners, triangles}; }
};

inline RawMesh box_mesh(const Eigen::Array3d& lower, const Eigen::Array3d& upper) {
  RawMesh m;
  for (unsigned k = 0; k < 8; ++k)
    m.corners.emplace_back((k & 1U) != 0 ? upper[0] : lower[0], (k & 2U) != 0 ? upper[1] : lower[1], (k & 4U) != 0 ? upper[2] : lower[2]);
  m.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return m;
}

// An octahedron whose edges are halved `levels` times; all corners on the unit sphere.
inline RawMesh sphere_mesh(int levels) {
  RawMesh m;
  m.corners = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  m.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> halves;
    const auto half = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, is_new] = halves.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(m.corners.size()));
      if (is_new) {
        Eigen::Array3d p = m.corners[a] + m.corners[b];
        p /= std::sqrt(p.square().sum());
        m.corners.push_back(p);
      }
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : m.triangles) {
      const std::uint32_t ab = half(a, b), bc = half(b, c), ca = half(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, Triangle{b, bc, ab}, Triangle{c, ca, bc}, Triangle{ab, bc, ca}}) finer.push_back(t);
    }
    m.triangles = finer;
  }
  return m;
}

// Radii 1 and 0.4 about z, n by n quadrilaterals.
inline RawMesh torus_mesh(std::uint32_t n) {
  RawMesh m;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / n, r = 1 + 0.4 * std::cos(v);
      m.corners.emplace_back(r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v));
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * n + j, b = (i + 1) % n * n + j, c = (i + 1) % n * n + (j + 1) % n, d = i * n + (j + 1) % n;
      m.triangles.push_back({a, b, c});
      m.triangles.push_back({a, c, d});
    }
  return m;
}

}  // namespace swarmfit
