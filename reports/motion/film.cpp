// SPDX-License-Identifier: MIT
#include "reports/motion/film.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr double kSteps = 65535;

using Segment = std::span<const Index>;

std::vector<Segment> segments_of(const Tracks& tracks) {
  std::vector<Segment> segments;
  for_each_segment(tracks, 1, [&](Segment rows) { segments.push_back(rows); });
  return segments;
}

void put(std::string& out, std::uint32_t value) {
  for (int byte = 0; byte < 4; ++byte) out += static_cast<char>(value >> (8 * byte));
}

std::uint32_t index_in(const std::vector<std::int64_t>& clock, std::int64_t frame) {
  const auto found = std::lower_bound(clock.begin(), clock.end(), frame);
  if (found == clock.end() || *found != frame) throw std::invalid_argument("pack: a frame is not in the clock");
  return static_cast<std::uint32_t>(found - clock.begin());
}

std::string table_of(const Tracks& tracks, const std::vector<Segment>& segments, const std::vector<std::int64_t>& clock) {
  std::string out;
  for (const Segment& segment : segments) {
    const auto first = static_cast<std::size_t>(segment.front()), last = static_cast<std::size_t>(segment.back());
    const std::uint32_t start = index_in(clock, tracks.frame()[first]), length = static_cast<std::uint32_t>(segment.size());
    if (index_in(clock, tracks.frame()[last]) != start + length - 1) throw std::invalid_argument("pack: a frame is not in the clock");
    put(out, tracks.track()[first]);
    put(out, start);
    put(out, length);
  }
  return out;
}

// One axis: all low bytes, then all high bytes.
std::string planes_of(const Tracks& tracks, const std::vector<Segment>& segments, int axis, double lower, double step) {
  std::string low, high;
  for (const Segment& segment : segments) {
    std::uint32_t before = 0;
    for (const Index row : segment) {
      const auto code = step > 0 ? static_cast<std::uint32_t>(std::lround((tracks.pos()(row, axis) - lower) / step)) : 0U;
      const std::uint32_t change = code - before;
      low += static_cast<char>(change);
      high += static_cast<char>(change >> 8);
      before = code;
    }
  }
  return low + high;
}

std::string kinds_of(const Tracks& tracks, const std::vector<Segment>& segments) {
  std::string out;
  if (tracks.kinds() < 2) return out;
  for (const Segment& segment : segments)
    for (const Index row : segment) out += static_cast<char>(tracks.kind(row));
  return out;
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                Z_DEFAULT_COMPRESSION) != Z_OK)
    throw RunError("report: cannot compress the film");
  out.resize(size);
  return out;
}

}  // namespace

std::vector<std::int64_t> film_clock(const std::vector<const Tracks*>& films) {
  std::vector<std::int64_t> clock;
  for (const Tracks* film : films)
    for (const FrameRange& frame : film->frames()) clock.push_back(frame.number);
  std::sort(clock.begin(), clock.end());
  clock.erase(std::unique(clock.begin(), clock.end()), clock.end());
  return clock;
}

PackedFilm pack(const Tracks& tracks, const std::vector<std::int64_t>& clock) {
  PackedFilm film;
  film.dims = tracks.dims();
  film.rows = static_cast<std::size_t>(tracks.rows());
  const std::vector<Segment> segments = segments_of(tracks);
  film.runs = segments.size();
  std::string bytes = table_of(tracks, segments, clock);
  for (int axis = 0; axis < film.dims; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    if (film.rows > 0) {
      film.lower[at] = tracks.pos().col(axis).minCoeff();
      film.step[at] = (tracks.pos().col(axis).maxCoeff() - film.lower[at]) / kSteps;
    }
    bytes += planes_of(tracks, segments, axis, film.lower[at], film.step[at]);
  }
  film.bytes = compressed(bytes + kinds_of(tracks, segments));
  return film;
}

}  // namespace swarmfit
