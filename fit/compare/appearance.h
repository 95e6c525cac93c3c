// SPDX-License-Identifier: MIT
// What a recording and the models fitted to it look like, beside their scores: films, pictures, forces, skill.
#pragma once

#include <optional>

#include "fit/compare/force_view.h"
#include "fit/compare/skill_assessment.h"
#include "fit/experiment/film.h"
#include "fit/model_fit/model_search.h"
#include "libeval/group/pictures.h"

namespace swarmfit {

// A model's.
struct Look {
  Likeness likeness;
  Tracks film;
};

// Holds references, so the conditions must outlive it.
class Appearance {
 public:
  Appearance(const Conditions& conditions, std::size_t models);

  // Skill on these columns, which are not mostly error. Simulates; before it there is no view of a run and no likeness.
  void assess(const PerColumn<bool>& columns, std::uint64_t seed, const Runtime& runtime);

  PictureFacts pictures() const;
  const ForceFacts& forces() const { return forces_.facts(); }
  const SkillAssessment& skill() const { return *skill_; }
  Tracks film() const;     // of the recording
  Scenery around() const;  // what surrounds everybody in the films
  FinalView view() const;  // of a final replicate, as bytes; valid as long as this is

  Look of(const std::vector<std::string>& views) const;  // of a model's final replicates

 private:
  const Conditions& conditions_;
  FilmSpan span_;
  PictureGrid grid_;
  ForceView forces_;
  std::optional<SkillAssessment> skill_;
};

}  // namespace swarmfit
