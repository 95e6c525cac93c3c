// SPDX-License-Identifier: MIT
#include "libswarm/scenario/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

const Node::Entries& entries_of(const Node& node) { return std::get<Node::Entries>(node.value); }

}  // namespace

std::optional<double> number_of(const Node& node) {
  if (const auto* whole = std::get_if<std::int64_t>(&node.value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&node.value); real && std::isfinite(*real)) return *real;
  return std::nullopt;
}

Table::Table(const std::string& path, const Node& table, std::string heading) : path_(&path), node_(&table), heading_(std::move(heading)) {}

const Node* Table::find(std::string_view key) const {
  const Node::Entries& entries = entries_of(*node_);
  for (std::size_t k = 0; k < entries.keys.size(); ++k)
    if (entries.keys[k] == key) return &entries.values[k];
  return nullptr;
}

const Node* Table::ask(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
  return find(key);
}

const Node& Table::need(std::string_view key) {
  const Node* node = ask(key);
  if (!node) refuse(fmt::format("{}no {}; expected {} = ...", heading_.empty() ? "" : heading_ + " has ", key, key));
  return *node;
}

std::string Table::called(std::string_view key) const { return heading_.empty() ? std::string(key) : fmt::format("{} {}", heading_, key); }

std::string Table::place() const { return at(*path_, node_->line, node_->column, ""); }

std::string Table::beside(const std::string& file) const {
  return file.starts_with('/') ? file : path_->substr(0, path_->find_last_of('/') + 1) + file;
}

std::string Table::place_of(std::string_view key) const {
  const Node* node = find(key);
  return node ? at(*path_, node->line, node->column, "") : place();
}

void Table::refuse(std::string_view key, const std::string& what) const { throw InputError(place_of(key) + called(key) + " " + what); }
void Table::refuse(const std::string& what) const { throw InputError(place() + what); }

bool Table::has(std::string_view key) { return ask(key) != nullptr; }

std::string Table::text(std::string_view key, std::optional<std::string> otherwise) {
  if (!ask(key) && otherwise) return *otherwise;
  const auto* text = std::get_if<std::string>(&need(key).value);
  if (!text) refuse(key, "is not text; expected text in quotes");
  return *text;
}

const ScenarioKey& Table::known(std::string_view key) const {
  const ScenarioKey* found = find_scenario_key(heading_, key);
  assert(found);
  return *found;
}

std::string Table::choice(std::string_view key, std::optional<std::string> otherwise) {
  return choice(key, known(key).words, std::move(otherwise));
}

std::string Table::choice(std::string_view key, std::span<const std::string_view> allowed, std::optional<std::string> otherwise) {
  std::string word = text(key, std::move(otherwise));
  if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
    refuse(key, fmt::format("= '{}' is not allowed; expected one of {}", word, fmt::join(allowed, ", ")));
  return word;
}

double Table::number(std::string_view key, std::optional<double> otherwise) { return number(key, otherwise, known(key).range); }

double Table::number(std::string_view key, std::optional<double> otherwise, NumberRange allowed) {
  if (!ask(key) && otherwise) return *otherwise;
  const auto value = number_of(need(key));
  if (!value || *value < allowed.lower || *value > allowed.upper)
    refuse(key, fmt::format("{} is not allowed; expected a number from {:g} to {:g}", value ? fmt::format("= {:g}", *value) : "",
                            allowed.lower, allowed.upper));
  return *value;
}

std::int64_t Table::whole(std::string_view key, std::optional<std::int64_t> otherwise) {
  if (!ask(key) && otherwise) return *otherwise;
  const auto* value = std::get_if<std::int64_t>(&need(key).value);
  const NumberRange range = known(key).range;
  // The upper end as a double may lie beyond the greatest whole number, and then nothing does.
  if (!value || static_cast<double>(*value) < range.lower || static_cast<double>(*value) > range.upper)
    refuse(key, fmt::format("{}is not allowed; expected a whole number from {:.0f} to {:.0f}", value ? fmt::format("= {} ", *value) : "",
                            range.lower, range.upper));
  return *value;
}

