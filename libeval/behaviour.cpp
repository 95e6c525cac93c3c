// SPDX-License-Identifier: MIT
#include "libeval/behaviour.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "libeval/following.h"
#include "libtrack/ellipsoid.h"
#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/quantile.h"
#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// ---- what was asked --------------------------------------------------------------------------------------------------------------

double number(const Questions& asked, std::string_view name, double otherwise) {
  const auto found = asked.find(name);
  return found == asked.end() ? otherwise : found->second.front();
}

Array3d place(const Questions& asked, std::string_view name) {
  Array3d p = Array3d::Zero();
  const auto found = asked.find(name);
  if (found == asked.end()) return p;
  for (std::size_t k = 0; k < std::min<std::size_t>(3, found->second.size()); ++k) p[static_cast<Index>(k)] = found->second[k];
  return p;
}

bool in_window(const Tracks& tracks, std::int64_t frame, const Questions& asked) {
  constexpr double kSlack = 1e-6;  // of a frame
  const double t = tracks.time(frame), slack = kSlack * tracks.dt();
  return t >= number(asked, "from", -HUGE_VAL) - slack && t <= number(asked, "until", HUGE_VAL) + slack;
}

std::vector<FrameRange> window(const Tracks& tracks, const Questions& asked) {
  std::vector<FrameRange> some;
  for (const FrameRange& f : tracks.frames())
    if (in_window(tracks, f.number, asked)) some.push_back(f);
  return some;
}

// ---- what is seen ----------------------------------------------------------------------------------------------------------------

