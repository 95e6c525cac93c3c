// SPDX-License-Identifier: MIT
#include "libswarm/scenario/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

Node node_of(const toml::node& from) {
  Node node;
  node.line = static_cast<long>(from.source().begin.line);
  node.column = static_cast<long>(from.source().begin.column);
  if (const auto* table = from.as_table()) {
    std::vector<std::pair<std::string, Node>> found;
    for (const auto& [key, value] : *table) found.emplace_back(std::string(key.str()), node_of(value));
    // toml++ sorts by key.
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return std::pair(a.second.line, a.second.column) < std::pair(b.second.line, b.second.column);
    });
    Node::Entries entries;
    for (auto& [key, value] : found) entries.keys.push_back(std::move(key)), entries.values.push_back(std::move(value));
    node.value = std::move(entries);
  } else if (const auto* array = from.as_array()) {
    Node::Array items;
    for (const toml::node& item : *array) items.push_back(node_of(item));
    node.value = std::move(items);
  } else if (const auto* text = from.as_string()) {
    node.value = text->get();
  } else if (const auto* integer = from.as_integer()) {
    node.value = integer->get();
  } else if (const auto* real = from.as_floating_point()) {
    node.value = real->get();
  } else if (const auto* flag = from.as_boolean()) {
    node.value = flag->get();
  }
  return node;
}

}  // namespace

Node parse_toml(const std::string& path, const std::string& text) {
  try {
    return node_of(toml::parse(text, path));
  } catch (const toml::parse_error& e) {
    const auto place = e.source().begin;
    throw InputError(at(path, place.line, place.column, fmt::format("{}; expected TOML", e.description())));
  }
}

}  // namespace swarmfit
