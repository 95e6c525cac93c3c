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

int group_of_maker(const Recovery& r, const RecoveryCase& c) {
  const auto place = std::find(c.order.begin(), c.order.end(), r.planted[c.planted]) - c.order.begin();
  return place < static_cast<std::ptrdiff_t>(c.group.size()) ? c.group[static_cast<std::size_t>(place)] : 0;
}

StudySection groups(const Recovery& r) {
  Html content = sections::confidence_matrix(r);
  content += element("p", "note",
                     markup("The best group holds the models that the recording cannot tell from the best one. A good recording leaves the "
                            "maker alone in it; a fair method keeps the maker in it in 95 of 100."));
  content += sections::alike_table(r);
  return {"groups", "Who is told apart", content};
}

StudySection goodness(const Recovery& r) {
  Html content = sections::rejection_matrix(r);
  content += element("p", "note",
                     markup("Goodness of fit asks each model by itself: are recordings made by its fit as far from it as this one is? The "
                            "maker should be rejected in about 5 of 100, every other model as often as possible."));
  return {"goodness", "Who is rejected", content};
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
    out = element("p", "",
                  escaped(fmt::format("What a fit would search was multiplied or divided by up to {}, anew for every recording, so that no "
                                      "search starts at the truth.",
                                      spread)));
  out += sections::planted_parameters(r, setting(settings, "unit"));
  return out;
}

}  // namespace

std::string recovery_sentence(const Recovery& r) {
  int right = 0;
  for (std::size_t p = 0; p < r.planted.size(); ++p) right += counts_of::recovered(r, p);
  const std::size_t all = r.cases.size();
  const std::string of_all = fmt::format("{} of {}", right, counted(static_cast<std::int64_t>(all), "recording"));
  return fmt::format("The model that made the recording is ranked first in {}.",
                     right == static_cast<int>(all) && all > 1 ? fmt::format("all {} recordings", all) : of_all);
}

std::string recovery_detail(const Recovery& r) {
  int alone = 0, shared = 0, outside = 0;
  for (const RecoveryCase& c : r.cases) {
    const auto best = std::count(c.group.begin(), c.group.end(), 1);
    const bool in_it = group_of_maker(r, c) == 1;
    alone += in_it && best == 1;
    shared += in_it && best > 1;
    outside += !in_it && best > 0;
  }
  const int unknown = static_cast<int>(r.cases.size()) - alone - shared - outside;
  return fmt::format("It is alone in the best group in {}, shares the group with others in {}, and is not in it in {}{}.", alone, shared,
                     outside, unknown > 0 ? fmt::format("; in {} the groups are not known", unknown) : "");
}

std::string recovery_html(const Recovery& r, const Settings& settings, const std::string& version) {
  StudyPage page{"recover", "model recovery", recovery_sentence(r), recovery_detail(r), synthetic_badge(), {}, {}, {}, {},
                 settings,  version};
  page.facts = fact("models that made recordings", std::to_string(r.planted.size()));
  page.facts += fact("models compared", std::to_string(r.compared.size()));
  page.facts += fact("recordings", std::to_string(r.cases.size()));
  page.facts += study_facts(settings);
  page.sections = {{"confusion", "Who is ranked first", ranked(r)},
                   groups(r),
                   goodness(r),
                   {"planted", "What was planted", parameters(r, settings)},
                   {"recordings", "Recording by recording", sections::cases_table(r)}};
  page.files = markup("<code>recovery.json</code>, <code>tables/cases.csv</code>");
  return study_html(page);
}

}  // namespace swarmfit
