// SPDX-License-Identifier: MIT
// What every model owes: tested for all registered models, each with every value of each of its options. A new model needs no line here.
#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

#include "fit/results/axis_scale.h"
#include "libswarm/stimuli.h"
#include "libswarm/walls.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// ---- all settings -------------------------------------------------------------------------------------------------------------

std::vector<std::string> settings() {
  std::vector<std::string> all;
  for (const ModelSpec& spec : models()) {
    all.emplace_back(spec.name);
    for (const Option& option : spec.options)
      for (std::size_t k = 1; k < option.values.size(); ++k)
        all.push_back(std::string(spec.name) + "[" + std::string(option.name) + "=" + std::string(option.values[k]) + "]");
  }
  return all;
}

// What ModelSpec::quiet sets, name and value.
std::vector<std::pair<std::string, std::string>> quiet_settings(const ModelSpec& spec) {
  std::vector<std::pair<std::string, std::string>> all;
  std::istringstream in{std::string(spec.quiet)};
  for (std::string setting; std::getline(in, setting, ',');)
    all.emplace_back(setting.substr(0, setting.find('=')), setting.substr(setting.find('=') + 1));
  return all;
}

// The same setting without randomness, where an option switches that off.
std::string quiet(const std::string& setting) {
  ModelChoice choice = parse_model(setting);
  for (const auto& [name, value] : quiet_settings(*choice.spec))
    if (choice.options.contains(name)) choice.options[name] = value;
  std::string name(choice.spec->name);
  char separator = '[';
  for (const auto& [option, value] : choice.options) {
    name += separator + option + "=" + value;
    separator = ',';
  }
  return separator == ',' ? name + "]" : name;
}

// And where a parameter does. Options come first: bswarm has both by the name of noise.
void silence(const Made& made, Lane& lane) {
  for (const auto& [name, value] : quiet_settings(*made.choice.spec))
    if (!made.choice.options.contains(name)) set(made, lane, name, std::stod(value));
}

// Everything switched on: parameters that are 0 by default get a tenth of their upper bound.
Lane busy(const Made& made, Index agents, double width) {
  Lane lane = crowd(made, agents, width, 0.5, 11);
  const auto& table = made.choice.spec->parameters;
  for (std::size_t k = 0; k < table.size(); ++k)
    if (table[k].scene.initial == 0) lane.p[k] = table[k].scene.upper / 10;
  return lane;
}

constexpr Plan kShort{.frame_dt = 0.01, .frames = 21};

