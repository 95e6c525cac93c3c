// SPDX-License-Identifier: MIT
#include "reports/study/power_report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "fit/study/recovery.h"
#include "libtrack/file.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;

// Of three recordings each: bswarm is told from boids, and back; from brownian only one way.
Power sample() {
  Power p;
  p.recovery.planted = p.recovery.compared = {"bswarm", "boids", "brownian"};
  for (const auto& name : p.recovery.planted) {
    p.recovery.rows.push_back(planted_rows(parse_model(name), "mm"));
    p.recovery.parameters.emplace_back(p.recovery.rows.back().size(), 1.0);
    p.recovery.confusion.emplace_back(3, 0);
  }
  p.pairs = {{0, 1, 3, 3, 3, 0.5, 0.1, 1},    {0, 2, 3, 2, 1, 0.05, 0.05, 2.7}, {1, 0, 3, 3, 3, 0.5, 0.1, 1},
             {1, 2, 3, 3, 2, 0.5, 0.1, 1.04}, {2, 0, 3, 3, 3, 0.4, 0.1, 1},     {2, 1, 3, 3, 3, 0.4, 0.1, 1}};
  return p;
}

TEST(PowerReport, SaysWhatIsNotToldApartAndHowMuchItWouldTake) {
  Power p = sample();
  EXPECT_EQ(power_sentence(p),
            "A recording like this one does not distinguish bswarm and brownian (the right order needs about 2.7 times as much data).");
  p.pairs[1].factor = INFINITY;
  EXPECT_EQ(power_sentence(p), "A recording like this one does not distinguish bswarm and brownian (more data may not help).");
  p.pairs[1].factor = 1;
  EXPECT_EQ(power_sentence(p),
            "A recording like this one ranks all these models correctly, but does not distinguish bswarm and brownian with certainty.")
      << "as the table says";
  p.pairs[1].told_apart = 2;
  EXPECT_EQ(power_sentence(p), "A recording like this one distinguishes all these models.");
}

TEST(PowerReport, PairsByHand) {
  const auto t = pairs_table(sample(), "");
  ASSERT_EQ(t.rows.size(), 6u);
  EXPECT_THAT(t.rows[1], testing::ElementsAre("bswarm", "brownian", "2 of 3", "1 of 3", "0.05", "0.05", "2.7 ×"));
  EXPECT_EQ(t.rows[0].back(), "as much");
  EXPECT_THAT(pairs_csv(sample()), HasSubstr("bswarm,brownian,3,2,1,0.05,0.05,2.7\n"));
  EXPECT_THAT(power_text(sample(), {.colour = false, .unicode = false}), HasSubstr("2.7 x"));
}

TEST(PowerReport, WritesARunThatHoldsTheAnswer) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "power_report";
  std::filesystem::remove_all(dir);
  Power p = sample();
  p.pairs[1].factor = INFINITY;
  write_power(dir.string(), p, {{"seeds", "3"}});
  const auto json = nlohmann::json::parse(read_file((dir / "power.json").string()));
  EXPECT_EQ(json["schema"], "swarmfit-power/2");
  EXPECT_EQ(json["answer"], power_sentence(p));
  EXPECT_TRUE(json["pairs"][1]["factor"].is_null());
  EXPECT_EQ(json["pairs"][3]["distinguished"], 2);
  EXPECT_THAT(read_file((dir / "config.toml").string()), HasSubstr("[power]\nseeds = 3\n"));
  for (const char* table : {"pairs.md", "pairs.tex", "pairs.csv", "cases.csv", "confusion.md", "confidence.tex"})
    EXPECT_TRUE(std::filesystem::exists(dir / "tables" / table)) << table;
  std::filesystem::remove_all(dir);
}

}  // namespace
}  // namespace swarmfit
