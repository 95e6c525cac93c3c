// SPDX-License-Identifier: MIT
#include "reports/study/measure_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/draw/inline_svg.h"
#include "reports/study/measure_figures.h"
#include "reports/study/study_html.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit {
namespace {

Html means_table(const TrackMeta& meta, const MeasuredGroup& g) {
  HtmlTable table(g.name == "all" ? "Means over time, all individuals" : "Means over time: " + g.name);
  table.head({column("quantity"), column("symbol"), column("mean", true), column("95 % interval", true), column("sd", true), column("unit"),
              column("correlation time", true), column("what it is")});
  for (std::size_t k = 0; k < g.means.size(); ++k) {
    const OrderParameter& p = *g.record.what()[k];
    const SeriesMean& m = g.means[k];
    const std::string interval = std::isfinite(m.lower) ? rounded(m.lower) + " .. " + rounded(m.upper) : kUndefined;
    table.row({name_cell(escaped(p.name)), text_cell(p.symbol), number_cell(in_print(rounded(m.mean))), number_cell(in_print(interval)),
               number_cell(in_print(rounded(m.sd))), text_cell(powers_unit(p.length, p.time, meta.unit)),
               number_cell(std::isfinite(m.correlation_time) ? rounded(m.correlation_time * meta.dt) + " s" : kUndefined),
               text_cell(p.meaning)});
  }
  return table.html();
}

Html means(const TrackMeta& meta, const Measured& measured) {
  Html out;
  for (const MeasuredGroup& g : measured.groups) out += means_table(meta, g);
  out += element("p", "note",
                 markup("Intervals are of the mean over time, from blocks of two correlation times or more; a dash: the recording is too "
                        "short for four of them."));
  return out;
}

Html states(const TrackMeta& meta, const Measured& measured) {
  HtmlTable table("States over time");
  table.head({column("group"), column("from [s]", true), column("to [s]", true), column("state"), column("rule")});
  for (const MeasuredGroup& g : measured.groups)
    for (const StateSpell& s : spells(g.states))
      table.row({name_cell(escaped(g.name)), number_cell(brief(meta.t0 + meta.dt * static_cast<double>(s.first))),
                 number_cell(brief(meta.t0 + meta.dt * static_cast<double>(s.last))), text_cell(s.state->name), text_cell(s.state->rule)});
  Html out = table.html();
  HtmlTable events("Fission and fusion");
  events.head(
      {column("group"), column("time [s]", true), column("event"), column("subgroups before", true), column("subgroups after", true)});
  bool any = false;
  for (const MeasuredGroup& g : measured.groups)
    for (const GroupEvent& e : g.states.events) {
      any = true;
      events.row({name_cell(escaped(g.name)), number_cell(brief(meta.t0 + meta.dt * static_cast<double>(e.frame))),
                  text_cell(e.fission() ? "fission" : "fusion"), number_cell(std::to_string(e.before)),
                  number_cell(std::to_string(e.after))});
    }
  if (any) out += events.html();
  out += element("p", "note",
                 markup("A subgroup holds at least a tenth of all individuals. A change of their number counts when it lasts a tenth of a "
                        "window."));
  return out;
}

Html drawing(const std::string& svg, std::string_view prefix) {
  return svg.empty() ? Html{} : element("figure", "wide", sheet_of(svg, prefix));
}

}  // namespace

std::string measure_sentence(const Measured& measured) {
  const auto& windows = measured.groups.front().states.windows;
  std::map<std::string_view, std::size_t> count;
  for (const StateWindow& w : windows) ++count[w.state->name];
  const auto most = std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == count.end()) return "This recording has no individuals.";
  return fmt::format("State: {} in {} of {}.", most->first, most->second, counted(static_cast<std::int64_t>(windows.size()), "window"));
}

std::string measure_html(const TrackMeta& meta, const Measured& measured, const Settings& settings, const std::string& version) {
  const MeasuredGroup& all = measured.groups.front();
  StudyPage page{"measure",
                 "order parameters of a recording",
                 measure_sentence(measured),
                 "",
                 meta.from.synthetic ? synthetic_badge() : Html{},
                 {},
                 {},
                 {},
                 {},
                 settings,
                 version};
  page.facts = fact("recording", printable(meta.from.path), true);
  page.facts += fact("frames", fmt::format("{} at {} Hz", all.record.frame().size(), brief(1 / meta.dt)));
  page.facts += fact("dimensions", fmt::format("{}-D, in {}", meta.dims, printable(meta.unit)));
  page.facts += fact("linked within", fmt::format("{} {}", rounded(all.link), printable(meta.unit)));
  page.facts += fact("window of states", fmt::format("{} s", brief(static_cast<double>(all.window) * meta.dt)));
  page.facts += fact("correlation length", std::isfinite(all.curves.correlation_length)
                                               ? fmt::format("{} {}", rounded(all.curves.correlation_length), printable(meta.unit))
                                               : "");
  page.sections = {{"means", "Means", means(meta, measured)},
                   {"states", "States", states(meta, measured)},
                   {"series", "Over time", drawing(series_svg(meta, measured), "series")},
                   {"curves", "Over distance and delay", drawing(group_curves_svg(meta, all), "curves")},
                   {"neighbours", "Nearest neighbours", drawing(neighbour_map_svg(meta, all.curves.map), "map")}};
  std::erase_if(page.sections, [](const StudySection& s) { return s.content.text.empty(); });
  page.files = markup("<code>measure.json</code>, <code>tables/series.csv</code>, <code>tables/means.csv</code>");
  return study_html(page);
}

}  // namespace swarmfit
