// SPDX-License-Identifier: MIT
#include "cli/scenario_schema.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "libswarm/scenario/keys.h"

namespace swarmfit::cli {
namespace {

using Json = nlohmann::ordered_json;
using Type = ScenarioKey::Type;

const Json kNumber = {{"type", "number"}};
const Json kRows = {
    {"type", "array"}, {"minItems", 1}, {"items", {{"type", "array"}, {"items", kNumber}, {"minItems", 2}, {"maxItems", 4}}}};

Json object_of(std::string_view table);

void bound(Json& value, const NumberRange& range) {
  constexpr double kExact = 9007199254740992;  // whole numbers beyond are not
  if (std::isfinite(range.lower)) value["minimum"] = range.lower;
  if (std::isfinite(range.upper) && range.upper < kExact) value["maximum"] = range.upper;
}

// Of the names that a file may invent.
Json by_name(std::string_view table) {
  if (table == "parameters") return {{"type", "object"}, {"additionalProperties", kNumber}};
  if (table == "schedule") return {{"type", "object"}, {"additionalProperties", kRows}};
  Json one = object_of(table);  // measures have arguments of their own
  one["additionalProperties"] = {{"anyOf", {kNumber, {{"type", "array"}, {"items", kNumber}}}}};
  return {{"type", "object"}, {"additionalProperties", one}};
}

Json type_of(const ScenarioKey& key) {
  switch (key.type) {
    case Type::text:
      return {{"type", "string"}};
    case Type::choice: {
      Json words = Json::array();
      for (const auto word : key.words) words.push_back(word);
      return {{"enum", words}};
    }
    case Type::number:
    case Type::whole: {
      Json value = {{"type", key.type == Type::number ? "number" : "integer"}};
      bound(value, key.range);
      return value;
    }
    case Type::place:
      return {{"type", "array"}, {"items", kNumber}, {"minItems", 2}, {"maxItems", 3}};
    case Type::rows:
      return kRows;
    case Type::table:
      return object_of(key.name);
    case Type::tables:
      return {{"type", "array"}, {"items", object_of(key.name)}};
    case Type::by_name:
      break;
  }
  return by_name(key.name);
}

Json object_of(std::string_view table) {
  Json properties = Json::object(), required = Json::array();
  for (const ScenarioKey& key : scenario_keys()) {
    if (key.of != table) continue;
    Json value = type_of(key);
    if (!key.meaning.empty()) value["description"] = key.meaning;
    properties[std::string(key.name)] = std::move(value);
    if (key.required) required.push_back(key.name);
  }
  Json object = {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) object["required"] = std::move(required);
  return object;
}

}  // namespace

std::string scenario_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "A scenario of swarmfit"}};
  schema.update(object_of(""));
  return schema.dump(2) + "\n";
}

}  // namespace swarmfit::cli
