// SPDX-License-Identifier: MIT
#include "cli/model_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libswarm/manual.h"

namespace swarmfit::cli {
namespace {

constexpr std::string_view kLicence = "SPDX-License-Identifier:";

// A unit of fits: powers of the recording's own scales.
std::string fit_unit(const Parameter& p) {
  std::string above, below;
  const auto factor = [&](const char* base, double exponent) {
    if (exponent == 0) return;
    std::string& side = exponent > 0 ? above : below;
    side += fmt::format("{}{}{}", side.empty() ? "" : " ", base, std::abs(exponent) == 1 ? "" : fmt::format("^{:g}", std::abs(exponent)));
  };
  factor(p.length == Parameter::Length::spacing ? "NND" : "L", p.unit.length);
  factor("T", p.unit.time);
  return below.empty() ? above : fmt::format("{}/{}", above.empty() ? "1" : above, below);
}

std::string range_text(const Range& range) { return fmt::format("{:.4g} ({:.4g} – {:.4g})", range.initial, range.lower, range.upper); }

// Inside a table a bar ends a cell.
std::string markdown_cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string code_cell(std::string_view text) { return text.empty() ? "" : fmt::format("`{}`", markdown_cell(text)); }

std::string parameter_row(const Parameter& p) {
  return fmt::format("| `{}` | {} | {} | {} | {} | {} {} | {} | {} | {} |\n", p.name, p.symbol, markdown_cell(p.meaning),
                     to_string(p.unit, "length"), range_text(p.scene), range_text(p.fit), fit_unit(p), p.fitted ? "yes" : "",
                     code_cell(p.when), markdown_cell(p.source));
}

std::string row_text(const Parameter& p) {
  const auto unit = to_string(p.unit, "L");
  return fmt::format("{}{}; scenes {:g} in {:g} .. {:g}; fits {:g} in {:g} .. {:g} {}{}{}", p.meaning,
                     unit.empty() ? "" : fmt::format(" [{}]", unit), p.scene.initial, p.scene.lower, p.scene.upper, p.fit.initial,
                     p.fit.lower, p.fit.upper, p.length == Parameter::Length::spacing ? "(in NND)" : "(in L, T)",
                     p.fitted ? ", searched" : "", p.when.empty() ? "" : fmt::format(", with {}", p.when));
}

}  // namespace

std::string model_manual(const ModelSpec& spec) {
  std::string_view comment = model_comment(spec.name);
  std::string text;
  while (!comment.empty()) {
    const auto end = std::min(comment.find('\n'), comment.size());
    std::string_view line = comment.substr(0, end);
    comment.remove_prefix(std::min(end + 1, comment.size()));
    line.remove_prefix(std::min(line.find_first_not_of('/'), line.size()));
    if (line.starts_with(' ')) line.remove_prefix(1);
    if (line.starts_with(kLicence) || (text.empty() && line.empty())) continue;
    text += std::string(line) + '\n';
  }
  return text;
}

namespace {

// Of the time step in fits.
std::string fit_step(const ModelSpec& spec) {
  std::string map = spec.map.empty()       ? ""
                    : spec.map == "always" ? "one step per frame"
                                           : fmt::format("one step per frame with `{}`", spec.map);
  const std::string most = std::isfinite(spec.largest_dt) ? fmt::format(", at most {:.3g} T", spec.largest_dt) : "";
  if (spec.map == "always") return ", of fits " + map;
  return fmt::format(", of fits as many steps per frame as it takes{}{}{}", most, map.empty() ? "" : "; ", map);
}

}  // namespace

std::string model_page(const ModelSpec& spec) {
  std::string page = fmt::format("# {0}\n\n{1}.\n\n![{0}]({0}.svg)\n\n```text\n{2}```\n\n", spec.name, spec.summary, model_manual(spec));
  page += fmt::format(
      "## Parameters\n\n"
      "Scenes are in simulation units. Fits are in the recording's own scales: L root-mean-square radius of the group, NND mean distance "
      "to the nearest neighbour, T = L / mean speed. *Searched*: by default; `--fix` and `--bounds` change that.\n\n"
      "| name | symbol | meaning | unit | scenes: default (bounds) | fits: default (bounds) | searched | only with | source |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const Parameter& p : spec.parameters) page += parameter_row(p);
  if (!spec.options.empty()) {
    page += "\n## Options\n\n| option | values, the default first | meaning |\n|---|---|---|\n";
    for (const Option& o : spec.options)
      page += fmt::format("| `{}` | `{}` | {} |\n", o.name, fmt::join(o.values, "`, `"), markdown_cell(o.meaning));
    const Option& first = spec.options.front();
    page += fmt::format("\nOptions travel with the name: `'{}[{}={}]'`.\n", spec.name, first.name, first.values.back());
  }
  page += fmt::format("\n## Source\n\n{}. Motion in {} dimensions; time step of scenes {:.3g} s{}.\n", spec.citation,
                      fmt::join(spec.dims, " or "), spec.native_dt, fit_step(spec));
  return page;
}

ListEntry model_entry(const ModelSpec& spec) {
  ListEntry e{std::string(spec.name), std::string(spec.summary), {{"source", std::string(spec.citation)}}};
  for (const auto& option : spec.options)
    e.facts.emplace_back(fmt::format("[{}={}]", option.name, fmt::join(option.values, "|")), std::string(option.meaning));
  for (const auto& parameter : spec.parameters) e.facts.emplace_back(std::string(parameter.name), row_text(parameter));
  return e;
}

}  // namespace swarmfit::cli
