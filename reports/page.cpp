// SPDX-License-Identifier: MIT
#include "reports/page.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

// A source expression of the content security policy: exactly this text may run.
std::string allowed(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw RunError("report: cannot compute SHA-256");
  std::array<unsigned char, 4 * ((EVP_MAX_MD_SIZE + 2) / 3) + 1> base64{};
  EVP_EncodeBlock(base64.data(), digest.data(), static_cast<int>(length));
  return fmt::format("'sha256-{}'", reinterpret_cast<const char*>(base64.data()));
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

std::string content_policy(std::string_view style, const std::vector<std::string_view>& scripts) {
  std::string sources;
  for (const std::string_view script : scripts) sources += ' ' + allowed(script);
  if (scripts.empty()) sources = " 'none'";
  return fmt::format("default-src 'none'; script-src{}; style-src {}; base-uri 'none'; form-action 'none'", sources, allowed(style));
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
