// SPDX-License-Identifier: MIT
#include "libswarm/stimuli.h"

#include <cmath>

#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// In index order, for the same bits whatever the alignment.
Array3d centre_of(const State& state) {
  Array3d sum = Array3d::Zero();
  for (Index i = 0; i < state.size(); ++i) sum += state.pos.row(i).transpose();
  return state.size() > 0 ? Array3d(sum / static_cast<double>(state.size())) : sum;
}

}  // namespace

Array3d on_path(const std::vector<Stimulus::Key>& keys, double t) {
  if (t <= keys.front().t) return keys.front().place;
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const auto &a = keys[k - 1], &b = keys[k];
    if (t < b.t) return a.place + (b.place - a.place) * ((t - a.t) / (b.t - a.t));
  }
  return keys.back().place;
}

Stimuli::Stimuli(std::vector<Stimulus> stimuli, double shift)
    : stimuli_(std::move(stimuli)), shift_(shift), present_(stimuli_.size(), true), fields_(stimuli_.size()) {
  for (const Stimulus& s : stimuli_) position_.push_back(s.motion == Stimulus::Motion::path ? s.path.front().place : s.start);
}

void Stimuli::advance(const Clock& clock, const World& world, State& state) {
  const double t = clock.t + shift_;
  dims_ = world.dims;
  for (std::size_t k = 0; k < stimuli_.size(); ++k) {
    const Stimulus& s = stimuli_[k];
    present_[k] = s.from <= t && t < s.until;
    switch (s.motion) {
      case Stimulus::Motion::line:
        position_[k] = s.start + t * s.velocity;
        break;
      case Stimulus::Motion::path:
        position_[k] = on_path(s.path, t);
        break;
      case Stimulus::Motion::lead:
        position_[k] = centre_of(state) + s.offset;
        break;
      case Stimulus::Motion::wander:
        if (last_) position_[k] = wandered(k, t - *last_, clock.rng);
        break;
      case Stimulus::Motion::ring:
        break;
    }
  }
  last_ = t;
}

Array3d Stimuli::wandered(std::size_t k, double dt, const Rng& rng) {
  constexpr double kSlack = 0.8;  // of the leash; from there on it pulls
  const Stimulus& s = stimuli_[k];
  if (!fields_[k]) fields_[k] = std::make_shared<NoiseField>(rng.derive(Stream::response, k));
  const Array3d u = position_[k] / s.scale, back = s.start - position_[k];
  Array3d way = dims_ == 2 ? fields_[k]->curl2(u) : fields_[k]->curl(u);
  way /= std::max(length(way), 1e-9);
  const double far = length(back) / s.radius;
  if (far > kSlack) way += 2 * (far - kSlack) / (1 - kSlack) * back / length(back);
  return position_[k] + s.speed * dt / std::max(length(way), 1e-9) * way;
}

Array3d Stimuli::place_for(std::size_t k, const Array3d& agent) const {
  const Stimulus& s = stimuli_[k];
  if (s.motion != Stimulus::Motion::ring) return position_[k];
  const Index across = dims_ == 2 ? 1 : 2;
  const double angle = std::atan2(agent[across] - s.start[across], agent[0] - s.start[0]) + s.ahead;
  Array3d place = s.start;
  place[0] += s.radius * std::cos(angle);
  place[across] += s.radius * std::sin(angle);
  return place;
}

Stimuli::Near Stimuli::nearest(const Array3d& position, const Bounds& bounds, double range) const {
  Near best{.from = Array3d::Zero()};
  double best2 = range * range;
  for (std::size_t k = 0; k < stimuli_.size(); ++k) {
    if (!present_[k]) continue;
    const Array3d from = bounds.separation(place_for(k, position), position);
    const double d2 = from[0] * from[0] + from[1] * from[1] + from[2] * from[2];
    const bool wins_tie = best.index < 0 || (stimuli_[k].kind == Stimulus::Kind::repel && best.kind == Stimulus::Kind::attract);
    if (d2 > best2 || (d2 == best2 && !wins_tie)) continue;
    best2 = d2;
    best = {static_cast<int>(k), stimuli_[k].kind, d2 > 0 ? Array3d(from / std::sqrt(d2)) : Array3d(Array3d::Zero()), std::sqrt(d2)};
  }
  return best;
}

}  // namespace swarmfit
