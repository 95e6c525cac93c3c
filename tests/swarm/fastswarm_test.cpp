// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libswarm/guide.h"
#include "libswarm/headings.h"
#include "libswarm/reference_set.h"
#include "libswarm/stimuli.h"
#include "libtrack/error.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using testing::HasSubstr;

// ---- samples ------------------------------------------------------------------------------------------------------------------

Tracks tracks_of(const std::vector<std::vector<std::pair<std::int64_t, Array3d>>>& individuals, double dt) {
  TrackColumns columns;
  std::vector<Array3d> places;
  for (std::uint32_t k = 0; k < individuals.size(); ++k) {
    columns.names.push_back(std::to_string(k));
    for (const auto& [frame, place] : individuals[k]) {
      columns.track.push_back(k);
      columns.frame.push_back(frame);
      places.push_back(place);
    }
  }
  columns.pos.resize(static_cast<Index>(places.size()), 3);
  for (std::size_t i = 0; i < places.size(); ++i) columns.pos.row(static_cast<Index>(i)) = places[i].transpose();
  TrackMeta meta;
  meta.dt = dt;
  return {std::move(columns), meta};
}

Array3d row_of(const ReferenceSet::Vectors& v, std::size_t k) { return {v[0][k], v[1][k], v[2][k]}; }

// A fall: frame k is at (k, 0, -k² / 2) dt-wise, so v_k = (1, 0, -(k + 1/2)) / dt and every change of velocity is (0, 0, -1) / dt.
TEST(ReferenceSet, IsOfForwardDifferences) {
  std::vector<std::pair<std::int64_t, Array3d>> fall;
  for (int k = 0; k < 14; ++k) fall.emplace_back(k, Array3d(k, 0, -0.5 * k * k));
  const ReferenceSet set(tracks_of({fall}, 0.5), {}, {});
  ASSERT_EQ(set.size(), 12u);  // the last two frames are followed by no two others
  for (std::size_t k = 0; k < set.size(); ++k) {
    EXPECT_TRUE(row_of(set.velocity(), k).isApprox(Array3d(2, 0, -2 * (static_cast<double>(k) + 0.5)), 1e-12)) << k;
    EXPECT_TRUE(row_of(set.acceleration(), k).isApprox(Array3d(0, 0, -2), 1e-12)) << k;
    EXPECT_TRUE(row_of(set.turn(), k).isApprox(Array3d(0, 0, -1), 1e-12)) << k;
    EXPECT_NEAR(set.speed()[k], row_of(set.velocity(), k).matrix().norm(), 1e-12);
  }
  EXPECT_NEAR(set.rms_change(), 2, 1e-12);
}

// Two individuals with a hole each; what spans a hole would be ten times as fast as anything recorded.
TEST(ReferenceSet, DoesNotReachAcrossGaps) {
  std::vector<std::vector<std::pair<std::int64_t, Array3d>>> both(2);
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 20; ++k)
      if (k != 7 && k != 12) both[static_cast<std::size_t>(i)].emplace_back(k, Array3d(k + (k > 7 ? 100 : 0) + (k > 12 ? 100 : 0), i, 0));
  const ReferenceSet set(tracks_of(both, 1), {}, {});
  EXPECT_EQ(set.size(), 2u * (5 + 2 + 5));
  EXPECT_NEAR(set.speed()[set.size() - 1], 1, 1e-12);
}

TEST(ReferenceSet, TakesOneOfEachStratum) {
  std::vector<std::vector<std::pair<std::int64_t, Array3d>>> all;
  for (int i = 0; i < 1000; ++i) all.push_back({{0, {0, 0, 0}}, {1, {1.0 + i, 0, 0}}, {2, {2.0 + 2 * i, 0, 0}}});
  const Tracks recording = tracks_of(all, 1);
  const ReferenceSet set(recording, {.samples = 100}, {3}), other(recording, {.samples = 100}, {4});
  ASSERT_EQ(set.size(), 100u);
  int differ = 0;
  for (std::size_t s = 0; s < 100; ++s) {
    EXPECT_GE(set.speed()[s], 10.0 * static_cast<double>(s) + 1);
    EXPECT_LE(set.speed()[s], 10.0 * static_cast<double>(s) + 10);
    differ += set.speed()[s] != other.speed()[s];
  }
  EXPECT_GT(differ, 70);  // nine of ten are expected to
}

