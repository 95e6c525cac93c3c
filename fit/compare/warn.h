// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "fit/results/warning.h"

namespace swarmfit {

inline constexpr double kStandardErrors = 2;  // by which two numbers must differ to be worth a word

template <class... Args>
void warn(std::vector<Warning>& out, Gravity gravity, fmt::format_string<Args...> text, Args&&... args) {
  out.emplace_back(gravity, fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace swarmfit
