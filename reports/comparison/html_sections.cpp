// SPDX-License-Identifier: MIT
#include "reports/comparison/html_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/comparison/quantities.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"
#include "reports/write/unit_text.h"

namespace swarmfit::sections {

namespace {

using Cells = std::vector<HtmlTable::Cell>;

Html model_name(const Comparison& c, std::size_t k) {
  Html out = key_drawing(k);
  out += escaped(c.models[k].model);
  return out;
}

// One column per metric, from what `text` says of each.
template <class Text>
void metric_columns(const Comparison& c, Cells& cells, Text text) {
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m) cells.push_back(number_cell(text(m), !counts(c, m)));
}

void metric_heads(const Comparison& c, Cells& cells) {
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    cells.push_back(column(marked(c, m, c.recording.columns[m].symbol()), true, !counts(c, m)));
}

struct Scale {
  double lower = INFINITY, upper = -INFINITY;
  void include(double x) {
    if (!std::isfinite(x)) return;
    lower = std::min(lower, x);
    upper = std::max(upper, x);
  }
};

// From 0 (or the lowest interval) to 1 (or the highest).
Scale score_scale(const Comparison& c) {
  Scale scale{0, 1};
  for (const ModelFit& r : c.models)
    for (const double x : {r.standing.score, r.standing.certainty.lower, r.standing.certainty.upper}) scale.include(x);
  return scale;
}

// Beneath the chart of a column: what it weighs, or what its energy is, or where nobody is compared, its mean and standard deviation.
std::string column_remark(const Comparison& c, std::size_t m) {
  const Moments& all = c.recording.distributions[m].moments;
  if (c.models.empty())
    return fmt::format("{} ± {} {}", rounded(all.mean), rounded(all.sd()),
                       metric_unit(c.recording.columns[m].metric, c.recording.data.unit));
  if (c.run.command == "evaluate") return fmt::format("energy {}", fixed(c.models.front().runs.raw_energies[m], 3));
  return counts(c, m) ? fmt::format("weight {}", fixed(c.ranking.weights[m], 3)) : "left out: " + why_left_out(c, m);
}

// Whose densities a chart shows.
std::string whose(const Comparison& c) {
  if (c.models.empty()) return {};
  return c.run.command == "evaluate" ? " in the recording and in the simulation" : " in the recording and in every model";
}

// What a chart shows, for those who cannot see it.
std::string finding(const Comparison& c, std::size_t m) {
  const Moments& all = c.recording.distributions[m].moments;
  std::string out = fmt::format("Recording: mean {}, standard deviation {} {}.", rounded(all.mean), rounded(all.sd()),
                                metric_unit(c.recording.columns[m].metric, c.recording.data.unit));
  for (const ModelFit& r : c.models)
    if (std::isfinite(r.runs.raw_energies[m])) out += fmt::format(" {}: energy {}.", r.model, fixed(r.runs.raw_energies[m], 2));
  return out;
}

std::vector<std::string> remarks(const ModelFit& r) {
  std::vector<std::string> out;
  const auto bounds = at_bounds(r);
  if (const auto facts = contradictions(r); !facts.empty()) out.push_back("contradicted by: " + enumerate(facts));
  if (!bounds.empty()) out.push_back("on a bound: " + enumerate(bounds));
  if (r.search.failed_simulations > 0)
    out.push_back(fmt::format("{} of {} simulations diverged", counted(r.search.failed_simulations), counted(r.search.simulations)));
  return out;
}

// The mean of a model as a multiple of the recording's; where that is near zero, how far it is off in the recording's standard deviations.
std::string mean_text(const Comparison& c, const ModelFit& r, std::size_t m) {
  constexpr double kNearZero = 0.1;
  const Moments& real = c.recording.distributions[m].moments;
  if (!(std::abs(real.mean) < kNearZero * real.sd()) || !std::isfinite(r.runs.mean_ratio[m])) return fixed(r.runs.mean_ratio[m], 2);
  const double off = (r.runs.mean_ratio[m] - 1) * real.mean / real.sd();
  return fmt::format("{}{} sd", off < 0 ? "−" : "+", fixed(std::abs(off), 2));
}

}  // namespace

Html badge(const Comparison& c) { return c.recording.data.synthetic ? synthetic_badge() : Html{}; }

Html data_facts(const Comparison& c, std::string_view what) {
  const DataFacts& d = c.recording.data;
  Html out = fact(what, d.path, true);
  out += fact("tracks", counted(static_cast<std::int64_t>(d.tracks)));
  out += fact("frames", fmt::format("{} ({} to {})", counted(static_cast<std::int64_t>(d.frames)), d.first_frame, d.last_frame));
  out += fact("frame interval", fmt::format("{} s ({} Hz)", brief(d.dt), brief(1 / d.dt)));
  out += fact("individuals per frame", brief(d.individuals_per_frame, 3));
  out += fact("dimensions", fmt::format("{}-D, in {}", d.dims, d.unit));
  out += fact("rms radius, all frames", fmt::format("{} {}", rounded(d.extent), d.unit));
  out += fact("mean neighbour distance", fmt::format("{} {}", rounded(d.spacing), d.unit));
  out += fact("mean speed", fmt::format("{} {}", rounded(d.speed), metric_unit(kSpeed, d.unit)));
  return out;
}

