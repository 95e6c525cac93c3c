// SPDX-License-Identifier: MIT
#include "reports/comparison/html.h"

#include <fmt/format.h>

#include "reports/comparison/chart_data.h"
#include "reports/comparison/html_sections.h"
#include "reports/comparison/words.h"
#include "reports/motion/player.h"
#include "reports/write/assets.h"
#include "reports/write/html_table.h"
#include "reports/write/number.h"
#include "reports/write/page.h"
#include "reports/write/run_folder.h"

namespace swarmfit {
namespace {

std::string policy() { return content_policy(assets::report_css, {assets::chart_js, assets::report_js, assets::sort_js, player_script()}); }

PageValues page_values(const Comparison& c) {
  const Headline answer = headline(c);
  return {{"policy", policy()},
          {"css", std::string(assets::report_css)},
          {"chart_js", std::string(assets::chart_js)},
          {"js", std::string(assets::report_js)},
          {"sort_js", std::string(assets::sort_js)},
          {"player_js", player_script()},
          {"data", chart_data(c)},
          {"title", html_escaped(fmt::format("{} – swarmfit", answer.sentence))},
          {"kind", c.run.command == "fit" ? "fit" : "comparison"},
          {"badge", sections::badge(c).text},
          {"sentence", html_escaped(answer.sentence)},
          {"detail", html_escaped(answer.detail)},
          {"facts", sections::data_facts(c).text},
          {"warnings", sections::warnings(c).text},
          {"ranking", sections::ranking(c).text},
          {"result_figure", sections::result_figure(c).text},
          {"strip", sections::strip(c).text},
          {"heat_map", sections::heat_map(c).text},
          {"pictures", sections::pictures(c).text},
          {"convergence", sections::convergence(c).text},
          {"posteriors", sections::posteriors(c).text},
          {"settings", sections::settings(c).text},
          {"final_replicates", std::to_string(c.run.budget.final_replicates)},
          {"what_skill_means", html_escaped(what_skill_means(c))},
          {"motion", sections::motion(c).text},
          {"legend", sections::legend(c).text},
          {"pdf_figures", sections::pdf_figures(c).text},
          {"band_note", sections::band_note(c).text},
          {"pdf_note", sections::pdf_note(c).text},
          {"moments", sections::moments(c).text},
          {"weights_converged", sections::weights_converged(c).text},
          {"weights", sections::weights(c).text},
          {"lags", sections::lags(c).text},
          {"parameters", sections::parameters(c).text},
          {"search", sections::search(c).text},
          {"observation", sections::observation(c).text},
          {"skill", sections::skill(c).text},
          {"without", sections::without(c).text},
          {"panel", sections::panel(c).text},
          {"methods", sections::methods(c).text},
          {"references", sections::references(c).text},
          {"command", html_escaped(fmt::format("swarmfit {} --config config.toml --out NEW_FOLDER", c.run.command))},
          {"provenance", sections::provenance(c).text},
          {"config", html_escaped(config_toml(c.run.command, c.run.config))},
          {"version", html_escaped(c.run.version)}};
}

}  // namespace

std::string report_html(const Comparison& c) { return filled(assets::report_html, page_values(c)); }

}  // namespace swarmfit
