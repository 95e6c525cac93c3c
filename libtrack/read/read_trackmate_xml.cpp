// SPDX-License-Identifier: MIT
// TrackMate's own XML: spots, edges between them in any order, and which tracks passed the filters; and its simple export of tracks,
// where t is the frame. Tinevez et al., Methods 115:80 (2017), doi:10.1016/j.ymeth.2016.09.016.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <unordered_map>

#include "libtrack/error.h"
#include "libtrack/read/branches.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/xml_file.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions&) {
  const auto root = xml_root(source.bytes);
  return root == "TrackMate" || root == "Tracks";
}

std::string length_unit(std::string_view stated) {
  if (stated == "pixel" || stated == "pixels") return "px";
  if (stated == "micron" || stated == "microns" || stated == "\xC2\xB5m" || stated == "\xCE\xBCm") return "um";
  return std::string(stated);
}

// Seconds; 0: no unit of time, such as frames.
double time_unit(std::string_view stated) {
  struct Unit {
    std::string_view name;
    double seconds;
  };
  constexpr std::array units = {Unit{"s", 1},        Unit{"sec", 1},     Unit{"second", 1},  Unit{"seconds", 1},
                                Unit{"ms", 1e-3},    Unit{"msec", 1e-3}, Unit{"min", 60},    Unit{"minute", 60},
                                Unit{"minutes", 60}, Unit{"h", 3600},    Unit{"hour", 3600}, Unit{"hours", 3600}};
  for (const auto& unit : units)
    if (unit.name == stated) return unit.seconds;
  return 0;
}

class TrackMateReader {
 public:
  explicit TrackMateReader(const Source& source) : source_(source), document_(parse_xml(source.name, source.bytes)) {
    table_.file = source.name;
    table_.row_name = "spot";
  }

  RawTable read() {
    if (const auto simple = document_->child("Tracks"))
      read_simple(simple);
    else
      read_model(document_->child("TrackMate"));
    drop_flat_z();
    return std::move(table_);
  }

 private:
  struct Spot {
    double frame;
    std::array<double, 3> at;
  };

  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const {
    throw InputError(fmt::format("{}: {}", xml_place(source_.name, source_.bytes, node), what));
  }

  double number(const pugi::xml_node& node, const char* attribute) const {
    const std::string_view text = node.attribute(attribute).value();
    if (const auto value = xml_number(text)) return *value;
    fail(node, fmt::format("{} of a {} is '{}'; expected a number", attribute, node.name(), text.substr(0, 40)));
  }

  double whole(const pugi::xml_node& node, const char* attribute) const {
    const double value = number(node, attribute);
    if (value != std::floor(value) || std::abs(value) > 9e15)
      fail(node, fmt::format("{} of a {} is {}; expected a whole number", attribute, node.name(), value));
    return value;
  }

  void units(const char* length, const char* interval, const char* time) {
    table_.unit = length_unit(length);
    table_.dt = xml_number(interval).value_or(0) * time_unit(time);
  }

  void add(const std::string& name, const Spot& spot) {
    table_.track.push_back(table_.names.number(name));
    table_[FileColumn::frame].push_back(spot.frame);
    table_[FileColumn::x].push_back(spot.at[0]);
    table_[FileColumn::y].push_back(spot.at[1]);
    table_[FileColumn::z].push_back(spot.at[2]);
  }

  void read_simple(const pugi::xml_node& tracks) {
    units(tracks.attribute("spaceUnits").value(), tracks.attribute("frameInterval").value(), tracks.attribute("timeUnits").value());
    int k = 0;
    for (const auto particle : tracks.children("particle")) {
      const auto name = std::to_string(k++);
      for (const auto spot : particle.children("detection"))
        add(name, {whole(spot, "t"), {number(spot, "x"), number(spot, "y"), number(spot, "z")}});
    }
  }

