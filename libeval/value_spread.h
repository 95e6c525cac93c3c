// SPDX-License-Identifier: MIT
// Mean and standard deviation, value by value, of things that are made of lists of numbers.
#pragma once

#include <tuple>
#include <utility>
#include <vector>

namespace swarmfit {

// Over those that are finite; NaN where fewer than one or two are. As long as the longest list.
std::pair<std::vector<double>, std::vector<double>> mean_and_sd(const std::vector<const std::vector<double>*>& lists);

// The same for structs whose lists a function `fields` ties.
template <class T>
std::pair<T, T> value_spread(std::vector<T> all) {
  std::pair<T, T> out;
  auto means = fields(out.first), sds = fields(out.second);
  const auto each = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) {
    std::vector<const std::vector<double>*> lists;
    for (T& one : all) lists.push_back(&std::get<k>(fields(one)));
    std::tie(std::get<k>(means), std::get<k>(sds)) = mean_and_sd(lists);
  };
  [&]<std::size_t... k>(std::index_sequence<k...>) { (each(std::integral_constant<std::size_t, k>()), ...); }
  (std::make_index_sequence<std::tuple_size_v<decltype(means)>>());
  return out;
}

}  // namespace swarmfit
