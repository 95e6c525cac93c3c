// SPDX-License-Identifier: MIT
#include "libtrack/read/xml_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

std::string at_offset(const std::string& name, std::string_view bytes, std::ptrdiff_t offset) {
  if (offset < 0) return name;
  const auto before = bytes.substr(0, static_cast<std::size_t>(offset));
  return fmt::format("{}:{}", name, 1 + std::count(before.begin(), before.end(), '\n'));
}

}  // namespace

std::string_view xml_root(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  for (;;) {
    const auto open = bytes.find_first_not_of(" \t\r\n");
    if (open == std::string_view::npos || bytes[open] != '<') return {};
    bytes.remove_prefix(open + 1);
    if (bytes.starts_with('?') || bytes.starts_with('!')) {  // declarations and comments before the root
      const std::string_view end = bytes.starts_with("!--") ? "-->" : ">";
      const auto close = bytes.find(end);
      if (close == std::string_view::npos) return {};
      bytes.remove_prefix(close + end.size());
      continue;
    }
    return bytes.substr(0, bytes.find_first_of(" \t\r\n/>"));
  }
}

std::shared_ptr<const pugi::xml_document> parse_xml(const std::string& name, std::string_view bytes) {
  auto document = std::make_shared<pugi::xml_document>();
  const auto result = document->load_buffer(bytes.data(), bytes.size());
  if (!result)
    throw InputError(fmt::format("{}: this is not well-formed XML ({}); expected an undamaged file", at_offset(name, bytes, result.offset),
                                 result.description()));
  return document;
}

std::string xml_place(const std::string& name, std::string_view bytes, const pugi::xml_node& node) {
  return at_offset(name, bytes, node.offset_debug());
}

std::optional<double> xml_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  return whole ? std::optional(value) : std::nullopt;
}

}  // namespace swarmfit
