// SPDX-License-Identifier: MIT
#include "reports/recording/gallery_html.h"

#include <fmt/format.h>

#include "reports/motion/player.h"
#include "reports/write/assets.h"
#include "reports/write/page.h"

namespace swarmfit {
namespace {

Html exhibit(const Exhibit& e) {
  const std::string name = html_escaped(e.card.name);
  Html out{fmt::format("<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\">{0}</h2>\n", name)};
  out += markup("<div class=\"exhibit\"><div>");
  out += player({{e.card.name, &e.tracks}}, e.scenery);
  out += markup("</div><div>");
  out += model_card(e.card);
  out += element("pre", "", element("code", "", escaped(e.command)));
  out += markup("</div></div></section>\n");
  return out;
}

}  // namespace

std::string gallery_html(const std::vector<Exhibit>& exhibits, const std::string& version) {
  Html all, contents;
  for (const Exhibit& e : exhibits) {
    all += exhibit(e);
    const std::string name = html_escaped(e.card.name);
    contents += Html{fmt::format("<li><a href=\"#{0}\">{0}</a></li>", name)};
  }
  return filled(assets::gallery_html, {{"policy", content_policy(assets::report_css, {player_script()})},
                                       {"css", std::string(assets::report_css)},
                                       {"player_js", player_script()},
                                       {"count", std::to_string(exhibits.size())},
                                       {"contents", contents.text},
                                       {"exhibits", all.text},
                                       {"version", html_escaped(version)}});
}

}  // namespace swarmfit
