// SPDX-License-Identifier: MIT
#include "reports/comparison/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "reports/comparison/figure_parts.h"
#include "reports/comparison/paper_tables.h"
#include "reports/comparison/words.h"

namespace swarmfit {

namespace parts {

std::vector<std::size_t> drawing_order(const Comparison& c) {
  std::vector<std::size_t> out, without_lag;
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m) (c.recording.columns[m].motion() ? out : without_lag).push_back(m);
  out.insert(out.end(), without_lag.begin(), without_lag.end());
  return out;
}

std::string lag_title(const Comparison& c, std::size_t column) {
  const bool several = c.recording.columns.size() > kMetrics;
  return several && c.recording.columns[column].motion() ? lag_name(c, c.recording.columns[column].lag) : std::string();
}

std::vector<plot::Entry> model_entries(const Comparison& c, plot::Sample sample) {
  std::vector<plot::Entry> out;
  for (std::size_t k = 0; k < c.models.size(); ++k) out.push_back({sample, k, c.models[k].model});
  return out;
}

}  // namespace parts

std::vector<Figure> figures(const Comparison& c) {
  std::vector<Figure> all = {parts::densities(c),  parts::scores(c),     parts::energies(c),  parts::convergence(c),
                             parts::parameters(c), parts::neighbours(c), parts::responses(c), parts::curves(c),
                             parts::forces(c),     parts::order(c),      parts::space(c)};
  for (std::size_t k = 0; k < c.models.size(); ++k) all.push_back(parts::posterior(c, k));
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m) all.push_back(parts::density_of(c, m));
  std::vector<Figure> out;
  for (Figure& f : all) {
    if (f.svg.empty()) continue;
    f.caption += ' ' + origin(c);
    out.push_back(std::move(f));
  }
  return out;
}

bool is_figure(std::string_view file_name) {
  constexpr std::array<std::string_view, 11> kNames = {"densities.svg",  "scores.svg",     "energies.svg",  "convergence.svg",
                                                       "parameters.svg", "neighbours.svg", "responses.svg", "curves.svg",
                                                       "forces.svg",     "order.svg",      "space.svg"};
  return std::find(kNames.begin(), kNames.end(), file_name) != kNames.end() ||
         ((file_name.starts_with("density_") || file_name.starts_with("posterior_")) && file_name.ends_with(".svg"));
}

std::string captions_markdown(const std::vector<Figure>& figures) {
  std::string out;
  for (const Figure& f : figures)
    out += fmt::format("{}**{}.svg** {}\n", out.empty() ? "" : "\n", markdown_text(f.name), markdown_text(f.caption));
  return out;
}

std::string captions_latex(const std::vector<Figure>& figures) {
  std::string out = "% needs \\usepackage{graphicx}, and the figures as PDF beside it\n";
  for (const Figure& f : figures) {
    const std::string_view environment = f.svg.find("width=\"178mm\"") == std::string::npos ? "figure" : "figure*";
    out += fmt::format(
        "\\begin{{{0}}}\n  \\centering\n  \\includegraphics{{{1}.pdf}}\n  \\caption{{{2}}}\n  \\label{{fig:{1}}}\n\\end{{{0}}}\n\n",
        environment, f.name, latex_text(f.caption));
  }
  return out;
}

}  // namespace swarmfit
