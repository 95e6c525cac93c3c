// SPDX-License-Identifier: MIT
#include "libswarm/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "libtrack/ellipsoid.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr int kHalvings = 3;
// Large groups are put into the order of their places now and then, so that who is near in space is near in memory. Every so many frames,
// counted from frame 0: a run that is stopped and gone on with does it at the same frames.
constexpr Index kSortedFrom = 2000;
constexpr std::int64_t kFramesPerSort = 16;
constexpr std::uint64_t kTicksPerStep = 1u << kHalvings;  // so that every part of a halved step draws numbers of its own

// Everything one lane needs while it runs; allocated once.
class Run {
 public:
  Run(const Model& model, const Plan& plan, Lane& lane)
      : model_(model), plan_(plan), lane_(lane), now_(lane.state), p_(lane.p), work_(model.workspace(lane.world, lane.rng)) {}

  void operator()() {
    for (std::int64_t k = 0; k < plan_.frames && !lane_.blew_up; ++k) {
      const std::int64_t frame = plan_.first_frame + k;
      prepare(frame, 0);
      if (lane_.out) lane_.out->frame({frame, now_.id, now_.kind, now_.pos, now_.vel, &now_.own});
      if (k + 1 < plan_.frames) advance_frame(frame);
    }
  }

 private:
  double dt() const { return plan_.frame_dt / plan_.substeps; }
  double time(std::int64_t frame, int sub) const { return static_cast<double>(frame) * plan_.frame_dt + sub * dt(); }

  // Counted from frame 0, not from the run's first frame: a run may be stopped and gone on with, and draws the same numbers.
  std::uint64_t tick(std::int64_t frame, int sub) const { return static_cast<std::uint64_t>(frame * plan_.substeps + sub) * kTicksPerStep; }

  StepContext context(double t, double length, std::uint64_t tick, int halvings) {
    return {t, length, tick, halvings > 0, p_, lane_.rng, near_, work_.get(), lane_.count};
  }

  // Lets the world move and agents come and go.
  void prepare(std::int64_t frame, int sub) {
    for (const Schedule& s : plan_.schedules) p_[s.parameter] = s.at(time(frame, sub));
    if (plan_.feedback && sub == 0 && frame > 0 && frame % plan_.feedback->every == 0) follow(*plan_.feedback);
    lane_.world.advance({frame, sub, time(frame, sub), dt(), lane_.rng}, now_);
    settle(frame, sub);
    if (sub == 0 && frame % kFramesPerSort == 0 && now_.size() >= kSortedFrom) sort();
  }

  void follow(const DensityFeedback& wanted) {
    constexpr double kMost = 4;
    const double density = ellipsoid_density(now_.pos, lane_.world.dims);
    if (!(density > 0)) return;
    const double factor = std::pow(density / wanted.density, 1.0 / lane_.world.dims);
    wider_ = std::clamp(wider_ * factor, 1 / kMost, kMost);
    for (const std::size_t parameter : wanted.parameters) p_[parameter] = wider_ * lane_.p[parameter];
  }

  void sort() {
    near_.build(now_.pos, lane_.world.bounds, std::numeric_limits<double>::infinity(), Neighbours::Method::grid);
    now_.reorder(near_.rows());
    next_ = now_;
  }

  // Newcomers get their private columns, and the second buffer the same agents as the first.
  void settle(std::int64_t frame, int sub) {
    if (now_.own.cols() != model_.columns()) now_.own.setZero(now_.size(), model_.columns());
    if (now_.entered < now_.size()) {
      const Index first = now_.entered;
      now_.entered = now_.size();
      model_.enter(now_, first, lane_.world, context(time(frame, sub), dt(), tick(frame, sub), kHalvings));
    }
    if (next_.id != now_.id || next_.kind != now_.kind) next_ = now_;
    next_.entered = now_.entered;
    next_.next_id = now_.next_id;
  }

  void advance_frame(std::int64_t frame) {
    for (int sub = 0; sub < plan_.substeps && !lane_.blew_up; ++sub) {
      if (sub > 0) prepare(frame, sub);
      advance(time(frame, sub), dt(), tick(frame, sub), kHalvings);
    }
  }