class EveryModel : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Settings, EveryModel, testing::ValuesIn(settings()), [](const auto& setting) {
  std::string name = setting.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

void expect_near(const State& a, const State& b, double tolerance) {
  ASSERT_EQ(a.id, b.id);
  EXPECT_LT((a.pos - b.pos).abs().maxCoeff(), tolerance);
  EXPECT_LT((a.vel - b.vel).abs().maxCoeff(), tolerance);
}

// ---- the table ----------------------------------------------------------------------------------------------------------------

TEST(EverySpec, TableIsSound) {
  std::set<std::string_view> names;
  for (const ModelSpec& spec : models()) {
    SCOPED_TRACE(spec.name);
    EXPECT_TRUE(names.insert(spec.name).second);
    EXPECT_FALSE(spec.summary.empty());
    EXPECT_FALSE(spec.citation.empty());
    EXPECT_GT(spec.native_dt, 0);
    EXPECT_GT(spec.largest_dt, 0);
    ASSERT_NE(spec.make, nullptr);
    for (const int dims : spec.dims) EXPECT_TRUE(dims == 2 || dims == 3);
    EXPECT_FALSE(spec.dims.empty());
    for (const auto& [name, value] : quiet_settings(spec))
      EXPECT_TRUE(spec.resolve({}).contains(name) || spec.find(name) >= 0) << name << " is neither an option nor a parameter";
    std::set<std::string_view> used, parameters;
    for (const Option& o : spec.options) {
      EXPECT_TRUE(used.insert(o.name).second) << o.name;
      EXPECT_GE(o.values.size(), 2u) << o.name;
      EXPECT_EQ(std::set(o.values.begin(), o.values.end()).size(), o.values.size()) << o.name;
      EXPECT_EQ(std::set(o.with.begin(), o.with.end()).size(), o.values.size()) << o.name << ": what each value means";
    }
    for (std::size_t k = 0; k < spec.parameters.size(); ++k) {
      const Parameter& p = spec.parameters[k];
      SCOPED_TRACE(p.name);
      EXPECT_EQ(p.row, k) << "the model's enum calls this row something else";
      EXPECT_TRUE(parameters.insert(p.name).second);
      EXPECT_FALSE(p.meaning.empty());
      EXPECT_FALSE(p.source.empty());
      for (const Range& range : {p.scene, p.fit}) {
        EXPECT_LT(range.lower, range.upper);
        EXPECT_LE(range.lower, range.initial);
        EXPECT_LE(range.initial, range.upper);
      }
      if (p.log) {
        EXPECT_GT(p.fit.lower, 0);
        EXPECT_GE(p.scene.lower, 0) << "0: a scene may do without what it stands for";
      }
    }
  }
}

TEST(EverySpec, ConditionsNameOptionsAndValuesThatExist) {
  for (const ModelSpec& spec : models())
    for (std::size_t p = 0; p < spec.parameters.size(); ++p) {
      const std::string when(spec.parameters[p].when);
      if (when.empty()) continue;
      // Options set exactly as the condition says must satisfy it; every name and value must be legal.
      Options given;
      for (std::size_t first = 0; first <= when.size();) {
        const std::size_t end = std::min(when.find(',', first), when.size());
        const std::string condition = when.substr(first, end - first);
        const std::size_t equals = condition.find('=');
        ASSERT_NE(equals, std::string::npos) << when;
        for (std::size_t v = equals + 1; v <= condition.size();) {
          const std::size_t bar = std::min(condition.find('|', v), condition.size());
          given[condition.substr(0, equals)] = condition.substr(v, bar - v);
          ASSERT_NO_THROW(spec.resolve(given)) << when;
          v = bar + 1;
        }
        first = end + 1;
      }
      EXPECT_TRUE(spec.uses(p, spec.resolve(given))) << when;
    }
}

TEST_P(EveryModel, HasTheColumnsItNames) {
  const Made made = make(GetParam());
  EXPECT_EQ(made.model->columns(), static_cast<Index>(made.choice.spec->columns.size()));
}

// ---- motion -------------------------------------------------------------------------------------------------------------------

TEST_P(EveryModel, MovesAndStaysFinite) {
  const Made made = make(GetParam());
  Lane lane = busy(made, 40, 3);
  lane.world.add(std::make_unique<Stimuli>(std::vector<Stimulus>{{.start = {1, 1, made.dims == 3 ? 1.0 : 0.0}, .velocity = {0.5, 0, 0}}}));
  const Rows start = lane.state.pos;
  run(made, {.frame_dt = 0.01, .frames = 101}, lane);
  EXPECT_FALSE(lane.blew_up);
  EXPECT_TRUE(lane.state.pos.isFinite().all() && lane.state.vel.isFinite().all());
  EXPECT_GT((lane.state.pos - start).abs().maxCoeff(), 1e-3);
}

TEST_P(EveryModel, SameSeedSameBits) {
  const Made made = make(GetParam());
  Lane a = busy(made, 40, 3), b = busy(made, 40, 3);
  run(made, kShort, a);
  run(made, kShort, b);
  expect_near(a.state, b.state, 1e-300);
}

// Large enough to be split among threads; the same bits for any number of them, and inside somebody else's parallel region.
TEST_P(EveryModel, SameBitsForAnyNumberOfThreads) {
  const Made made = make(GetParam());
  const auto with = [&](int threads, bool nested) {
    Lane lane = busy(made, 2100, 20);
    const Plan plan{.frame_dt = 0.01, .frames = 2};
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    if (nested) {
#pragma omp parallel num_threads(2)
#pragma omp single
      run(made, plan, lane);
    } else {
      run(made, plan, lane);
    }
    omp_set_num_threads(before);
    return lane.state;
  };
  const State one = with(1, false);
  expect_near(one, with(3, false), 1e-300);
  expect_near(one, with(2, true), 1e-300);
}

// What regression of accelerations rests on (ModelSpec::force): the velocity changes by a force, however short the step.
TEST_P(EveryModel, ForcesDoNotDependOnTheStep) {
  ModelChoice choice = parse_model(GetParam());
  if (!choice.spec->has_force(choice.options)) return;
  for (const auto& [name, value] : choice.spec->force->options) choice.options[name] = value;
  std::string setting = choice.spec->name + "[";
  for (const auto& [name, value] : choice.options) setting += name + "=" + value + ",";
  setting.back() = ']';
  const Made made = make(choice.options.empty() ? choice.spec->name : setting);
  const auto acceleration = [&](double step) {
    Lane lane = busy(made, 40, 3);
    for (const std::size_t row : choice.spec->force->silent) lane.p[row] = 0;
    const Rows before = lane.state.vel;
    run(made, {.frame_dt = step, .first_frame = 1, .frames = 2}, lane);
    return Rows((lane.state.vel - before) / step);
  };
  const Rows whole = acceleration(1e-5), half = acceleration(5e-6);
  EXPECT_GT(whole.abs().maxCoeff(), 0.1);
  EXPECT_LT((whole - half).abs().maxCoeff(), 1e-3 * whole.abs().maxCoeff());
}

// Agents keep their ids but stand in other rows: only the order of sums may change.
TEST_P(EveryModel, RowOrderDoesNotMatter) {
  const Made made = make(GetParam());
  Lane a = busy(made, 40, 3), b = busy(made, 40, 3);
  std::vector<Index> order(40);
  std::iota(order.begin(), order.end(), Index{0});
  std::reverse(order.begin() + 3, order.end());
  b.state = {};
  for (const Index i : order)
    b.state.spawn(0, a.state.pos.row(i).transpose(), a.state.vel.row(i).transpose(), a.state.id[static_cast<std::size_t>(i)]);
  run(made, kShort, a);
  run(made, kShort, b);
  for (std::size_t k = 0; k < order.size(); ++k) {
    ASSERT_EQ(b.state.id[k], a.state.id[static_cast<std::size_t>(order[k])]);
    EXPECT_LT((b.state.pos.row(static_cast<Index>(k)) - a.state.pos.row(order[k])).abs().maxCoeff(), 1e-8);
  }
}

// Without noise nothing but the agents themselves, and where the recording had them, gives a direction or a place.
TEST_P(EveryModel, NoiselessMotionTurnsAndShiftsWithTheAgents) {
  const std::string setting = quiet(GetParam());
  const int dims = most_dims(setting);
  const Eigen::Vector3d axis = dims == 3 ? Eigen::Vector3d(1, 2, -1).normalized() : Eigen::Vector3d(0, 0, 1);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, axis).toRotationMatrix();
  const auto turned = [&](const Rows& rows) { return Rows((rows.matrix() * turn.transpose()).array()); };
  const Eigen::Array<double, 1, 3> shift(3, -7, dims == 3 ? 11 : 0);
  Lane a = busy(make(setting), 40, 3), b = busy(make(setting), 40, 3);
  b.state.pos = turned(a.state.pos).rowwise() + shift;
  b.state.vel = turned(a.state.vel);
  for (Lane* lane : {&a, &b}) {
    const Tracks reference = flight_of(lane->state, dims);
    const Made made = make(setting, dims, &reference);
    silence(made, *lane);
    run(made, kShort, *lane);
  }
  EXPECT_LT((b.state.pos - (turned(a.state.pos).rowwise() + shift)).abs().maxCoeff(), 1e-8);
  EXPECT_LT((b.state.vel - turned(a.state.vel)).abs().maxCoeff(), 1e-6);
}

