// SPDX-License-Identifier: MIT
#include "fit/experiment/conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "fit/experiment/entry.h"
#include "libeval/order.h"
#include "libswarm/scenario/surroundings.h"
#include "libtrack/cut.h"
#include "libtrack/distributions.h"
#include "libtrack/error.h"
#include "libtrack/kinematics.h"
#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr double kCentral = 0.95;  // a share of all values

// Everybody of the first frame, for the whole length of the recording.
std::vector<Presence::Visit> constant_visits(const Tracks& tracks, std::vector<Presence::Visit> visits) {
  const auto first = tracks.frames().front().number;
  std::erase_if(visits, [&](const Presence::Visit& v) { return v.enter != first; });
  for (auto& v : visits) v.leave = tracks.frames().back().number;
  return visits;
}

// Individuals that were there but not tracked: there throughout, starting where and as fast as somebody was recorded at some time.
std::vector<Presence::Visit> unseen_visits(const Tracks& tracks, const std::vector<Presence::Visit>& recorded, int count) {
  constexpr Rng rng{0};  // the same for all seeds: they are part of the conditions
  std::vector<Presence::Visit> visits;
  for (int k = 0; k < count; ++k) {
    const auto u = rng.uniform2(Stream::start, 0, static_cast<std::uint32_t>(k));
    const auto row = static_cast<Index>(u[0] * static_cast<double>(tracks.rows()));
    const auto& like = recorded[static_cast<std::size_t>(u[1] * static_cast<double>(recorded.size()))];
    visits.push_back({static_cast<std::uint32_t>(tracks.track_count()) + static_cast<std::uint32_t>(k), like.kind,
                      tracks.frames().front().number, tracks.frames().back().number, tracks.pos().row(row).transpose(), like.vel,
                      like.vel_error});
  }
  return visits;
}

double individuals_per_frame(const Tracks& tracks) {
  return static_cast<double>(tracks.rows()) / static_cast<double>(tracks.frames().size());
}

int unseen_individuals(const Tracks& tracks, int population) {
  if (population <= 0) return 0;
  const double seen = individuals_per_frame(tracks);
  if (population < seen)
    throw InputError(
        fmt::format("`population` {}: fewer than the {:.1f} individuals seen per frame; expected at least as many", population, seen));
  return static_cast<int>(std::lround(population - seen));
}

// Would an error of this size make a difference to any metric? Straight flight filmed without error has an error of its own, of rounding
// and of solvers, that no recording's metrics resolve, and with which simulations differ from it in what it does not matter.
bool shows(const Tracks& recording, const Eigen::Array3d& sigma) {
  constexpr std::uint64_t any = 1;
  constexpr double least = 0.01;  // of a metric's spread
  const auto share = error_share(recording, sigma, any);
  return std::any_of(share.begin(), share.end(), [](double s) { return s > least; });
}

double parse_number(std::string_view text, const std::string& whole) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw InputError(fmt::format("`arena` {}: '{}' is not a number; expected open, box, sphere or x0:x1,y0:y1[,z0:z1]", whole, text));
  return value;
}

Bounds box_from_text(const std::string& text, int dims) {
  Bounds bounds;
  bounds.kind = Bounds::Kind::box;
  std::string_view rest = text;
  for (int axis = 0; axis < dims; ++axis) {
    const auto comma = rest.find(',');
    const auto range = rest.substr(0, comma);
    const auto colon = range.find(':');
    if (colon == std::string_view::npos || (comma == std::string_view::npos) != (axis == dims - 1))
      throw InputError(fmt::format("`arena` {}: not an arena; expected open, box, sphere or {} for this recording", text,
                                   dims == 3 ? "x0:x1,y0:y1,z0:z1" : "x0:x1,y0:y1"));
    bounds.lower[axis] = parse_number(range.substr(0, colon), text);
    bounds.upper[axis] = parse_number(range.substr(colon + 1), text);
    if (!(bounds.lower[axis] < bounds.upper[axis]))
      throw InputError(fmt::format("`arena` {}: {} is empty; expected lower:upper with lower < upper", text, range));
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
  }
  return bounds;
}

