// SPDX-License-Identifier: MIT
// SLEAP's labels, .slp: an HDF5 file with the tables frames, instances and points; names are JSON. Points that a person set (points)
// count before predicted ones (pred_points) of the same track and frame. Before format 1.1 the centre of a pixel was at 0.5.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/postures.h"

namespace swarmfit {
namespace {

using nlohmann::json;

bool recognises(const Source& source, const ReadOptions&) {
  const auto* contents = source.hdf5();
  return contents && contents->find("/metadata") && contents->find("/instances") && contents->find("/pred_points") &&
         contents->find("/frames") && contents->find("/points");
}

class SlpReader {
 public:
  SlpReader(const Source& source, const ReadOptions& options) : source_(source), options_(options) {
    table_.file = source.name;
    table_.unit = "px";
  }

  RawTable read() {
    read_names();
    read_tables();
    choose_video();
    Postures postures(table_, options_, nodes_);
    const bool tracked = any_track();
    find_replaced();
    for (std::size_t i = 0; i < track_.size(); ++i) keep(i, tracked);
    for (const auto& [key, i] : chosen_) add(postures, key, i);
    postures.finish();
    if (untracked_ > 0) table_.notes.push_back(fmt::format("{} instances without a track were left out", untracked_));
    if (replaced_ > 0)
      table_.notes.push_back(fmt::format("{} predicted instances were left out for those that a person set in their place", replaced_));
    return std::move(table_);
  }

 private:
  using Key = std::pair<std::size_t, double>;  // track and frame

  [[noreturn]] void fail(const std::string& what) const { throw InputError(fmt::format("{}: {}", source_.name, what)); }
  [[noreturn]] void damaged() const { fail("its tables do not fit each other; expected an undamaged file of SLEAP"); }

  void read_names() {
    const auto* metadata = source_.hdf5()->find("/metadata");
    shift_ = metadata->number("format_id").value_or(1) < 1.1 ? -0.5 : 0;
    const auto names = json::parse(metadata->text("json"), nullptr, false);
    try {
      const auto& skeletons = names.at("skeletons");
      if (skeletons.size() != 1) fail(fmt::format("it has {} skeletons; expected one", skeletons.size()));
      for (const auto& node : skeletons.at(0).at("nodes"))
        nodes_.push_back(names.at("nodes").at(node.at("id").get<std::size_t>()).at("name").get<std::string>());
    } catch (const json::exception&) {
      fail("the names of its nodes cannot be read; expected an undamaged file of SLEAP");
    }
    if (nodes_.empty()) fail("its skeleton has no nodes; expected at least one");
  }

  void read_tables() {
    const auto data = read_hdf5(source_.name, source_.bytes,
                                {{"/frames", "frame_id"},
                                 {"/frames", "frame_idx"},
                                 {"/frames", "video"},
                                 {"/instances", "frame_id"},
                                 {"/instances", "instance_type"},
                                 {"/instances", "track"},
                                 {"/instances", "point_id_start"},
                                 {"/instances", "point_id_end"},
                                 {"/points", "x"},
                                 {"/points", "y"},
                                 {"/points", "visible"},
                                 {"/pred_points", "x"},
                                 {"/pred_points", "y"},
                                 {"/pred_points", "visible"},
                                 {"/pred_points", "score"},
                                 {"/instances", "instance_id"},
                                 {"/instances", "from_predicted"}});
    for (std::size_t i = 0; i < data[0].numbers.size(); ++i) frames_[data[0].numbers[i]] = {data[1].numbers[i], data[2].numbers[i]};
    frame_id_ = data[3].numbers;
    predicted_ = data[4].numbers;
    track_ = data[5].numbers;
    start_ = data[6].numbers;
    end_ = data[7].numbers;
    set_ = {data[8].numbers, data[9].numbers, data[10].numbers, std::vector<double>(data[8].numbers.size(), 1)};
    id_ = data[15].numbers;
    from_ = data[16].numbers;
    found_ = {data[11].numbers, data[12].numbers, data[13].numbers, data[14].numbers};
    read_track_names();
  }

  void read_track_names() {
    const auto* tracks = source_.hdf5()->find("/tracks_json");
    if (!tracks || tracks->kind != Hdf5Object::Kind::text) return;
    const auto data = read_hdf5(source_.name, source_.bytes, {{"/tracks_json"}});
    for (const auto& text : data[0].texts) {
      const auto entry = json::parse(text, nullptr, false);
      const bool named = entry.is_array() && entry.size() > 1 && entry[1].is_string();
      names_.push_back(named ? entry[1].get<std::string>() : std::to_string(names_.size()));
    }
  }

