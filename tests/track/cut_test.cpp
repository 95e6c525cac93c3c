// SPDX-License-Identifier: MIT
#include "libtrack/cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;

const char* const kSheepAndDog =
    "id,frame,x,y,vx,vy,ax,ay,kind\n"
    "sheep,0,0,0,1,2,3,4,0\n"
    "sheep,1,1,0,5,6,7,8,0\n"
    "dog,1,9,9,9,8,7,6,1\n"
    "sheep,2,2,0,1,1,1,1,0\n"
    "dog,2,8,9,2,3,4,5,1\n"
    "ram,3,5,5,0,0,0,0,2\n";

TEST(Cut, KeepsEveryColumn) {
  const Tracks all = read(kSheepAndDog, flags()), part = cut(all, 1, 3);
  ASSERT_EQ(part.rows(), 4);
  EXPECT_THAT(part.frame(), ElementsAre(1, 1, 2, 2));
  for (Index row = 0; row < 4; ++row) {
    EXPECT_TRUE((part.pos().row(row) == all.pos().row(row + 1)).all());
    EXPECT_TRUE((part.vel().row(row) == all.vel().row(row + 1)).all());
    EXPECT_TRUE((part.acc().row(row) == all.acc().row(row + 1)).all());
    EXPECT_EQ(part.kind(row), all.kind(row + 1));
    EXPECT_EQ(part.names().at(part.track()[static_cast<std::size_t>(row)]), all.names().at(all.track()[static_cast<std::size_t>(row) + 1]));
  }
  EXPECT_EQ(part.names(), all.names());
  EXPECT_EQ(part.kinds(), 2);
  EXPECT_EQ(all.kinds(), 3);
  EXPECT_EQ(part.meta().from.sha256, all.meta().from.sha256);
  EXPECT_EQ(part.meta().from.path, "f.csv");
}

TEST(Cut, NothingIsDifferencedAcrossIt) {
  const Tracks part = cut(read(kSheepAndDog, flags()), 1, 2);
  EXPECT_THAT(part.next(), ElementsAre(-1, -1));
  EXPECT_EQ(cut(part, 5, 9).rows(), 0);
  EXPECT_EQ(cut(part, 5, 9).kinds(), 1);
}

TEST(OfKind, IsARecordingOfThemAlone) {
  const Tracks all = read(kSheepAndDog, flags()), dog = of_kind(all, 1), sheep = of_kind(all, 0);
  ASSERT_EQ(dog.rows(), 2);
  EXPECT_THAT(dog.names(), ElementsAre("dog"));
  EXPECT_THAT(dog.frame(), ElementsAre(1, 2));
  EXPECT_THAT(dog.track(), ElementsAre(0, 0));
  EXPECT_THAT(dog.next(), ElementsAre(1, -1));
  EXPECT_EQ(dog.kind(0), 1);
  EXPECT_TRUE((dog.acc().row(1) == all.acc().row(3)).all());
  EXPECT_TRUE((dog.vel().row(1) == all.vel().row(3)).all());
  EXPECT_THAT(sheep.frame(), ElementsAre(0, 1, 2));
  EXPECT_EQ(of_kind(all, 7).rows(), 0);
}

TEST(OfKind, GoesByNameOrNumber) {
  Tracks all = read(kSheepAndDog, flags());
  EXPECT_EQ(kind_named(all, "2"), 2);
  TrackMeta meta = all.meta();
  meta.kinds = {"sheep", "dog"};
  all = Tracks(all.columns(), meta);
  EXPECT_EQ(kind_named(all, "dog"), 1);
  EXPECT_EQ(kind_named(all, "1"), 1);
  EXPECT_EQ(kind_named(all, "2"), 2);
  try {
    kind_named(all, "wolf");
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "`kind` wolf: no individual in f.csv is of that kind; expected one of sheep (0), dog (1), 2");
  }
}

}  // namespace
}  // namespace swarmfit
