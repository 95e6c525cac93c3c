// SPDX-License-Identifier: MIT
// What a report's page says below its result, section by section.
#pragma once

#include <span>

#include "fit/results/comparison.h"
#include "reports/write/html_table.h"

namespace swarmfit {

struct PageSection {
  const char *id, *title, *in_contents;  // contents bar: "" if it is not there
  bool technical;                        // folded away
  Html (*content)(const Comparison&);    // what stands under the heading; nothing: no section
};

// In reading order (page_sections.def).
std::span<const PageSection> page_sections();

namespace page {

#define SECTION(id, title, in_contents) Html id(const Comparison&);
#define TECHNICAL(id, title) Html id(const Comparison&);
#include "reports/comparison/page_sections.def"
#undef SECTION
#undef TECHNICAL

}  // namespace page
}  // namespace swarmfit
