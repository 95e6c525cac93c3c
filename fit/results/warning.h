// SPDX-License-Identifier: MIT
// A sentence that a reader must see before believing a ranking, and how much it weighs.
#pragma once

#include <string>
#include <utility>

namespace swarmfit {

enum class Gravity {
  claim,    // a conclusion that the ranking seems to invite does not hold
  result,   // the ranking or the best model may be wrong
  meaning,  // the ranking stands, but says less than it seems to
  note,     // good to know
};

struct Warning {
  Gravity gravity = Gravity::meaning;
  std::string text;
  Warning(std::string sentence) : text(std::move(sentence)) {}  // NOLINT(google-explicit-constructor)
  Warning(const char* sentence) : text(sentence) {}             // NOLINT(google-explicit-constructor)
  Warning(Gravity weight, std::string sentence) : gravity(weight), text(std::move(sentence)) {}
  operator const std::string&() const { return text; }  // NOLINT(google-explicit-constructor)
  friend bool operator==(const Warning& a, const std::string& b) { return a.text == b; }
  friend bool operator==(const Warning& a, const char* b) { return a.text == b; }
};

}  // namespace swarmfit
