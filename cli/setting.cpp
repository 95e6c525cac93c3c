// SPDX-License-Identifier: MIT
#include "cli/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "cli/config_file.h"
#include "cli/tables.h"
#include "libtrack/error.h"
#include "libtrack/read/join.h"

namespace swarmfit::cli {
namespace {

constexpr std::string_view kLiteral = "ren2016";

template <class Number>
Number parsed(const std::string& word) {
  Number value{};
  std::from_chars(word.data(), word.data() + word.size(), value);  // it was checked
  return value;
}

// A setting that a protocol governs holds in all comparisons, also in those that do not offer it.
bool holds_in(const Setting& s, Commands command) {
  return (s.in & command) != 0 || (!s.ren2016.empty() && (command & kComparisons) != 0 && find_setting(s.name, command) == nullptr);
}

void fill_defaults(Values& values, Commands command) {
  for (const Setting& s : settings())
    if ((s.in & command) != 0 && !governed(s, command) && !values.has(s.name) && !initial_of(s, command).empty())
      values.set(s.name, {std::string(initial_of(s, command))});
}

void fill_protocol(Values& values, Commands command) {
  const bool literal = values.text("protocol") == kLiteral;
  for (const Setting& s : settings())
    if (holds_in(s, command) && governed(s, command) && !s.follows && !values.has(s.name))
      values.set(s.name, {std::string(literal ? s.ren2016 : s.initial)});
  for (const Setting& s : settings())
    if (holds_in(s, command) && s.follows && !values.has(s.name)) values.set(s.name, {s.follows(values)});
}

void use(const Setting& s, Arguments& a, const Values& values) {
  if (!s.use || !values.has(s.name)) return;
  try {
    s.use(a, {values.words(s.name), values});
  } catch (const InputError& e) {
    const std::string_view what = e.what();
    if (what.find(fmt::format("`{}`", s.name)) != what.npos) throw;
    throw InputError(fmt::format("{}: {}", flag_of(s), what));
  }
}

std::vector<std::string> names_of(const std::vector<ModelChoice>& models) {
  std::vector<std::string> names;
  for (const auto& model : models) names.push_back(model.name);
  return names;
}

}  // namespace

const std::vector<std::string>& Values::words(std::string_view name) const {
  static const std::vector<std::string> kNone;
  const auto found = words_.find(name);
  return found == words_.end() ? kNone : found->second;
}

std::string Values::text(std::string_view name) const {
  const auto& all = words(name);
  return all.empty() ? "" : all.front();
}

double Values::number(std::string_view name, double otherwise) const { return has(name) ? parsed<double>(text(name)) : otherwise; }

double Value::number() const { return parsed<double>(text()); }

std::uint64_t Value::natural() const {
  return text().starts_with('-') ? static_cast<std::uint64_t>(parsed<std::int64_t>(text())) : parsed<std::uint64_t>(text());
}

std::span<const Setting> settings() {
  static const std::vector<Setting> kAllSettings = [] {
    std::vector<Setting> all;
    for (const auto& part : {data_settings(), run_settings(), scene_settings(), synthesis_settings(), measure_settings(),
                             comparison_settings(), output_settings()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return kAllSettings;
}

bool is_positional(const Setting& setting) { return std::isupper(static_cast<unsigned char>(setting.name.front())) != 0; }

std::string flag_of(const Setting& setting) { return (is_positional(setting) ? "" : "--") + std::string(setting.name); }

const Setting* find_setting(std::string_view name, Commands command) {
  const auto all = settings();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Setting& s) { return s.name == name && (s.in & command) != 0; });
  return found == all.end() ? nullptr : &*found;
}

std::string_view initial_of(const Setting& s, Commands command) {
  return (s.elsewhere.in & command) != 0 ? s.elsewhere.initial : s.initial;
}

bool governed(const Setting& s, Commands command) { return (command & kComparisons) != 0 && (!s.ren2016.empty() || s.follows); }

std::vector<std::string> checked(const Setting& setting, std::vector<std::string> words) {
  if (setting.allowed.split) {
    std::vector<std::string> parts;
    for (const auto& word : words)
      for (auto& part : split_outside_brackets(word)) parts.push_back(std::move(part));
    words = std::move(parts);
  }
  try {
    if (!setting.allowed.many && words.size() != 1) throw InputError(fmt::format("{} values; expected one", words.size()));
    for (auto& word : words) {
      if (setting.required && setting.allowed.kind == Allowed::Kind::text && word.empty())
        throw InputError("'' is not allowed; expected a name");  // a shell's variable that is not set
      word = checked(setting.allowed, word);
    }
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", flag_of(setting), e.what()));
  }
  return words;
}

namespace {

// A shell makes many words of goats/*.csv.
void gather_files(Arguments& a, bool several) {
  if (a.recordings.size() < 2) return;
  if (a.read.join) {
    a.read.joined = std::move(a.recordings);
    a.recordings = {common_pattern(a.read.joined)};
  } else if (!several) {
    throw InputError(fmt::format("{}: {} files; expected one, or --join to read them as one recording", a.command, a.recordings.size()));
  }
}

}  // namespace

Arguments understood(const Command& command, const Values& given) {
  Arguments a;
  a.command = command.name;
  Values written = given;
  fill_defaults(written, command.bit);
  Values values = written;
  if ((command.bit & kComparisons) != 0) fill_protocol(values, command.bit);
  for (const Setting& s : settings())
    if (holds_in(s, command.bit)) use(s, a, values);
  gather_files(a, (command.bit & kFits) != 0);
  if ((command.bit & kMeasurements) != 0) a.config = config_of(command.bit, written);
  if ((command.bit & kComparisons) == 0) return a;
  // What recover compares with stays as it was given: every recording that it makes is another one.
  if (command.bit != kRecover) written = values;
  if (command.bit == kRecover && a.recovery.planted.empty()) a.recovery.planted = a.compare.models;
  if (command.bit == kRecover) written.set("plant", names_of(a.recovery.planted));
  written.set("model", names_of(a.compare.models));
  a.config = config_of(command.bit, written);
  return a;
}

}  // namespace swarmfit::cli
