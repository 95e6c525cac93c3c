// SPDX-License-Identifier: MIT
// The section on forces: what pushes whom, in the recording and in simulations of every model.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "libtrack/nan.h"
#include "reports/comparison/html_sections.h"
#include "reports/comparison/page_sections.h"
#include "reports/write/number.h"

namespace swarmfit::page {
namespace {

std::string what_is_needed(const ForceFacts& f) {
  std::string out = "Drag and confinement are always fitted. ";
  out += f.needed.empty() ? "They suffice to describe the recorded accelerations."
                          : fmt::format("The recorded accelerations also need: {} (p ≤ 0.01).", fmt::join(f.needed, ", "));
  const auto test = [&](const char* what, double p) {
    if (std::isfinite(p)) out += fmt::format(" Test that pairs {}: p = {}.", what, rounded(p, 2));
  };
  test("neither attract nor repel each other", f.attraction_p);
  test("do not align", f.alignment_p);
  return out;
}

HtmlTable noise_table(const Comparison& c) {
  const std::string unit = c.recording.data.unit;
  HtmlTable table("Noise by regression, per axis");
  table.head({column(""), column(fmt::format("white [{}/s¹·⁵]", unit), true), column(fmt::format("with a memory [{}/s²]", unit), true),
              column("memory [s]", true)});
  const auto row = [&](const Html& name, const std::vector<double>& noise) {
    std::vector<HtmlTable::Cell> cells{name_cell(name)};
    for (std::size_t k = 0; k < 3; ++k) cells.push_back(number_cell(k < noise.size() ? rounded(noise[k]) : rounded(kNaN)));
    table.row(cells);
  };
  row(markup("recording"), c.recording.forces.recording.noise);
  for (const ModelFit& m : c.models) row(escaped(m.model), m.likeness.forces.median.noise);
  return table;
}

}  // namespace

Html forces(const Comparison& c) {
  Html out = sections::forces_figure(c);
  if (out.text.empty()) return out;
  out += element("p", "", escaped(what_is_needed(c.recording.forces)));
  out += noise_table(c).html();
  out += element(
      "p", "note",
      markup("No model is assumed and nothing is simulated for the recording's curves: accelerations are regressed on velocity, position "
             "and neighbours, with the measurement error taken into account. Curves of a model come from its own simulations by the same "
             "regression, so they need not equal the model's own forces. The numbers are in tables/forces.csv."));
  return out;
}

}  // namespace swarmfit::page
