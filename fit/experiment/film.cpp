// SPDX-License-Identifier: MIT
#include "fit/experiment/film.h"

#include <algorithm>

#include "libtrack/cut.h"

namespace swarmfit {

FilmSpan film_span(const Tracks& recording, std::size_t films) {
  const auto frames = recording.frames();
  if (frames.empty()) return {};
  const Index most = kFilmPoints / static_cast<Index>(std::max<std::size_t>(films, 1));
  Index rows = 0;
  std::size_t shown = 0;
  while (shown < std::min(frames.size(), kFilmFrames) && (shown == 0 || rows + frames[shown].count <= most)) rows += frames[shown++].count;
  return {frames.front().number, frames[shown - 1].number + 1};
}

FilmStrip strip_of(const Tracks& tracks, const FilmSpan& span) {
  const Tracks film = cut(tracks, span.first, span.last);
  const TrackColumns& c = film.columns();
  return {c.track, c.frame, {c.pos.data(), c.pos.data() + c.pos.size()}, {c.vel.data(), c.vel.data() + c.vel.size()}, c.kind};
}

Tracks film_of(FilmStrip strip, const Tracks& recording) {
  const auto rows = [](const std::vector<double>& values) {
    return Rows(Eigen::Map<const Rows>(values.data(), static_cast<Index>(values.size()) / 3, 3));
  };
  TrackColumns c;
  c.names = recording.names();
  c.track = std::move(strip.track);
  c.frame = std::move(strip.frame);
  c.pos = rows(strip.pos);
  c.vel = rows(strip.vel);
  c.kind = std::move(strip.kind);
  TrackMeta meta = recording.meta();
  meta.from = {};
  meta.from.synthetic = true;
  return Tracks(std::move(c), std::move(meta));
}

}  // namespace swarmfit
