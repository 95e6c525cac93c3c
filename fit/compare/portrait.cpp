// SPDX-License-Identifier: MIT
#include "fit/compare/portrait.h"

#include <algorithm>
#include <cmath>

#include "fit/compare/facts.h"
#include "fit/experiment/film.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"

namespace swarmfit {

namespace {

void require_somebody(const Tracks& tracks) {
  if (tracks.rows() == 0) throw InputError(tracks.meta().from.path + ": no individuals to show; expected at least one");
}

// Nothing is left out, nothing is known to be error_dominated.
ObservationFacts plain_observation(const RecordingFacts& r) {
  ObservationFacts out;
  out.used = r.defined;
  out.error_dominated = PerColumn<bool>(r.columns.size());
  out.why_not = PerColumn<std::string>(r.columns.size());
  return out;
}

RecordingFacts facts_of(const Evaluation& e) {
  RecordingFacts r;
  r.binning = e.binning;
  r.columns = e.columns;
  r.distributions = e.real_distribution;
  r.axis_lower = e.axis_lower;
  r.axis_width = e.axis_width;
  r.defined = PerColumn<bool>(e.columns.size());
  for (std::size_t m = 0; m < e.columns.size(); ++m) r.defined[m] = std::isfinite(e.raw_energies[m]);
  return r;
}

// The same tracks so many frames later.
Tracks later(const Tracks& tracks, std::int64_t frames) {
  TrackColumns c = tracks.columns();
  for (std::int64_t& frame : c.frame) frame += frames;
  for (std::int64_t& frame : c.episodes) frame += frames;
  return {std::move(c), tracks.meta()};
}

ModelFit as_model(const Evaluation& e) {
  ModelFit r;
  r.model = "simulation";
  r.runs.raw_energies = e.raw_energies;
  r.runs.distributions = e.simulated_distribution;
  r.runs.raw_se = PerColumn<double>(e.columns.size());
  return r;
}

}  // namespace

Comparison portrait(const Tracks& tracks) {
  require_somebody(tracks);
  Comparison c;
  c.recording = measured_facts(Target(metric_samples(tracks), Binning{}));
  c.recording.data = data_facts(tracks, natural_scales(tracks));
  c.recording.observation = plain_observation(c.recording);
  const PictureGrid grid = picture_grid(tracks);
  c.recording.pictures = {grid, pictures(tracks, grid), timeline(tracks)};
  const FilmSpan span = film_span(tracks, 1);
  c.film = cut(tracks, span.first, span.last);
  return c;
}

PairPortrait portrait(const Tracks& real, const Tracks& simulated, const Evaluation& e) {
  require_somebody(real);
  require_somebody(simulated);
  PairPortrait out;
  out.simulation = data_facts(simulated, natural_scales(simulated));
  Comparison& c = out.comparison;
  c.run.command = "evaluate";
  c.recording = facts_of(e);
  c.recording.data = data_facts(real, natural_scales(real));
  c.recording.observation = plain_observation(c.recording);
  c.ranking.weights = PerColumn<double>(e.columns.size());
  c.models = {as_model(e)};
  const FilmSpan of_real = film_span(real, 2), of_simulated = film_span(simulated, 2);
  const std::int64_t frames = std::min(of_real.last - of_real.first, of_simulated.last - of_simulated.first);
  c.film = cut(real, of_real.first, of_real.first + frames);
  c.models.front().film = later(cut(simulated, of_simulated.first, of_simulated.first + frames), of_real.first - of_simulated.first);
  return out;
}

}  // namespace swarmfit
