// SPDX-License-Identifier: MIT
#include "fit/model_fit/likelihood.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <numbers>

#include "tests/fit/other_simulators.h"

namespace swarmfit {
namespace {

LinearMotion langevin(const LangevinTruth& t) {
  const ModelChoice model = parse_model("langevin");
  return *model.spec->linear(model.options, std::array{t.tau_v, t.k, t.tau_eta, t.sigma_eta});
}

// Log-density of the whole vector of positions at once, from its dense covariance.
double dense_log_density(const Eigen::VectorXd& z, const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  const Eigen::VectorXd off = root.matrixL().solve(z - mean);
  const Eigen::MatrixXd l = root.matrixL();
  return -0.5 * (off.squaredNorm() + static_cast<double>(z.size()) * std::log(2 * std::numbers::pi)) - l.diagonal().array().log().sum();
}

TEST(Likelihood, IsTheDensityOfAllPositionsTogether) {
  const LangevinTruth t{0.6, 4, 0.1, 5};
  const Tracks tracks = langevin_recording(t, 1, 12, 0.02, 0.01, 3, 5);
  const LinearMotion m = langevin(t);
  const double sd = 0.02, speed = natural_scales(tracks).speed * 1e3;
  double expected = 0;
  const Eigen::Array3d centre = tracks.pos().colwise().mean().transpose();
  for (int axis = 0; axis < 2; ++axis) {
    const Index n = tracks.rows();
    Eigen::VectorXd z = (tracks.pos().col(axis) - centre[axis]).matrix();
    Eigen::Matrix3d p0 = Eigen::Matrix3d::Zero();
    p0(0, 0) = sd * sd, p0(1, 1) = speed * speed;
    Eigen::Matrix3d on = Eigen::Matrix3d::Identity();
    on(2, 0) = m.hidden_on[0], on(2, 1) = m.hidden_on[1], on(2, 2) = m.hidden_sd;
    p0(2, 2) = 1;
    p0 = on * p0 * on.transpose();
    std::vector<Eigen::Matrix3d> keep, error;
    for (Index r = 1; r < n; ++r) {
      const LinearNoise<3> step(
          m.drift, m.noise,
          tracks.dt() * static_cast<double>(tracks.frame()[static_cast<std::size_t>(r)] - tracks.frame()[static_cast<std::size_t>(r - 1)]));
      Eigen::Matrix3d a, l;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          a(static_cast<Index>(i), static_cast<Index>(j)) = step.keep[i][j],
                                   l(static_cast<Index>(i), static_cast<Index>(j)) = step.draw[i][j];
      keep.push_back(a), error.push_back(l * l.transpose());
    }
    // Covariances of the states at two times, by carrying the earlier one on.
    const Index later = n - 1;
    Eigen::VectorXd mean(later);
    Eigen::MatrixXd covariance(later, later);
    Eigen::Matrix3d p = p0;
    Eigen::Vector3d y(z[0], 0, m.hidden_on[0] * z[0]);
    for (Index i = 0; i < later; ++i) {
      p = keep[static_cast<std::size_t>(i)] * p * keep[static_cast<std::size_t>(i)].transpose() + error[static_cast<std::size_t>(i)];
      y = keep[static_cast<std::size_t>(i)] * y;
      mean[i] = y[0];
      Eigen::Matrix3d carried = p;
      covariance(i, i) = p(0, 0) + sd * sd;
      for (Index j = i + 1; j < later; ++j) {
        carried = keep[static_cast<std::size_t>(j)] * carried;
        covariance(j, i) = covariance(i, j) = carried(0, 0);
      }
    }
    const Eigen::VectorXd rest = z.tail(later);
    expected += dense_log_density(rest, mean, covariance) - dense_log_density(rest.head(1), mean.head(1), covariance.topLeftCorner(1, 1));
  }
  EXPECT_NEAR(log_likelihood(tracks, m, Eigen::Array3d(sd, sd, 0)), expected, 1e-5 * std::abs(expected));
}

// 95 % intervals of 4 parameters in 10 recordings: of 40 such intervals at least 34 hold the truth with a probability of more than 99 %.
TEST(Likelihood, FindsWhatMadeARecordingOfOthers) {
  const LangevinTruth t{0.6, 4, 0.1, 5};
  const std::array truth{t.tau_v, t.k, t.tau_eta, t.sigma_eta};
  int held = 0;
  std::array<double, 4> off{};
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Tracks tracks = langevin_recording(t, 10, 250, 0.02, 0.005, seed, 9);
    const Conditions conditions = make_conditions(tracks, {});
    const SearchSpace space(parse_model("langevin"), conditions.scales, {});
    const auto found = maximum_likelihood(space, conditions, space.start(), Rng{seed});
    ASSERT_TRUE(found);
    ASSERT_EQ(found->parameters.size(), 4u);
    for (std::size_t p = 0; p < 4; ++p) {
      const MostLikely& one = found->parameters[p];
      held += one.lower <= truth[p] && truth[p] <= one.upper;
      off[p] += std::abs(one.value / truth[p] - 1) / 10;
    }
  }
  EXPECT_GE(held, 34);
  for (const double o : off) EXPECT_LT(o, 0.25);
}

TEST(Likelihood, OnlyOfModelsThatHaveOne) {
  const Tracks tracks = langevin_recording({0.6, 4, 0.1, 5}, 3, 60, 0.02, 0, 1);
  const Conditions conditions = make_conditions(tracks, {});
  const SearchSpace space(parse_model("boids"), conditions.scales, {});
  EXPECT_FALSE(maximum_likelihood(space, conditions, space.start(), Rng{1}));
}

}  // namespace
}  // namespace swarmfit
