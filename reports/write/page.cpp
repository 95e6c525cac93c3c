// SPDX-License-Identifier: MIT
#include "reports/write/page.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "libtrack/error.h"
#include "reports/write/html_table.h"

namespace swarmfit {
namespace {

// A source expression of the content security policy: exactly this text may run.
std::string allowed(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw RunError("report: cannot compute SHA-256");
  return fmt::format("'sha256-{}'", base64({reinterpret_cast<const char*>(digest.data()), length}));
}

}  // namespace

std::string filled(std::string_view page, const PageValues& values) {
  std::string out;
  while (true) {
    const std::size_t open = page.find("{{");
    out += page.substr(0, open);
    if (open == std::string_view::npos) return out;
    const std::size_t close = page.find("}}", open);
    out += values.at(std::string(page.substr(open + 2, close - open - 2)));
    page.remove_prefix(close + 2);
  }
}

std::string page_section(std::string_view id, std::string_view title, std::string_view content) {
  if (content.empty()) return {};
  return fmt::format("<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\">{1}</h2>\n{2}</section>\n", id,
                     html_escaped(title), content);
}

std::string content_policy(std::string_view style, const std::vector<std::string_view>& scripts) {
  std::string sources;
  for (const std::string_view script : scripts) sources += ' ' + allowed(script);
  if (scripts.empty()) sources = " 'none'";
  return fmt::format("default-src 'none'; script-src{}; style-src {}; base-uri 'none'; form-action 'none'", sources, allowed(style));
}

std::string base64(std::string_view bytes) {
  std::string out(4 * ((bytes.size() + 2) / 3) + 1, '\0');  // and the zero that it ends with
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(out.data()), reinterpret_cast<const unsigned char*>(bytes.data()),
                  static_cast<int>(bytes.size()));
  out.pop_back();
  return out;
}

std::string embedded(std::string_view json) {
  std::string out;
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace swarmfit
