// SPDX-License-Identifier: MIT
#include "libswarm/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "libswarm/mesh_surface.h"
#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kLeaf = 4;  // most triangles of a box without children
constexpr double kSkin = 1e-9;      // of the diagonal
constexpr double kEdge = 1e-12;     // how far beyond an edge a way still meets a triangle, of its size

// The nearest point of a triangle, and of which part it is: 0 the face, 1 .. 3 edge k - 1, 4 .. 6 corner k - 4. After C. Ericson, Real-Time
// Collision Detection, 2005, section 5.1.5.
struct Foot {
  Array3d place;
  int part;
};
Foot foot_on(const Array3d& a, const Array3d& b, const Array3d& c, const Array3d& p) {
  const Array3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {a, 4};
  const Array3d bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {b, 5};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + d1 / (d1 - d3) * ab, 1};
  const Array3d cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {c, 6};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + d2 / (d2 - d6) * ac, 3};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), 2};
  const double all = va + vb + vc;
  return {a + vb / all * ab + vc / all * ac, 0};
}

double distance2(const Array3d& lower, const Array3d& upper, const Array3d& p) {
  double sum = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double beyond = std::max({lower[k] - p[k], p[k] - upper[k], 0.0});
    sum += beyond * beyond;
  }
  return sum;
}

// Does the way come within `margin` of the box before `most` of it is over?
bool meets(const Array3d& lower, const Array3d& upper, const Array3d& start, const Array3d& way, double most, double margin) {
  double enters = 0, leaves = most;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double low = lower[k] - margin, high = upper[k] + margin;
    if (way[k] == 0) {
      if (start[k] < low || start[k] > high) return false;
      continue;
    }
    const double a = (low - start[k]) / way[k], b = (high - start[k]) / way[k];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves;
}

// A stack of boxes that no tree of halves outgrows: it holds two per level.
struct Stack {
  std::array<std::uint32_t, 128> items;
  std::size_t size = 0;
  void push(std::uint32_t item) { items[size++] = item; }
  std::uint32_t pop() { return items[--size]; }
  bool empty() const { return size == 0; }
};

}  // namespace

Mesh::Mesh(const std::vector<Array3d>& corners, const std::vector<Triangle>& triangles) {
  MeshSurface surface = closed_surface(corners, triangles);
  corners_ = std::move(surface.corners);
  triangles_ = std::move(surface.triangles);
  volume_ = surface.volume;
  plant_tree();
  find_normals();
  skin_ = kSkin * length(upper() - lower());
  clearance_ = Clearance(lower(), upper(), [this](const Array3d& place) { return nearest(place).distance; });
}

void Mesh::plant_tree() {
  std::vector<std::uint32_t> order(triangles_.size());
  std::iota(order.begin(), order.end(), 0U);
  boxes_.reserve(triangles_.size());
  boxes_.emplace_back();
  split(0, order, 0, static_cast<std::uint32_t>(order.size()));
  std::vector<Triangle> sorted;
  sorted.reserve(order.size());
  for (const std::uint32_t t : order) sorted.push_back(triangles_[t]);
  triangles_ = std::move(sorted);
}

// Halves by number along the longest side of the box, so that the tree is as shallow as can be.
void Mesh::split(std::uint32_t box, std::vector<std::uint32_t>& order, std::uint32_t first, std::uint32_t end) {
  Array3d lower = Array3d::Constant(kInfinite), upper = -lower;
  for (std::uint32_t k = first; k < end; ++k)
    for (const std::uint32_t corner : triangles_[order[k]]) lower = lower.min(corners_[corner]), upper = upper.max(corners_[corner]);
  if (end - first <= kLeaf) {
    boxes_[box] = {lower, upper, first, end - first};
    return;
  }
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  const auto middle = [&](std::uint32_t t) {
    return corners_[triangles_[t][0]][axis] + corners_[triangles_[t][1]][axis] + corners_[triangles_[t][2]][axis];
  };
  const std::uint32_t half = first + (end - first) / 2;
  std::nth_element(order.begin() + first, order.begin() + half, order.begin() + end, [&](std::uint32_t a, std::uint32_t b) {
    const double ma = middle(a), mb = middle(b);
    return ma < mb || (ma == mb && a < b);
  });
  const auto child = static_cast<std::uint32_t>(boxes_.size());
  boxes_[box] = {lower, upper, child, 0};
  boxes_.resize(boxes_.size() + 2);
  split(child, order, first, half);
  split(child + 1, order, half, end);
}

