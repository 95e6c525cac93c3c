// SPDX-License-Identifier: MIT
// The parts about how a result came about: parameters, search, observation, methods, provenance.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "fit/results/axis_scale.h"
#include "libtrack/nan.h"
#include "reports/comparison/html_sections.h"
#include "reports/comparison/methods.h"
#include "reports/comparison/second_opinions.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"

namespace swarmfit::sections {

namespace {

using Cells = std::vector<HtmlTable::Cell>;

// Where a value lies between its bounds, 0..1, on the scale on which it was searched.
double place(const ParameterResult& p, double value) {
  return p.fitted && p.upper > p.lower ? place_on(scale_of(p.log, p.lower), p.lower, p.upper, value) : kNaN;
}

std::string axis_name(const ParameterResult& p) {
  switch (scale_of(p.log, p.lower)) {
    case AxisScale::linear:
      return "linear";
    case AxisScale::root:
      return "square root";
    case AxisScale::logarithmic:
      return "logarithmic";
  }
  return {};
}

Html parameter_table(const ModelFit& r) {
  HtmlTable table(fmt::format("Parameters of {}", r.model));
  table.look("frozen tight");
  const bool posterior = r.posterior.simulations > 0;
  const bool halves = std::any_of(r.parameters.begin(), r.parameters.end(), [](const auto& p) { return std::isfinite(p.halves_lower); });
  Cells head = {column("parameter"),           column("symbol"),   column("value", true),         column("unit"),
                column("searched from", true), column("to", true), column("place between bounds")};
  if (halves) head.push_back(column("fits to halves", true));
  const bool likely = std::isfinite(r.likelihood.log_likelihood);
  const bool regressed = r.regression.rows > 0;
  if (likely) head.push_back(column("maximum likelihood, 95 %", true));
  if (regressed) head.push_back(column("regression, 95 %", true));
  if (posterior) head.insert(head.end(), {column("95 %", true), column("verdict"), column("correlated with")});
  head.push_back(column("meaning"));
  table.head(head);
  for (const ParameterResult& p : r.parameters) {
    Html where = place_drawing(place(p, p.value), p.at_bound, place(p, p.posterior.lower), place(p, p.posterior.upper));
    if (p.fitted) where += element("span", "note", escaped(" " + axis_name(p)));
    if (p.at_bound) where += markup(" <span class=\"flag\">on a bound</span>");
    if (!p.fitted) where = markup("<span class=\"note\">not searched</span>");
    Cells cells = {name_cell(escaped(p.name)),
                   text_cell(p.symbol),
                   number_cell(rounded(p.value, 4)),
                   text_cell(unit_in_print(p.unit)),
                   number_cell(p.fitted ? rounded(p.lower) : ""),
                   number_cell(p.fitted ? rounded(p.upper) : ""),
                   {.content = where}};
    if (halves) cells.push_back(number_cell(p.fitted ? halves_text(p) : ""));
    if (likely) cells.push_back(number_cell(p.fitted ? opinion_text(p.likelihood) : ""));
    if (regressed) cells.push_back(number_cell(p.fitted ? opinion_text(p.regression) : ""));
    if (posterior)
      cells.insert(cells.end(), {number_cell(p.fitted ? interval_text(p.posterior) : ""), text_cell(verdict_text(p)),
                                 text_cell(partner_text(p.posterior))});
    cells.push_back(text_cell(p.meaning));
    table.row(cells);
  }
  return table.html();
}

// The largest change of a raw energy when the time step is halved, among the metrics that count.
double half_step_change(const Comparison& c, const ModelFit& r) {
  double largest = kNaN;
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m) {
    const double change = std::abs(r.runs.half_step_energies[m] - r.runs.raw_energies[m]);
    if (counts(c, m) && std::isfinite(change)) largest = std::isfinite(largest) ? std::max(largest, change) : change;
  }
  return largest;
}

std::string error_text(const Comparison& c) {
  const ObservationFacts& o = c.recording.observation;
  if (o.error_source == "none") return "none added";
  if (o.white && o.sigma.isZero()) return "none added: the estimate would not change any metric";
  return fmt::format("{} ({}{})", sigma_text(c), o.error_source, o.error_source == "estimate" && !o.white ? ", but not white" : "");
}

std::string smoothing_text(const Comparison& c) {
  return c.recording.observation.smoothing > 0 ? fmt::format("Gaussian, {} frames, on both sides", brief(c.recording.observation.smoothing))
                                               : "none";
}

}  // namespace

