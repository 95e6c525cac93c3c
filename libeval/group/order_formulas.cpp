// SPDX-License-Identifier: MIT
#include "libeval/group/order_formulas.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "libeval/spacing.h"
#include "libtrack/nan.h"
#include "libtrack/quantile.h"

namespace swarmfit::order_formulas {
namespace {

using Eigen::Vector3d;
constexpr double kPart = 0.1;       // share of all that makes a component a part
constexpr double kLaneWidth = 1.5;  // in nearest-neighbour distances: 3/4 of the spacing 2 d of a Poisson process (Rex and Löwen 2007)
constexpr Index kLeastShape = 3;    // individuals that have a shape

// Mean of what is added; NaN if fewer than `least` were.
struct Mean {
  double sum = 0;
  Index count = 0;
  void add(double x) { sum += x, ++count; }
  double value(Index least = 1) const { return count < least ? kNaN : sum / static_cast<double>(count); }
};

// Length of a sum of vectors over their number; two at least.
struct MeanVector {
  Vector3d sum = Vector3d::Zero();
  Index count = 0;
  void add(const Vector3d& v) { sum += v, ++count; }
  Vector3d value() const { return count > 0 ? Vector3d(sum / static_cast<double>(count)) : Vector3d(Vector3d::Constant(kNaN)); }
  double length() const { return count < 2 ? kNaN : sum.norm() / static_cast<double>(count); }
};

bool moves(const Motion& m, std::size_t k) { return m.heading[k] != Vector3d::Zero(); }

// r̂ × ê at the mid-point of every step.
template <class Add>
void for_each_turn(const Motion& m, const Add& add) {
  for (std::size_t k = 0; k < m.row.size(); ++k) {
    const Vector3d r = 0.5 * (m.from[k] + m.to[k]);
    const double radius = r.norm();
    if (moves(m, k) && radius > 0) add(k, Vector3d((r / radius).cross(m.heading[k])));
  }
}

// The nearest neighbour's direction in the eyes of everybody who moves: cosine of its bearing.
template <class Add>
void for_each_bearing(const Moment& moment, const Add& add) {
  const Motion& m = moment.motion();
  for (std::size_t k = 0; k < m.row.size(); ++k) {
    const Index row = m.row[k], other = moment.nearest().row[static_cast<std::size_t>(row)];
    if (other < 0 || !moves(m, k)) continue;
    const Vector3d way = moment.separation(row, other);
    if (const double distance = way.norm(); distance > 0) add(m.heading[k].dot(way) / distance);
  }
}

}  // namespace

double individuals(const Moment& moment) { return static_cast<double>(moment.size()); }

double polarisation(const Moment& moment) {
  const Motion& m = moment.motion();
  MeanVector mean;
  for (std::size_t k = 0; k < m.row.size(); ++k)
    if (moves(m, k)) mean.add(m.heading[k]);
  return mean.length();
}

double milling(const Moment& moment) {
  const Motion& m = moment.motion();
  MeanVector mean;
  for (std::size_t k = 0; k < m.row.size(); ++k) {
    const Vector3d& r = moment.offsets()[static_cast<std::size_t>(m.row[k])];
    const double radius = r.norm();
    if (moves(m, k) && radius > 0) mean.add((r / radius).cross(m.heading[k]));
  }
  return mean.length();
}

double net_rotation(const Moment& moment) {
  MeanVector mean;
  for_each_turn(moment.motion(), [&](std::size_t, const Vector3d& turn) { mean.add(turn); });
  return mean.length();
}

double rotation(const Moment& moment) {
  Mean mean;
  for_each_turn(moment.motion(), [&](std::size_t, const Vector3d& turn) { mean.add(turn.norm()); });
  return mean.value(2);
}

double speed(const Moment& moment) {
  Mean mean;
  for (const Vector3d& step : moment.motion().step) mean.add(step.norm() / moment.options().dt);
  return mean.value();
}

double group_speed(const Moment& moment) {
  const Motion& m = moment.motion();
  return m.row.size() < 2 ? kNaN : m.mean_step.norm() / moment.options().dt;
}

double angular_speed(const Moment& moment) {
  const Motion& m = moment.motion();
  Mean mean;
  for (std::size_t k = 0; k < m.row.size(); ++k)
    mean.add(std::atan2(m.from[k].cross(m.to[k]).norm(), m.from[k].dot(m.to[k])) / moment.options().dt);
  return mean.value(2);
}

double extent(const Moment& moment) {
  double squares = 0;
  for (const Vector3d& r : moment.offsets()) squares += r.squaredNorm();
  return moment.size() < 2 ? kNaN : std::sqrt(squares / static_cast<double>(moment.size()));
}

double median_radius(const Moment& moment) {
  if (moment.size() < 2) return kNaN;
  std::vector<double> radius;
  for (const Vector3d& r : moment.offsets()) radius.push_back(r.norm());
  return median(std::move(radius));
}

double elongation(const Moment& moment) {
  const Motion& m = moment.motion();
  const double length = m.mean_step.norm();
  if (moment.size() < kLeastShape || !(length > 0)) return kNaN;
  const Vector3d ahead = m.mean_step / length;
  double along = 0, all = 0;
  for (const Vector3d& r : moment.offsets()) {
    const double x = r.dot(ahead);
    along += x * x;
    all += r.squaredNorm();
  }
  const double across = (all - along) / (moment.options().dims - 1);
  return across > 0 ? std::sqrt(along / across) : kNaN;
}

double axis_ratio(const Moment& moment) {
  const Vector3d& variance = moment.axes().variance;
  return moment.size() < kLeastShape || !(variance[0] > 0) ? kNaN : variance[1] / variance[0];
}

double axis_turn(const Moment& moment) {
  const Motion& m = moment.motion();
  if (static_cast<Index>(m.row.size()) < kLeastShape) return kNaN;
  const int dims = moment.options().dims;
  const Vector3d a = principal_axes(m.from, dims).axis.col(0), b = principal_axes(m.to, dims).axis.col(0);
  const Vector3d cross = a.cross(b);
  const double dot = a.dot(b), sine = dims == 2 ? cross[2] : cross.norm();
  // An axis has no sense: the shorter way.
  const double angle = dims == 2 ? std::atan2(dot < 0 ? -sine : sine, std::abs(dot)) : std::atan2(sine, std::abs(dot));
  return angle / moment.options().dt;
}

double core(const Moment& moment) {
  if (moment.size() < kLeastShape) return kNaN;
  const double radius = 0.5 * median_radius(moment);
  Mean mean;
  for (const Vector3d& r : moment.offsets()) mean.add(r.norm() < radius ? 1 : 0);
  return mean.value();
}

double halves(const Moment& moment) {
  const Motion& m = moment.motion();
  const Vector3d axis = principal_axes(m.from, moment.options().dims).axis.col(0);
  std::array<MeanVector, 2> middle, turn;
  const auto half = [&](std::size_t k) { return m.from[k].dot(axis) < 0 ? std::size_t{0} : std::size_t{1}; };
  const auto place = [&](std::size_t k) { return Vector3d(0.5 * (m.from[k] + m.to[k])); };
  for (std::size_t k = 0; k < m.row.size(); ++k) middle[half(k)].add(place(k));
  for (std::size_t k = 0; k < m.row.size(); ++k) {
    const Vector3d r = place(k) - middle[half(k)].value();
    const double radius = r.norm();
    if (moves(m, k) && radius > 0) turn[half(k)].add((r / radius).cross(m.heading[k]));
  }
  if (turn[0].count < kLeastShape || turn[1].count < kLeastShape) return kNaN;
  const double least = std::min(turn[0].length(), turn[1].length());
  return turn[0].sum.dot(turn[1].sum) < 0 ? -least : least;
}

double nearest(const Moment& moment) {
  Mean mean;
  if (moment.size() > 1)
    for (const double d : moment.nearest().distance) mean.add(d);
  return mean.value();
}

double nearest_cv(const Moment& moment) {
  if (moment.size() < kLeastShape) return kNaN;
  const double mean = nearest(moment);
  double squares = 0;
  for (const double d : moment.nearest().distance) squares += (d - mean) * (d - mean);
  return std::sqrt(squares / static_cast<double>(moment.size())) / mean;
}

double nearest_ratio(const Moment& moment) {
  const int dims = moment.options().dims;
  const auto n = static_cast<double>(moment.size());
  if (moment.size() < dims + 2) return kNaN;
  double determinant = 1;
  for (Index k = 0; k < dims; ++k) determinant *= moment.axes().variance[k] * n / (n - 1);
  const double free = poisson_nearest(dims) * std::pow(uniform_volume(determinant, dims) / n, 1.0 / dims);
  return free > 0 ? nearest(moment) / free : kNaN;
}

double parts(const Moment& moment) {
  const double least = std::max(2.0, kPart * static_cast<double>(moment.size()));
  const auto& size = moment.components().size;
  return static_cast<double>(std::count_if(size.begin(), size.end(), [&](Index n) { return static_cast<double>(n) >= least; }));
}

double largest(const Moment& moment) { return static_cast<double>(moment.components().size.front()) / static_cast<double>(moment.size()); }

double mixing(const Moment& moment) {
  const Motion& m = moment.motion();
  if (m.row.size() < 2) return kNaN;
  const auto nearest_of = [&](const std::vector<Vector3d>& places) {
    Places all;
    all.pos.resize(static_cast<Index>(places.size()), 3);
    for (std::size_t k = 0; k < places.size(); ++k) all.pos.row(static_cast<Index>(k)) = places[k].transpose().array();
    return Moment(moment.options(), all).nearest().row;
  };
  const auto before = nearest_of(m.from), after = nearest_of(m.to);
  Mean mean;
  for (std::size_t k = 0; k < before.size(); ++k) mean.add(before[k] == after[k] ? 0 : 1 / moment.options().dt);
  return mean.value();
}

double ahead(const Moment& moment) {
  Mean mean;
  for_each_bearing(moment, [&](double cosine) { mean.add(cosine); });
  return mean.value();
}

double abreast(const Moment& moment) {
  Mean mean;
  for_each_bearing(moment, [&](double cosine) { mean.add(std::sqrt(std::max(0.0, 1 - cosine * cosine))); });
  return mean.value();
}

double lanes(const Moment& moment) {
  const Motion& m = moment.motion();
  if (m.moving < 2) return kNaN;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const Vector3d& heading : m.heading) second += heading * heading.transpose();
  const Vector3d flow = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(second).eigenvectors().col(2);
  const double width = kLaneWidth * nearest(moment);
  Mean mean;
  for (std::size_t i = 0; i < m.row.size(); ++i) {
    double same = 0, opposite = 0;
    for (std::size_t j = 0; j < m.row.size(); ++j) {
      if (i == j || !moves(m, i) || !moves(m, j)) continue;
      const Vector3d way = moment.separation(m.row[i], m.row[j]);
      if ((way - way.dot(flow) * flow).norm() < width) ++(m.heading[i].dot(flow) * m.heading[j].dot(flow) > 0 ? same : opposite);
    }
    const double order = (same - opposite) / (same + opposite);
    if (same + opposite > 0) mean.add(order * order);
  }
  return mean.value();
}

double radial_force(const Moment& moment) {
  const Places& p = moment.places();
  const double dt2 = moment.options().dt * moment.options().dt;
  Mean mean;
  for (Index row = 0; row < moment.size(); ++row) {
    const Vector3d a = (p.step.row(row) - p.back.row(row)).transpose().matrix() / dt2;
    const Vector3d& r = moment.offsets()[static_cast<std::size_t>(row)];
    if (const double radius = r.norm(); std::isfinite(a.sum()) && radius > 0) mean.add(a.dot(r) / radius);
  }
  return mean.value(2);
}

}  // namespace swarmfit::order_formulas
