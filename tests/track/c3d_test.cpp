// SPDX-License-Identifier: MIT
// C3D files made by hand, on all three kinds of machines, after the C3D User Guide.
#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kIntel = 84, kDec = 85, kMips = 86;

// Two points, four frames from number 5 on, 50 Hz. The second one is not seen in the second frame.
struct Made {
  int machine = kIntel;
  bool floating = true;
  std::vector<std::string> labels = {"left", "right"};
  std::string unit = "mm";
  float rate = 50;
  int analog = 0, points = 2;

  std::string word(int value) const {
    const char low = static_cast<char>(value & 0xFF), high = static_cast<char>((value >> 8) & 0xFF);
    return machine == kMips ? std::string{high, low} : std::string{low, high};
  }
  std::string real(float value) const {
    // A VAX float has four times the value of the IEEE float with the same bits, and its words the other way round.
    const auto bits = std::bit_cast<std::uint32_t>(machine == kDec ? value * 4 : value);
    const int high = static_cast<int>(bits >> 16), low = static_cast<int>(bits & 0xFFFF);
    return machine == kIntel ? word(low) + word(high) : word(high) + word(low);
  }
  std::string record(int group, const std::string& name, const std::string& body, bool last = false) const {
    return std::string{static_cast<char>(name.size()), static_cast<char>(group)} + name +
           word(last ? 0 : static_cast<int>(body.size()) + 2) + body;
  }
  std::string parameters() const {
    const std::size_t width = 8;
    std::string names{static_cast<char>(-1), 2, static_cast<char>(width), static_cast<char>(labels.size())};
    for (const auto& label : labels) names += label + std::string(width - label.size(), ' ');
    const std::string units{static_cast<char>(-1), 1, static_cast<char>(unit.size())};
    std::string out{1, 0x50, 1, static_cast<char>(machine)};
    out += record(-1, "POINT", std::string(1, '\0'));
    const auto none = std::string(1, '\0');
    out += record(1, "SCALE", std::string{4, 0} + real(floating ? -1.0F : 0.25F) + none);
    out += record(1, "RATE", std::string{4, 0} + real(rate) + none);
    out += record(1, "UNITS", units + unit + none);
    out += record(1, "LABELS", names + none, true);
    out.resize(512);
    return out;
  }
  std::string value(double v) const { return floating ? real(static_cast<float>(v)) : word(static_cast<int>(v * 4)); }
  std::string bytes() const {
    std::string out{2, 0x50};
    out += word(points) + word(analog) + word(5) + word(8) + word(10) + real(floating ? -1.0F : 0.25F) + word(3) + word(0) + real(50);
    out.resize(512);
    out += parameters();
    for (int frame = 0; frame < 4; ++frame) {
      for (int k = 0; k < 2; ++k)
        out += value(frame / 2.0) + value(-1 - k) + value(3 + k) +
               (floating ? real(frame == 1 && k == 1 ? -1 : 0) : word(frame == 1 && k == 1 ? -1 : 0));
      for (int a = 0; a < analog; ++a) out += value(99);
    }
    return out;
  }
};

std::vector<double> column(const Tracks& tracks, int axis) {
  std::vector<double> out;
  for (Index i = 0; i < tracks.rows(); ++i) out.push_back(tracks.pos()(i, axis));
  return out;
}

void expect_all(const Made& made) {
  const auto tracks = read(made.bytes());
  EXPECT_EQ(tracks.meta().from.format, "c3d");
  EXPECT_THAT(tracks.names(), ElementsAre("left", "right"));
  EXPECT_EQ(tracks.meta().unit, "mm");
  EXPECT_DOUBLE_EQ(tracks.dt(), 0.02);
  EXPECT_THAT(tracks.frame(), ElementsAre(5, 5, 6, 7, 7, 8, 8));
  EXPECT_THAT(column(tracks, 0), ElementsAre(0, 0, 0.5, 1, 1, 1.5, 1.5));
  EXPECT_THAT(column(tracks, 1), ElementsAre(-1, -2, -1, -1, -2, -1, -2));
  EXPECT_THAT(column(tracks, 2), ElementsAre(3, 4, 3, 3, 4, 3, 4));
  EXPECT_THAT(tracks.meta().from.notes, Contains("1 of 8 positions were not seen"));
}