Html warnings(const Comparison& c) {
  if (c.warnings.empty()) return {};
  Html groups;
  for (const Gravity gravity : {Gravity::claim, Gravity::result, Gravity::meaning, Gravity::note}) {
    Html items;
    for (const Warning& warning : c.warnings)
      if (warning.gravity == gravity) items += element("li", "", escaped(in_print(warning.text)));
    if (items.text.empty()) continue;
    groups += element("h3", gravity == Gravity::note ? "light" : "", escaped(gravity_title(gravity)));
    groups += element("ul", "", items);
  }
  Html out = markup("<aside class=\"warnings\" aria-labelledby=\"warnings-title\"><h2 id=\"warnings-title\">Warnings</h2>");
  out += groups;
  out += markup("</aside>");
  return out;
}

Html ranking(const Comparison& c) {
  HtmlTable table("Models by score");
  table.sortable().look("frozen");
  const auto columns = ranking_columns(c, Audience::page);
  const auto row = [&](const HtmlTable::Cell& model, auto cell) {
    Cells cells = {cell(*columns.front()), model};
    for (std::size_t k = 1; k < columns.size(); ++k) cells.push_back(cell(*columns[k]));
    return cells;
  };
  table.head(row(column("model"), [](const Quantity& q) { return column(q.head, q.key != "score_ci", false, q.meaning); }));
  const Scale scale = score_scale(c);
  for (std::size_t k = 0; k < c.models.size(); ++k) {
    const ModelFit& r = c.models[k];
    Html name = model_name(c, k);
    for (const std::string& remark : remarks(r)) name += element("span", "flag", escaped(remark));
    const auto cell = [&](const Quantity& q) -> HtmlTable::Cell {
      const Certainty& sure = r.standing.certainty;
      if (q.key != "score_ci") return number_cell(q.print(c, r, Audience::page));
      Html drawn = interval_drawing(r.standing.score, sure.lower, sure.upper, scale.lower, scale.upper, k);
      drawn += element("span", "n note", escaped(in_print(q.print(c, r, Audience::page))));
      return {.content = drawn};
    };
    table.row(row(name_cell(name), cell), r.standing.rank == 1 ? "first" : "");
  }
  const Estimate& walker = c.recording.skill.walker;
  if (std::isfinite(walker.value)) {
    const auto cell = [&](const Quantity& q) { return q.key == "skill" ? number_cell(walker_skill(walker)) : text_cell(""); };
    table.foot(row(name_cell(escaped(kWalk)), cell));
  }
  Html out = table.html();
  for (const std::string& note : {what_ranks_mean(c), what_held_out_means(c)})
    if (!note.empty()) out += element("p", "note", escaped(note));
  return out;
}

Html settings(const Comparison& c) {
  Html out;
  if (const std::string fixed = kept_fixed(c); !fixed.empty())
    out += element("p", "note", Html{"<b>Kept fixed</b>, not searched: " + escaped(fixed).text + "."});
  out += element("p", "note", Html{"<b>Simulation steps per frame</b>: " + escaped(steps_taken(c)).text + "."});
  return out;
}

Html legend(const Comparison& c) {
  Html out = element("span", "", Html{recording_key().text + "recording"});
  for (std::size_t k = 0; k < c.models.size(); ++k) {
    out += Html{fmt::format("<label><input type=\"checkbox\" data-model=\"{}\" checked> ", k)};
    out += model_name(c, k);
    out += markup("</label>\n");
  }
  return out;
}

Html pdf_figures(const Comparison& c) {
  Html out;
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m) {
    const std::string name = c.recording.columns[m].name(), symbol = c.recording.columns[m].symbol();
    const std::string remark = column_remark(c, m);
    if (c.recording.distributions[m].histogram.samples == 0) {
      out += Html{fmt::format("<figure><h3>{} {}</h3><p class=\"note\">No samples in this recording.</p></figure>\n", name, symbol)};
      continue;
    }
    out +=
        Html{fmt::format("<figure><h3>{0} {1}</h3><div class=\"canvas\"><canvas id=\"pdf-{2}\" role=\"img\" "
                         "aria-label=\"Density of the {0}{4}. {5}\"></canvas></div><figcaption>{3}</figcaption></figure>\n",
                         name, symbol, c.recording.columns[m].key(), html_escaped(remark), whose(c), html_escaped(finding(c, m)))};
  }
  return out;
}

