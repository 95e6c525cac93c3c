// SPDX-License-Identifier: MIT
#include "libeval/confidence_set.h"

#include <algorithm>
#include <cmath>

#include "libtrack/nan.h"

namespace swarmfit {
namespace {

using Eigen::Index;
using Models = std::vector<Index>;

// Draws about their mean, without the rows that are not finite.
Eigen::MatrixXd centred(const Eigen::MatrixXd& draws, const Models& models) {
  Eigen::MatrixXd out(draws.rows(), static_cast<Index>(models.size()));
  Index rows = 0;
  for (Index b = 0; b < draws.rows(); ++b) {
    for (std::size_t k = 0; k < models.size(); ++k) out(rows, static_cast<Index>(k)) = draws(b, models[k]);
    rows += out.row(rows).allFinite();
  }
  out.conservativeResize(rows, Eigen::NoChange);
  for (Index k = 0; k < out.cols(); ++k) {
    double sum = 0;
    for (Index b = 0; b < rows; ++b) sum += out(b, k);
    out.col(k).array() -= sum / static_cast<double>(std::max<Index>(rows, 1));
  }
  return out;
}

// Standard deviation of the difference of two columns whose means are 0.
double scatter(const Eigen::MatrixXd& draws, Index i, Index j) {
  double sum = 0;
  for (Index b = 0; b < draws.rows(); ++b) {
    const double difference = draws(b, i) - draws(b, j);
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(draws.rows() - 1));
}

// A difference in units of its scatter; two models that never differ are equal or infinitely far apart.
double in_scatter(double difference, double sd) {
  if (sd > 0) return difference / sd;
  return difference == 0 ? 0 : std::copysign(INFINITY, difference);
}

// The models in the order in which they leave, each with the p of the hypothesis that those still there are equal.
struct Elimination {
  explicit Elimination(const ScoreDraws& all, const Models& models) : scores(all.scores), draws(centred(all.draws, models)) {
    for (std::size_t k = 0; k < models.size(); ++k) left.push_back({models[k], static_cast<Index>(k)});
    sd.resize(draws.cols(), draws.cols());
    for (Index i = 0; i < draws.cols(); ++i)
      for (Index j = 0; j < draws.cols(); ++j) sd(i, j) = scatter(draws, i, j);
  }

  struct Member {
    Index model, column;
  };

  // T_R and the model that lies farthest behind another, in units of the scatter.
  std::pair<double, std::size_t> range() const {
    std::pair<double, std::size_t> worst{-INFINITY, 0};
    for (std::size_t i = 0; i < left.size(); ++i)
      for (std::size_t j = 0; j < left.size(); ++j) {
        if (i == j) continue;
        const double t = in_scatter(scores(left[j].model) - scores(left[i].model), sd(left[i].column, left[j].column));
        if (t > worst.first) worst = {t, i};
      }
    return worst;
  }

  double range_of_draw(Index b) const {
    double most = 0;
    for (const Member& i : left)
      for (const Member& j : left) most = std::max(most, in_scatter(draws(b, i.column) - draws(b, j.column), sd(i.column, j.column)));
    return most;
  }

  double p(double statistic) const {
    Index beyond = 0;
    for (Index b = 0; b < draws.rows(); ++b) beyond += range_of_draw(b) >= statistic;
    return static_cast<double>(1 + beyond) / static_cast<double>(1 + draws.rows());
  }

  const Eigen::VectorXd& scores;
  Eigen::MatrixXd draws, sd;
  std::vector<Member> left;
};

Models scored(const ScoreDraws& all) {
  Models out;
  for (Index m = 0; m < all.scores.size(); ++m)
    if (std::isfinite(all.scores(m))) out.push_back(m);
  return out;
}

// p of these models among themselves; others are left as they are.
void eliminate(const ScoreDraws& all, const Models& models, std::vector<double>& p) {
  Elimination rest(all, models);
  if (rest.draws.rows() < 2) return;
  double highest = 0;
  while (rest.left.size() > 1) {
    const auto [statistic, worst] = rest.range();
    highest = std::max(highest, rest.p(statistic));  // once in, a set stays in
    p[static_cast<std::size_t>(rest.left[worst].model)] = highest;
    rest.left.erase(rest.left.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  if (!rest.left.empty()) p[static_cast<std::size_t>(rest.left.front().model)] = 1;
}

}  // namespace

std::vector<double> confidence_set_p(const ScoreDraws& all) {
  std::vector<double> p(static_cast<std::size_t>(all.scores.size()), kNaN);
  eliminate(all, scored(all), p);
  return p;
}

std::vector<int> confidence_groups(const ScoreDraws& all, double alpha) {
  std::vector<int> group(static_cast<std::size_t>(all.scores.size()), 0);
  Models rest = scored(all);
  for (int g = 1; !rest.empty(); ++g) {
    std::vector<double> p(group.size(), kNaN);
    eliminate(all, rest, p);
    Models others;
    for (const Index m : rest) {
      const double own = p[static_cast<std::size_t>(m)];
      if (own > alpha) group[static_cast<std::size_t>(m)] = g;
      if (own <= alpha) others.push_back(m);
    }
    rest = std::move(others);  // empty where p is NaN
  }
  return group;
}

}  // namespace swarmfit
