// SPDX-License-Identifier: MIT
#include "libswarm/mesh_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libtrack/error.h"
#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kFlat = 1e-12;  // of the square of the longest side: an area that is rounding; likewise of a volume

std::string named(const Array3d& p) { return fmt::format("({:g}, {:g}, {:g})", p[0], p[1], p[2]); }

// For every corner the first one at the same place.
std::vector<std::uint32_t> welded(const std::vector<Array3d>& corners) {
  std::vector<std::uint32_t> order(corners.size()), same(corners.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    for (Eigen::Index k = 0; k < 3; ++k)
      if (corners[a][k] != corners[b][k]) return corners[a][k] < corners[b][k];
    return a < b;
  };
  std::sort(order.begin(), order.end(), before);
  for (std::size_t k = 0; k < order.size(); ++k)
    same[order[k]] = k > 0 && (corners[order[k]] == corners[order[k - 1]]).all() ? same[order[k - 1]] : order[k];
  return same;
}

// The same triangle whichever corner it begins with.
Triangle from_least(const Triangle& t) {
  const auto least = static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
  return {t[least], t[(least + 1) % 3], t[(least + 2) % 3]};
}

void check_area(const std::vector<Array3d>& corners, const Triangle& t, std::size_t number) {
  const Array3d& a = corners[t[0]];
  const Array3d ab = corners[t[1]] - a, ac = corners[t[2]] - a, bc = ac - ab;
  const double side2 = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  if (!(length(cross(ab, ac)) > kFlat * side2))
    throw InputError(fmt::format("triangle {} has no area: {}, {}, {} are on a line; expected triangles", number + 1, named(a),
                                 named(corners[t[1]]), named(corners[t[2]])));
}

std::vector<Triangle> distinct(const std::vector<Array3d>& corners, const std::vector<Triangle>& triangles) {
  const std::vector<std::uint32_t> same = welded(corners);
  std::vector<Triangle> kept;
  for (std::size_t number = 0; number < triangles.size(); ++number) {
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (triangles[number][k] >= corners.size())
        throw InputError(
            fmt::format("triangle {} has corner {}; expected corners 1 to {}", number + 1, triangles[number][k] + 1, corners.size()));
      t[k] = same[triangles[number][k]];
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    check_area(corners, t, number);
    kept.push_back(from_least(t));
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

struct Edge {
  std::uint32_t from, to;
  std::uint32_t triangle;
};

// All edges in both directions, sorted by their ends; throws where one has not exactly two triangles, one each way.
std::vector<Edge> paired_edges(const std::vector<Array3d>& corners, const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({triangles[t][k], triangles[t][(k + 1) % 3], static_cast<std::uint32_t>(t)});
  const auto ends = [](const Edge& e) { return std::array{std::min(e.from, e.to), std::max(e.from, e.to), e.from}; };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return ends(a) < ends(b); });
  for (std::size_t k = 0; k < edges.size();) {
    std::size_t end = k;
    while (end < edges.size() && ends(edges[end])[0] == ends(edges[k])[0] && ends(edges[end])[1] == ends(edges[k])[1]) ++end;
    const std::string where = fmt::format("edge from {} to {}", named(corners[edges[k].from]), named(corners[edges[k].to]));
    if (end - k == 1) throw InputError(fmt::format("the surface is open at the {}; expected a closed one", where));
    if (end - k > 2) throw InputError(fmt::format("{} triangles meet at the {}; expected two", end - k, where));
    if (edges[k].from == edges[k + 1].from)
      throw InputError(
          fmt::format("the triangles at the {} turn different ways; expected all counter-clockwise as seen from outside", where));
    k = end;
  }
  return edges;
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t t) {
  while (parent[t] != t) t = parent[t] = parent[parent[t]];
  return t;
}

// Every part of the surface encloses a volume; returns the sum. About a corner of the surface, where rounding is least.
double enclosed(const std::vector<Array3d>& corners, const std::vector<Triangle>& triangles, const std::vector<Edge>& edges) {
  std::vector<std::uint32_t> parent(triangles.size());
  std::iota(parent.begin(), parent.end(), 0U);
  for (std::size_t k = 0; k < edges.size(); k += 2) parent[root_of(parent, edges[k].triangle)] = root_of(parent, edges[k + 1].triangle);
  std::vector<double> volume(triangles.size(), 0), area(triangles.size(), 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t part = root_of(parent, t);
    const Array3d& a = corners[triangles[part][0]];  // of its own part, or a small one far away would drown
    const Array3d p = corners[triangles[t][0]] - a, q = corners[triangles[t][1]] - a, r = corners[triangles[t][2]] - a;
    volume[part] += dot(p, cross(q, r)) / 6;
    area[part] += length(cross(q - p, r - p)) / 2;
  }
  double sum = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (parent[t] != t) continue;
    if (!(std::abs(volume[t]) > kFlat * std::pow(area[t], 1.5)))
      throw InputError(
          fmt::format("the part of the surface at {} encloses nothing; expected the surface of a body", named(corners[triangles[t][0]])));
    sum += volume[t];
  }
  return sum;
}

}  // namespace

MeshSurface closed_surface(const std::vector<Array3d>& corners, const std::vector<Triangle>& triangles) {
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (!corners[k].isFinite().all()) throw InputError(fmt::format("corner {} is {}; expected finite numbers", k + 1, named(corners[k])));
  MeshSurface surface{corners, distinct(corners, triangles)};
  if (surface.triangles.empty()) throw InputError("no triangles; expected the surface of a body");
  surface.volume = enclosed(corners, surface.triangles, paired_edges(corners, surface.triangles));
  if (surface.volume > 0) return surface;
  surface.volume = -surface.volume;
  for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

std::vector<Array3d> face_normals(const std::vector<Array3d>& corners, const std::vector<Triangle>& triangles) {
  std::vector<Array3d> normals;
  normals.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const Array3d n = cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]);
    normals.emplace_back(n / length(n));
  }
  return normals;
}

std::vector<std::array<Array3d, 3>> edge_normals(const std::vector<Triangle>& triangles, const std::vector<Array3d>& faces) {
  struct Side {
    std::uint32_t low, high, triangle, edge;
  };
  std::vector<Side> sides;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      sides.push_back({std::min(triangles[t][k], triangles[t][(k + 1) % 3]), std::max(triangles[t][k], triangles[t][(k + 1) % 3]), t, k});
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
  });
  std::vector<std::array<Array3d, 3>> normals(triangles.size());
  for (std::size_t k = 0; k + 1 < sides.size(); k += 2) {
    const Array3d sum = faces[sides[k].triangle] + faces[sides[k + 1].triangle];
    normals[sides[k].triangle][sides[k].edge] = normals[sides[k + 1].triangle][sides[k + 1].edge] = sum;
  }
  return normals;
}

std::vector<Array3d> corner_normals(const std::vector<Array3d>& corners, const std::vector<Triangle>& triangles,
                                    const std::vector<Array3d>& faces) {
  std::vector<Array3d> normals(corners.size(), Array3d::Zero());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Array3d a = corners[triangles[t][(k + 1) % 3]] - corners[triangles[t][k]];
      const Array3d b = corners[triangles[t][(k + 2) % 3]] - corners[triangles[t][k]];
      normals[triangles[t][k]] += std::atan2(length(cross(a, b)), dot(a, b)) * faces[t];
    }
  return normals;
}

}  // namespace swarmfit