// Mean over the frames of the window of what `of` finds in each; frames where that is NaN have no part.
template <class Of>
double mean_over(const Tracks& tracks, const Questions& asked, Of&& of) {
  double sum = 0;
  int count = 0;
  for (const FrameRange& f : window(tracks, asked)) {
    const double value = of(f);
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / count : kNaN;
}

Array3d at(const Tracks& tracks, Index row) { return tracks.pos().row(row).transpose(); }

Array3d centre(const Tracks& tracks, const FrameRange& f) {
  Array3d sum = Array3d::Zero();
  for (Index row = f.first; row < f.first + f.count; ++row) sum += at(tracks, row);
  return sum / static_cast<double>(f.count);
}

// Displacement to the next frame; zero if there is none.
Array3d step(const Tracks& tracks, Index row) {
  const Index next = tracks.next()[static_cast<std::size_t>(row)];
  return next < 0 ? Array3d(Array3d::Zero()) : Array3d(at(tracks, next) - at(tracks, row));
}

double polarisation(const Witness& w, const Questions& asked) {
  return mean_over(w.agents, asked, [&](const FrameRange& f) {
    Array3d sum = Array3d::Zero();
    int moving = 0;
    for (Index row = f.first; row < f.first + f.count; ++row)
      if (const Array3d s = step(w.agents, row); length(s) > 0) sum += s / length(s), ++moving;
    return moving > 1 ? length(sum) / moving : kNaN;
  });
}

// |mean of r̂ × v̂| about a place, or about the centre of the group.
double rotation(const Witness& w, const Questions& asked) {
  return mean_over(w.agents, asked, [&](const FrameRange& f) {
    const Array3d about = asked.contains("centre") ? place(asked, "centre") : centre(w.agents, f);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int moving = 0;
    for (Index row = f.first; row < f.first + f.count; ++row) {
      const Array3d r = at(w.agents, row) - about, s = step(w.agents, row);
      if (length(r) == 0 || length(s) == 0) continue;
      sum += (r / length(r)).matrix().cross((s / length(s)).matrix());
      ++moving;
    }
    return moving > 1 ? sum.norm() / moving : kNaN;
  });
}

double radius(const Witness& w, const Questions& asked) {
  return mean_over(w.agents, asked, [&](const FrameRange& f) {
    const Array3d about = asked.contains("centre") ? place(asked, "centre") : centre(w.agents, f);
    double sum = 0;
    for (Index row = f.first; row < f.first + f.count; ++row) sum += length(at(w.agents, row) - about);
    return sum / static_cast<double>(f.count);
  });
}

double extent(const Witness& w, const Questions& asked) {
  return mean_over(w.agents, asked, [&](const FrameRange& f) {
    const Array3d middle = centre(w.agents, f);
    double sum = 0;
    for (Index row = f.first; row < f.first + f.count; ++row) {
      const Array3d r = at(w.agents, row) - middle;
      sum += dot(r, r);
    }
    return f.count > 1 ? std::sqrt(sum / static_cast<double>(f.count)) : kNaN;
  });
}

double spacing(const Witness& w, const Questions& asked) {
  const auto frames = window(w.agents, asked);
  if (frames.empty()) return kNaN;
  const FrameRange& f = frames.back();  // all pairs: one frame is enough
  double sum = 0;
  for (Index a = f.first; a < f.first + f.count; ++a) {
    double least = HUGE_VAL;
    for (Index b = f.first; b < f.first + f.count; ++b)
      if (a != b) least = std::min(least, length(at(w.agents, b) - at(w.agents, a)));
    sum += least;
  }
  return f.count > 1 ? sum / static_cast<double>(f.count) : kNaN;
}

double speed(const Witness& w, const Questions& asked) {
  return mean_over(w.agents, asked, [&](const FrameRange& f) {
    double sum = 0;
    int moving = 0;
    for (Index row = f.first; row < f.first + f.count; ++row)
      if (w.agents.next()[static_cast<std::size_t>(row)] >= 0) sum += length(step(w.agents, row)) / w.agents.dt(), ++moving;
    return moving > 0 ? sum / moving : kNaN;
  });
}

double density(const Witness& w, const Questions& asked) {
  return mean_over(w.agents, asked,
                   [&](const FrameRange& f) { return ellipsoid_density(w.agents.pos().middleRows(f.first, f.count), w.agents.dims()); });
}

double count(const Witness& w, const Questions& asked) {
  return mean_over(w.agents, asked, [](const FrameRange& f) { return static_cast<double>(f.count); });
}

double drift(const Witness& w, const Questions& asked) {
  const auto frames = window(w.agents, asked);
  return frames.empty() ? kNaN : length(centre(w.agents, frames.back()) - centre(w.agents, frames.front()));
}

double progress(const Witness& w, const Questions& asked) {
  const auto frames = window(w.agents, asked);
  const Array3d along = place(asked, "along");
  return frames.empty() ? kNaN : dot(centre(w.agents, frames.back()) - centre(w.agents, frames.front()), along) / length(along);
}

// Positions where nobody is allowed.
double trespass(const Witness& w, const Questions& asked) {
  double sum = 0;
  for (const FrameRange& f : window(w.agents, asked))
    for (Index row = f.first; row < f.first + f.count; ++row) sum += w.forbidden && w.forbidden(at(w.agents, row)) ? 1 : 0;
  return sum;
}

// ---- stimuli and goals -----------------------------------------------------------------------------------------------------------

// Distances of everybody to the nearest stimulus at a frame; none if there is no stimulus then.
std::vector<double> to_stimulus(const Witness& w, const FrameRange& f) {
  std::vector<double> distances;
  if (!w.stimuli) return distances;
  const auto frames = w.stimuli->frames();
  const auto now =
      std::lower_bound(frames.begin(), frames.end(), f.number, [](const FrameRange& a, std::int64_t n) { return a.number < n; });
  if (now == frames.end() || now->number != f.number || now->count == 0) return distances;
  for (Index row = f.first; row < f.first + f.count; ++row) {
    double least = HUGE_VAL;
    for (Index s = now->first; s < now->first + now->count; ++s) least = std::min(least, length(at(w.agents, row) - at(*w.stimuli, s)));
    distances.push_back(least);
  }
  return distances;
}

double stimulus_distance(const Witness& w, const Questions& asked) {
  return mean_over(w.agents, asked, [&](const FrameRange& f) { return median(to_stimulus(w, f)); });
}

double nearest_to_stimulus(const Witness& w, const Questions& asked) {
  double least = HUGE_VAL;
  for (const FrameRange& f : window(w.agents, asked))
    for (const double d : to_stimulus(w, f)) least = std::min(least, d);
  return std::isfinite(least) ? least : kNaN;
}

double share(std::size_t some, const Tracks& of) {
  return of.track_count() > 0 ? static_cast<double>(some) / static_cast<double>(of.track_count()) : kNaN;
}

double met(const Witness& w, const Questions& asked) {
  std::set<std::uint32_t> who;
  for (const FrameRange& f : window(w.agents, asked)) {
    const auto d = to_stimulus(w, f);
    for (std::size_t k = 0; k < d.size(); ++k)
      if (d[k] <= number(asked, "radius", 0)) who.insert(w.agents.track()[static_cast<std::size_t>(f.first) + k]);
  }
  return share(who.size(), w.agents);
}

bool in_region(const Array3d& p, const Questions& asked, int dims) {
  const Array3d lower = place(asked, "lower"), upper = place(asked, "upper");
  bool inside = true;
  for (Index axis = 0; axis < dims; ++axis) inside = inside && lower[axis] <= p[axis] && p[axis] <= upper[axis];
  return inside;
}

double arrived(const Witness& w, const Questions& asked) {
  std::set<std::uint32_t> who;
  for (const FrameRange& f : window(w.agents, asked))
    for (Index row = f.first; row < f.first + f.count; ++row)
      if (in_region(at(w.agents, row), asked, w.agents.dims())) who.insert(w.agents.track()[static_cast<std::size_t>(row)]);
  return share(who.size(), w.agents);
}

double present(const Witness& w, const Questions& asked) {
  return mean_over(w.agents, asked, [&](const FrameRange& f) {
    int inside = 0;
    for (Index row = f.first; row < f.first + f.count; ++row) inside += in_region(at(w.agents, row), asked, w.agents.dims()) ? 1 : 0;
    return static_cast<double>(inside) / static_cast<double>(f.count);
  });
}

Following along_curve(const Witness& w, const Questions& asked) {
  return w.curve ? following(w.agents, window(w.agents, asked), *w.curve, w.reach) : Following{};
}

double off_curve(const Witness& w, const Questions& asked) { return w.curve ? along_curve(w, asked).distance / w.curve->spacing() : kNaN; }

double curve_covered(const Witness& w, const Questions& asked) { return along_curve(w, asked).coverage; }

const std::vector<Behaviour>& table() {
  static const std::vector<Behaviour> all{
      {"polarisation", "length of the mean heading, mean over the times", {}, {}, polarisation},
      {"rotation", "length of the mean of r̂ × v̂ about `centre`, or about the group's own", {}, {"centre"}, rotation},
      {"radius", "mean distance from `centre`, or from the group's own", {}, {"centre"}, radius},
      {"extent", "root-mean-square distance from the group's centre", {}, {}, extent},
      {"spacing", "mean distance to the nearest neighbour, at the last of the times", {}, {}, spacing},
      {"density", "agents per volume of the ellipsoid of two standard deviations", {}, {}, density},
      {"speed", "mean speed", {}, {}, speed},
      {"count", "mean number of agents", {}, {}, count},
      {"drift", "distance between the group's first and last centre", {}, {}, drift},
      {"progress", "way of the group's centre in the direction `along`", {"along"}, {}, progress},
      {"trespass", "positions inside an obstacle or beyond the bounds, of all agents at all frames", {}, {}, trespass},
      {"enforced",
       "share of agents and steps that minimum-distance enforcement moved",
       {},
       {},
       [](const Witness& w, const Questions&) { return w.enforced; }},
      {"stimulus_distance", "median distance to the nearest stimulus, mean over the times", {}, {}, stimulus_distance},
      {"nearest_to_stimulus", "least distance of any agent from a stimulus at any of the times", {}, {}, nearest_to_stimulus},
      {"met", "share of all agents that were within `radius` of a stimulus at any of the times", {"radius"}, {}, met},
      {"arrived", "share of all agents that were between `lower` and `upper` at any of the times", {"lower", "upper"}, {}, arrived},
      {"present", "share of agents between `lower` and `upper`, mean over the times", {"lower", "upper"}, {}, present},
      {"off_curve", "mean distance from the curve, in mean distances of its key points", {}, {}, off_curve},
      {"curve_covered", "share of the curve that somebody is near, mean over the times", {}, {}, curve_covered},
  };
  return all;
}

const Behaviour& find(std::string_view name) {
  const auto all = behaviours();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Behaviour& b) { return b.name == name; });
  if (found != all.end()) return *found;
  std::vector<std::string_view> names;
  for (const Behaviour& b : all) names.push_back(b.name);
  throw InputError(fmt::format("measure '{}': unknown; expected one of {}", name, fmt::join(names, ", ")));
}

}  // namespace

