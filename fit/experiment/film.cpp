// SPDX-License-Identifier: MIT
#include "fit/experiment/film.h"

#include <algorithm>

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

}  // namespace swarmfit