  // Frames of several videos are several recordings.
  void choose_video() {
    std::map<double, std::size_t> videos;
    for (const auto& [id, frame] : frames_) ++videos[frame.second];
    if (videos.empty()) fail("there are no frames; expected labelled frames");
    video_ = videos.begin()->first;
    if (videos.size() == 1 && options_.variable.empty()) return;
    const auto hit =
        std::find_if(videos.begin(), videos.end(), [&](const auto& v) { return fmt::format("{}", v.first) == options_.variable; });
    if (hit == videos.end()) {
      std::vector<std::string> shown;
      for (const auto& [video, count] : videos) shown.push_back(fmt::format("{}", video));
      fail(fmt::format("it holds the videos {}; expected `var` NUMBER to choose one", listed(shown)));
    }
    video_ = hit->first;
  }

  bool any_track() const {
    return std::any_of(track_.begin(), track_.end(), [](double t) { return t >= 0; });
  }

  // Predicted instances that a person corrected: the correction says which.
  void find_replaced() {
    for (std::size_t i = 0; i < from_.size(); ++i)
      if (predicted_[i] == 0 && from_[i] >= 0) gone_.insert(from_[i]);
  }

  void keep(std::size_t i, bool tracked) {
    const auto frame = frames_.find(frame_id_[i]);
    if (frame == frames_.end()) damaged();
    if (frame->second.second != video_) return;
    if (predicted_[i] != 0 && gone_.count(id_[i]) > 0) {
      ++replaced_;
      return;
    }
    if (tracked && track_[i] < 0) {
      ++untracked_;
      return;
    }
    const Key key{tracked ? static_cast<std::size_t>(track_[i]) : 0, frame->second.first};
    const auto [entry, fresh] = chosen_.try_emplace(key, i);
    if (fresh) return;
    if (!tracked)
      fail(fmt::format(
          "frame {} has several instances and none has a track: these are detections, not individuals; expected tracked instances",
          key.second));
    if (predicted_[i] == predicted_[entry->second])
      fail(fmt::format("track {} has two instances in frame {}; expected one", key.first, key.second));
    ++replaced_;
    if (predicted_[i] == 0) entry->second = i;
  }

  void add(Postures& postures, const Key& key, std::size_t i) {
    const auto& points = predicted_[i] != 0 ? found_ : set_;
    const auto first = static_cast<std::size_t>(start_[i]), count = nodes_.size();
    if (!(start_[i] >= 0) || end_[i] - start_[i] != static_cast<double>(count) || first + count > points[0].size()) damaged();
    std::array<std::vector<double>, 3> at;
    for (std::size_t n = 0; n < count; ++n) {
      const bool visible = points[2][first + n] != 0;
      at[0].push_back(visible ? points[0][first + n] + shift_ : kNaN);
      at[1].push_back(visible ? points[1][first + n] + shift_ : kNaN);
      at[2].push_back(points[3][first + n]);
    }
    const auto name = key.first < names_.size() ? names_[key.first] : std::to_string(key.first);
    postures.add({table_.names.number(name), key.second, kNaN, at[0], at[1], {}, at[2]});
  }

  const Source& source_;
  const ReadOptions& options_;
  RawTable table_;
  std::vector<std::string> nodes_, names_;
  double shift_ = 0, video_ = 0;
  std::map<double, std::pair<double, double>> frames_;                          // frame_id → frame number and video
  std::vector<double> frame_id_, predicted_, track_, start_, end_, id_, from_;  // of the instances
  std::array<std::vector<double>, 4> set_, found_;                              // of the points: x, y, visible, score
  std::set<double> gone_;                                                       // their ids
  std::map<Key, std::size_t> chosen_;                                           // instance of a track in a frame
  std::size_t untracked_ = 0, replaced_ = 0;
};

RawTable read(const Source& source, const ReadOptions& options) {
  if (!recognises(source, options))
    throw InputError(source.name + ": there are no tables instances, points and frames; expected .slp of SLEAP");
  return SlpReader(source, options).read();
}

}  // namespace

const Reader kSlp = {{"slp", "SLEAP labels", ".slp"}, recognises, read};

}  // namespace swarmfit
