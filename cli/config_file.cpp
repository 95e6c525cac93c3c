// SPDX-License-Identifier: MIT
#include "cli/config_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include "libtrack/error.h"

namespace swarmfit::cli {
namespace {

toml::table parse(const std::string& path, const std::string& text) {
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& e) {
    const auto place = e.source().begin;
    throw InputError(at(path, place.line, place.column, fmt::format("{}; expected TOML", e.description())));
  }
}

[[noreturn]] void refuse(const std::string& path, const toml::node& node, const std::string& what) {
  const auto place = node.source().begin;
  throw InputError(at(path, place.line, place.column, what));
}

// A value as the command line would have it.
std::optional<std::string> word_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* real = node.as_floating_point()) return fmt::format("{}", real->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  return std::nullopt;
}

std::vector<std::string> words_of(const std::string& path, const toml::node& node, std::string_view name) {
  std::vector<std::string> words;
  const auto add = [&](const toml::node& one) {
    const auto word = word_of(one);
    if (!word) refuse(path, node, fmt::format("{} is neither text nor number; expected a value or an array of them", name));
    words.push_back(*word);
  };
  if (const auto* array = node.as_array())
    for (const toml::node& one : *array) add(one);
  else
    add(node);
  return words;
}

std::string joined_names(Commands command) {
  std::vector<std::string_view> names;
  for (const Setting& s : settings())
    if ((s.in & command) != 0) names.push_back(s.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string toml_value(const Setting& s, const std::vector<std::string>& words) {
  if (s.allowed.many) return toml_array(words);
  const std::string& word = words.front();
  switch (s.allowed.kind) {
    case Allowed::Kind::flag:
    case Allowed::Kind::number:
    case Allowed::Kind::time:
      return word;
    case Allowed::Kind::whole: {  // TOML's integers have 63 bits
      const bool fits = word.size() < 19 || (word.size() == 19 && word <= std::to_string(std::numeric_limits<std::int64_t>::max()));
      return fits ? word : toml_string(word);
    }
    case Allowed::Kind::text:
    case Allowed::Kind::choice:
      break;
  }
  return toml_string(word);
}

}  // namespace

std::string toml_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + '"';
}

std::string toml_array(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const auto& text : texts) parts.push_back(toml_string(text));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

Settings config_of(Commands command, const Values& values) {
  Settings out;
  for (const Setting& s : settings()) {
    if ((s.in & command) == 0 || !s.travels || !values.has(s.name)) continue;
    const auto& words = values.words(s.name);
    if (s.allowed.kind == Allowed::Kind::flag && words.front() != "true") continue;
    std::string text = toml_value(s, words);
    try {
      static_cast<void>(toml::parse("x = " + text));
    } catch (const toml::parse_error&) {
      throw InputError(fmt::format("{}: {} is not UTF-8; expected text that config.toml can hold", flag_of(s), shown(text)));
    }
    out.emplace_back(s.name, std::move(text));
  }
  return out;
}

Settings with(Settings config, std::string_view name, const std::string& toml) {
  for (auto& [key, value] : config)
    if (key == name) value = toml;
  return config;
}

Values read_config(const std::string& path, const std::string& text, const Command& command) {
  const toml::table all = parse(path, text);
  for (const auto& [heading, node] : all) {
    const std::string name(heading.str());
    const bool known = std::any_of(commands().begin(), commands().end(), [&name](const Command& c) { return c.name == name; });
    if (!known || !node.is_table())
      refuse(path, node, fmt::format("'{}' is not a command; expected settings under [{}]", shown(name), command.name));
  }
  const toml::table* mine = all[command.name].as_table();
  if (!mine) throw InputError(fmt::format("{}: says nothing of {}; expected settings under [{}]", path, command.name, command.name));
  Values values;
  for (const auto& [key, node] : *mine) {
    if (!find_setting(key.str(), command.bit))
      refuse(path, node,
             fmt::format("'{}' is not a setting of {}; expected one of {}", shown(key.str()), command.name, joined_names(command.bit)));
    values.set(key.str(), words_of(path, node, key.str()));
  }
  return values;
}

bool same_config(const std::string& one, const std::string& other) {
  try {
    return toml::parse(one) == toml::parse(other);
  } catch (const toml::parse_error&) {
    return false;
  }
}

}  // namespace swarmfit::cli
