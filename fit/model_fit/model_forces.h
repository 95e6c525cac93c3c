// SPDX-License-Identifier: MIT
// The acceleration that a model with forces (ModelSpec::force) gives to recorded animals.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "fit/experiment/conditions.h"
#include "libswarm/simulate.h"
#include "libswarm/symmetric_differences.h"

namespace swarmfit {

// Everybody who was there is seen by the others, at the places and velocities of symmetric differences.
class ModelForces {
 public:
  // The model is one without noise.
  ModelForces(const ModelChoice& model, const Conditions& conditions, const SymmetricDifferences& seen);

  // Per axis, a value per row of the differences [unit/s²]; NaN where the model blew up. parameters: a value per row of its table.
  std::array<Eigen::VectorXd, 3> at(const std::vector<double>& parameters) const;

 private:
  struct Moment {
    State state;
    std::vector<Index> equation;  // of every agent; -1: it has none
  };
  void add(const FrameRange& frame, const SymmetricDifferences& seen, const std::vector<Index>& equation);

  Index rows_;
  std::unique_ptr<Model> model_;
  World world_;
  Plan plan_;
  std::vector<Moment> moments_;
};

}  // namespace swarmfit
