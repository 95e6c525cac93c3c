// SPDX-License-Identifier: MIT
#include "libeval/order.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "libtrack/cut.h"

namespace swarmfit {
namespace {

using Eigen::Vector3d;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Vector3d position(const Tracks& tracks, Index row) { return {tracks.pos()(row, 0), tracks.pos()(row, 1), tracks.pos()(row, 2)}; }

// Length of a sum of unit vectors over their number.
struct MeanUnit {
  Vector3d sum = Vector3d::Zero();
  Index count = 0;
  void add(const Vector3d& unit) { sum += unit, ++count; }
  double length() const { return count < 2 ? kNaN : sum.norm() / static_cast<double>(count); }
};

struct Order {
  double polarisation, milling, extent;
};

Order order_of(const Tracks& tracks, const FrameRange& frame) {
  const auto n = static_cast<double>(frame.count);
  Vector3d centre = Vector3d::Zero();
  for (Index row = frame.first; row < frame.first + frame.count; ++row) centre += position(tracks, row);
  centre /= n;

  MeanUnit heading, rotation;
  double squares = 0;
  for (Index row = frame.first; row < frame.first + frame.count; ++row) {
    const Vector3d p = position(tracks, row), r = p - centre;
    squares += r.squaredNorm();
    const Index next = tracks.next()[static_cast<std::size_t>(row)];
    if (next < 0) continue;
    const Vector3d step = position(tracks, next) - p;
    const double length = step.norm(), radius = r.norm();
    if (!(length > 0)) continue;
    heading.add(step / length);
    if (radius > 0) rotation.add((r / radius).cross(step / length));
  }
  return {heading.length(), rotation.length(), frame.count < 2 ? kNaN : std::sqrt(squares / n)};
}

}  // namespace

OrderSeries order_parameters(const Tracks& tracks, std::optional<std::uint8_t> kind) {
  if (kind) return order_parameters(of_kind(tracks, *kind));
  OrderSeries out;
  for (const FrameRange& frame : tracks.frames()) {
    const Order order = order_of(tracks, frame);
    out.frame.push_back(frame.number);
    out.polarisation.push_back(order.polarisation);
    out.milling.push_back(order.milling);
    out.extent.push_back(order.extent);
  }
  return out;
}

double mean_defined(const std::vector<double>& values) {
  double sum = 0, count = 0;
  for (const double x : values)
    if (std::isfinite(x)) sum += x, ++count;
  return count > 0 ? sum / count : kNaN;
}

}  // namespace swarmfit
