// SPDX-License-Identifier: MIT
#include "reports/comparison/html.h"

#include <fmt/format.h>

#include "reports/comparison/chart_data.h"
#include "reports/comparison/html_sections.h"
#include "reports/comparison/page_sections.h"
#include "reports/comparison/words.h"
#include "reports/motion/player.h"
#include "reports/write/assets.h"
#include "reports/write/page.h"

namespace swarmfit {
namespace {

std::string policy() { return content_policy(assets::report_css, {assets::chart_js, assets::report_js, assets::sort_js, player_script()}); }

PageValues page_values(const Comparison& c) {
  const Headline answer = headline(c);
  std::string contents, shown, technical;
  for (const PageSection& s : page_sections()) {
    const std::string text = page_section(s.id, s.title, s.content(c).text);
    (s.technical ? technical : shown) += text;
    if (!text.empty() && *s.in_contents != '\0') contents += fmt::format("<li><a href=\"#{}\">{}</a></li>", s.id, s.in_contents);
  }
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
          {"result_figure", sections::result_figure(c).text},
          {"strip", sections::strip(c).text},
          {"warnings", sections::warnings(c).text},
          {"contents", contents},
          {"sections", shown},
          {"technical", technical},
          {"version", html_escaped(c.run.version)}};
}

}  // namespace

std::string report_html(const Comparison& c) { return filled(assets::report_html, page_values(c)); }

}  // namespace swarmfit
