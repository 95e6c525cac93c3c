// SPDX-License-Identifier: MIT
#include "reports/study/study_html.h"

#include <fmt/format.h>

#include "reports/comparison/words.h"
#include "reports/write/assets.h"
#include "reports/write/page.h"
#include "reports/write/plain_text.h"

namespace swarmfit {
std::string study_html(const StudyPage& page) {
  std::string sections;
  for (const StudySection& s : page.sections) sections += page_section(s.id, s.title, s.content.text);
  return filled(assets::study_html,
                {{"policy", content_policy(assets::report_css, {assets::sort_js})},
                 {"css", std::string(assets::report_css)},
                 {"sort_js", std::string(assets::sort_js)},
                 {"kind", html_escaped(page.kind)},
                 {"badge", page.badge.text},
                 {"sentence", html_escaped(printable(page.sentence))},
                 {"detail", html_escaped(printable(page.detail))},
                 {"facts", page.facts.text},
                 {"warnings", page.warnings.text},
                 {"sections", sections},
                 {"command", html_escaped(fmt::format("swarmfit {} --config config.toml --out NEW_FOLDER", page.command))},
                 {"config", html_escaped(config_toml(page.command, page.settings))},
                 {"files", page.files.text},
                 {"version", html_escaped(page.version)}});
}

std::string setting(const Settings& settings, std::string_view name) {
  for (const auto& [key, value] : settings) {
    if (key != name) continue;
    const bool quoted = value.size() >= 2 && value.front() == '"' && value.back() == '"';
    return quoted ? value.substr(1, value.size() - 2) : value;
  }
  return {};
}

}  // namespace swarmfit