Html band_note(const Comparison& c) {
  if (c.models.empty() ||
      std::all_of(c.ranking.band.lower.begin(), c.ranking.band.lower.end(), [](const auto& bins) { return bins.empty(); }))
    return {};
  return escaped(
      fmt::format(" Shaded band: range of 95 % of recordings simulated from {}, bin by bin; a recording inside the band is not a misfit.",
                  c.models.front().model));
}

Html pdf_note(const Comparison& c) {
  switch (c.recording.binning.normalisation) {
    case Normalisation::reference:
      return escaped(fmt::format("{} bins from {} to {} standard deviations of the recording about its mean{}. Empty ranges are not shown.",
                                 c.recording.binning.bins, brief(c.recording.binning.lower), brief(c.recording.binning.upper),
                                 c.recording.binning.clip ? "; values outside are counted in the end bins" : ""));
    case Normalisation::separate:
      return markup(
          "Every set is standardised by its own mean and standard deviation before it is compared: only the shape counts. The models are "
          "drawn "
          "as if they had the recording's mean and spread; the true ones are in the table below.");
    case Normalisation::none:
      return markup("Binned in physical units over the recording's 0.5 to 99.5 percentile range.");
  }
  return {};
}

Html moments(const Comparison& c) {
  HtmlTable table(
      "Mean and standard deviation: of the recording, and of every model as a multiple of it; where the mean is near zero, its difference "
      "in standard deviations");
  table.look("frozen tight");
  Cells head = {column("model"), column("")};
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    head.push_back(column(fmt::format("{} [{}]", marked(c, m, c.recording.columns[m].symbol()),
                                      metric_unit(c.recording.columns[m].metric, c.recording.data.unit)),
                          true, !counts(c, m)));
  table.head(head);
  Cells mean = {name_cell(markup("recording")), text_cell("mean")}, sd = {text_cell(""), text_cell("sd")};
  metric_columns(c, mean, [&](std::size_t m) { return rounded(c.recording.distributions[m].moments.mean); });
  metric_columns(c, sd, [&](std::size_t m) { return rounded(c.recording.distributions[m].moments.sd()); });
  table.row(mean).row(sd);
  for (std::size_t k = 0; k < c.models.size(); ++k) {
    const ModelFit& r = c.models[k];
    Cells means = {name_cell(model_name(c, k)), text_cell("mean\u00a0×")}, sds = {text_cell(""), text_cell("sd\u00a0×")};
    metric_columns(c, means, [&](std::size_t m) { return mean_text(c, r, m); });
    metric_columns(c, sds, [&](std::size_t m) { return fixed(r.runs.sd_ratio[m], 2); });
    table.row(means).row(sds);
  }
  return table.html();
}

Html weights(const Comparison& c) {
  HtmlTable table("Weights and normalisation of the metrics");
  table.look("frozen");
  Cells head = {column("")};
  metric_heads(c, head);
  table.head(head);
  const auto row = [&](const Html& title, const PerColumn<double>& values) {
    Cells cells = {name_cell(title)};
    metric_columns(c, cells, [&](std::size_t m) { return rounded(values[m]); });
    table.row(cells);
  };
  row(markup("weight"), c.ranking.weights);
  row(markup("least energy (p1)"), c.ranking.p1);
  row(markup("range of energies (p2)"), c.ranking.p2);
  for (const WeightStep& step : c.ranking.weight_history) row(escaped(fmt::format("weight, pass {}", step.pass)), step.weights);
  return table.html();
}

Html lags(const Comparison& c) {
  Html out = element("p", "note", escaped(lag_weights(c) + lags_measured(c)));
  if (c.ranking.lags.size() < 3) return out;
  HtmlTable table("Weight of every lag");
  table.head({column("lag", true), column("over", true), column("columns in the score", true), column("weight", true),
              column("largest share of measurement error", true)});
  for (const LagFacts& l : c.ranking.lags)
    table.row({number_cell(l.lag > 0 ? std::to_string(l.lag) : "d, η"),
               number_cell(l.lag > 0 ? fmt::format("{} s", brief(l.lag * c.recording.data.dt)) : kUndefined),
               number_cell(std::to_string(l.scored)), number_cell(fixed(l.weight, 3)), number_cell(percent(l.error_share))});
  out += table.html();
  return out;
}

Html weights_converged(const Comparison& c) {
  if (c.ranking.weight_history.empty()) return {};
  const std::size_t passes = c.ranking.weight_history.size();
  return escaped(fmt::format("{} after {} {} (largest change {}).", c.ranking.weights_converged ? "Converged" : "Not converged", passes,
                             passes == 1 ? "pass" : "passes", rounded(c.ranking.weight_history.back().largest_change, 2)));
}

}  // namespace swarmfit::sections
