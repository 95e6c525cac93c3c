// SPDX-License-Identifier: MIT
// The parts that stand beside the score: skill, rankings with one model left out, and what was not fitted.
#include <fmt/format.h>

#include <cmath>

#include "reports/comparison/html_sections.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/unit_text.h"

namespace swarmfit::sections {

namespace {

using Cells = std::vector<HtmlTable::Cell>;

std::string plus_minus(const Estimate& e) { return std::isfinite(e.se) ? rounded(e.value) + " ± " + rounded(e.se, 2) : rounded(e.value); }

// How many standard errors a model is off; NaN if that is unknown.
double in_errors(const Estimate& model, const Estimate& recording) {
  return std::abs(model.value - recording.value) / std::hypot(model.se, recording.se);
}

template <class Text>
void metric_row(HtmlTable& table, const Comparison& c, const Html& title, Text text) {
  Cells cells = {name_cell(title)};
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m) cells.push_back(number_cell(text(m), !counts(c, m)));
  table.row(cells);
}

std::string interaction_text(const SkillFacts& s) {
  if (!std::isfinite(s.interaction_p[0])) return {};
  return fmt::format(
      "Test for interaction, against {} surrogates with tracks shifted in time: nearest-neighbour distance p = {}, velocity difference "
      "p = {}.",
      s.surrogates, fixed(s.interaction_p[0], 2), fixed(s.interaction_p[1], 2));
}

std::string memory_text(const SkillFacts& s) {
  if (!std::isfinite(s.memory_p)) return {};
  return fmt::format(
      "Test for memory of direction, against {} random walks of its own steps: all motion metrics in the score together p = {}.",
      s.surrogates, fixed(s.memory_p, 2));
}

constexpr const char* kHowSkillIsMade =
    "Skill = 1 − (D − floor)/(null − floor). D is the mean distance from the recording over the metrics of the score (over all defined "
    "metrics if none of these distinguishes surrogates). The floor is the distance between halves of the recording; models and surrogates "
    "are measured with as many samples. For d and η the null is the recording's own tracks shifted in time (no interaction); for the other "
    "metrics it is a random walk with the recorded steps in shuffled directions. The walk keeps the recorded speeds, so v never "
    "distinguishes it; a model with a wrong v still loses skill. Where the walk is as close to the recording as its halves are to each "
    "other, the null is the recording's positions in random order.";

}  // namespace

Html skill(const Comparison& c) {
  HtmlTable table("Distance to the recording (total variation, 0 to 1), half against half");
  table.look("frozen");
  Cells head = {column("")};
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m) head.push_back(column(c.recording.columns[m].symbol(), true, !counts(c, m)));
  table.head(head);
  const SkillFacts& s = c.recording.skill;
  metric_row(table, c, markup("recording against itself (floor)"), [&](std::size_t m) { return fixed(s.floor[m], 3); });
  const bool places = s.null_of == SkillNull::places;
  metric_row(table, c, escaped(fmt::format("{}{}", kWalk, places ? "" : " (null)")), [&](std::size_t m) { return fixed(s.null[m], 3); });
  if (places) metric_row(table, c, markup("its positions in random order (null)"), [&](std::size_t m) { return fixed(s.places[m], 3); });
  metric_row(table, c, markup("distinguishes surrogates"), [&](std::size_t m) { return std::string(s.informative[m] ? "yes" : "no"); });
  for (std::size_t k = 0; k < c.models.size(); ++k) {
    Html name = key_drawing(k);
    name += escaped(c.models[k].model);
    metric_row(table, c, name, [&](std::size_t m) { return fixed(c.models[k].likeness.total_variation[m], 3); });
  }
  Html out = element("p", "", escaped(kHowSkillIsMade));
  out += table.html();
  out += element("p", "", escaped(memory_text(s)));
  out += element("p", "", escaped(interaction_text(s)));
  return out;
}

Html without(const Comparison& c) {
  if (c.ranking.without.empty()) return {};
  HtmlTable table("Ranking with one model left out");
  table.head({column("without"),
              column(c.recording.hold_out.used() ? "ranking of the others (score in sample)" : "ranking of the others (score)"),
              column("order")});
  for (const LeftOut& w : c.ranking.without) {
    std::string ranking;
    for (const auto& [model, score] : w.ranking) ranking += fmt::format("{}{} ({})", ranking.empty() ? "" : ", ", model, fixed(score, 3));
    table.row({name_cell(escaped(w.model)), text_cell(ranking),
               text_cell(w.winner_changed ? "another best model"
                         : w.reordered    ? "changed"
                                          : "the same")});
  }
  return table.html();
}

Html panel(const Comparison& c) {
  HtmlTable table("Observables outside the score");
  table.look("frozen tight");
  Cells head = {column("observable"), column("unit"), column("recording", true)};
  for (const ModelFit& r : c.models) head.push_back(column(r.model, true));
  table.head(head);
  for (std::size_t k = 0; k < c.recording.panel.items.size(); ++k) {
    const PanelItem& item = c.recording.panel.items[k];
    const Estimate& real = c.recording.panel.recording[k];
    Cells cells = {name_cell(escaped(item.name)), text_cell(panel_unit(item, c.recording.data.unit)), number_cell(plus_minus(real))};
    for (const ModelFit& r : c.models) {
      const double off = in_errors(r.likeness.panel[k], real);
      cells.push_back(number_cell(plus_minus(r.likeness.panel[k]), std::isfinite(off) && off > 2));
    }
    table.row(cells);
  }
  Html out = table.html();
  out += element(
      "p", "note",
      markup("± is one standard error: of the recording over blocks of time, of a model over its final replicates. Pale: more than "
             "two standard errors from the recording. None was fitted directly; mean speed and mean nearest-neighbour distance are in "
             "the score as distributions. Velocity autocorrelations are in tables/vacf.csv."));
  return out;
}

}  // namespace swarmfit::sections