  void read_model(const pugi::xml_node& root) {
    const auto model = root.child("Model");
    if (!model) throw InputError(source_.name + ": there is no Model; expected a file that TrackMate saved");
    units(model.attribute("spatialunits").value(), root.child("Settings").child("ImageData").attribute("timeinterval").value(),
          model.attribute("timeunits").value());
    read_spots(model.child("AllSpots"));
    const auto filtered = model.child("FilteredTracks");
    std::set<std::string> kept;
    for (const auto id : filtered.children("TrackID")) kept.insert(id.attribute("TRACK_ID").value());
    std::size_t left_out = 0;
    for (const auto track : model.child("AllTracks").children("Track")) {
      const std::string id = track.attribute("TRACK_ID").value();
      if (!filtered || kept.count(id) > 0)
        read_track(track, id);
      else
        ++left_out;
    }
    if (left_out > 0) table_.notes.push_back(fmt::format("tracks that TrackMate's filters reject, left out: {}", left_out));
    if (cut_ > 0) table_.notes.push_back(fmt::format("tracks that split or merge, cut there: {}, into {} individuals", cut_, pieces_));
    const std::size_t loose = spots_.size() - used_.size();
    if (loose > 0) table_.notes.push_back(fmt::format("spots that belong to no track, left out: {} of {}", loose, spots_.size()));
    if (table_.track.empty()) throw InputError(source_.name + ": there are no tracks in it, only spots; expected tracks");
  }

  void read_spots(const pugi::xml_node& all) {
    for (const auto frame : all.children("SpotsInFrame")) {
      for (const auto spot : frame.children("Spot")) {
        const auto index = static_cast<std::uint32_t>(spots_.size());
        if (!number_of_.emplace(spot.attribute("ID").value(), index).second)
          fail(spot, fmt::format("there is another spot '{}'; expected every ID once", spot.attribute("ID").value()));
        spots_.push_back({whole(spot, "FRAME"), {number(spot, "POSITION_X"), number(spot, "POSITION_Y"), number(spot, "POSITION_Z")}});
        frame_.push_back(spots_.back().frame);
      }
    }
  }

  std::uint32_t spot(const pugi::xml_node& edge, const char* attribute) const {
    const auto hit = number_of_.find(edge.attribute(attribute).value());
    if (hit == number_of_.end())
      fail(edge, fmt::format("there is no spot '{}'; expected the ID of one", edge.attribute(attribute).value()));
    return hit->second;
  }

  void read_track(const pugi::xml_node& track, const std::string& id) {
    Edges edges;
    for (const auto edge : track.children("Edge")) {
      auto from = spot(edge, "SPOT_SOURCE_ID"), to = spot(edge, "SPOT_TARGET_ID");
      if (frame_[from] > frame_[to]) std::swap(from, to);
      if (frame_[from] == frame_[to]) fail(edge, "an edge joins two spots of one frame; expected different frames");
      edges.emplace_back(from, to);
    }
    const auto parts = branches(edges, frame_);
    if (parts.size() > 1) {
      ++cut_;
      pieces_ += parts.size();
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const auto name = parts.size() == 1 ? id : fmt::format("{}-{}", id, k + 1);
      for (const auto at : parts[k]) {
        add(name, spots_[at]);
        used_.insert(at);
      }
    }
  }

  // Flat recordings have a z, too: always the same.
  void drop_flat_z() {
    auto& z = table_[FileColumn::z];
    if (std::adjacent_find(z.begin(), z.end(), std::not_equal_to<>()) == z.end()) z.clear();
  }

  const Source& source_;
  std::shared_ptr<const pugi::xml_document> document_;
  RawTable table_;
  std::vector<Spot> spots_;
  std::vector<double> frame_;  // of the spots
  std::unordered_map<std::string, std::uint32_t> number_of_;
  std::set<std::uint32_t> used_;
  std::size_t cut_ = 0, pieces_ = 0;
};

RawTable read(const Source& source, const ReadOptions&) {
  if (!recognises(source, {})) throw InputError(source.name + ": there is no TrackMate element; expected XML of TrackMate");
  return TrackMateReader(source).read();
}

}  // namespace

const Reader kTrackMateXml = {
    {"trackmate", "TrackMate XML: its own files, with splits and merges, and exported tracks", ".xml"}, recognises, read};

}  // namespace swarmfit
