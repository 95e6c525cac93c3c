// SPDX-License-Identifier: MIT
// Where a swarm is held, for models that tie their agents to a place.
#pragma once

#include "libswarm/world.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// Mean of all observed positions [unit]; the origin without a recording, or without a row in it.
inline Eigen::Array3d swarm_centre(const Tracks* recording) {
  if (!recording || recording->rows() == 0) return Eigen::Array3d::Zero();
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (Index i = 0; i < recording->rows(); ++i) sum += recording->pos().row(i).transpose();
  return sum / static_cast<double>(recording->rows());
}

// Centre of a bounded arena; the origin of an open one.
inline Eigen::Array3d arena_centre(const Bounds& bounds) {
  switch (bounds.kind) {
    case Bounds::Kind::open:
      break;
    case Bounds::Kind::sphere:
      return bounds.centre;
    case Bounds::Kind::box:
    case Bounds::Kind::periodic:
      return 0.5 * (bounds.lower + bounds.upper);
  }
  return Eigen::Array3d::Zero();
}

}  // namespace swarmfit
