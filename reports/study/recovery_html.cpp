// SPDX-License-Identifier: MIT
#include "reports/study/recovery_html.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/study/recovery_counts.h"
#include "reports/study/recovery_sections.h"
#include "reports/study/study_facts.h"
#include "reports/study/study_html.h"
#include "reports/write/number.h"

namespace swarmfit {
namespace {

int group_of_true(const Recovery& r, const RecoveryCase& c) {
  const auto place = std::find(c.order.begin(), c.order.end(), r.planted[c.planted]) - c.order.begin();
  return place < static_cast<std::ptrdiff_t>(c.group.size()) ? c.group[static_cast<std::size_t>(place)] : 0;
}

StudySection groups(const Recovery& r) {
  Html content = sections::confidence_matrix(r);
  content +=
      element("p", "note",
              markup("The best group holds the models that the recording cannot distinguish from the best one. Ideally it holds the true "
                     "model alone; a fair method keeps the true model in it in 95 of 100 recordings."));
  content += sections::overlap_table(r);
  return {"groups", "Which models are distinguished", content};
}

StudySection goodness(const Recovery& r) {
  Html content = sections::rejection_matrix(r);
  content +=
      element("p", "note",
              markup("Goodness of fit tests each model by itself: does the recording fit it as well as recordings simulated from it do? "
                     "The true model should be rejected in about 5 of 100 recordings, every other model in as many as possible."));
  return {"goodness", "Which models are rejected", content};
}

Html ranked(const Recovery& r) {
  Html out = sections::confusion_matrix(r);
  out += sections::how_matrices_read();
  return out;
}

Html parameters(const Recovery& r, const Settings& settings) {
  const std::string spread = setting(settings, "spread");
  Html out;
  if (!spread.empty() && spread != "1")
    out = element(
        "p", "",
        escaped(fmt::format("For each recording, true parameters were drawn within a factor of {} of the defaults, so that no search "
                            "starts at the truth.",
                            spread)));
  out += sections::planted_parameters(r);
  return out;
}

}  // namespace

std::string recovery_sentence(const Recovery& r) {
  int right = 0;
  for (std::size_t p = 0; p < r.planted.size(); ++p) right += counts_of::recovered(r, p);
  const std::size_t all = r.cases.size();
  const std::string of_all = fmt::format("{} of {}", right, counted(static_cast<std::int64_t>(all), "recording"));
  return fmt::format("The true model is ranked first in {}.",
                     right == static_cast<int>(all) && all > 1 ? fmt::format("all {} recordings", all) : of_all);
}

std::string recovery_detail(const Recovery& r) {
  int alone = 0, shared = 0, outside = 0;
  for (const RecoveryCase& c : r.cases) {
    const auto best = std::count(c.group.begin(), c.group.end(), 1);
    const bool in_it = group_of_true(r, c) == 1;
    alone += in_it && best == 1;
    shared += in_it && best > 1;
    outside += !in_it && best > 0;
  }
  const int unknown = static_cast<int>(r.cases.size()) - alone - shared - outside;
  return fmt::format("It is alone in the best group in {}, shares it with others in {}, and is outside it in {}{}.", alone, shared, outside,
                     unknown > 0 ? fmt::format("; in {} the groups are not known", unknown) : "");
}

std::string recovery_html(const Recovery& r, const Settings& settings, const std::string& version) {
  StudyPage page{"recover", "model recovery", recovery_sentence(r), recovery_detail(r), synthetic_badge(), {}, {}, {}, {},
                 settings,  version};
  page.facts = fact("true models", std::to_string(r.planted.size()));
  page.facts += fact("models compared", std::to_string(r.compared.size()));
  page.facts += fact("recordings", std::to_string(r.cases.size()));
  page.facts += study_facts(settings);
  page.sections = {{"confusion", "Which model is ranked first", ranked(r)},
                   groups(r),
                   goodness(r),
                   {"planted", "True parameters", parameters(r, settings)},
                   {"recordings", "Recording by recording", sections::cases_table(r)}};
  page.files = markup("<code>recovery.json</code>, <code>tables/cases.csv</code>");
  return study_html(page);
}

}  // namespace swarmfit