void Mesh::find_normals() {
  const std::vector<Array3d> faces = face_normals(corners_, triangles_);
  const auto edges = edge_normals(triangles_, faces);
  const std::vector<Array3d> at_corners = corner_normals(corners_, triangles_, faces);
  normals_.resize(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    normals_[t].face = faces[t];
    normals_[t].edge = edges[t];
    for (std::size_t k = 0; k < 3; ++k) normals_[t].corner[k] = at_corners[triangles_[t][k]];
  }
}

Mesh::Near Mesh::nearest(const Array3d& p) const {
  double best = kInfinite;
  std::uint32_t triangle = 0;
  Foot foot{p, 0};
  Stack open;
  open.push(0);
  while (!open.empty()) {
    const Box& box = boxes_[open.pop()];
    if (distance2(box.lower, box.upper, p) >= best) continue;
    if (box.count == 0) {
      const Box &one = boxes_[box.first], &other = boxes_[box.first + 1];
      const bool first_is_near = distance2(one.lower, one.upper, p) <= distance2(other.lower, other.upper, p);
      open.push(first_is_near ? box.first + 1 : box.first);
      open.push(first_is_near ? box.first : box.first + 1);
      continue;
    }
    for (std::uint32_t t = box.first; t < box.first + box.count; ++t) {
      const Foot f = foot_on(corners_[triangles_[t][0]], corners_[triangles_[t][1]], corners_[triangles_[t][2]], p);
      const Array3d from = p - f.place;
      if (const double d2 = dot(from, from); d2 < best) best = d2, triangle = t, foot = f;
    }
  }
  const Pseudonormals& n = normals_[triangle];
  const auto part = static_cast<std::size_t>(foot.part);
  const Array3d& pseudo = part == 0 ? n.face : part < 4 ? n.edge[part - 1] : n.corner[part - 4];
  const Array3d from = p - foot.place;
  const double d = std::sqrt(best), sign = dot(from, pseudo) < 0 ? -1 : 1;
  // At the surface itself the way there has no direction.
  const double size = length(pseudo);
  const Array3d outward = d > 1e-3 * skin_ && d > 0 ? Array3d(sign / d * from) : Array3d(pseudo / size);
  return {sign * d, foot.place, outward};
}

bool Mesh::inside(const Array3d& p) const {
  const double known = clearance(p);
  if (known > 0 || known < -2 * skin_) return known < 0;
  return nearest(p).distance < -2 * skin_;
}

std::optional<Mesh::Hit> Mesh::first_hit(const Array3d& start, const Array3d& way) const {
  double most = 1;
  std::optional<std::uint32_t> met;
  const double far = length(way);
  Stack open;
  if (far > std::abs(clearance(start)) - 2 * skin_ && far > 0) open.push(0);
  while (!open.empty()) {
    const Box& box = boxes_[open.pop()];
    if (!meets(box.lower, box.upper, start, way, most, 2 * skin_)) continue;
    if (box.count == 0) {
      open.push(box.first);
      open.push(box.first + 1);
      continue;
    }
    for (std::uint32_t t = box.first; t < box.first + box.count; ++t) {
      const Array3d &a = corners_[triangles_[t][0]], ab = corners_[triangles_[t][1]] - a, ac = corners_[triangles_[t][2]] - a;
      const Array3d n = cross(ab, ac);  // T. Möller, B. Trumbore, 1997; only from outside
      const double towards = -dot(way, n);
      if (!(towards > 0)) continue;
      const Array3d from = start - a;
      const double above = dot(from, n);
      if (above < -2 * skin_ * length(n)) continue;  // it is behind the triangle already
      const double share = std::max(0.0, above / towards);
      if (share > most || (met && share == most)) continue;
      const Array3d q = cross(from, way);
      const double u = dot(ac, q) / towards, v = -dot(ab, q) / towards;
      if (u < -kEdge || v < -kEdge || u + v > 1 + kEdge) continue;
      most = share;
      met = t;
    }
  }
  if (!met) return std::nullopt;
  const Array3d& outward = normals_[*met].face;
  Array3d place = start + most * way;
  place += (skin_ - dot(place - corners_[triangles_[*met][0]], outward)) * outward;
  return Hit{most, place, outward};
}

}  // namespace swarmfit
