// SPDX-License-Identifier: MIT
// Things that are made of lists of numbers, summarised value by value.
#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace swarmfit {

// `summary` of the k-th values that are finite, for every k of the longest list.
template <class Summary>
std::vector<double> value_by_value(const std::vector<const std::vector<double>*>& lists, const Summary& summary) {
  std::size_t size = 0;
  for (const auto* list : lists) size = std::max(size, list->size());
  std::vector<double> out, values;
  for (std::size_t k = 0; k < size; ++k) {
    values.clear();
    for (const auto* list : lists)
      if (k < list->size() && std::isfinite((*list)[k])) values.push_back((*list)[k]);
    out.push_back(summary(values));
  }
  return out;
}

// The same for structs whose lists a function `fields` ties.
template <class T, class Summary>
T summarised(std::vector<T> all, const Summary& summary) {
  T out;
  auto lists_of = fields(out);
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    const auto each = [&](auto number) {
      std::vector<const std::vector<double>*> lists;
      for (T& one : all) lists.push_back(&std::get<number>(fields(one)));
      std::get<number>(lists_of) = value_by_value(lists, summary);
    };
    (each(std::integral_constant<std::size_t, k>()), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<decltype(lists_of)>>());
  return out;
}

double mean_of(const std::vector<double>& values);  // NaN without any
double sd_of(const std::vector<double>& values);    // NaN with fewer than two

}  // namespace swarmfit
