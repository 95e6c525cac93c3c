// SPDX-License-Identifier: MIT
#include "libswarm/stimuli.h"

#include <cmath>

namespace swarmfit {

Stimuli::Stimuli(std::vector<Stimulus> stimuli) : stimuli_(std::move(stimuli)) {
  for (const Stimulus& s : stimuli_) position_.push_back(s.start);
}

void Stimuli::advance(const Clock& clock, const World&, State&) {
  for (std::size_t k = 0; k < stimuli_.size(); ++k) position_[k] = stimuli_[k].start + clock.t * stimuli_[k].velocity;
}

Stimuli::Near Stimuli::nearest(const Eigen::Array3d& position, const Bounds& bounds, double range) const {
  Near best{.from = Eigen::Array3d::Zero()};
  double best2 = range * range;
  for (std::size_t k = 0; k < stimuli_.size(); ++k) {
    const Eigen::Array3d from = bounds.separation(position_[k], position);
    const double d2 = from[0] * from[0] + from[1] * from[1] + from[2] * from[2];
    const bool wins_tie = best.index < 0 || (stimuli_[k].kind == Stimulus::Kind::repel && best.kind == Stimulus::Kind::attract);
    if (d2 > best2 || (d2 == best2 && !wins_tie)) continue;
    best2 = d2;
    best = {static_cast<int>(k), stimuli_[k].kind, d2 > 0 ? Eigen::Array3d(from / std::sqrt(d2)) : Eigen::Array3d(Eigen::Array3d::Zero()),
            std::sqrt(d2)};
  }
  return best;
}

}  // namespace swarmfit
