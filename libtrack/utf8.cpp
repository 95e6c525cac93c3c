// SPDX-License-Identifier: MIT
#include "libtrack/utf8.h"

#include <fmt/format.h>

#include <algorithm>

namespace swarmfit {
namespace {

constexpr char32_t kUnknown = 0xFFFD, kHighest = 0x10FFFF;

bool surrogate(char32_t c) { return c >= 0xD800 && c <= 0xDFFF; }

// Length of the character at the front of `text`, 0 when that is no UTF-8 (The Unicode Standard, table 3-7).
std::size_t take(std::string_view text, char32_t& out) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
  if (length == 0 || text.size() < length) return 0;
  out = length == 1 ? first : first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return 0;
    out = out << 6U | (byte(i) & 0x3FU);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  return out < least[length] || out > kHighest || surrogate(out) ? 0 : length;
}

}  // namespace

std::u32string to_utf32(std::string_view utf8) {
  std::u32string out;
  while (!utf8.empty()) {
    char32_t c = 0;
    const auto length = take(utf8, c);
    out += length == 0 ? kUnknown : c;
    utf8.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string to_utf8(std::u32string_view text) {
  std::string out;
  const auto add = [&](char32_t bits) { out += static_cast<char>(bits); };
  for (char32_t c : text) {
    if (c > kHighest || surrogate(c)) c = kUnknown;
    if (c < 0x80) {
      add(c);
    } else if (c < 0x800) {
      add(0xC0 | c >> 6U), add(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
      add(0xE0 | c >> 12U), add(0x80 | (c >> 6U & 0x3F)), add(0x80 | (c & 0x3F));
    } else {
      add(0xF0 | c >> 18U), add(0x80 | (c >> 12U & 0x3F)), add(0x80 | (c >> 6U & 0x3F)), add(0x80 | (c & 0x3F));
    }
  }
  return out;
}

std::string plain_name(std::string_view name) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!name.empty() && blank(name.front())) name.remove_prefix(1);
  while (!name.empty() && blank(name.back())) name.remove_suffix(1);
  std::string out;
  while (!name.empty()) {
    char32_t c = 0;
    const auto length = take(name, c);
    if (length == 0 || c < 0x20 || c == 0x7F)
      out += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(name[0])));
    else
      out += name.substr(0, length);
    name.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

}  // namespace swarmfit
