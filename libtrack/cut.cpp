// SPDX-License-Identifier: MIT
#include "libtrack/cut.h"

#include <algorithm>

namespace swarmfit {

Tracks cut(const Tracks& tracks, std::int64_t first, std::int64_t last) {
  const auto frame = tracks.frame();
  const auto begin = std::lower_bound(frame.begin(), frame.end(), first) - frame.begin();
  const auto end = std::lower_bound(frame.begin(), frame.end(), last) - frame.begin();
  TrackColumns c;
  c.names = tracks.names();
  c.track.assign(tracks.track().begin() + begin, tracks.track().begin() + end);
  c.frame.assign(frame.begin() + begin, frame.begin() + end);
  c.pos = tracks.pos().middleRows(begin, end - begin);
  if (tracks.has_velocity()) c.vel = tracks.vel().middleRows(begin, end - begin);
  if (tracks.has_acceleration()) c.acc = tracks.acc().middleRows(begin, end - begin);
  if (const auto& kind = tracks.columns().kind; !kind.empty()) c.kind.assign(kind.begin() + begin, kind.begin() + end);
  c.episodes.assign(tracks.episodes().begin(), tracks.episodes().end());
  return Tracks(std::move(c), tracks.meta());
}

}  // namespace swarmfit
