// SPDX-License-Identifier: MIT
// The force law that a recording shows, by regression of accelerations: no search, no simulation.
#pragma once

#include <memory>

#include "libswarm/force_fit.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// Of symmetric differences (libswarm/symmetric_differences.h), by instruments (libswarm/instrumental_regression.h).
class ForceRegression {
 public:
  ForceRegression(const Tracks& tracks, const ForceBasis& basis);
  ~ForceRegression();

  Index rows() const;    // accelerations that have instruments
  Index enough() const;  // to fit at all: four for every coefficient

  // Drag and confinement, which are always in, and beside them those groups whose coefficients are not all 0 at p < .05 / 5 (Wald, with the
  // memory of all groups together): they come in and go out one by one. None if there are fewer rows than enough.
  ForceGroups needed();

  ForceFit fit(const ForceGroups& groups);    // with the memory of the noise that goes with them
  ForceFit refit(const ForceGroups& groups);  // with the memory that was found last: for one group more, in which it might drown

 private:
  struct Measured;
  ForceGroups there(ForceGroups groups) const;
  ForceFit result(const ForceGroups& groups) const;
  std::unique_ptr<Measured> measured_;
};

// The needed groups, fitted.
ForceFit fit_forces(const Tracks& tracks, const ForceBasis& basis);

}  // namespace swarmfit
