// SPDX-License-Identifier: MIT
// A setting is one entry of a table: flag, key in config.toml, help, default, check and meaning. Parser, help, config.toml, protocols and
// error lines follow from it; nothing else knows the name.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/allowed.h"
#include "cli/arguments.h"

namespace swarmfit::cli {

// Commands as bits, so that a setting can say in which of them it appears.
using Commands = unsigned;
inline constexpr Commands kDescribe = 1U << 0U, kConvert = 1U << 1U, kSimulate = 1U << 2U, kEvaluate = 1U << 3U, kWeigh = 1U << 4U,
                          kFit = 1U << 5U, kCompare = 1U << 6U, kResume = 1U << 7U, kReport = 1U << 8U, kRecover = 1U << 9U,
                          kPower = 1U << 10U, kModels = 1U << 11U, kGallery = 1U << 12U, kFormats = 1U << 13U, kMerge = 1U << 14U,
                          kScenarios = 1U << 15U, kMeasure = 1U << 16U, kSweep = 1U << 17U, kExtend = 1U << 18U, kAugment = 1U << 19U;
inline constexpr Commands kFits = kFit | kCompare | kPower;                    // what works on a recording
inline constexpr Commands kComparisons = kFits | kRecover;                     // what a protocol governs
inline constexpr Commands kMeasurements = kMeasure | kSweep;                   // runs without a comparison
inline constexpr Commands kStudies = kRecover | kPower;                        // many comparisons
inline constexpr Commands kShared = kComparisons | kResume | kMerge | kSweep;  // what several processes do together
inline constexpr Commands kSyntheses = kExtend | kAugment;                     // what adds simulated points to a recording
inline constexpr Commands kAll = (kAugment << 1U) - 1;
inline constexpr Commands kManual = 1U << 30U, kCompletion = 1U << 31U;  // about the program itself, with no setting in common with kAll

// What was given for the settings of a command, by name and already checked, and what holds where nothing was.
class Values {
 public:
  bool has(std::string_view name) const { return words_.contains(name); }
  const std::vector<std::string>& words(std::string_view name) const;  // none if there is nothing
  std::string text(std::string_view name) const;                       // the first of them, or nothing
  double number(std::string_view name, double otherwise) const;
  void set(std::string_view name, std::vector<std::string> words) { words_[std::string(name)] = std::move(words); }

 private:
  std::map<std::string, std::vector<std::string>, std::less<>> words_;
};

// What was given for one setting, for its meaning to take.
struct Value {
  const std::vector<std::string>& words;
  const Values& all;  // of the other settings, for those whose meanings hang together

  const std::string& text() const { return words.front(); }
  bool on() const { return text() == "true"; }
  double number() const;
  template <class Integer>
  Integer whole() const {
    return static_cast<Integer>(natural());
  }

 private:
  std::uint64_t natural() const;  // of a negative number its two's complement
};

struct Setting {
  std::string_view name{};  // of the flag, without dashes, and in config.toml; in capitals: given by its place
  Commands in = 0;          // the commands that have it
  std::string_view help{};
  Allowed allowed{};           // what may be given
  std::string_view initial{};  // what holds if nothing is; empty: nothing does
  std::string_view ren2016{};  // the same under that protocol, if the protocol governs this setting
  std::string_view group{};    // heading in help; empty: the first one
  char letter = 0;             // short flag
  bool required = false;
  bool travels = true;  // part of config.toml: the result depends on it
  struct {
    Commands in = 0;
    std::string_view initial{};
  } elsewhere{};                                    // commands with another default
  std::string (*follows)(const Values&) = nullptr;  // what holds if nothing is given and other settings decide
  // What it means. Called in the order of the table with what was given or holds; InputError without a place gets the flag in front.
  void (*use)(Arguments&, const Value&) = nullptr;
};

// All of them. Their order is that of help and of config.toml.
std::span<const Setting> settings();

struct Command {
  std::string_view name{};
  Commands bit = 0;
  std::string_view help{};
  int (*run)(const Arguments&) = nullptr;
};
std::span<const Command> commands();

bool is_positional(const Setting& setting);
std::string flag_of(const Setting& setting);  // "--scoring", or "DATA"
const Setting* find_setting(std::string_view name, Commands command);
std::string_view initial_of(const Setting& setting, Commands command);  // under the default protocol; empty: nothing
bool governed(const Setting& setting, Commands command);                // by a protocol

// Checks what was given for a setting. Throws InputError that begins with the flag.
std::vector<std::string> checked(const Setting& setting, std::vector<std::string> words);

// What the command is to do, from what was given. Throws InputError.
Arguments understood(const Command& command, const Values& given);

}  // namespace swarmfit::cli