TEST_P(EveryModel, PlanarMotionStaysInThePlane) {
  const ModelSpec& spec = *parse_model(GetParam()).spec;
  if (std::find(spec.dims.begin(), spec.dims.end(), 2) == spec.dims.end()) GTEST_SKIP() << "three dimensions only";
  const Made made = make(GetParam(), 2);
  Lane lane = busy(made, 40, 3);
  lane.state.pos.row(1) = lane.state.pos.row(0);  // ties are broken in the plane too
  lane.world.add(std::make_unique<Stimuli>(std::vector<Stimulus>{{.start = {1, 1, 0}}}));
  run(made, {.frame_dt = 0.01, .frames = 101}, lane);
  EXPECT_FALSE(lane.blew_up);
  EXPECT_TRUE((lane.state.pos.col(2) == 0).all());
  EXPECT_TRUE((lane.state.vel.col(2) == 0).all());
}

TEST_P(EveryModel, StaysInsideTheBounds) {
  const Made made = make(GetParam());
  for (const auto kind : {Bounds::Kind::box, Bounds::Kind::periodic, Bounds::Kind::sphere}) {
    Lane lane = busy(made, 40, 1);
    lane.world.bounds.kind = kind;
    lane.world.bounds.upper.setOnes();
    lane.world.bounds.centre.setConstant(0.5);
    lane.world.bounds.radius = 0.87;
    run(made, kShort, lane);
    Rows p = lane.state.pos - 0.5;
    if (made.dims == 2) p.col(2) = 0;
    EXPECT_FALSE(lane.blew_up);
    EXPECT_LE(kind == Bounds::Kind::sphere ? std::sqrt(p.square().rowwise().sum().maxCoeff()) / 0.87 : p.abs().maxCoeff() / 0.5, 1 + 1e-12);
  }
}

TEST_P(EveryModel, StaysOutsideObstaclesThatItDoesNotKnow) {
  const Made made = make(GetParam());
  Lane lane = busy(made, 40, 3);
  const Walls walls({{.shape = Obstacle::Shape::box, .lower = {1, 0, 0}, .upper = {1.1, 3, 3}},
                     {.shape = Obstacle::Shape::sphere, .centre = {2, 2, 2}, .radius = 0.6, .wall = Bounds::Wall::slip}});
  lane.world.add(walls.clone());
  Recorded out;
  lane.out = &out;
  run(made, {.frame_dt = 0.01, .frames = 101}, lane);
  EXPECT_FALSE(lane.blew_up);
  for (std::size_t m = 1; m < out.moments.size(); ++m)  // some start inside
    for (Index i = 0; i < lane.state.size(); ++i)
      EXPECT_FALSE(walls.hold(out.moments[m].pos.row(i).transpose(), made.dims)) << "frame " << m;
}

