// SPDX-License-Identifier: MIT
#include "libtrack/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swarmfit {
namespace {

using Eigen::Array3d;

double norm(const Array3d& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

}  // namespace

double Curve::length() const {
  double sum = 0;
  for (std::size_t k = 0; k < pieces(); ++k) sum += norm(end_of(k) - points[k]);
  return sum;
}

double distance_to(const Curve& curve, const Array3d& x) {
  double best = INFINITY;
  for (std::size_t k = 0; k < curve.pieces(); ++k) {
    const Array3d a = curve.points[k], along = curve.end_of(k) - a;
    const double square = (along * along).sum();
    const double part = square > 0 ? std::clamp(((x - a) * along).sum() / square, 0.0, 1.0) : 0;
    best = std::min(best, norm(x - a - part * along));
  }
  return best;
}

std::vector<Array3d> places_along(const Curve& curve, std::size_t count) {
  std::vector<Array3d> out;
  const double step = curve.length() / static_cast<double>(curve.closed ? count : count - 1);
  double walked = 0;  // up to the beginning of piece k
  for (std::size_t k = 0; k < curve.pieces(); ++k) {
    const Array3d along = curve.end_of(k) - curve.points[k];
    const double length = norm(along);
    for (; out.size() < count; out.push_back(curve.points[k] + (static_cast<double>(out.size()) * step - walked) / length * along))
      if (static_cast<double>(out.size()) * step > walked + length || length == 0) break;
    walked += length;
  }
  while (out.size() < count) out.push_back(curve.end_of(curve.pieces() - 1));  // rounding
  return out;
}

Curve placed(const Curve& curve, double factor, const Array3d& centre, bool upright) {
  Array3d mean = Array3d::Zero();
  for (const Array3d& p : curve.points) mean += p / static_cast<double>(curve.points.size());
  Curve out = curve;
  for (Array3d& p : out.points) {
    const Array3d d = factor * (p - mean);
    p = centre + (upright ? Array3d(d[0], -d[2], d[1]) : d);
  }
  return out;
}

Curve heart() {
  Curve out{{}, true};
  for (int k = 0; k < 11; ++k) {
    const double t = 2 * std::numbers::pi * k / 11, s = std::sin(t);
    out.points.emplace_back(16 * s * s * s, 13 * std::cos(t) - 5 * std::cos(2 * t) - 2 * std::cos(3 * t) - std::cos(4 * t), 0);
  }
  return out;
}

Curve star() {
  Curve out{{}, true};
  for (int k = 0; k < 10; ++k) {
    const double angle = std::numbers::pi * (0.5 + k / 5.0), radius = k % 2 == 0 ? 1 : 0.382;
    out.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return out;
}

}  // namespace swarmfit
