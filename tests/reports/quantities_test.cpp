// SPDX-License-Identifier: MIT
#include "reports/comparison/quantities.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "reports/comparison/json.h"
#include "reports/comparison/tables.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

std::string schema_page() {
  std::ostringstream out;
  out << std::ifstream(SWARMFIT_SOURCE_DIR "/docs/results_schema.md").rdbuf();
  return out.str();
}

TEST(Quantities, HaveKeysOfTheirOwnAndAMeaning) {
  std::set<std::string_view> keys;
  const ModelFit nobody;
  for (const Quantity& q : quantities()) {
    EXPECT_TRUE(keys.insert(q.key).second) << q.key;
    EXPECT_FALSE(q.meaning.empty() || q.meaning.ends_with('.')) << q.key;
    EXPECT_EQ(q.first == Audience::nobody, q.print == nullptr) << q.key;
    EXPECT_EQ(q.head.empty(), q.print == nullptr) << q.key;
    EXPECT_EQ(q.key.ends_with("_ci"), std::holds_alternative<IntervalEnds>(q.of(nobody))) << q.key;
  }
  for (const ColumnQuantity& q : column_quantities()) EXPECT_TRUE(keys.insert(q.key).second) << q.key;
}

TEST(Quantities, StandOnThePageOfTheSchema) {
  const std::string page = schema_page();
  const auto named = [&](std::string_view key) { return page.find('`' + std::string(key.substr(key.find('.') + 1)) + '`') != page.npos; };
  for (const Quantity& q : quantities()) EXPECT_TRUE(named(q.key)) << q.key;
  for (const ColumnQuantity& q : column_quantities()) EXPECT_TRUE(named(q.key)) << q.key;
}

TEST(Quantities, AreInResultsAndTables) {
  Comparison c = sample_comparison();
  c.recording.hold_out.ways = {{1, 240, 261, 500, {}, {}}};
  const auto json = nlohmann::json::parse(to_json(c)).at("models").at(0);
  const std::string ranking = result_tables(c).front().csv;
  for (const Quantity& q : quantities()) {
    std::string pointer = "/" + std::string(q.key), column(q.key);
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    std::replace(column.begin(), column.end(), '.', '_');
    if (column.ends_with("_ci")) column.resize(column.size() - 2);
    EXPECT_TRUE(json.contains(nlohmann::json::json_pointer(pointer))) << q.key;
    EXPECT_THAT(ranking, testing::HasSubstr(column)) << q.key;
  }
  for (const ColumnQuantity& q : column_quantities()) EXPECT_TRUE(json.at(q.key).contains("v")) << q.key;
}

TEST(Quantities, OfWhatIsHeldOutAreThereOnlyWhereAnythingIs) {
  const auto json = nlohmann::json::parse(to_json(sample_comparison())).at("models").at(0);
  EXPECT_FALSE(json.contains("held_out"));
}

}  // namespace
}  // namespace swarmfit