TEST(C3d, FloatsOfEveryMachine) {
  for (const int machine : {kIntel, kDec, kMips}) {
    SCOPED_TRACE(machine);
    expect_all({.machine = machine});
  }
}

TEST(C3d, ScaledIntegersAndAnalogSamples) {
  for (const int machine : {kIntel, kDec, kMips}) {
    SCOPED_TRACE(machine);
    expect_all({.machine = machine, .floating = false, .analog = 3});
  }
}

TEST(C3d, SubjectsAndMarkers) {
  const Made made{.labels = {"a:nose", "a:tail"}};
  EXPECT_EQ(error_of(made.bytes()), "f.csv: every individual has 2 points, nose, tail; expected `node` NAME or `node` mean");
  ReadOptions tail;
  tail.node = "tail";
  const auto tracks = read(made.bytes(), tail);
  EXPECT_THAT(tracks.names(), ElementsAre("a"));
  EXPECT_THAT(column(tracks, 1), ElementsAre(-2, -2, -2));
}

TEST(C3d, NamesThatAreMissingOrComeAgain) {
  EXPECT_THAT(read(Made{.labels = {"", ""}}.bytes()).names(), ElementsAre("point 1", "point 2"));
  EXPECT_THAT(read(Made{.labels = {"a"}}.bytes()).names(), ElementsAre("a", "point 2"));
  EXPECT_THAT(read(Made{.labels = {"a", "a"}}.bytes()).names(), ElementsAre("a", "a-2"));
  EXPECT_THAT(read(Made{.labels = {"\t", "\n"}}.bytes()).names(), ElementsAre("\\x0a", "unnamed"));
}

TEST(C3d, RatesBeyondAllSenseAreRefused) {
  EXPECT_THAT(error_of(Made{.rate = 1e-37F}.bytes()), HasSubstr("the file states a frame interval of 1e+37 s"));
  EXPECT_THAT(error_of(Made{.rate = 1e35F}.bytes()), HasSubstr("expected finite numbers, the first from 1e-30 to 1e+30"));
}

TEST(C3d, WhatIsDamagedIsRefused) {
  const std::string good = Made{}.bytes();
  EXPECT_EQ(error_of(good.substr(0, good.size() - 1)), "f.csv: the file is cut short: it holds 3 of 4 frames; expected all");
  EXPECT_EQ(error_of(Made{.points = 0}.bytes()), "f.csv: there are no points, only other measurements; expected a recording of positions");
  const auto changed = [&](std::size_t at, char value) {
    std::string bytes = good;
    bytes[at] = value;
    return error_of(bytes);
  };
  EXPECT_THAT(changed(16, 1), HasSubstr("the positions begin in block 1; expected one behind the header"));
  const auto scale = good.find("SCALE") + 5;
  EXPECT_THAT(changed(scale, 3), HasSubstr("the parameter SCALE overlaps the next one"));
  EXPECT_THAT(changed(scale + 2, 3), HasSubstr("values of type 3; expected -1, 1, 2 or 4"));
  EXPECT_THAT(changed(scale + 3, 9), HasSubstr("9 dimensions; expected 7 at most"));
  EXPECT_THAT(changed(good.find("LABELS") + 11, -1), HasSubstr("a parameter is larger than the file; expected smaller dimensions"));
  for (std::size_t size = 1024; size < good.size(); ++size) EXPECT_THAT(error_of(good.substr(0, size)), HasSubstr("expected")) << size;
}

}  // namespace
}  // namespace swarmfit
