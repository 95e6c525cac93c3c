// SPDX-License-Identifier: MIT
#include "libtrack/cut.h"

#include <algorithm>

namespace swarmfit {

Tracks cut(const Tracks& tracks, std::int64_t first, std::int64_t last) {
  const auto frame = tracks.frame();
  const auto begin = std::lower_bound(frame.begin(), frame.end(), first) - frame.begin();
  const auto end = std::lower_bound(frame.begin(), frame.end(), last) - frame.begin();
  TrackColumns c;
  c.names.resize(tracks.track_count());  // nobody reads them
  c.track.assign(tracks.track().begin() + begin, tracks.track().begin() + end);
  c.frame.assign(frame.begin() + begin, frame.begin() + end);
  c.pos = tracks.pos().middleRows(begin, end - begin);
  if (tracks.has_velocity()) c.vel = tracks.vel().middleRows(begin, end - begin);
  c.episodes.assign(tracks.episodes().begin(), tracks.episodes().end());
  TrackMeta meta = tracks.meta();
  meta.from = {};
  return Tracks(std::move(c), std::move(meta));
}

}  // namespace swarmfit
