// SPDX-License-Identifier: MIT
// Files of TRex, .npz: one individual each, one array per quantity, positions in cm, infinite where it was not seen. X#wcentroid is the
// weighted centre of the body, X#pcentroid that of its posture, X the head; the first of them is the position unless --node says
// otherwise. Walter and Couzin, eLife 10:e64000 (2021), doi:10.7554/eLife.64000.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/frame_clock.h"
#include "libtrack/read/npy.h"
#include "libtrack/read/postures.h"
#include "libtrack/read/unpack.h"

namespace swarmfit {
namespace {

struct Point {
  const char *node, *x, *y;
};
constexpr std::array kPoints = {Point{"wcentroid", "X#wcentroid", "Y#wcentroid"}, Point{"pcentroid", "X#pcentroid", "Y#pcentroid"},
                                Point{"head", "X", "Y"}};

bool has(const ZipFile& zip, const std::string& array) { return zip.has(array + ".npy"); }
bool has(const ZipFile& zip, const Point& point) { return has(zip, point.x) && has(zip, point.y); }

bool recognises(const Source& source, const ReadOptions& options) {
  if (!is_zip(source.bytes) || !options.variable.empty() || !options.columns.empty()) return false;
  const ZipFile zip(source.name, source.bytes);
  return has(zip, "frame") && has(zip, "missing") &&
         std::any_of(kPoints.begin(), kPoints.end(), [&](const auto& p) { return has(zip, p); });
}

// "30_fish.MOV_fish0.npz" → "fish0": TRex puts the individual behind the last underscore.
std::string individual(std::string_view path) {
  path = path.substr(path.find_last_of('/') + 1);
  path = path.substr(0, path.find_last_of('.'));
  const auto cut = path.find_last_of('_');
  return std::string(cut == std::string_view::npos ? path : path.substr(cut + 1));
}

class TrexFile {
 public:
  explicit TrexFile(const Source& source) : name_(source.name), zip_(source.name, source.bytes) {}

  bool has(const std::string& array) const { return swarmfit::has(zip_, array); }
  bool has(const Point& point) const { return swarmfit::has(zip_, point); }
  std::vector<double> array(const std::string& name) {
    auto out = parse_npy(name_, name, zip_.read(name + ".npy"));
    if (rows_ == 0) rows_ = out.value.size();
    if (out.dims.size() != 1 || out.value.size() != rows_)
      throw InputError(
          fmt::format("{}: array '{}' does not have the {} rows of the others; expected one value per frame", name_, out.shown(), rows_));
    return std::move(out.value);
  }

 private:
  std::string name_;
  ZipFile zip_;
  std::size_t rows_ = 0;
};

// Frames by the times of all rows, also of those where nothing was seen: a video that skips images goes on counting its frames. Times
// without a constant interval are left to whoever reports that.
void number_by_time(std::vector<double> all, RawTable& table, std::vector<double>& frame, std::vector<double>& time) {
  const std::array<std::size_t, 2> first = {0, all.size()};
  const bool sound =
      std::all_of(all.begin(), all.end(), [](double t) { return std::isfinite(t); }) && std::is_sorted(all.begin(), all.end());
  const FrameClock clock = sound ? fit_frame_clock(all, first) : FrameClock();
  if (!clock.problem.empty() || clock.dt == 0) {
    time = std::move(all);
    return;
  }
  frame.assign(clock.frame.begin(), clock.frame.end());
  table.dt = clock.dt;
  table.t0 = clock.t0;
}

RawTable read(const Source& source, const ReadOptions& options) {
  if (!recognises(source, options))
    throw InputError(source.name + ": there are no arrays frame, missing and X in it; expected .npz of TRex, without `var` and `columns`");
  TrexFile file(source);
  RawTable table;
  table.file = source.name;
  table.unit = "cm";
  auto frame = file.array("frame");
  std::vector<double> time;
  if (file.has("time")) number_by_time(file.array("time"), table, frame, time);
  std::vector<std::string> nodes;
  std::vector<std::vector<double>> x, y;
  for (const auto& point : kPoints) {
    if (!file.has(point)) continue;
    nodes.emplace_back(point.node);
    x.push_back(file.array(point.x));
    y.push_back(file.array(point.y));
  }
  Postures postures(table, options, nodes, nodes[0]);
  const auto track = table.names.number(individual(source.name));
  std::vector<double> px(nodes.size()), py(nodes.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      px[n] = x[n][i];
      py[n] = y[n][i];
    }
    postures.add({track, time.empty() ? frame[i] : kNaN, time.empty() ? kNaN : time[i], px, py, {}, {}});
  }
  postures.finish();
  table.notes.emplace_back("positions are in cm by the scale that TRex was given (cm_per_pixel)");
  check_numbers(table);
  return table;
}

}  // namespace

const Reader kTrex = {{"trex", "TRex arrays (npz), one individual per file", ".npz"}, recognises, read};

}  // namespace swarmfit
