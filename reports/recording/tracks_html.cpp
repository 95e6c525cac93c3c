// SPDX-License-Identifier: MIT
#include "reports/recording/tracks_html.h"

#include <fmt/format.h>

#include "reports/comparison/chart_data.h"
#include "reports/comparison/html_sections.h"
#include "reports/comparison/words.h"
#include "reports/motion/player.h"
#include "reports/recording/summary_words.h"
#include "reports/write/assets.h"
#include "reports/write/number.h"
#include "reports/write/page.h"

namespace swarmfit {
namespace {

// What a tracker may have done wrong; a simulation has none.
Html suspicions(const Summary& s) {
  if (s.suspicions.empty()) return {};
  Html items;
  for (const Suspicion& one : s.suspicions) items += element("li", "", escaped(suspicion_words(one)));
  Html out =
      markup("<aside class=\"warnings\" aria-labelledby=\"warnings-title\"><h2 id=\"warnings-title\">Check these before using it</h2>");
  out += element("ul", "", items);
  out += markup("</aside>");
  return out;
}

Html contents_table(const TextRows& rows) {
  HtmlTable table("Contents");
  for (const auto& row : rows) table.row({name_cell(escaped(row[0])), number_cell(row[1]), text_cell(in_print(row[2]))});
  return table.html();
}

Html quantile_table(const TextRows& rows) {
  HtmlTable table("Distributions over frames, tracks and individuals");
  for (const auto& row : rows) {
    const bool head = &row == &rows.front();
    std::vector<HtmlTable::Cell> cells;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const bool number = k > 0 && k < 6;
      cells.push_back(head     ? column(row[k], number)
                      : k == 0 ? name_cell(escaped(row[k]))
                      : number ? number_cell(row[k])
                               : text_cell(row[k]));
    }
    head ? table.head(cells) : table.row(cells);
  }
  return table.html();
}

Html model_section(const TracksPage& page) {
  if (!page.model) return {};
  Html out = markup("<section id=\"model\" aria-labelledby=\"model-title\">\n<h2 id=\"model-title\">The model</h2>\n");
  out += model_card(*page.model);
  out += markup("</section>\n");
  return out;
}

Html repairs(const TrackMeta& meta) {
  Html out;
  for (const std::string& note : meta.from.notes) out += fact("repaired while reading", note, true);
  out += fact("read as", meta.from.format);
  out += fact("columns", meta.from.columns);
  out += fact("SHA-256 of the recording", meta.from.sha256, true);
  return out;
}

}  // namespace

std::string tracks_html(const Comparison& c, const TrackMeta& meta, const Summary& summary, const TracksPage& page) {
  const std::string name = page.model ? page.model->name : file_name(meta.from.path);
  return filled(assets::tracks_html,
                {{"policy", content_policy(assets::report_css, {assets::chart_js, assets::report_js, player_script()})},
                 {"css", std::string(assets::report_css)},
                 {"chart_js", std::string(assets::chart_js)},
                 {"js", std::string(assets::report_js)},
                 {"player_js", player_script()},
                 {"data", chart_data(c)},
                 {"kind", page.model ? "simulation" : "recording"},
                 {"badge", sections::badge(c).text},
                 {"name", html_escaped(name)},
                 {"facts", sections::data_facts(c, page.model ? "simulation" : "recording").text},
                 {"warnings", page.model ? std::string() : suspicions(summary).text},
                 {"motion", page_section("motion", "In motion", sections::motion(c).text)},
                 {"model", model_section(page).text},
                 {"quality", page.model ? std::string() : page_section("quality", "Quality of the tracks", sections::quality(c).text)},
                 {"pictures", page_section("pictures", "The group in pictures", sections::pictures(c).text)},
                 {"pdf_figures", sections::pdf_figures(c).text},
                 {"contents", contents_table(contents_rows(meta, summary)).text},
                 {"quantiles", quantile_table(quantile_rows(meta, summary)).text},
                 {"localisation", html_escaped(in_print(localisation_words(meta, summary.localisation)))},
                 {"command", html_escaped(page.command)},
                 {"provenance", repairs(meta).text},
                 {"version", html_escaped(page.version)}});
}

}  // namespace swarmfit
