// SPDX-License-Identifier: MIT
#include "fit/portrait.h"

#include "fit/facts.h"
#include "fit/film.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"

namespace swarmfit {

Comparison portrait(const Tracks& tracks) {
  if (tracks.rows() == 0) throw InputError(tracks.meta().from.path + ": nobody to show; expected at least one individual");
  Comparison c;
  const Target target(metric_samples(tracks), Binning{});
  c.data = data_facts(tracks, natural_scales(tracks));
  fill_axes(c, target);
  c.observation.used = c.defined;
  c.observation.drowned = PerColumn<bool>(c.columns.size());
  c.observation.why_not = PerColumn<std::string>(c.columns.size());
  const FilmSpan span = film_span(tracks, 1);
  c.film = cut(tracks, span.first, span.last);
  return c;
}

}  // namespace swarmfit
