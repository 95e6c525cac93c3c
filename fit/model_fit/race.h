// SPDX-License-Identifier: MIT
// Candidates simulated on the same seeds: what is known of them, and how a search learns more.
#pragma once

#include <map>

#include "fit/experiment/objective.h"
#include "fit/model_fit/search_space.h"
#include "fit/optimise/differential_evolution.h"
#include "fit/optimise/screening.h"
#include "libeval/score.h"

namespace swarmfit {

// Cost of energies under a weighting: minus the score; +inf if it is undefined.
double cost_of(const Energies& energies, const Weighting& weighting);

// What a search minimises, in its parts: signed differences, each by the root of its column's weight.
Eigen::VectorXd parts_of(const Differences& differences, const Weighting& weighting);

struct Archived {
  Point x;
  Energies raw, guided, first;  // as in Outcome
  Differences differences;
};

// Candidates whose energies can be compared, now and under later weightings.
struct Round {
  Stream stream;
  std::vector<Rng> seeds;
  std::vector<Archived> archive;   // simulated on all seeds
  Point recommended;               // by the last search's response surface; empty before
  std::vector<Point> suggested{};  // by searches of the same model with other settings

  bool complete(const Outcome& outcome) const { return outcome.replicates.size() == seeds.size(); }
};

// Everything on all of the round's seeds, but what `worth` turns down after the first of them (none: nothing is turned down).
std::vector<Outcome> simulate(const Round& round, const std::vector<Point>& points, const SearchSpace& space, const Objective& objective,
                              const Objective::Worth& worth = {});

// The costs of one search, and what it has simulated. Holds references, so all arguments must outlive it.
class Race {
 public:
  Race(const Round& round, const SearchSpace& space, const Objective& objective, const Weighting& weighting);

  std::vector<double> cost(const std::vector<Point>& points);
  // +inf: given up. Parents are in the round's archive or were seen here.
  std::vector<double> against(const std::vector<Point>& children, const std::vector<Point>& parents);

  const Outcome& seen(const Point& x) const { return seen_.at(x); }  // without distributions

 private:
  struct Costs {
    double first, all;  // of the first replicates, and of all
  };
  struct Lexicographic {
    bool operator()(const Point& a, const Point& b) const;
  };
  Costs costs(const Energies& first, const Energies& all) const { return {cost_of(first, weighting_), cost_of(all, weighting_)}; }
  Costs known(const Point& x) const;
  std::vector<double> remember(const std::vector<Point>& points, std::vector<Outcome>& outcomes);

  const Round& round_;
  const SearchSpace& space_;
  const Objective& objective_;
  const Weighting& weighting_;
  Screening screening_;
  std::map<Point, Costs, Lexicographic> archived_;
  std::map<Point, Outcome, Lexicographic> seen_;
};

}  // namespace swarmfit
