// SPDX-License-Identifier: MIT
// The force law that a recording shows, by regression of accelerations: no search, no simulation.
#pragma once

#include <memory>

#include "libswarm/force_fit.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// Symmetric differences (libswarm/force_design.h). With noise that remembers by rho from frame to frame,
//
//   a_t - rho a_{t-1} = theta · (c_t - rho c_{t-1}) + new noise,
//
// and new noise is independent of the terms c four frames before, which share no position with either side: they are the instruments of
// a regression that neither localisation error nor the memory of the noise misleads (Söderström and Stoica 1983). rho and the variance of
// the remembered noise are those of an exponential through the autocovariance of the residuals from the third frame on, where error is
// gone, to where it has died away; the shortest memory is taken that agrees with its own theta. What is white is what the first two
// autocovariances have beside it and beside the localisation error:
//
//   sigma² = 6 / (11 dt³) (2 Var D + 3 Cov(D_t, D_t+1)),  D = a dt²
//
// Errors are those of a sandwich over pieces of tracks; tests are Hotelling's, as there may be few of them.
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