void require_inside(const Bounds& bounds, const Tracks& recording, const std::string& text) {
  for (int axis = 0; axis < recording.dims(); ++axis) {
    const auto column = recording.pos().col(axis);
    if (column.minCoeff() < bounds.lower[axis] || column.maxCoeff() > bounds.upper[axis])
      throw InputError(fmt::format("`arena` {}: recorded positions reach {:.6g}:{:.6g} along {}; expected an arena that contains them",
                                   text, column.minCoeff(), column.maxCoeff(), "xyz"[axis]));
  }
}

// Arena and obstacles of the file.
void surround(Conditions& c, const WorldFile& file, const std::string& arena) {
  constexpr double kStrays = 0.01;  // localisation errors put some positions into walls
  const Surroundings around = read_surroundings(file.path, file.text, c.recording.dims());
  if (around.bounds.kind == Bounds::Kind::periodic)
    throw InputError(file.path + ": [bounds] shape = 'periodic', where nothing is recorded; expected open, box or sphere");
  if (around.bounds.kind != Bounds::Kind::open) {
    if (arena != "open")
      throw InputError(fmt::format("`arena` {}: is given together with the bounds of {}; expected one of the two", arena, file.path));
    if (around.bounds.kind == Bounds::Kind::box) require_inside(around.bounds, c.recording, file.path);
    c.world.bounds = around.bounds;
  }
  if (around.obstacles.empty()) return;
  auto walls = std::make_unique<Walls>(around.obstacles);
  Index inside = 0;
  for (Index row = 0; row < c.recording.rows(); ++row)
    inside += walls->hold(c.recording.pos().row(row).transpose(), c.recording.dims()) ? 1 : 0;
  if (static_cast<double>(inside) > kStrays * static_cast<double>(c.recording.rows()))
    throw InputError(fmt::format("{}: {} of {} recorded positions are inside an obstacle; expected obstacles that nobody was in", file.path,
                                 inside, c.recording.rows()));
  c.world.add(std::move(walls));
}

// Every frame is simulated, those in which nobody is seen, too: a recording that is nearly all hole would take hours and the whole memory.
void require_no_endless_hole(const Tracks& recording) {
  constexpr std::int64_t most = 20'000'000, long_enough = 100'000, most_per_seen = 100;
  const auto seen = static_cast<std::int64_t>(recording.frames().size());
  if (seen == 0) return;
  const std::int64_t first = recording.frames().front().number, last = recording.frames().back().number, frames = last - first + 1;
  if (frames <= most && (frames <= long_enough || frames / most_per_seen <= seen)) return;
  throw InputError(
      fmt::format("{}: of the {} frames from {} to {} only {} show somebody, and all would be simulated; expected a recording "
                  "without such holes (`frames` takes a part of it)",
                  recording.meta().from.path, frames, first, last, seen));
}

}  // namespace

Eigen::Array3d measurement_error(const Conditions& c) { return (c.sigma.square() + c.grid.step.square() / 12).sqrt(); }

Scales natural_scales(const Tracks& recording) {
  const auto velocity = forward_velocity(recording);
  double speed = 0;
  std::vector<double> speeds;
  for (Index i = 0; i < velocity.rows(); ++i) {
    const double v = std::sqrt(velocity.row(i).square().sum());
    if (std::isfinite(v)) speed += v, speeds.push_back(v);
  }
  speed = speeds.empty() ? 0 : speed / static_cast<double>(speeds.size());
  const double bulk = quantile(speeds, 0.5 + kCentral / 2) - quantile(speeds, 0.5 - kCentral / 2);
  const auto nearest = nearest_neighbours(recording);
  double spacing = 0;
  std::size_t paired = 0;
  for (const double d : nearest.distance)
    if (std::isfinite(d)) spacing += d, ++paired;
  const auto order = order_parameters(recording);
  double square = 0, weight = 0;
  const auto frames = recording.frames();
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (frames[f].count < 2 || !std::isfinite(order.extent[f])) continue;
    square += static_cast<double>(frames[f].count) * order.extent[f] * order.extent[f];
    weight += static_cast<double>(frames[f].count);
  }
  return {weight > 0 ? std::sqrt(square / weight) : 0, paired ? spacing / static_cast<double>(paired) : 0, speed,
          speed > 0 ? bulk / (2 * kNormal95 * speed) : 1};
}

