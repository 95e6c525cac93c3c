// SPDX-License-Identifier: MIT
#include "libtrack/read/missing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "libtrack/error.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr std::array kUsual = {-1.0, 0.0, -999.0, -9999.0, -99.0};

// A code is several times the very same position; an animal is hardly ever there twice to the last digit.
constexpr std::size_t kSuspicious = 3;

}  // namespace

void leave_out_codes(RawTable& table, const ReadOptions& options) {
  auto& x = table[FileColumn::x];
  auto& y = table[FileColumn::y];
  if (options.missing) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i] != *options.missing || y[i] != *options.missing) continue;
      x[i] = kNaN;
      ++count;
    }
    if (count == 0)
      throw InputError(fmt::format("`missing` {0:g}: {1} has no position ({0:g}, {0:g}); expected the value that stands for not seen",
                                   *options.missing, table.file));
    table.notes.push_back(fmt::format("{0} rows at ({1:g}, {1:g}) were not seen (--missing)", count, *options.missing));
    return;
  }
  for (const double code : kUsual) {
    std::size_t count = 0, first = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i] == code && y[i] == code && count++ == 0) first = i;
    if (count >= kSuspicious)
      table.notes.push_back(
          fmt::format("{0} rows are exactly at ({1:g}, {1:g}) (first at {2}): if that stands for not seen, add --missing {1:g}", count,
                      code, table.place(first)));
  }
}

}  // namespace swarmfit