TEST(ReferenceSet, GroupsAreOfEqualSizeAndHaveNeighbours) {
  std::vector<std::vector<std::pair<std::int64_t, Array3d>>> all;
  for (int i = 0; i < 100; ++i) all.push_back({{0, {0, 0, 0}}, {1, {1.0 + i, 0, 0}}, {2, {2.0 + 2 * i, 0, 0}}});
  const ReferenceSet set(tracks_of(all, 1), {}, {});  // speeds 1 .. 100, ten to a group
  const auto expect = [&](double speed, std::size_t window, std::size_t first, std::size_t end) {
    const auto span = set.like(speed, window);
    EXPECT_EQ(span.first, first) << speed;
    EXPECT_EQ(span.end, end) << speed;
  };
  expect(35, 0, 30, 40);
  expect(35, 1, 20, 50);
  expect(40, 0, 30, 40);
  expect(41, 0, 40, 50);
  expect(0, 1, 0, 20);
  expect(1e9, 1, 80, 100);
  expect(35, 10, 0, 100);
}

TEST(ReferenceSet, YawKeepsSpeedsAndHeights) {
  const Tracks& recording = any_flight(3);
  const ReferenceSet as(recording, {}, {}), turned(recording, {.yaw = true}, {});
  double moved = 0;
  for (std::size_t k = 0; k < as.size(); ++k) {
    EXPECT_NEAR(as.velocity()[2][k], turned.velocity()[2][k], 1e-12);
    EXPECT_NEAR(row_of(as.velocity(), k).matrix().norm(), row_of(turned.velocity(), k).matrix().norm(), 1e-12);
    EXPECT_NEAR((row_of(as.velocity(), k) * row_of(as.acceleration(), k)).sum(),
                (row_of(turned.velocity(), k) * row_of(turned.acceleration(), k)).sum(), 1e-12);
    moved = std::max(moved, (row_of(as.velocity(), k) - row_of(turned.velocity(), k)).abs().maxCoeff());
  }
  EXPECT_GT(moved, 0.1);
}

TEST(ReferenceSet, RefusesARecordingThatTeachesNothing) {
  std::vector<std::vector<std::pair<std::int64_t, Array3d>>> pairs(50, {{0, {0, 0, 0}}, {1, {1, 0, 0}}});
  pairs.push_back({{0, {0, 0, 0}}, {1, {1, 0, 0}}, {2, {1, 0, 0}}});
  try {
    ReferenceSet(tracks_of(pairs, 1), {}, {});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "the recording: 1 place is followed by two further frames of the same individual; expected at least 10 to learn from");
  }
}

// ---- the choice, against Eq 2 to 14 written out ---------------------------------------------------------------------------------

struct FixedGuide : Guide {
  std::unique_ptr<WorldPart> clone() const override { return std::make_unique<FixedGuide>(*this); }
  std::optional<Array3d> goal(std::uint32_t id) const override { return id % 3 == 0 ? std::nullopt : std::optional(Array3d(5, -2, 1)); }
};

struct Twin {
  const Made& made;
  const Lane& lane;
  const ReferenceSet& set;
  bool cubes = false, literal = false;
  std::optional<Array3d> danger = {}, lure = {};
  NoiseField field{lane.rng};

  double p(std::string_view name) const { return lane.p[static_cast<std::size_t>(made.choice.spec->find(name))]; }

