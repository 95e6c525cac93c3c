// SPDX-License-Identifier: MIT
// Poses in NWB files by the extension ndx-pose: PoseEstimation holds a PoseEstimationSeries per point, each with positions, confidences
// and times. One PoseEstimation is one individual seen by one camera. https://github.com/rly/ndx-pose
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/postures.h"

namespace swarmfit {
namespace {

std::vector<const Hdf5Object*> of_type(const Hdf5Contents& contents, const std::string& under, std::string_view type) {
  std::vector<const Hdf5Object*> out;
  for (const auto& object : contents.objects)
    if (object.path.starts_with(under) && object.text("neurodata_type") == type) out.push_back(&object);
  return out;
}

std::string last_name(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

bool recognises(const Source& source, const ReadOptions&) {
  const auto* contents = source.hdf5();
  return contents && contents->find("/") && !contents->find("/")->text("nwb_version").empty() &&
         !of_type(*contents, "/processing/", "PoseEstimation").empty();
}

const Hdf5Object& choose(const std::vector<const Hdf5Object*>& poses, const std::string& file, const ReadOptions& options) {
  std::vector<std::string> names;
  for (const auto* pose : poses) names.push_back(last_name(pose->path));
  if (options.variable.empty() && poses.size() == 1) return *poses[0];
  const auto hit = std::find(names.begin(), names.end(), options.variable);
  if (hit == names.end())
    throw InputError(fmt::format("{}: there are {} PoseEstimation, {}; expected `var` NAME, one individual seen by one camera", file,
                                 poses.size(), listed(names)));
  return *poses[static_cast<std::size_t>(hit - names.begin())];
}

class Series {
 public:
  Series(const Source& source, const Hdf5Contents& contents, const std::string& path) : file_(source.name), path_(path) {
    const auto* data = contents.find(path + "/data");
    if (!data || data->dims.size() != 2 || (data->dims[1] != 2 && data->dims[1] != 3)) fail("has no data of times x 2 or 3");
    std::vector<Hdf5Request> requests = {{path + "/data"}};
    const auto* times = contents.find(path + "/timestamps");
    if (times) requests.push_back({path + "/timestamps"});
    if (contents.find(path + "/confidence")) requests.push_back({path + "/confidence"});
    auto read = read_hdf5(source.name, source.bytes, requests);
    rows = data->dims[0];
    axes = data->dims[1];
    position = std::move(read[0].numbers);
    const double scale = data->number("conversion").value_or(1), offset = data->number("offset").value_or(0);
    for (double& value : position) value = value * scale + offset;
    unit = data->text("unit");
    if (times) time = std::move(read[1].numbers);
    if (requests.size() > 1u + (times ? 1 : 0)) confidence = std::move(read.back().numbers);
    if (!times) times_from_rate(contents.find(path + "/starting_time"), read_start(source, contents));
    if (time.size() != rows || (!confidence.empty() && confidence.size() != rows)) fail("has arrays of different lengths");
  }

  std::size_t rows = 0, axes = 0;
  std::vector<double> position, time, confidence;
  std::string unit;

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {} {}; expected a series of ndx-pose", file_, path_, what));
  }

  double read_start(const Source& source, const Hdf5Contents& contents) const {
    if (!contents.find(path_ + "/starting_time")) fail("has neither timestamps nor starting_time");
    const auto start = read_hdf5(source.name, source.bytes, {{path_ + "/starting_time"}});
    return start[0].numbers.empty() ? 0 : start[0].numbers[0];
  }

  void times_from_rate(const Hdf5Object* start, double first) {
    const double rate = start->number("rate").value_or(0);
    if (!(rate > 0)) fail("has a starting_time without a rate");
    for (std::size_t i = 0; i < rows; ++i) time.push_back(first + static_cast<double>(i) / rate);
  }

  std::string file_, path_;
};

std::string length_unit(const std::string& stated) {
  if (stated == "pixels" || stated == "pixel") return "px";
  if (stated == "meters" || stated == "meter" || stated == "metres") return "m";
  if (stated == "millimeters") return "mm";
  if (stated == "centimeters") return "cm";
  return stated == "unknown" ? "" : stated;
}

RawTable read(const Source& source, const ReadOptions& options) {
  if (!recognises(source, options))
    throw InputError(source.name + ": there is no PoseEstimation under /processing; expected NWB with poses of ndx-pose");
  const auto& contents = *source.hdf5();
  const auto& pose = choose(of_type(contents, "/processing/", "PoseEstimation"), source.name, options);
  std::vector<std::string> nodes;
  std::vector<Series> series;
  for (const auto* object : of_type(contents, pose.path + "/", "PoseEstimationSeries")) {
    nodes.push_back(last_name(object->path));
    series.emplace_back(source, contents, object->path);
  }
  if (series.empty()) throw InputError(fmt::format("{}: {} holds no PoseEstimationSeries; expected one per point", source.name, pose.path));
  for (const auto& s : series)
    if (s.time != series[0].time || s.axes != series[0].axes || s.unit != series[0].unit)
      throw InputError(
          fmt::format("{}: the points of {} have different times, axes or units; expected the same for all", source.name, pose.path));

  RawTable table;
  table.file = source.name;
  table.unit = length_unit(series[0].unit);
  const auto track = table.names.number(options.variable.empty() ? "1" : last_name(pose.path));
  Postures postures(table, options, nodes);
  const std::size_t axes = series[0].axes;
  const bool sure = std::all_of(series.begin(), series.end(), [](const auto& s) { return !s.confidence.empty(); });
  std::array<std::vector<double>, 4> point;
  for (auto& p : point) p.assign(nodes.size(), kNaN);
  using Span = std::span<const double>;
  for (std::size_t i = 0; i < series[0].rows; ++i) {
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      for (std::size_t a = 0; a < axes; ++a) point[a][n] = series[n].position[i * axes + a];
      if (sure) point[3][n] = series[n].confidence[i];
    }
    postures.add({track, kNaN, series[0].time[i], point[0], point[1], axes == 3 ? Span(point[2]) : Span(), sure ? Span(point[3]) : Span()});
  }
  postures.finish();
  check_numbers(table);
  return table;
}

}  // namespace

const Reader kNwb = {{"nwb", "poses in NWB (HDF5, ndx-pose)", ".nwb"}, recognises, read};

}  // namespace swarmfit
