// SPDX-License-Identifier: MIT
#include "libswarm/centre.h"

namespace swarmfit {

using Eigen::Array3d;

Array3d middle_of(const Bounds& bounds) {
  switch (bounds.kind) {
    case Bounds::Kind::box:
    case Bounds::Kind::periodic:
      return 0.5 * (bounds.lower + bounds.upper);
    case Bounds::Kind::sphere:
      return bounds.centre;
    case Bounds::Kind::open:
      break;
  }
  return Array3d::Zero();
}

SwarmCentre::SwarmCentre(const Setup& setup) {
  if (!setup.reference || setup.reference->rows() == 0) return;
  const Rows& pos = setup.reference->pos();
  Array3d sum = Array3d::Zero();
  for (Index i = 0; i < pos.rows(); ++i) sum += pos.row(i).transpose();  // not Eigen's sum: its order changes with alignment
  recorded_ = sum / static_cast<double>(pos.rows());
}

}  // namespace swarmfit
