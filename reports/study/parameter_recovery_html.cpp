// SPDX-License-Identifier: MIT
#include "reports/study/parameter_recovery_html.h"

#include <fmt/format.h>

#include <algorithm>

#include "libtrack/nan.h"
#include "reports/comparison/words.h"
#include "reports/study/parameter_recovery_report.h"
#include "reports/study/study_facts.h"
#include "reports/study/study_html.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit {
namespace {

const char* place_in_band(const ParameterRecovery& r, const ParameterCoverage& p) {
  return p.covered < r.fewest ? "too rarely" : p.covered > r.most ? "too often" : "within";
}

std::vector<std::string> names_with(const ParameterRecovery& r, std::string_view place) {
  std::vector<std::string> out;
  for (const ParameterCoverage& p : r.parameters)
    if (place_in_band(r, p) == place) out.push_back(p.name);
  return out;
}

Html coverage(const ParameterRecovery& r) {
  HtmlTable table("How often the 95 % interval contains the true value");
  const std::string band = fmt::format("{} to {}", r.fewest, r.most);
  table.head({column("parameter"), column("covered", true), column("and the 99 % band"), column("band", true), column("place in it"),
              column("identified", true), column("one-sided", true), column("flat", true), column("mean width", true), column("bias", true),
              column("rmse", true)});
  for (const ParameterCoverage& p : r.parameters) {
    const bool within = std::string_view(place_in_band(r, p)) == "within";
    const double lower = std::min({0.5 * p.recordings, 1.0 * p.covered, 1.0 * r.fewest});
    table.row({name_cell(escaped(p.name)),
               number_cell(fmt::format("{} of {}", p.covered, p.recordings)),
               {.content = interval_drawing(p.covered, r.fewest, r.most, lower, p.recordings, 0)},
               number_cell(band),
               {.content = within ? escaped("within") : element("span", "flag", escaped(place_in_band(r, p)))},
               number_cell(std::to_string(p.identified)),
               number_cell(std::to_string(p.one_sided)),
               number_cell(std::to_string(p.flat)),
               number_cell(fixed(p.width, 2)),
               number_cell(fixed(p.bias, 3)),
               number_cell(fixed(p.rmse, 3))});
  }
  Html out = table.sortable().html();
  out += element("p", "note",
                 markup("Mark: what was counted; bar: the 99 % band; the axis runs from half of the recordings to all. Width, bias and "
                        "rmse (of the posterior's median) are fractions of the searched range, on the axis of the search."));
  return out;
}

Html drawings(const ParameterRecovery& r) {
  Html figures;
  for (std::size_t k = 0; k < r.parameters.size(); ++k) {
    const ParameterCoverage& p = r.parameters[k];
    Html figure = element("h3", "", escaped(p.name));
    figure += intervals_drawing(r, k);
    figure += element("figcaption", "", escaped(fmt::format("{} of {} intervals contain the true value", p.covered, p.recordings)));
    figures += element("figure", "", figure);
  }
  Html out = element("div", "grid", figures);
  out += element("p", "note",
                 markup("A line per recording: the 95 % interval, and the median as a dot, above the true value; on the slanted line both "
                        "are equal. Dashed and crossed: intervals that miss the true value. Axes are those of the search: some "
                        "logarithmic, some square roots. Point at a line for its numbers."));
  return out;
}

std::vector<double> ranks_of(const ParameterRecovery& r, std::size_t k) {
  std::vector<double> out;
  for (const ParameterCase& c : r.cases) out.push_back(k < c.rank.size() ? c.rank[k] : kNaN);
  return out;
}

std::vector<double> nearer_of(const ParameterRecovery& r) {
  std::vector<double> out;
  for (const ParameterCase& c : r.cases) out.push_back(c.nearer);
  return out;
}

Html calibration(const ParameterRecovery& r) {
  Html figures;
  const auto add = [&](const std::string& name, const std::vector<double>& ranks, double distance) {
    Html figure = element("h3", "", escaped(name));
    figure += ranks_drawing(ranks, r.uniform_band, name);
    figure += element(
        "figcaption", "",
        escaped(fmt::format("farthest from uniform: {}{}", fixed(distance, 2), distance > r.uniform_band ? ", beyond the band" : "")));
    figures += element("figure", "", figure);
  };
  for (std::size_t k = 0; k < r.parameters.size(); ++k) add(r.parameters[k].name, ranks_of(r, k), r.parameters[k].from_uniform);
  if (r.parameters.size() > 1) add("all together", nearer_of(r), r.from_uniform);
  Html out = element("p", "", escaped(ranks_text(r)));
  out += element("div", "grid", figures);
  out += element(
      "p", "note",
      markup("The rank of a true value is the share of its posterior that lies below it (simulation-based calibration, Talts et al. "
             "2018, arXiv:1804.06788); for all parameters together it is the share that lies nearer to a random point than the truth "
             "does (Lemos et al. 2023, arXiv:2302.03026). Ranks of correct posteriors are uniform: all lines keep to their bands in 95 % "
             "of studies. Steep in the middle: posteriors are too wide; steep at the ends: too narrow; all to one side: "
             "biased."));
  return out;
}

Html cases(const ParameterRecovery& r) {
  HtmlTable table("Every interval");
  table.head({column("parameter"), column("seed", true), column("true value", true), column("median", true), column("2.5 %", true),
              column("97.5 %", true), column("contains it"), column("verdict")});
  for (std::size_t k = 0; k < r.parameters.size(); ++k)
    for (const ParameterCase& c : r.cases) {
      const ParameterInterval& p = c.found[k];
      table.row({name_cell(escaped(p.name)), number_cell(std::to_string(c.seed)), number_cell(rounded(c.truth[k], 4)),
                 number_cell(rounded(p.median, 4)), number_cell(rounded(p.lower, 4)), number_cell(rounded(p.upper, 4)),
                 text_cell(p.lower <= c.truth[k] && c.truth[k] <= p.upper ? "yes" : "no"), text_cell(to_string(p.verdict))});
    }
  Html out = markup("<details><summary>All intervals</summary>");
  out += table.sortable().html();
  out += markup("</details>\n");
  return out;
}

}  // namespace

