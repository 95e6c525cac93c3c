// SPDX-License-Identifier: MIT
// GPX, versions 1.0 and 1.1: positions in degrees with UTC times, projected to metres. Each track (trk) is an individual; where its
// segments (trkseg) part, nothing was received. Routes and waypoints are plans, not motion. https://www.topografix.com/gpx.asp
#include <fmt/format.h>

#include <pugixml.hpp>

#include "libtrack/error.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/timestamp.h"
#include "libtrack/read/xml_file.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions&) { return xml_root(source.bytes) == "gpx"; }

class GpxReader {
 public:
  explicit GpxReader(const Source& source) : source_(source), document_(parse_xml(source.name, source.bytes)) {
    table_.file = source.name;
    table_.row_name = "track point";
    table_.degrees = true;
    table_.columns = "t,x,y";
  }

  RawTable read() {
    const auto root = document_->child("gpx");
    std::size_t tracks = 0;
    for (const auto track : root.children("trk")) read_track(track, ++tracks);
    if (table_.track.empty())
      throw InputError(fmt::format("{}: there are {} tracks without a point in it; expected track points (trkpt)", source_.name, tracks));
    table_.notes.emplace_back("heights (ele) were left out: those of GPS are rough");
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const {
    throw InputError(fmt::format("{}: {}", xml_place(source_.name, source_.bytes, node), what));
  }

  // Tracks of one name are parts of one individual's.
  void read_track(const pugi::xml_node& track, std::size_t number) {
    const std::string name = track.child("name").text().get();
    const auto individual = table_.names.number(name.empty() ? std::to_string(number) : name);
    for (const auto segment : track.children("trkseg"))
      for (const auto point : segment.children("trkpt")) read_point(point, individual);
  }

  void read_point(const pugi::xml_node& point, std::uint32_t individual) {
    const std::string_view written = point.child("time").text().get();
    if (written.empty()) fail(point, "the point has no time; expected one in every point: without times it is a route and no recording");
    const auto time = parse_timestamp(written);
    if (!time || written.find('-') == std::string_view::npos)
      fail(point, fmt::format("'{}' is not a time; expected ISO 8601", written.substr(0, 40)));
    table_.track.push_back(individual);
    table_[FileColumn::t].push_back(*time);
    table_[FileColumn::x].push_back(degrees(point, "lon"));
    table_[FileColumn::y].push_back(degrees(point, "lat"));
  }

  double degrees(const pugi::xml_node& point, const char* name) const {
    const std::string_view text = point.attribute(name).value();
    const auto value = xml_number(text);
    if (!value) fail(point, fmt::format("{} is '{}'; expected degrees", name, text.substr(0, 40)));
    return *value;
  }

  const Source& source_;
  std::shared_ptr<const pugi::xml_document> document_;
  RawTable table_;
};

RawTable read(const Source& source, const ReadOptions& options) {
  if (!recognises(source, options)) throw InputError(source.name + ": there is no gpx element; expected GPX");
  return GpxReader(source).read();
}

}  // namespace

const Reader kGpx = {{"gpx", "GPX: tracks of GPS receivers in degrees, projected to metres", ".gpx"}, recognises, read};

}  // namespace swarmfit
