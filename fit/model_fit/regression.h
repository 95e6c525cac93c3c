// SPDX-License-Identifier: MIT
// Parameters by regression of accelerations, where a model has forces (ModelSpec::force): gradient matching (Varah 1982,
// doi:10.1137/0903003; Ramsay et al. 2007, doi:10.1111/j.1467-9868.2007.00610.x). No recording is simulated: a second opinion, within
// seconds.
#pragma once

#include <optional>
#include <vector>

#include "fit/experiment/conditions.h"
#include "fit/model_fit/search_space.h"

namespace swarmfit {

// In physical units; the ends of the 95 % interval are NaN on a bound, and of radii at which a force jumps: those are profiled.
struct RegressedParameter {
  std::size_t row;  // of the parameter table
  double value, lower, upper;
};

struct AccelerationFit {
  std::vector<RegressedParameter> parameters;  // searched ones that the force depends on, in table order
  double memory = 0;                           // of the noise [s]; 0: none was found
  Index rows = 0;                              // accelerations that were used
};

// Solves, by Gauss-Newton steps from the defaults,
//
//   sum over t of f'(t-4) [a_t - F_t - rho (a_{t-1} - F_{t-1})] = 0,
//
// F being the model's acceleration without noise at recorded places and velocities, f' its derivatives by the parameters, as instruments
// (libswarm/instrumental_regression.h). rho is searched for where the model's noise has a memory, else 0. Values stay between the bounds of
// the search.
//
// Nothing for models without forces, where nothing is searched, with too few unbroken tracks, and where the steps do not converge.
std::optional<AccelerationFit> acceleration_fit(const SearchSpace& space, const Conditions& conditions);

}  // namespace swarmfit