std::vector<double> Table::numbers_of(std::string_view key, const Node& node) const {
  std::vector<double> values;
  const auto add = [&](const Node& item) {
    const auto value = number_of(item);
    if (!value) refuse(key, "holds what is not a finite number; expected numbers");
    values.push_back(*value);
  };
  if (const auto* items = std::get_if<Node::Array>(&node.value))
    for (const Node& item : *items) add(item);
  else
    add(node);
  return values;
}

Eigen::Array3d Table::place(std::string_view key, std::optional<Eigen::Array3d> otherwise, int dims) {
  if (!ask(key) && otherwise) return *otherwise;
  const Node& node = need(key);
  const auto values = std::holds_alternative<Node::Array>(node.value) ? numbers_of(key, node) : std::vector<double>{};
  if (values.size() != static_cast<std::size_t>(dims))
    refuse(key, fmt::format("is not allowed; expected {}", dims == 3 ? "[x, y, z]" : "[x, y]"));
  Eigen::Array3d place = Eigen::Array3d::Zero();
  for (std::size_t k = 0; k < values.size(); ++k) place[static_cast<Eigen::Index>(k)] = values[k];
  return place;
}

std::vector<double> Table::numbers(std::string_view key) {
  const Node* node = ask(key);
  return node ? numbers_of(key, *node) : std::vector<double>{};
}

std::vector<std::vector<double>> Table::rows(std::string_view key, std::size_t columns) {
  const auto wrong = [&] { refuse(key, fmt::format("is not allowed; expected rows of {} numbers, [[...], [...]]", columns)); };
  std::vector<std::vector<double>> rows;
  const auto* items = std::get_if<Node::Array>(&need(key).value);
  if (!items || items->empty()) wrong();
  for (const Node& item : *items) {
    if (!std::holds_alternative<Node::Array>(item.value)) wrong();
    rows.push_back(numbers_of(key, item));
    if (rows.back().size() != columns) wrong();
    if (rows.size() > 1 && !(rows[rows.size() - 2].front() < rows.back().front()))
      refuse(key, fmt::format("goes from {:g} to {:g} s; expected times in ascending order", rows[rows.size() - 2].front(),
                              rows.back().front()));
  }
  return rows;
}

std::optional<Table> Table::table(std::string_view key) {
  const Node* node = ask(key);
  if (!node) return std::nullopt;
  if (!std::holds_alternative<Node::Entries>(node->value)) refuse(key, fmt::format("is not a table; expected [{}]", key));
  std::string outer = heading_;
  std::erase_if(outer, [](char c) { return c == '[' || c == ']'; });
  return Table(*path_, *node, fmt::format("[{}{}{}]", outer, outer.empty() ? "" : ".", key));
}

std::vector<Table> Table::tables(std::string_view key) {
  std::vector<Table> all;
  const Node* node = ask(key);
  if (!node) return all;
  const auto* items = std::get_if<Node::Array>(&node->value);
  if (!items) refuse(key, fmt::format("is not an array of tables; expected [[{}]]", key));
  for (const Node& item : *items) {
    if (!std::holds_alternative<Node::Entries>(item.value)) refuse(key, fmt::format("is not an array of tables; expected [[{}]]", key));
    all.emplace_back(*path_, item, fmt::format("[[{}]]", key));
  }
  return all;
}

std::vector<std::string> Table::keys() const { return entries_of(*node_).keys; }

void Table::finish() const {
  for (const auto& key : keys())
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
      throw InputError(fmt::format("{}'{}' is not known{}; expected one of {}", place_of(key), key,
                                   heading_.empty() ? "" : " in " + heading_, fmt::join(asked_, ", ")));
}

}  // namespace swarmfit