  double energy(Index i, std::size_t k, double dt) const {
    const State& s = lane.state;
    const Array3d x = s.pos.row(i).transpose(), v = row_of(set.velocity(), k), before = s.vel.row(i).transpose();
    const Array3d x2 = x + v * dt, hat = heading_of(v);
    const double rho = p("rho"), d_rep = p("d_rep"), d1 = d_rep + p("inner"), d2 = d1 + p("outer");
    const auto norm = [](const Array3d& a) { return std::sqrt(a.square().sum()); };
    const auto apart = [&](const Array3d& a) { return cubes ? a.abs().maxCoeff() : norm(a); };
    double rep = 0, oa = 0;
    int repelling = 0, attracting = 0;
    Array3d centre = Array3d::Zero();
    for (Index j = 0; j < s.size(); ++j) {
      const Array3d y = s.pos.row(j).transpose(), y2 = y + Array3d(s.vel.row(j).transpose()) * dt;
      centre += y / static_cast<double>(s.size());
      if (j == i) continue;
      const double r = apart(y - x);
      if (r < d_rep) rep += std::exp(rho * (1 - norm(x2 - y2) / d_rep)), ++repelling;
      if (r >= d1 && r <= d2) oa += std::exp(rho * (norm(x2 - y) / d1 - 1)), ++attracting;
    }
    const bool startled = danger && norm(*danger - x) <= p("d_danger");
    double e = 0;
    if (repelling > 0) e += p("w_rep") * rep / repelling;
    if (attracting > 0 && !startled) e += p("w_oa") * oa / attracting;
    if (!startled) e += p("w_cos") * std::exp(rho * norm(hat - heading_of(centre - x)));
    e += p("w_dir") * std::exp(rho * norm(hat - heading_of(before)));
    const Array3d change = v - before, recorded = row_of(set.acceleration(), k) * dt / set.dt();
    e += p("w_acc") * (std::exp(rho * norm(heading_of(change) - heading_of(recorded))) +
                       std::abs(norm(change) - norm(recorded)) / (literal ? 1 : set.rms_change()));
    if (startled) e += p("w_env") * std::exp(rho * (1 - norm(x2 - *danger) / p("d_danger")));
    if (!startled && lure) e += p("w_env") * std::exp(rho * norm(hat - heading_of(*lure - x)));
    e += p("w_n") * std::exp(rho * norm(hat - heading_of(field.curl(x / p("scale")))));
    const std::uint32_t id = s.id[static_cast<std::size_t>(i)];
    if (p("w_user") > 0 && id % 3 != 0) e += p("w_user") * std::exp(rho * norm(hat - heading_of(Array3d(5, -2, 1) - x)));
    return e;
  }

  std::size_t lowest(Index i, double dt) const {
    std::size_t best = 0;
    double least = INFINITY;
    for (std::size_t k = 0; k < set.size(); ++k)
      if (const double e = energy(i, k, dt); e < least) least = e, best = k;
    return best;
  }
};

// Agents chosen so that every term has somebody to act on.
Lane swarm(const Made& made, Index agents = 60, double width = 4) {
  Lane lane = crowd(made, agents, width, 0.5, 21);
  set(made, lane, "w_n", 0.4);
  return lane;
}

void expect_lowest(const std::string& setting, const std::function<void(const Made&, Lane&, Twin&)>& arrange, double dt = 0.01) {
  SCOPED_TRACE(setting);
  const Tracks& recording = any_flight(3);
  const Made made = make("fastswarm[groups=all" + setting + "]", 3, &recording);
  Lane lane = swarm(made);
  const ReferenceSet set(recording, {}, {});
  const Lane before = [&] {
    Twin unused{made, lane, set};
    arrange(made, lane, unused);
    return lane;
  }();
  Twin twin{made, before, set};
  Lane again = lane;
  arrange(made, again, twin);
  run(made, {.frame_dt = dt, .frames = 2}, lane);
  for (Index i = 0; i < lane.state.size(); ++i) {
    const std::size_t k = twin.lowest(i, dt);
    EXPECT_TRUE((lane.state.vel.row(i).transpose() == row_of(set.velocity(), k)).all()) << "agent " << i;
  }
}