TEST_P(EveryModel, AgentsComeAndGo) {
  const Made made = make(GetParam());
  Lane lane = busy(made, 20, 2);
  std::vector<Presence::Visit> visits;
  for (std::uint32_t k = 0; k < 10; ++k)
    visits.push_back({100 + k, 0, 3 + k, 9 + 2 * k, {1, 1 + 0.1 * k, made.dims == 3 ? 1.0 : 0.0}, {0.3, 0, 0}});
  lane.world.add(std::make_unique<Presence>(visits));
  Recorded out;
  lane.out = &out;
  run(made, kShort, lane);
  ASSERT_FALSE(lane.blew_up);
  for (const auto& moment : out.moments) {
    std::size_t expected = 20;
    for (const auto& v : visits) expected += v.enter <= moment.frame && moment.frame <= v.leave;
    EXPECT_EQ(moment.id.size(), expected) << "frame " << moment.frame;
    EXPECT_EQ(std::set(moment.id.begin(), moment.id.end()).size(), expected);
    EXPECT_TRUE(moment.pos.isFinite().all());
  }
  EXPECT_NEAR(out.moments[3].pos(20, 1), 1, 1e-15);  // where it was recorded
}

// ---- the bounds of fits ---------------------------------------------------------------------------------------------------------

// What a recording looks like from here; random motion of that kind is the start of the simulations.
struct Recording {
  const char* name;
  Index agents;
  Scales scales;
  double dt;
  bool polarised;
};

// Candidates are drawn uniformly within the fit bounds, on the scale on which they are searched. At least a quarter of them must move
// within a factor two of the recorded speed, or the search wastes most of its time (about half do; 100 candidates: ±5 %).
TEST_P(EveryModel, ManyRandomCandidatesMoveAboutAsFastAsTheRecording) {
  const Recording midges{"midges", 10, {.extent = 107, .spacing = 70, .speed = 225}, 0.01, false};
  const Recording jackdaws{"jackdaws", 28, {.extent = 10, .spacing = 2.5, .speed = 11}, 1.0 / 60, true};
  const ModelChoice choice = parse_model(GetParam());
  for (const Recording& r : {midges, jackdaws}) {
    swarmfit::Setup setup;  // not testing::Test::Setup
    const Made plain = make(GetParam());
    const Tracks reference = flight_of(crowd(plain, r.agents, 2 * r.scales.extent, r.scales.speed).state, plain.dims);
    setup.dims = plain.dims;
    setup.reference = &reference;
    setup.scales = r.scales;
    const Made made{choice, make_model(choice, setup), plain.dims};
    Plan plan{.frame_dt = r.dt, .substeps = stable_steps(choice, r.scales, r.dt), .frames = 150};
    int matching = 0;
    const std::uint32_t candidates = 100;
    for (std::uint32_t k = 0; k < candidates; ++k) {
      Lane lane = crowd(made, r.agents, 2 * r.scales.extent, r.scales.speed, k);  // a cube of edge 2 L has the extent L
      if (r.polarised) lane.state.vel.rowwise() = Eigen::Array<double, 1, 3>(r.scales.speed, 0, 0);
      for (std::size_t p = 0; p < lane.p.size(); ++p) {
        const Parameter& row = choice.spec->parameters[p];
        const auto [initial, lower, upper] = row.fit;
        const double u = Rng{77}.uniform(Stream::probe, k, static_cast<std::uint32_t>(p));
        const double drawn = value_at(scale_of(row.log, lower), lower, upper, u);
        lane.p[p] = row.scale(r.scales) * (row.fitted && choice.spec->uses(p, choice.options) ? drawn : initial);
      }
      Recorded out;
      lane.out = &out;
      run(made, plan, lane);
      ASSERT_FALSE(lane.blew_up);
      double speed = 0;
      for (const auto& m : out.moments) speed += m.vel.square().rowwise().sum().sqrt().mean() / static_cast<double>(out.moments.size());
      matching += speed > r.scales.speed / 2 && speed < 2 * r.scales.speed;
    }
    EXPECT_GE(matching, 0.25 * candidates) << r.name;
  }
}

TEST_P(EveryModel, AloneIsFine) {
  const Made made = make(GetParam());
  Lane lane = busy(made, 1, 1);
  run(made, kShort, lane);
  EXPECT_FALSE(lane.blew_up);
  EXPECT_TRUE(lane.state.pos.isFinite().all());
}

}  // namespace
}  // namespace swarmfit
