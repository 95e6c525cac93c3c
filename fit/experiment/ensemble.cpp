// SPDX-License-Identifier: MIT
#include "fit/experiment/ensemble.h"

#include <algorithm>
#include <array>

#include "fit/experiment/checkpointed_batches.h"
#include "fit/experiment/observe.h"
#include "fit/experiment/stop_between_frames.h"
#include "libswarm/mesh.h"
#include "libswarm/walls.h"
#include "libtrack/cut.h"
#include "libtrack/file.h"
#include "libtrack/kinematics.h"

namespace swarmfit {
namespace {

constexpr double kEscapeSpeed = 1e3;  // in units of the recorded mean speed: nothing recorded moves like that

std::string key_of(const std::string& identity, const std::string& name, const Job& job) {
  std::string bytes = identity;
  put(bytes, name);
  put(bytes, job.parameters);
  put(bytes, job.seed);
  return sha256_hex(bytes);
}

void put_places(std::string& bytes, const Tracks& tracks) {
  const TrackColumns& columns = tracks.columns();
  put(bytes, columns.track);
  put(bytes, columns.frame);
  put(bytes, std::vector<double>(columns.pos.data(), columns.pos.data() + columns.pos.size()));
}

// Nothing where the recording brings no world. Of meshes what was read, since their files may change while the world's does not.
void put_world(std::string& bytes, const Conditions& c) {
  if (c.options.world.path.empty()) return;
  put(bytes, c.options.world.text);
  const auto* walls = c.world.part<Walls>();
  for (const Obstacle& o : walls ? walls->obstacles() : std::vector<Obstacle>{}) {
    if (!o.mesh) continue;
    for (const auto& corner : o.mesh->corners())
      for (Index axis = 0; axis < 3; ++axis) put(bytes, corner[axis]);
    for (const Triangle& t : o.mesh->triangles()) put(bytes, std::vector<std::uint32_t>(t.begin(), t.end()));
  }
}

}  // namespace

std::string fingerprint(const Conditions& c) {
  std::string bytes;
  put_places(bytes, c.recording);
  for (int axis = 0; axis < 3; ++axis) put(bytes, std::array{c.sigma[axis], c.grid.step[axis]});
  put(bytes, std::array{c.scales.extent, c.scales.spacing, c.scales.speed, c.scales.unlike});
  put(bytes, c.metrics.lags);
  put(bytes, c.first_frame);
  if (c.reference) put_places(bytes, *c.reference);
  put_world(bytes, c);
  return sha256_hex(bytes);
}

Ensemble::Ensemble(const ModelChoice& model, const Conditions& conditions, const Runtime& runtime)
    : conditions_(conditions), runtime_(runtime), choice_(model) {
  const Tracks& recording = conditions.recording;
  const Tracks* reference = conditions.reference ? conditions.reference.get() : &recording;
  plan_.frame_dt = recording.dt();
  stable_steps_ = swarmfit::stable_steps(model, conditions.scales, recording.dt());
  use_steps(conditions.options.steps > 0 ? conditions.options.steps : stable_steps_);
  plan_.first_frame = conditions.first_frame;
  plan_.frames = conditions.frames;
  plan_.speed_limit = kEscapeSpeed * conditions.scales.speed;
  model_ = make_model(model, {.dims = recording.dims(),
                              .scales = conditions.scales,
                              .reference = reference,
                              .step = plan_.frame_dt / plan_.substeps,
                              .kinds = recording.kinds()});
  if (runtime.checkpoint) under_ = fingerprint(conditions);
}

void Ensemble::use_steps(int steps) { plan_.substeps = choice_.spec->is_map(choice_.options) ? 1 : steps; }

std::string Ensemble::identity(int finer) const { return choice_.name + '\n' + std::to_string(steps() * finer) + '\n' + under_ + '\n'; }

Run Ensemble::run(const Job& job) const {
  const bool as_recorded = conditions_.options.presence == ConditionOptions::Presence::recorded;
  const bool keep_velocity = conditions_.options.velocity == VelocitySource::recorded;
  TrackCollector collector(conditions_.recording.names(), keep_velocity);
  Observer camera(as_recorded ? &conditions_.recording : nullptr, conditions_.sigma, job.seed, collector,
                  static_cast<std::uint32_t>(conditions_.recording.track_count()), conditions_.grid);
  Plan plan = plan_;
  if (!choice_.spec->fixed_step) plan.substeps *= job.finer;
  StopBetweenFrames watched(*runtime_.executor, camera);
  Lane lane{job.parameters, job.seed, State{}, conditions_.world, &watched, {}, false};
  cpu_backend().run(*model_, plan, {&lane, 1});
  TrackMeta meta = conditions_.recording.meta();
  meta.from = {};
  meta.from.synthetic = true;
  Run run{collector.take(meta), lane.count, lane.blew_up};
  if (conditions_.options.smoothing > 0) run.seen = smooth(run.seen, conditions_.options.smoothing);
  const std::int64_t compared = conditions_.recording.frames().front().number;
  if (!as_recorded && compared > plan.first_frame) run.seen = cut(run.seen, compared, plan.first_frame + plan.frames);
  return run;
}

std::vector<std::string> Ensemble::made(std::size_t count, const Executor::Work& work) const {
  if (runtime_.tally && count > 0) {
    Tally& tally = *runtime_.tally;
    tally.made += static_cast<std::int64_t>(count);
    ++tally.batches;
    tally.largest_batch = std::max(tally.largest_batch, count);
  }
  return runtime_.executor->run(count, work);
}

std::vector<std::string> Ensemble::measured_bytes(std::span<const Job> jobs, const std::string& name, const Measure& measure) const {
  const auto make = [&](std::size_t k) { return measure(run(jobs[k]), k); };
  Checkpoint* checkpoint = name.empty() ? nullptr : runtime_.checkpoint;
  if (!checkpoint) return made(jobs.size(), make);

  std::vector<std::string> keys;
  for (const Job& job : jobs) keys.push_back(key_of(identity(job.finer), name, job));
  bool first = true;
  const auto found = [&](std::size_t kept) {
    if (runtime_.tally && first) runtime_.tally->found += static_cast<std::int64_t>(kept);
    first = false;
  };
  const auto work = [&](std::span<const std::size_t> batch) { return made(batch.size(), [&](std::size_t i) { return make(batch[i]); }); };
  return checkpointed_batches(checkpoint, keys, work, found);
}

std::vector<Rng> replicate_seeds(const Rng& root, Stream stream, int replicates) {
  std::vector<Rng> seeds;
  for (int r = 0; r < replicates; ++r) seeds.push_back(root.derive(stream, static_cast<std::uint64_t>(r)));
  return seeds;
}

std::vector<Job> jobs_on(const std::vector<double>& parameters, std::span<const Rng> seeds) {
  std::vector<Job> jobs;
  for (const Rng& seed : seeds) jobs.push_back({parameters, seed});
  return jobs;
}

}  // namespace swarmfit
