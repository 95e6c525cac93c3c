// SPDX-License-Identifier: MIT
#include "fit/model_fit/regression.h"

#include <gmock/gmock.h>

#include <Eigen/LU>

#include <cmath>

#include "tests/fit/other_simulators.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

AccelerationFit fitted(const std::string& model, const Tracks& tracks) {
  const Conditions conditions = make_conditions(tracks, {});
  const SearchSpace space(parse_model(model), conditions.scales, {});
  const auto found = acceleration_fit(space, conditions);
  return found ? *found : AccelerationFit{};
}

const RegressedParameter& parameter(const AccelerationFit& fit, const std::string& model, const std::string& name) {
  const auto row = static_cast<std::size_t>(parse_model(model).spec->find(name));
  const auto at = std::find_if(fit.parameters.begin(), fit.parameters.end(), [row](const auto& p) { return p.row == row; });
  if (at == fit.parameters.end()) throw std::runtime_error(model + " has no " + name);
  return *at;
}

// The same equations written down for the three terms of friction and confinement, solved at once. Noise is white, so nothing is
// remembered.
TEST(AccelerationFit, IsTheSolutionOfItsLinearEquations) {
  const Tracks tracks = langevin_recording({0.6, 4, 0.004, 20}, 8, 300, 0.02, 0, 5);
  const Conditions conditions = make_conditions(tracks, {});
  const Array3d centre = tracks.pos().colwise().mean().transpose();
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const double dt = tracks.dt();
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    const auto rows = tracks.rows_of(t);
    const auto x = [&](std::size_t k) { return Array3d(tracks.pos().row(rows[k]).transpose()); };
    const auto terms = [&](std::size_t k) {
      const Array3d v = (x(k + 1) - x(k - 1)) / (2 * dt);
      Eigen::Matrix3d out;
      out.col(0) = v;
      out.col(1) = -v.square().sum() * v;
      out.col(2) = centre - (x(k - 1) + x(k) + x(k + 1)) / 3;
      return out;
    };
    for (std::size_t k = 5; k + 1 < rows.size(); ++k) {
      normal += terms(k - 4).transpose() * terms(k);
      right += terms(k - 4).transpose() * ((x(k + 1) - 2 * x(k) + x(k - 1)) / (dt * dt)).matrix();
    }
  }
  const Eigen::Vector3d expected = normal.inverse() * right;
  const std::string model = "brownian[interaction=none]";
  const AccelerationFit fit = fitted(model, tracks);
  ASSERT_EQ(fit.parameters.size(), 3u);
  EXPECT_EQ(fit.memory, 0);
  EXPECT_NEAR(parameter(fit, model, "k").value, expected[2], 1e-4 * expected[2]);
  ASSERT_GT(expected[1], 0) << "else gamma2 ends on its bound, and the others are others";
  EXPECT_NEAR(parameter(fit, model, "gamma2").value, expected[1], 1e-4 * expected[1]);
  EXPECT_NEAR(parameter(fit, model, "gamma1").value, expected[0], 1e-4 * std::abs(expected[0]));
}

// 95 % intervals of k in ten recordings with gaps and a localisation error: of ten at least 7 hold the truth with a probability of 99.9 %.
TEST(AccelerationFit, FindsFrictionAndConfinementThroughNoiseWithAMemoryAndError) {
  int held = 0;
  double off_k = 0, off_tau = 0, memory = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const AccelerationFit fit = fitted("langevin", langevin_recording({0.6, 4, 0.1, 5}, 20, 500, 0.02, 0.002, seed, 60));
    const auto& k = parameter(fit, "langevin", "k");
    held += k.lower <= 4 && 4 <= k.upper;
    off_k += std::abs(k.value / 4 - 1) / 10;
    off_tau += std::abs(parameter(fit, "langevin", "tau_v").value / 0.6 - 1) / 10;
    memory += fit.memory / 10;
  }
  EXPECT_GE(held, 7);
  EXPECT_LT(off_k, 0.15);
  EXPECT_LT(off_tau, 0.3);
  EXPECT_NEAR(memory, 0.1, 0.03);
}

TEST(AccelerationFit, FindsDragAttractionAndRadiusOfASwarm) {
  const SwarmTruth truth{.gamma = 0.008, .lambda = 400, .chi_rep = 600, .chi_att = 900, .r_rep = 60, .r_att = 400};
  const std::string model = "bswarm[noise=white,avoidance=none]";
  const AccelerationFit fit = fitted(model, swarm_recording(truth, 12, 400, 0.01, 7));
  const auto within = [&](const char* name, double value, double most) {
    const auto& p = parameter(fit, model, name);
    EXPECT_NEAR(p.value, value, most * value) << name;
    EXPECT_LT(p.lower, value) << name;
    EXPECT_GT(p.upper, value) << name;
  };
  within("gamma", truth.gamma, 0.15);
  within("chi_att", truth.chi_att, 0.25);
  within("chi_rep", truth.chi_rep, 0.4);
  EXPECT_NEAR(parameter(fit, model, "r_rep").value, truth.r_rep, 0.2 * truth.r_rep);
  EXPECT_TRUE(std::isnan(parameter(fit, model, "r_rep").lower)) << "profiled: no interval";
}

TEST(AccelerationFit, OnlyOfModelsWithForcesAndTracksLongEnough) {
  const Tracks tracks = langevin_recording({0.6, 4, 0.1, 5}, 3, 60, 0.02, 0, 1);
  EXPECT_EQ(fitted("boids", tracks).rows, 0);
  EXPECT_GT(fitted("langevin", tracks).rows, 0);
  EXPECT_EQ(fitted("langevin", langevin_recording({0.6, 4, 0.1, 5}, 3, 6, 0.02, 0, 1)).rows, 0);
}

}  // namespace
}  // namespace swarmfit
