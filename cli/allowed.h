// SPDX-License-Identifier: MIT
// What may be given for a setting, checked in one place and refused in one wording.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace swarmfit::cli {

struct Allowed {
  enum class Kind { flag, text, choice, whole, number, time };

  Kind kind = Kind::text;
  bool many = false;                        // a list of such
  bool split = false;                       // whose words may also be given with commas between
  std::vector<std::string_view> choices{};  // of a choice
  double lower = 0, upper = 0;              // of numbers, both included unless `open`
  bool open = false;                        // the lower end is not allowed itself
};

inline Allowed on_or_off() { return {.kind = Allowed::Kind::flag}; }
inline Allowed text() { return {}; }
inline Allowed texts() { return {.many = true}; }
inline Allowed split_texts() { return {.many = true, .split = true}; }
inline Allowed one_of(std::vector<std::string_view> choices) { return {.kind = Allowed::Kind::choice, .choices = std::move(choices)}; }
inline Allowed some_of(std::vector<std::string_view> choices) {
  return {.kind = Allowed::Kind::choice, .many = true, .split = true, .choices = std::move(choices)};
}
inline Allowed whole(double lower, double upper) { return {.kind = Allowed::Kind::whole, .lower = lower, .upper = upper}; }
inline Allowed number(double lower, double upper) { return {.kind = Allowed::Kind::number, .lower = lower, .upper = upper}; }
inline Allowed above(double lower, double upper) { return {.kind = Allowed::Kind::number, .lower = lower, .upper = upper, .open = true}; }
inline Allowed time_up_to(double seconds) { return {.kind = Allowed::Kind::time, .upper = seconds, .open = true}; }

// At the commas outside brackets: models carry settings in brackets.
std::vector<std::string> split_outside_brackets(std::string_view text);

// The word as it is kept: numbers in their shortest form, times in seconds. Throws InputError "'word' is ...; expected ...".
std::string checked(const Allowed& allowed, const std::string& word);

std::string expected(const Allowed& allowed);  // "a whole number from 0 to 1024"
std::string label(const Allowed& allowed);     // what help shows of it: "INT in [0 - 1024]"; empty for a flag

// A word of the user's as one short line: control characters escaped, the end of a long one left out.
std::string shown(std::string_view word);

}  // namespace swarmfit::cli
