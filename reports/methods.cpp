// SPDX-License-Identifier: MIT
#include "reports/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "reports/paper_text.h"

namespace swarmfit {
namespace {

struct Language {
  std::string (*text)(std::string_view);
  std::string_view lowered, level;  // around a subscript
};

std::string_view section_of(std::string_view page) {
  const std::size_t open = page.find("<section id=\"methods\"");
  if (open == std::string_view::npos) return {};
  page.remove_prefix(open);
  return page.substr(0, page.find("</section>"));
}

// The contents of all elements of this name.
std::vector<std::string_view> elements(std::string_view html, std::string_view name) {
  const std::string open = fmt::format("<{}>", name), close = fmt::format("</{}>", name);
  std::vector<std::string_view> out;
  for (std::size_t at = html.find(open); at != std::string_view::npos; at = html.find(open, at)) {
    at += open.size();
    out.push_back(html.substr(at, html.find(close, at) - at));
  }
  return out;
}

// What html_escaped made of text is undone, and line breaks become spaces.
std::string unescaped(std::string_view html) {
  using Pair = std::pair<std::string_view, char>;
  static constexpr std::array kEntities{Pair{"&lt;", '<'}, Pair{"&gt;", '>'}, Pair{"&quot;", '"'}, Pair{"&#39;", '\''}, Pair{"&amp;", '&'}};
  std::string out;
  while (!html.empty()) {
    std::size_t used = 1;
    char c = html.front() == '\n' ? ' ' : html.front();
    for (const auto& [entity, character] : kEntities)
      if (html.starts_with(entity)) c = character, used = entity.size();
    out += c;
    html.remove_prefix(used);
  }
  return out;
}

std::string translated(std::string_view html, const Language& language) {
  std::string out;
  while (!html.empty()) {
    const std::size_t tag = std::min(html.find('<'), html.size());
    out += language.text(unescaped(html.substr(0, tag)));
    html.remove_prefix(tag);
    if (html.starts_with("<sub>")) out += language.lowered;
    if (html.starts_with("</sub>")) out += language.level;
    html.remove_prefix(std::min(html.find('>'), html.size()));
    html.remove_prefix(html.empty() ? 0 : 1);
  }
  return out;
}

}  // namespace

std::string methods_markdown(std::string_view page) {
  const Language markdown{markdown_text, "<sub>", "</sub>"};
  const std::string_view section = section_of(page);
  std::string out;
  for (const auto paragraph : elements(section, "p")) out += translated(paragraph, markdown) + "\n\n";
  int number = 0;
  for (const auto reference : elements(section, "li")) out += fmt::format("{}. {}\n", ++number, translated(reference, markdown));
  return out;
}

std::string methods_latex(std::string_view page) {
  const Language latex{latex_text, "\\textsubscript{", "}"};
  const std::string_view section = section_of(page);
  std::string out, references;
  for (const auto paragraph : elements(section, "p")) out += translated(paragraph, latex) + "\n\n";
  for (const auto reference : elements(section, "li")) references += "  \\item " + translated(reference, latex) + '\n';
  return references.empty() ? out : out + "\\begin{enumerate}\n" + references + "\\end{enumerate}\n";
}

}  // namespace swarmfit
