// SPDX-License-Identifier: MIT
#include "reports/recording/evaluation_html.h"

#include <fmt/format.h>

#include "reports/comparison/chart_data.h"
#include "reports/comparison/html_sections.h"
#include "reports/comparison/methods.h"
#include "reports/comparison/words.h"
#include "reports/motion/player.h"
#include "reports/recording/evaluation_words.h"
#include "reports/write/assets.h"
#include "reports/write/number.h"
#include "reports/write/page.h"
#include "reports/write/unit_text.h"

namespace swarmfit {
namespace {

using Cells = std::vector<HtmlTable::Cell>;

constexpr std::size_t kEnergyCell = 2, kUnitCell = 7;  // of energy_rows
constexpr std::ptrdiff_t kPlaceCell = 3;

// The rows of the terminal, and where each energy lies between the same and disjoint.
Html energies(const Evaluation& e) {
  HtmlTable table("Energy of every metric between recording and simulation");
  const TextRows rows = energy_rows(e);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Cells cells;
    for (std::size_t j = 0; j < rows[k].size(); ++j) {
      const bool number = j >= kEnergyCell && j < kUnitCell;
      cells.push_back(k == 0   ? column(rows[k][j], number)
                      : j == 1 ? name_cell(escaped(rows[k][j]))
                      : number ? number_cell(rows[k][j])
                               : text_cell(rows[k][j]));
    }
    const double energy = k > 0 ? e.raw_energies[k - 1] : 0, worst = worst_energy(e.binning);
    const HtmlTable::Cell place = k == 0 ? column(fmt::format("0 to {}", brief(worst)))
                                         : HtmlTable::Cell{.content = interval_drawing(energy, 0, energy, 0, worst, 0)};
    cells.insert(cells.begin() + kPlaceCell, place);
    k == 0 ? table.head(cells) : table.row(cells);
  }
  return table.sortable().html();
}

Html order(const Evaluation& e) {
  HtmlTable table("Order of the group");
  const TextRows rows = order_rows(e);
  for (const auto& row : rows) {
    const bool head = &row == &rows.front();
    Cells cells{head ? column(row[0]) : name_cell(escaped(row[0]))};
    for (std::size_t k = 1; k < row.size(); ++k) cells.push_back(head ? column(row[k], true) : number_cell(row[k]));
    head ? table.head(cells) : table.row(cells);
  }
  return table.html();
}

Html sides(const DataFacts& real, const DataFacts& simulated) {
  HtmlTable table("The two recordings");
  table.head({column(""), column("recording", true), column("simulation", true)});
  const auto row = [&](const std::string& what, auto text) {
    table.row({name_cell(escaped(what)), number_cell(text(real)), number_cell(text(simulated))});
  };
  row("tracks", [](const DataFacts& d) { return counted(static_cast<std::int64_t>(d.tracks)); });
  row("frames", [](const DataFacts& d) { return counted(static_cast<std::int64_t>(d.frames)); });
  row("first and last frame", [](const DataFacts& d) { return fmt::format("{} to {}", d.first_frame, d.last_frame); });
  row("frame interval [s]", [](const DataFacts& d) { return brief(d.dt); });
  row("individuals per frame", [](const DataFacts& d) { return brief(d.individuals_per_frame, 3); });
  row(fmt::format("mean neighbour distance [{}]", real.unit), [](const DataFacts& d) { return rounded(d.spacing); });
  row(fmt::format("mean speed [{}]", metric_unit(kSpeed, real.unit)), [](const DataFacts& d) { return rounded(d.speed); });
  return table.html();
}

Html provenance(const std::string& whose, const DataFacts& d) {
  Html out;
  for (const std::string& note : d.notes) out += fact("repaired while reading the " + whose, note, true);
  out += fact(whose + " read as", d.format);
  out += fact("columns of the " + whose, d.columns);
  out += fact("SHA-256 of the " + whose, d.sha256, true);
  return out;
}

std::string source(const DataFacts& d) { return d.path + (d.synthetic ? " (synthetic)" : ""); }

Html files(const DataFacts& real, const DataFacts& simulated) {
  Html out = fact("recording", source(real), true);
  out += fact("simulation", source(simulated), true);
  return out;
}

Html paragraphs(const Methods& m) {
  Html out;
  for (const std::string& text : m.paragraphs) out += element("p", "", escaped(text));
  return out;
}

Html references(const Methods& m) {
  Html out;
  for (const std::string& text : m.references) out += element("li", "", escaped(text));
  return out;
}

PageValues parts(const Evaluation& e, const PairPortrait& p, const std::string& version) {
  const Comparison& c = p.comparison;
  const Methods how = methods(e, c.recording.observation.velocity == "recorded", version);
  Html origin = provenance("recording", c.recording.data);
  origin += provenance("simulation", p.simulation);
  return {{"badge", sections::badge(c).text},
          {"sentence", html_escaped(evaluation_sentence(e))},
          {"detail", html_escaped(energy_words(e))},
          {"facts", files(c.recording.data, p.simulation).text},
          {"energies", energies(e).text},
          {"lags", html_escaped(lag_words(e))},
          {"motion", page_section("motion", "In motion", sections::motion(c).text)},
          {"legend", sections::legend(c).text},
          {"pdf_figures", sections::pdf_figures(c).text},
          {"pdf_note", sections::pdf_note(c).text},
          {"sides", sides(c.recording.data, p.simulation).text},
          {"order", order(e).text},
          {"methods", paragraphs(how).text},
          {"references", references(how).text},
          {"provenance", origin.text}};
}

}  // namespace

std::string evaluation_html(const Evaluation& e, const PairPortrait& p, const std::string& command, const std::string& version) {
  PageValues values = parts(e, p, version);
  values.insert({{"policy", content_policy(assets::report_css, {assets::chart_js, assets::report_js, assets::sort_js, player_script()})},
                 {"css", std::string(assets::report_css)},
                 {"chart_js", std::string(assets::chart_js)},
                 {"js", std::string(assets::report_js)},
                 {"sort_js", std::string(assets::sort_js)},
                 {"player_js", player_script()},
                 {"data", chart_data(p.comparison)},
                 {"command", html_escaped(command)},
                 {"version", html_escaped(version)}});
  return filled(assets::evaluation_html, values);
}

}  // namespace swarmfit
