// SPDX-License-Identifier: MIT
#include "reports/draw/inline_svg.h"

namespace swarmfit {
namespace {

// Text in the document is escaped, so that these cannot be words of anybody's.
void rename(std::string& text, std::string_view before, std::string_view prefix) {
  for (auto at = text.find(before); at != std::string::npos; at = text.find(before, at + before.size() + prefix.size()))
    text.insert(at + before.size(), prefix);
}

}  // namespace

Html inline_svg(const std::string& document, std::string_view prefix) {
  std::string text = document;
  rename(text, "id=\"", prefix);
  rename(text, "url(#", prefix);
  return {text};
}

Html sheet_of(const std::string& document, std::string_view prefix) {
  const bool wide = document.find("width=\"178mm\"") != std::string::npos;
  return element("div", wide ? "paper" : "paper half", inline_svg(document, prefix));
}

}  // namespace swarmfit
