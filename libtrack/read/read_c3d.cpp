// SPDX-License-Identifier: MIT
// C3D, motion capture: every point is an individual, named by POINT:LABELS; where all labels are subject:marker, as Vicon writes them, a
// subject is an individual and its markers are points of it. Rate and unit are in the file.
#include <fmt/format.h>

#include <unordered_map>
#include <unordered_set>

#include "libtrack/nan.h"
#include "libtrack/read/c3d_file.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/postures.h"
#include "libtrack/read/units.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions&) { return is_c3d(source.bytes); }

// LABELS holds 255 names at most, LABELS2, LABELS3, ... the others. A name that is missing or comes again gets a number.
std::vector<std::string> labels_of(const C3dFile& file) {
  std::vector<std::string> out;
  for (int part = 1;; ++part) {
    const auto* labels = file.parameter(part == 1 ? "LABELS" : fmt::format("LABELS{}", part));
    if (!labels) break;
    out.insert(out.end(), labels->texts.begin(), labels->texts.end());
  }
  out.resize(file.points());
  std::unordered_set<std::string> seen;
  std::unordered_map<std::string, int> times;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (out[k].empty()) out[k] = fmt::format("point {}", k + 1);
    const std::string name = out[k];
    while (!seen.insert(out[k]).second) out[k] = fmt::format("{}-{}", name, ++times.try_emplace(name, 1).first->second);
  }
  return out;
}

void add_points(RawTable& table, const C3dFile& file, const std::vector<std::string>& labels) {
  std::size_t unseen = 0;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const auto track = table.names.number(labels[k]);
    for (std::size_t f = 0; f < file.frames(); ++f) {
      const auto point = file.at(f, k);
      if (!point && ++unseen) continue;
      table.track.push_back(track);
      table[FileColumn::frame].push_back(file.first_frame() + static_cast<double>(f));
      table[FileColumn::x].push_back(point->x);
      table[FileColumn::y].push_back(point->y);
      table[FileColumn::z].push_back(point->z);
    }
  }
  table.notes.emplace_back("every point is an individual");
  if (unseen > 0) table.notes.push_back(fmt::format("{} of {} positions were not seen", unseen, labels.size() * file.frames()));
}

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// Names in the order in which they come.
struct Numbered {
  std::vector<std::string> names;
  std::unordered_map<std::string, std::size_t> number;
  std::size_t operator()(const std::string& name) {
    const auto [at, added] = number.try_emplace(name, names.size());
    if (added) names.push_back(name);
    return at->second;
  }
};

struct Subjects {
  std::vector<std::string> names, markers;
  std::vector<std::vector<std::size_t>> point;  // by subject and marker; kNone: the subject has none of this name
};

// None where not all labels are subject:marker, or subjects share so few markers that a table of both would be mostly empty.
Subjects subjects_of(const std::vector<std::string>& labels) {
  Numbered subjects, markers;
  std::vector<std::pair<std::size_t, std::size_t>> place;
  for (const auto& label : labels) {
    const auto colon = label.find(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == label.size()) return {};
    place.emplace_back(subjects(label.substr(0, colon)), markers(label.substr(colon + 1)));
  }
  if (subjects.names.size() * markers.names.size() > 4 * labels.size()) return {};
  Subjects out{subjects.names, markers.names, {}};
  out.point.assign(out.names.size(), std::vector<std::size_t>(out.markers.size(), kNone));
  for (std::size_t k = 0; k < place.size(); ++k) out.point[place[k].first][place[k].second] = k;
  return out;
}

void add_subjects(RawTable& table, const C3dFile& file, const Subjects& subjects, const ReadOptions& options) {
  Postures postures(table, options, subjects.markers);
  std::vector<double> x(subjects.markers.size()), y(x), z(x);
  for (std::size_t s = 0; s < subjects.names.size(); ++s) {
    const auto track = table.names.number(subjects.names[s]);
    for (std::size_t f = 0; f < file.frames(); ++f) {
      for (std::size_t m = 0; m < x.size(); ++m) {
        const std::size_t k = subjects.point[s][m];
        const auto point = k == kNone ? std::nullopt : file.at(f, k);
        x[m] = point ? point->x : kNaN;
        y[m] = point ? point->y : kNaN;
        z[m] = point ? point->z : kNaN;
      }
      postures.add({track, file.first_frame() + static_cast<double>(f), kNaN, x, y, z, {}});
    }
  }
  postures.finish();
}

RawTable read(const Source& source, const ReadOptions& options) {
  const C3dFile file(source.name, source.bytes);
  RawTable table;
  table.file = source.name;
  const auto labels = labels_of(file);
  if (const auto subjects = subjects_of(labels); !subjects.names.empty())
    add_subjects(table, file, subjects, options);
  else
    add_points(table, file, labels);
  if (file.rate() > 0) table.dt = 1 / file.rate();
  if (const auto* units = file.parameter("UNITS"); units && !units->texts.empty())
    table.unit = length_unit(units->texts[0]).value_or(units->texts[0]);
  return table;
}

}  // namespace

const Reader kC3d = {{"c3d", "C3D, motion capture: a label per point, or subject:marker", ".c3d"}, recognises, read};

}  // namespace swarmfit
