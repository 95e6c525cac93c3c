// SPDX-License-Identifier: MIT
#include "libtrack/read/own_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

class OwnTable {
 public:
  OwnTable(const std::string& file, OwnParts parts) : parts_(std::move(parts)) { table_.file = file; }

  RawTable read() {
    if (text("swarmfit") != "tracks/1")
      fail(fmt::format("the layout is '{}'; expected tracks/1, as swarmfit convert writes it", text("swarmfit").substr(0, 40)));
    table_.unit = text("unit");
    table_.dt = number("dt");
    table_.t0 = number("t0");
    table_.synthetic = number("synthetic") != 0;
    table_.notes = parts_.texts["notes"];
    table_.kinds = parts_.texts["kinds"];
    for (const double start : parts_.numbers["episodes"]) {
      if (!(std::abs(start) < 9e15)) fail("an episode begins nowhere; expected frame numbers");
      table_.episodes.push_back(static_cast<std::int64_t>(start));
    }
    take_columns();
    take_tracks();
    check_numbers(table_);
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(fmt::format("{}: {}", table_.file, what)); }

  std::string text(const std::string& name) {
    const auto& texts = parts_.texts[name];
    return texts.empty() ? "" : texts[0];
  }
  double number(const std::string& name) {
    const auto& numbers = parts_.numbers[name];
    return numbers.empty() ? 0 : numbers[0];
  }

  void take_columns() {
    struct Column {
      const char* name;
      FileColumn as;
    };
    constexpr std::array columns = {Column{"frame", FileColumn::frame}, Column{"x", FileColumn::x},      Column{"y", FileColumn::y},
                                    Column{"z", FileColumn::z},         Column{"vx", FileColumn::vx},    Column{"vy", FileColumn::vy},
                                    Column{"vz", FileColumn::vz},       Column{"ax", FileColumn::ax},    Column{"ay", FileColumn::ay},
                                    Column{"az", FileColumn::az},       Column{"kind", FileColumn::kind}};
    rows_ = parts_.numbers["track"].size();
    for (const auto& [name, as] : columns) {
      auto& values = parts_.numbers[name];
      if (values.empty()) continue;
      if (values.size() != rows_) fail(fmt::format("'{}' has {} numbers and 'track' {}; expected one per row", name, values.size(), rows_));
      table_[as] = std::move(values);
    }
    for (const auto c : {FileColumn::frame, FileColumn::x, FileColumn::y})
      if (!table_.has(c)) fail("frame, x or y is missing; expected all of them");
  }

  void take_tracks() {
    std::vector<std::uint32_t> of;
    for (const auto& name : parts_.texts["names"]) of.push_back(table_.names.number(name));
    for (const double track : parts_.numbers["track"]) {
      if (!(track >= 0) || !(track < static_cast<double>(of.size())) || track != std::floor(track))
        fail(fmt::format("track {} is not among {} names; expected whole numbers that count them from 0", track, of.size()));
      table_.track.push_back(of[static_cast<std::size_t>(track)]);
    }
  }

  OwnParts parts_;
  RawTable table_;
  std::size_t rows_ = 0;
};

}  // namespace

RawTable own_table(const std::string& file, OwnParts parts) { return OwnTable(file, std::move(parts)).read(); }

}  // namespace swarmfit