std::string coverage_sentence(const ParameterRecovery& r) {
  if (r.cases.empty()) return fmt::format("None of {} recordings simulated from {} can be fitted.", r.left_out, r.model);
  const auto rarely = names_with(r, "too rarely"), often = names_with(r, "too often");
  const std::string of = fmt::format(" of {}", r.model);
  if (rarely.empty() && often.empty())
    return fmt::format("The coverage of the 95 % intervals is within chance of 95 % for all {} parameters{}.", r.parameters.size(), of);
  if (rarely.empty())
    return fmt::format("The 95 % intervals of {}{} contain the true value too often: they are too wide.", enumerate(often), of);
  return fmt::format("The 95 % intervals of {}{} contain the true value too rarely{}.", enumerate(rarely), of,
                     often.empty() ? "" : fmt::format(", those of {} too often", enumerate(often)));
}

std::string parameter_recovery_html(const ParameterRecovery& r, const Settings& settings, const std::string& version) {
  StudyPage page{"recover", "parameter recovery", coverage_sentence(r), "", synthetic_badge(), {}, {}, {}, {}, settings, version};
  page.facts = fact("model", r.model);
  page.facts += fact("recordings", std::to_string(r.cases.size()));
  page.facts += study_facts(settings);
  if (!r.cases.empty()) {
    page.detail = coverage_band_text(r) + left_out_text(r);
    page.sections = {{"coverage", "Coverage", coverage(r)},
                     {"calibration", "Whole posteriors", calibration(r)},
                     {"intervals", "Intervals against true values", drawings(r)},
                     {"recordings", "Recording by recording", cases(r)}};
  }
  page.files = markup("<code>recovery.json</code>, <code>tables/cases.csv</code>");
  return study_html(page);
}

}  // namespace swarmfit
