// SPDX-License-Identifier: MIT
// Recordings by small Euler steps and the standard library's random numbers: nothing of our simulators is in them.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

struct LangevinTruth {
  double tau_v, k, tau_eta, sigma_eta;
};

// every: one in so many rows is missing.
inline Tracks langevin_recording(const LangevinTruth& t, int agents, int frames, double dt, double error, unsigned seed, int every = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  constexpr int fine = 50, settling = 400;
  const double h = dt / fine;
  TrackColumns c;
  std::vector<std::array<double, 2>> places;
  for (int a = 0; a < agents; ++a) c.names.push_back(std::to_string(a));
  std::vector<std::vector<std::array<double, 2>>> seen(static_cast<std::size_t>(agents));
  for (auto& path : seen)
    for (int axis = 0; axis < 2; ++axis) {
      double x = normal(random), v = normal(random), eta = t.sigma_eta * normal(random);
      path.resize(static_cast<std::size_t>(frames));
      for (int f = -settling; f < frames; ++f) {
        if (f >= 0) path[static_cast<std::size_t>(f)][static_cast<std::size_t>(axis)] = x + error * normal(random);
        for (int s = 0; s < fine; ++s) {
          const double dv = (-v / t.tau_v - t.k * x + eta) * h;
          eta += -eta / t.tau_eta * h + t.sigma_eta * std::sqrt(2 * h / t.tau_eta) * normal(random);
          x += v * h + dv * h / 2;
          v += dv;
        }
      }
    }
  for (int f = 0; f < frames; ++f)
    for (int a = 0; a < agents; ++a) {
      if (every > 1 && (f + a) % every == 1) continue;  // a gap
      c.track.push_back(static_cast<std::uint32_t>(a));
      c.frame.push_back(f);
      places.push_back(seen[static_cast<std::size_t>(a)][static_cast<std::size_t>(f)]);
    }
  c.pos = Rows::Zero(static_cast<Index>(places.size()), 3);
  for (std::size_t r = 0; r < places.size(); ++r)
    for (int axis = 0; axis < 2; ++axis) c.pos(static_cast<Index>(r), axis) = places[r][static_cast<std::size_t>(axis)];
  TrackMeta meta;
  meta.dt = dt;
  meta.dims = 2;
  return {std::move(c), meta};
}

struct SwarmTruth {  // Ren et al. 2016, Eqs 3 and 5, without alignment; white noise
  double gamma, lambda, chi_rep, chi_att, r_rep, r_att;
};

inline Tracks swarm_recording(const SwarmTruth& t, int agents, int frames, double dt, unsigned seed) {
  using Eigen::Array3d;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  constexpr int fine = 10, settling = 200;
  const double h = dt / fine;
  const auto any = [&](double by) { return Array3d(by * normal(random), by * normal(random), by * normal(random)); };
  std::vector<Array3d> x, v;
  for (int a = 0; a < agents; ++a) x.push_back(any(60)), v.push_back(any(100));
  TrackColumns c;
  for (int a = 0; a < agents; ++a) c.names.push_back(std::to_string(a));
  c.pos = Rows::Zero(static_cast<Index>(agents) * frames, 3);
  for (int f = -settling; f < frames; ++f) {
    for (int a = 0; f >= 0 && a < agents; ++a) {
      c.pos.row(static_cast<Index>(c.frame.size())) = x[static_cast<std::size_t>(a)].transpose();
      c.track.push_back(static_cast<std::uint32_t>(a));
      c.frame.push_back(f);
    }
    for (int s = 0; s < fine; ++s) {
      std::vector<Array3d> force;
      for (std::size_t i = 0; i < x.size(); ++i) {
        Array3d near = Array3d::Zero(), far = near;
        int nears = 0, fars = 0;
        for (std::size_t j = 0; j < x.size(); ++j) {
          if (j == i) continue;
          const Array3d to = x[j] - x[i];
          const double r = to.matrix().norm();
          if (r < t.r_rep) {
            near += to / r, ++nears;
          } else if (r < t.r_rep + t.r_att) {
            far += to / r, ++fars;
          }
        }
        Array3d sum = -t.gamma * v[i].matrix().norm() * v[i];
        if (nears > 0) sum -= t.chi_rep * near / nears;
        if (fars > 0) sum += t.chi_att * far / fars;
        force.push_back(sum);
      }
      for (std::size_t i = 0; i < x.size(); ++i) {
        v[i] += h * force[i] + any(t.lambda * std::sqrt(h));
        x[i] += h * v[i];
      }
    }
  }
  TrackMeta meta;
  meta.dt = dt;
  meta.dims = 3;
  meta.unit = "mm";
  return {std::move(c), meta};
}

}  // namespace swarmfit