  // One step, or two halves of it if the model asks for that.
  void advance(double t, double length, std::uint64_t tick, int halvings) {
    if (now_.size() == 0 || lane_.blew_up) return;
    if (now_.own.cols() > 0) next_.own = now_.own;
    StepContext c = context(t, length, tick, halvings);
    if (model_.update() == Update::sequential) c.order = take_turns(tick);
    switch (model_.step(now_, next_, lane_.world, c)) {
      case Step::done:
        return accept();
      case Step::halve_dt:
        if (halvings == 0) throw InputError(ask_too_much(t));
        ++lane_.count.halved_steps;
        advance(t, length / 2, tick, halvings - 1);
        return advance(t + length / 2, length / 2, tick + (std::uint64_t{1} << (halvings - 1)), halvings - 1);
      case Step::blew_up:
        lane_.blew_up = true;
        return;
    }
  }

  // Everybody begins where they are; the order of moves depends on ids, not on rows.
  std::span<const Index> take_turns(std::uint64_t tick) {
    next_.pos = now_.pos;
    next_.vel = now_.vel;
    turns_.clear();
    for (Index row = 0; row < now_.size(); ++row) {
      const std::uint32_t id = now_.id[static_cast<std::size_t>(row)];
      turns_.push_back({lane_.rng.uniform(Stream::order, tick, id), id, row});
    }
    std::sort(turns_.begin(), turns_.end(), [](const Turn& a, const Turn& b) { return std::tie(a.draw, a.id) < std::tie(b.draw, b.id); });
    order_.clear();
    for (const Turn& turn : turns_) order_.push_back(turn.row);
    return order_;
  }

  std::string ask_too_much(double t) const {
    return fmt::format(
        "model {}: asks for half a step at {:g} s, after {} halvings; expected a step as long as it is where it may not halve",
        model_.name(), t, kHalvings);
  }

  void accept() {
    std::swap(now_.pos, next_.pos);
    std::swap(now_.vel, next_.vel);
    std::swap(now_.own, next_.own);
    lane_.world.constrain(next_, now_);
    lane_.count.agent_steps += static_cast<std::uint64_t>(now_.size());
    lane_.blew_up = !sane();
  }

  // Finite positions and speeds within the limit. A NaN fails every comparison.
  bool sane() const {
    const double limit2 = std::min(plan_.speed_limit * plan_.speed_limit, std::numeric_limits<double>::max());
    bool sane = true;
    for (Index i = 0; i < now_.size(); ++i) {
      const double vx = now_.vel(i, 0), vy = now_.vel(i, 1), vz = now_.vel(i, 2);
      const double sum = now_.pos(i, 0) + now_.pos(i, 1) + now_.pos(i, 2);
      sane &= (vx * vx + vy * vy + vz * vz <= limit2) & (std::abs(sum) <= 1e300);
    }
    return sane;
  }

  const Model& model_;
  const Plan& plan_;
  Lane& lane_;
  State& now_;
  State next_;
  std::vector<double> p_;
  double wider_ = 1;  // than at the start: parameters that follow the density
  std::unique_ptr<Workspace> work_;
  Neighbours near_;
  struct Turn {
    double draw;
    std::uint32_t id;
    Index row;
  };
  std::vector<Turn> turns_;  // of sequential models
  std::vector<Index> order_;
};

struct CpuBackend : Backend {
  void run(const Model& model, const Plan& plan, std::span<Lane> lanes) const override {
    for (Lane& lane : lanes) Run(model, plan, lane)();
  }
};

}  // namespace

double Schedule::at(double t) const {
  if (t <= keys.front().first) return keys.front().second;
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const auto& [t0, a] = keys[k - 1];
    const auto& [t1, b] = keys[k];
    if (t < t1) return a + (b - a) * (t - t0) / (t1 - t0);
  }
  return keys.back().second;
}

const Backend& cpu_backend() {
  static const CpuBackend backend;
  return backend;
}

int stable_steps(const ModelChoice& model, const Scales& scales, double frame_dt) {
  if (model.spec->is_map(model.options)) return 1;
  const double steps = frame_dt / (model.spec->largest_dt * scales.time());
  return std::max(1, static_cast<int>(std::ceil(steps - 1e-9)));
}

}  // namespace swarmfit
