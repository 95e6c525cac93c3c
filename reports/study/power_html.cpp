// SPDX-License-Identifier: MIT
#include "reports/study/power_html.h"

#include <fmt/format.h>

#include <cmath>

#include "reports/comparison/html_paper_table.h"
#include "reports/comparison/html_sections.h"
#include "reports/study/power_report.h"
#include "reports/study/recovery_html.h"
#include "reports/study/recovery_sections.h"
#include "reports/study/study_html.h"
#include "reports/write/number.h"

namespace swarmfit {
namespace {

std::string time_text(double seconds) {
  if (seconds < 120) return fmt::format("{} s", brief(seconds, 2));
  return seconds < 7200 ? fmt::format("{} min", brief(seconds / 60, 2)) : fmt::format("{} h", brief(seconds / 3600, 2));
}

// What a recording of so many seconds lacks.
std::string lacking(double factor, double seconds) {
  if (!std::isfinite(factor) || !(seconds > 0)) return kUndefined;
  return factor < 1.05 ? "none" : time_text((factor - 1) * seconds);
}

Html pairs(const Power& p) {
  const double seconds = static_cast<double>(p.fitted.recording.data.frames) * p.fitted.recording.data.dt;
  PaperTable t = pairs_table(p,
                             "Distinguished: the true model ranks before the rival, and the rival is not in the best group. Lead: mean "
                             "lead of the true model in score, with its sd.");
  t.align = "llrrrrrr";
  t.head.emplace_back("more time needed");
  for (std::size_t k = 0; k < p.pairs.size(); ++k) t.rows[k].push_back(lacking(p.pairs[k].factor, seconds));
  Html out = on_screen(t).html();
  out += element(
      "p", "note",
      markup("Data for the right order: how many times as long, or with how many times as many animals, for the true model to lead in 95 "
             "of 100 recordings, if leads keep their mean and their scatter falls as one over the root of the length. To be distinguished "
             "as well, two models may need more. Never: the true model does not lead on average, so more data may not help."));
  return out;
}

Html matrices(const Power& p) {
  Html out = sections::confusion_matrix(p.recovery);
  out += sections::confidence_matrix(p.recovery);
  out += sections::rejection_matrix(p.recovery);
  out += sections::how_matrices_read();
  return out;
}

std::string detail(const Power& p) {
  const auto made = static_cast<std::int64_t>(p.recovery.cases.size());
  return fmt::format(
      "Every model was fitted to the recording, simulated recordings like it ({} in all), and all models were compared on each. {} "
      "This shows what the recording can decide, not which model is right.",
      made, recovery_sentence(p.recovery));
}

}  // namespace

std::string power_html(const Power& p, const Settings& settings) {
  const Comparison& fitted = p.fitted;
  StudyPage page{"power",
                 "which models a recording can distinguish",
                 power_sentence(p),
                 detail(p),
                 sections::badge(fitted),
                 sections::data_facts(fitted),
                 sections::warnings(fitted),
                 {},
                 {},
                 settings,
                 fitted.run.version};
  page.sections = {{"pairs", "How much more data it would take", pairs(p)},
                   {"matrices", "Which models are distinguished", matrices(p)},
                   {"planted", "True parameters", sections::planted_parameters(p.recovery)},
                   {"recordings", "Recording by recording", sections::cases_table(p.recovery)}};
  page.files = markup("<code>power.json</code>, <code>tables/pairs.csv</code>, <code>tables/cases.csv</code>");
  return study_html(page);
}

}  // namespace swarmfit