TEST(Fastswarm, ChoosesAsBruteForceDoes) {
  expect_lowest("", [](const Made&, Lane&, Twin&) {});
  expect_lowest(",magnitude=literal", [](const Made&, Lane&, Twin& t) { t.literal = true; });
  expect_lowest(",neighbours=cubes", [](const Made&, Lane&, Twin& t) { t.cubes = true; });
  expect_lowest("", [](const Made& m, Lane& l, Twin&) { set(m, l, "w_rep", 20), set(m, l, "w_oa", 30), set(m, l, "d_rep", 1.2); });
  expect_lowest("", [](const Made& m, Lane& l, Twin&) { set(m, l, "w_acc", 0), set(m, l, "w_dir", 0.1); });
  expect_lowest(
      "", [](const Made&, Lane&, Twin&) {}, 0.04);  // longer steps than the recording's
}

TEST(Fastswarm, ChoosesAsBruteForceDoesNearStimuliAndGuides) {
  const auto place = [](Stimulus::Kind kind, const Array3d& at) {
    return std::make_unique<Stimuli>(std::vector<Stimulus>{{.kind = kind, .start = at}});
  };
  expect_lowest("", [&](const Made& m, Lane& l, Twin& t) {
    set(m, l, "w_env", 2), set(m, l, "d_danger", 2);
    t.danger = Array3d(2, 2, 1);
    l.world.add(place(Stimulus::Kind::repel, *t.danger));
  });
  expect_lowest("", [&](const Made& m, Lane& l, Twin& t) {
    set(m, l, "w_env", 1);
    t.lure = Array3d(9, 2, 1);
    l.world.add(place(Stimulus::Kind::attract, *t.lure));
  });
  expect_lowest("", [&](const Made& m, Lane& l, Twin&) {
    set(m, l, "w_user", 1);
    l.world.add(std::make_unique<FixedGuide>());
  });
}

// What the search among samples about as fast costs, in energy above the lowest there is: it can only cost, and costs little.
TEST(Fastswarm, LossFromGroupingIsSmall) {
  const Tracks& recording = any_flight(3);
  const Made made = make("fastswarm", 3, &recording);
  const ReferenceSet set(recording, {}, {});
  Lane lane = swarm(made);
  double loss = 0;
  int worse = 0, all = 0;
  for (int k = 0; k < 10; ++k) {
    const Lane before = lane;
    const Twin twin{made, before, set};
    run(made, {.frame_dt = 0.01, .first_frame = k, .frames = 2}, lane);
    for (Index i = 0; i < lane.state.size(); ++i) {
      double chosen = INFINITY;
      for (std::size_t s = 0; s < set.size(); ++s)
        if ((lane.state.vel.row(i).transpose() == row_of(set.velocity(), s)).all()) chosen = std::min(chosen, twin.energy(i, s, 0.01));
      const double least = twin.energy(i, twin.lowest(i, 0.01), 0.01);
      ASSERT_GE(chosen, least);
      loss += chosen / least - 1;
      worse += chosen > least;
      ++all;
    }
  }
  RecordProperty("mean_relative_loss", std::to_string(loss / all));
  RecordProperty("share_of_worse_choices", std::to_string(static_cast<double>(worse) / all));
  EXPECT_GT(worse, 0);
  EXPECT_LT(loss / all, 0.5);
}

TEST(Fastswarm, FliesAtRecordedVelocitiesOnly) {
  const Tracks& recording = any_flight(2);
  const Made made = make("fastswarm", 2, &recording);
  const ReferenceSet set(recording, {}, {});
  Lane lane = crowd(made, 30, 3, 0.5, 2, 2);
  run(made, {.frame_dt = 0.01, .frames = 20}, lane);
  for (Index i = 0; i < 30; ++i) {
    bool found = false;
    for (std::size_t k = 0; k < set.size(); ++k) found = found || (lane.state.vel.row(i).transpose() == row_of(set.velocity(), k)).all();
    EXPECT_TRUE(found);
  }
}

TEST(Fastswarm, NeedsARecordingAndItsStep) {
  const auto error = [](const swarmfit::Setup& setup) -> std::string {
    try {
      make_model(parse_model("fastswarm"), setup);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(error({}), HasSubstr("cannot be made without a recording"));
  EXPECT_THAT(error({.reference = &any_flight(3), .step = 0.005}), HasSubstr("expected 0.01 s, the recording's frame interval"));
}

}  // namespace
}  // namespace swarmfit
