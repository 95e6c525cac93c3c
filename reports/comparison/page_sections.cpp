// SPDX-License-Identifier: MIT
#include "reports/comparison/page_sections.h"

#include <fmt/format.h>

#include "reports/comparison/html_sections.h"
#include "reports/comparison/words.h"
#include "reports/write/run_folder.h"

namespace swarmfit {

std::span<const PageSection> page_sections() {
#define SECTION(id, title, in_contents) PageSection{#id, title, in_contents, false, page::id},
#define TECHNICAL(id, title) PageSection{#id, title, "", true, page::id},
  static constexpr PageSection all[] = {
#include "reports/comparison/page_sections.def"
  };
#undef SECTION
#undef TECHNICAL
  return all;
}

namespace page {
namespace {

Html note(const Html& text) { return element("p", "note", text); }

Html facts_of(const Html& facts) { return {fmt::format("<dl class=\"facts\">{}</dl>\n", facts.text)}; }

Html joined(std::initializer_list<Html> parts) {
  Html out;
  for (const Html& part : parts) out += part;
  return out;
}

}  // namespace

Html ranking(const Comparison& c) {
  const std::string score = fmt::format(
      "E = 1 − Σ weight × normalised energy: higher is better, relative to the models listed here; it rests on {} fresh replicates, the "
      "bar is its 95 % interval across recordings of this length. ± is one standard error over the replicates.",
      c.run.budget.final_replicates);
  Html about = joined({markup("<b>Score</b> "), escaped(score)});
  if (const std::string skill = what_skill_means(c); !skill.empty())
    about += joined({markup(" <b>Skill</b> is independent of the other models: "), escaped(skill)});
  return joined({sections::ranking(c), note(about)});
}

Html energies(const Comparison& c) { return sections::heat_map(c); }
Html pictures(const Comparison& c) { return sections::pictures(c); }
Html motion(const Comparison& c) { return sections::motion(c); }

Html distributions(const Comparison& c) {
  return joined({markup("<form class=\"controls\" id=\"legend\" aria-label=\"Which models the charts show\">"), sections::legend(c),
                 markup("\n<label class=\"control\"><input type=\"checkbox\" id=\"log\"> logarithmic density</label></form>\n"
                        "<div class=\"grid\">"),
                 sections::pdf_figures(c),
                 markup("\n<div class=\"card\"><h3>How to read these</h3><p class=\"note\">Grey: distribution in the recording. Lines: "
                        "distribution in the simulations of each model, all final replicates pooled. The closer a line follows the grey "
                        "area, the better. Model peaks are cropped at twice the recording's peak. Steps in a curve come from rounded "
                        "positions or few samples."),
                 sections::band_note(c), markup(" "), sections::pdf_note(c),
                 markup("</p></div>\n</div>\n<noscript><p class=\"note\">The charts need JavaScript; these are the numbers behind them, in "
                        "full in <code>tables/pdfs.csv</code>.</p></noscript>\n"),
                 sections::moments(c)});
}

Html panel(const Comparison& c) { return sections::panel(c); }
Html skill(const Comparison& c) { return joined({sections::skill(c), sections::without(c)}); }
Html parameters(const Comparison& c) { return joined({sections::parameters(c), sections::posteriors(c)}); }

Html recording(const Comparison& c) { return facts_of(sections::data_facts(c)); }
Html weights(const Comparison& c) { return joined({note(sections::weights_converged(c)), sections::weights(c), sections::lags(c)}); }
Html search(const Comparison& c) { return joined({sections::convergence(c), sections::search(c), sections::settings(c)}); }
Html observation(const Comparison& c) { return sections::observation(c); }

Html methods(const Comparison& c) {
  return joined({sections::methods(c), markup("<ol class=\"references\">\n"), sections::references(c), markup("\n</ol>\n")});
}

Html repeat(const Comparison& c) {
  return joined({markup("<p>The same version on the same kind of processor reproduces every file of the run bit by bit, except "
                        "<code>timing.json</code>.</p>\n<pre><code>"),
                 escaped(fmt::format("swarmfit {} --config config.toml --out NEW_FOLDER", c.run.command)), markup("</code></pre>\n"),
                 facts_of(sections::provenance(c)), markup("<details><summary>config.toml</summary><pre><code>"),
                 escaped(config_toml(c.run.command, c.run.config)), markup("</code></pre></details>\n")});
}

}  // namespace page
}  // namespace swarmfit
