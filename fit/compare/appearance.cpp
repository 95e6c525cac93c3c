// SPDX-License-Identifier: MIT
#include "fit/compare/appearance.h"

#include <tuple>

#include "fit/experiment/scenery.h"
#include "libswarm/walls.h"
#include "libtrack/cut.h"

namespace swarmfit {
namespace {

constexpr std::size_t kForceRuns = 8;  // of whose forces the median is drawn

// What is seen of a final replicate beside its score; of the first one also its scales and the film.
struct View {
  AssessedRun assessed;
  Scales scales;
  FilmStrip film;
  Pictures pictures;
  ForceCurves forces;
};
auto fields(View& v) { return std::tie(v.assessed, v.scales, v.film, v.pictures, v.forces); }

}  // namespace

Appearance::Appearance(const Conditions& conditions, std::size_t models)
    : conditions_(conditions),
      span_(film_span(conditions.recording, models + 1)),
      grid_(picture_grid(conditions.recording)),
      forces_(conditions.recording) {}

void Appearance::assess(const PerColumn<bool>& columns, std::uint64_t seed, const Runtime& runtime) {
  skill_.emplace(conditions_, columns, seed, runtime);
}

PictureFacts Appearance::pictures() const {
  return {grid_, swarmfit::pictures(conditions_.recording, grid_), timeline(conditions_.recording)};
}

Tracks Appearance::film() const { return cut(conditions_.recording, span_.first, span_.last); }

Scenery Appearance::around() const {
  const World& world = conditions_.world;
  const auto* walls = world.part<Walls>();
  if (!walls && world.bounds.kind == Bounds::Kind::open) return {};
  return scenery_of(world.bounds, walls ? walls->obstacles() : std::vector<Obstacle>{}, film());
}

FinalView Appearance::view() const {
  return [this](const Run& run, std::size_t k) {
    const bool first = k == 0, forces = !run.blew_up && k < kForceRuns;
    return to_bytes(View{skill_->of(run), first ? natural_scales(run.seen) : Scales{}, first ? strip_of(run.seen, span_) : FilmStrip{},
                         swarmfit::pictures(run.seen, grid_), forces ? forces_.of(run.seen) : ForceCurves{}});
  };
}

Look Appearance::of(const std::vector<std::string>& views) const {
  std::vector<AssessedRun> assessed;
  std::vector<Pictures> seen;
  std::vector<ForceCurves> forces;
  FilmStrip film;
  Scales scales;
  for (const std::string& bytes : views) {
    View view = from_bytes<View>(bytes);
    if (assessed.empty()) film = std::move(view.film), scales = view.scales;
    assessed.push_back(std::move(view.assessed));
    seen.push_back(std::move(view.pictures));
    forces.push_back(std::move(view.forces));
  }
  Likeness likeness = skill_->likeness(assessed);
  likeness.pictures = picture_spread(seen);
  likeness.forces = force_spread(forces);
  likeness.extent = scales.extent;
  likeness.spacing = scales.spacing;
  likeness.speed = scales.speed;
  return {std::move(likeness), film_of(std::move(film), conditions_.recording)};
}

}  // namespace swarmfit