Html parameters(const Comparison& c) {
  Html out;
  for (std::size_t k = 0; k < c.models.size(); ++k) {
    const ModelFit& r = c.models[k];
    Html title = key_drawing(k);
    title += escaped(r.model);
    out += Html{k == 0 ? "<details open>" : "<details>"};
    out += element("summary", "", title);
    if (!r.summary.empty()) out += element("p", "note", escaped(r.summary));
    out += parameter_table(r);
    if (r.posterior.simulations > 0) out += element("p", "note", escaped(what_posteriors_mean()));
    out += markup("</details>\n");
  }
  return out;
}

Html search(const Comparison& c) {
  HtmlTable table("What the search did");
  table.head({column("model"), column("candidates tried", true), column("simulations", true), column("diverged", true),
              column("final runs diverged", true), column("ended because"), column("steps per frame", true),
              column("largest change at half the time step", true), column("without collision-free velocity", true)});
  for (std::size_t k = 0; k < c.models.size(); ++k) {
    const ModelFit& r = c.models[k];
    Html name = key_drawing(k);
    name += escaped(r.model);
    table.row({name_cell(name), number_cell(counted(r.search.evaluations)), number_cell(counted(r.search.simulations)),
               number_cell(counted(r.search.failed_simulations)), number_cell(percent(r.runs.failed_final)),
               text_cell(r.search.stop_reason), number_cell(std::to_string(r.runs.steps)), number_cell(fixed(half_step_change(c, r), 2)),
               number_cell(percent(r.runs.infeasible_avoidance))});
  }
  Html out = table.html();
  out += element("p", "note",
                 markup("Largest change at half the time step: of any energy in the score, when the same parameters are simulated with "
                        "half the time step. "
                        "Without collision-free velocity: share of agents and steps of the final simulations."));
  return out;
}

Html observation(const Comparison& c) {
  const ObservationFacts& o = c.recording.observation;
  Html facts = fact("presence of individuals", o.presence == "recorded" ? "as recorded, gaps included" : o.presence);
  facts += fact("arena", o.arena);
  if (o.unseen > 0) facts += fact("simulated in addition to tracked individuals", counted(o.unseen, "individual"));
  facts += fact("measurement error", error_text(c));
  facts += fact("smoothing", smoothing_text(c));
  facts += fact("velocities", o.velocity == "recorded" ? "the recording's own" : "differences of positions");
  Html out =
      element("p", "", markup("Simulated positions get the recording's gaps, measurement error and smoothing before they are compared."));
  out += element("dl", "facts", facts);

  HtmlTable table("Share of measurement error in each metric, and effective number of independent samples");
  table.head({column("metric"), column(""), column("share of variance", true), column("independent samples", true), column("in the score"),
              column("reason")});
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    table.row({name_cell(escaped(c.recording.columns[m].name())), text_cell(c.recording.columns[m].symbol()),
               number_cell(percent(o.error_share[m])), number_cell(brief(o.independent[m], 2)),
               text_cell(!counts(c, m)          ? "no"
                         : o.error_dominated[m] ? "beyond measurement error"
                                                : "yes"),
               text_cell(why_left_out(c, m))});
  out += table.html();
  return out;
}

Html methods(const Comparison& c) {
  Html out;
  for (const std::string& paragraph : swarmfit::methods(c).paragraphs) out += element("p", "", escaped(paragraph));
  return out;
}

Html references(const Comparison& c) {
  Html out;
  for (const std::string& reference : swarmfit::methods(c).references) out += element("li", "", escaped(reference));
  return out;
}

std::string size_text(const SearchSize& s) { return fmt::format("{} × {} on {} replicates", s.population, s.generations, s.replicates); }

Html provenance(const Comparison& c) {
  Html out = fact("version", c.run.version);
  out += fact("seed", std::to_string(c.run.seed));
  out += fact("protocol", c.run.protocol);
  out += fact("common parameters", fmt::format("{}", fmt::join(c.run.common, ", ")));
  out += fact("budget", fmt::format("{}: search {}, selection {}, confirmation on {}, report on {} replicates", budget_text(c),
                                    size_text(c.run.budget.search), size_text(c.run.budget.selection), c.run.budget.confirmation_replicates,
                                    c.run.budget.final_replicates));
  out += fact("calibration", c.ranking.mean_weights ? "each pass searches under the mean of all weights so far"
                                                    : "each pass searches under the last weights, as published");
  out += fact("read as", c.recording.data.format);
  out += fact("columns", c.recording.data.columns);
  out += fact("SHA-256 of the recording", c.recording.data.sha256, true);
  for (const std::string& note : c.recording.data.notes) out += fact("repaired while reading", note, true);
  return out;
}

}  // namespace swarmfit::sections