Bounds parse_arena(const std::string& text, const Tracks& recording) {
  Bounds bounds;
  if (text == "open") return bounds;
  if (text == "box") {
    bounds.kind = Bounds::Kind::box;
    bounds.lower = recording.pos().colwise().minCoeff().transpose();
    bounds.upper = recording.pos().colwise().maxCoeff().transpose();
  } else if (text == "sphere") {
    bounds.kind = Bounds::Kind::sphere;
    bounds.centre = recording.pos().colwise().mean().transpose();
    bounds.radius = std::sqrt((recording.pos().rowwise() - bounds.centre.transpose()).square().rowwise().sum().maxCoeff());
  } else {
    bounds = box_from_text(text, recording.dims());
    require_inside(bounds, recording, text);
  }
  return bounds;
}

Conditions make_conditions(const Tracks& recording, const ConditionOptions& options, std::int64_t warm_up) {
  require_no_endless_hole(recording);
  Conditions c;
  c.options = options;
  c.metrics.velocity = options.velocity;
  c.localisation = estimate_localisation(recording);
  c.recording = options.smoothing > 0 ? smooth(recording, options.smoothing) : recording;
  c.scales = natural_scales(recording);
  const std::string& path = recording.meta().from.path;
  if (!(c.scales.speed > 0)) throw InputError(path + ": nothing moves; expected tracks of at least two consecutive frames with motion");
  if (!(c.scales.spacing > 0) || !(c.scales.extent > 0))
    throw InputError(path + ": no frame shows two individuals apart; expected a group, since neighbour distances scale the fit");
  const bool estimated = options.error == ConditionOptions::Error::estimate && c.localisation.white;
  if (estimated && shows(recording, c.localisation.sigma)) c.sigma = c.localisation.sigma;
  if (options.error == ConditionOptions::Error::given) c.sigma = Eigen::Array3d::Constant(options.sigma);
  if (recording.dims() == 2) c.sigma[2] = 0;
  if (options.rounding) c.grid = rounding_grid(recording);
  c.world.dims = recording.dims();
  c.world.bounds = parse_arena(options.arena, recording);
  const auto recorded =
      recorded_visits(recording, c.localisation.white ? c.localisation.sigma : Eigen::Array3d(Eigen::Array3d::Zero()), options.entry);
  auto visits = options.presence == ConditionOptions::Presence::recorded ? recorded : constant_visits(recording, recorded);
  c.unseen = unseen_individuals(recording, options.population);
  const auto unseen = unseen_visits(recording, recorded, c.unseen);
  visits.insert(visits.end(), unseen.begin(), unseen.end());
  c.world.add(std::make_unique<Presence>(std::move(visits)));
  if (!options.world.path.empty()) surround(c, options.world, options.arena);
  // Neighbours of the whole group are nearer than those among the tracked.
  if (options.population > 0) c.scales.spacing *= std::pow(individuals_per_frame(recording) / options.population, 1.0 / recording.dims());
  c.first_frame = recording.frames().front().number;
  c.frames = recording.frames().back().number - c.first_frame + 1;
  if (warm_up > 0) c.recording = cut(c.recording, c.first_frame + warm_up, c.first_frame + c.frames);
  return c;
}

Conditions held_out_conditions(const Tracks& held_out, const Conditions& fitted, std::int64_t warm_up) {
  Conditions c = make_conditions(held_out, fitted.options, warm_up);
  c.scales = fitted.scales;
  c.localisation = fitted.localisation;
  c.sigma = fitted.sigma;
  c.grid = fitted.grid;
  c.metrics = fitted.metrics;
  c.reference = std::make_shared<const Tracks>(fitted.recording);
  return c;
}

}  // namespace swarmfit
