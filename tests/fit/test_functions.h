// SPDX-License-Identifier: MIT
// Test functions on the unit cube with a known optimum, which lies away from the centre so that no method profits from a liking for it.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "fit/optimise/differential_evolution.h"
#include "libtrack/rng.h"

namespace swarmfit::testing {

struct TestFunction {
  std::string name;
  Point optimum;                              // in the cube; the true value there is 0
  std::function<double(const Point&)> truth;  // without noise
  std::function<double(const Point&)> cost;   // what a search sees: a pure function of the point, as with common random numbers

  BatchCost batch() const {
    return [f = cost](const std::vector<Point>& points) {
      std::vector<double> costs;
      for (const Point& x : points) costs.push_back(f(x));
      return costs;
    };
  }
};

// Uniform in [0.2, 0.8]^d, another one for every seed.
inline Point random_optimum(int dimensions, std::uint64_t seed) {
  Point x(dimensions);
  for (int k = 0; k < dimensions; ++k) x[k] = 0.2 + 0.6 * Rng{seed}.uniform(Stream::start, 0, static_cast<std::uint32_t>(k));
  return x;
}

inline TestFunction noiseless(std::string name, Point optimum, const std::function<double(const Point&)>& f) {
  return {std::move(name), std::move(optimum), f, f};
}

// Rastrigin's function, box side 10.24: about 10^d local minima.
inline TestFunction rastrigin(int dimensions, std::uint64_t seed) {
  const Point optimum = random_optimum(dimensions, seed);
  return noiseless("Rastrigin", optimum, [optimum](const Point& x) {
    const Eigen::ArrayXd z = 10.24 * (x - optimum).array();
    return (z.square() + 10.0 * (1.0 - (2.0 * std::numbers::pi * z).cos())).sum();
  });
}

// Independent standard normal numbers.
inline Eigen::MatrixXd normal_matrix(int rows, int columns, std::uint64_t seed) {
  Eigen::MatrixXd m(rows, columns);
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k)
      m(i, k) = Rng{seed}.normal2(Stream::start, static_cast<std::uint64_t>(i) + 1, static_cast<std::uint32_t>(k))[0];
  }
  return m;
}

// The same, turned at random: no coordinate can be searched by itself.
inline TestFunction rotated_rastrigin(int dimensions, std::uint64_t seed) {
  const Point optimum = random_optimum(dimensions, seed);
  const Eigen::MatrixXd rotation = normal_matrix(dimensions, dimensions, seed).householderQr().householderQ();
  return noiseless("rotated Rastrigin", optimum, [optimum, rotation](const Point& x) {
    const Eigen::ArrayXd z = (rotation * (10.24 * (x - optimum))).array();
    return (z.square() + 10.0 * (1.0 - (2.0 * std::numbers::pi * z).cos())).sum();
  });
}

// Rosenbrock's valley, box side 10.
inline TestFunction rosenbrock(int dimensions, std::uint64_t seed) {
  const Point optimum = random_optimum(dimensions, seed);
  return noiseless("Rosenbrock", optimum, [optimum](const Point& x) {
    const Eigen::ArrayXd z = 1.0 + 10.0 * (x - optimum).array();
    double sum = 0;
    for (Eigen::Index k = 0; k + 1 < z.size(); ++k) sum += 100.0 * std::pow(z[k + 1] - z[k] * z[k], 2) + std::pow(1.0 - z[k], 2);
    return sum;
  });
}

inline TestFunction sphere(int dimensions, std::uint64_t seed) {
  const Point optimum = random_optimum(dimensions, seed);
  return noiseless("sphere", optimum, [optimum](const Point& x) { return 100.0 * (x - optimum).squaredNorm(); });
}

// What a fit looks like: the mean total variation distance of seven histograms, normal distributions whose means and widths depend on
// the parameters, from those at the optimum. A sharp valley without a parabola at its bottom.
inline TestFunction histograms(int dimensions, std::uint64_t seed) {
  static constexpr int metrics = 7, bins = 60;
  const Point optimum = random_optimum(dimensions, seed);
  const Eigen::MatrixXd effect = 1.5 * normal_matrix(2 * metrics, dimensions, seed + 1000);
  const auto densities = [effect](const Point& x) {
    const Eigen::ArrayXd drive = (effect * (x.array() - 0.5).matrix()).array().tanh();
    const Eigen::ArrayXd position = Eigen::ArrayXd::LinSpaced(bins, -5, 5);
    Eigen::ArrayXXd density(bins, metrics);
    for (int j = 0; j < metrics; ++j) {
      density.col(j) = (-0.5 * ((position - 2 * drive[j]) / std::exp(drive[metrics + j])).square()).exp();
      density.col(j) /= density.col(j).sum();
    }
    return density;
  };
  const Eigen::ArrayXXd recorded = densities(optimum);
  return noiseless("histograms", optimum, [=](const Point& x) { return (densities(x) - recorded).abs().sum() / (2 * metrics); });
}

// Frozen noise: a normal number that is a hash of the point's bits, independent from point to point.
inline double noise_at(const Point& x, std::uint64_t seed) {
  Rng hash{seed};
  for (const double v : x)
    hash = hash.derive(Stream::localisation, std::bit_cast<std::uint64_t>(v) >> 16,
                       static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(v)));
  return hash.normal2(Stream::localisation, 1, 0)[0];
}

// `f` with frozen noise of standard deviation `sd`.
inline TestFunction noisy(TestFunction f, double sd, std::uint64_t seed) {
  f.name = "noisy " + f.name;
  f.cost = [truth = f.truth, sd, seed](const Point& x) { return truth(x) + sd * noise_at(x, seed); };
  return f;
}

}  // namespace swarmfit::testing