std::span<const Behaviour> behaviours() { return table(); }

void check_question(std::string_view measure, const Questions& asked) {
  const Behaviour& b = find(measure);
  std::vector<std::string_view> known = b.needs;
  known.insert(known.end(), b.may.begin(), b.may.end());
  for (const std::string_view always : {"from", "until", "relative_to"}) known.push_back(always);
  for (const auto& [name, values] : asked) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("measure {}: '{}' is not known; expected one of {}", measure, name, fmt::join(known, ", ")));
    const bool one = name == "from" || name == "until" || name == "radius";
    const std::size_t least = one ? 1 : 2, most = one ? 1 : name == "relative_to" ? 2 : 3;
    if (values.size() < least || values.size() > most)
      throw InputError(fmt::format("measure {}: {} has {} numbers; expected {}", measure, name, values.size(),
                                   least == most ? fmt::format("{}", most) : "2 or 3"));
  }
  for (const auto name : b.needs)
    if (!asked.contains(name)) throw InputError(fmt::format("measure {}: no {}; expected {} = ...", measure, name, name));
}

double observed(std::string_view measure, const Witness& seen, const Questions& asked) {
  check_question(measure, asked);
  const Behaviour& b = find(measure);
  const double value = b.of(seen, asked);
  const auto relative = asked.find("relative_to");
  if (relative == asked.end()) return value;
  Questions other = asked;
  other["from"] = {relative->second[0]};
  other["until"] = {relative->second[1]};
  return value / b.of(seen, other);
}

}  // namespace swarmfit
