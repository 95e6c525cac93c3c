// SPDX-License-Identifier: MIT
#include "libtrack/read/mat_drives.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

// One unbroken drive.
struct Drive {
  int event;                 // its number in the experiment
  std::int64_t first, last;  // frames within the event
};

class Drives {
 public:
  Drives(const MatFile& mat, const std::string& file) : mat_(mat), file_(file) { table_.file = file; }

  RawTable read() {
    table_.dt = number("dt");
    if (!(table_.dt > 0)) fail(fmt::format("the frame interval dt is {}; expected a positive time", table_.dt));
    find_stride();
    for (int k = 1; has(fmt::format("pos_ev_{}", k)); ++k) add_event(k);
    name_individuals();
    table_.columns = table_.has(FileColumn::vx) ? "id,frame,x,y,vx,vy" : "id,frame,x,y";
    table_.notes.push_back(fmt::format("{} drives were read as separate episodes; frame = {} x event + frame within the event",
                                       table_.episodes.size() + 1, stride_));
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(file_ + ": " + what); }

  bool has(const std::string& name) const { return mat_.array.contains(name); }
  const MatArray& array(const std::string& name) const {
    if (!has(name)) fail(fmt::format("variable '{}' is missing; expected it beside pos_ev_k", name));
    return mat_.array.at(name);
  }
  double number(const std::string& name) const {
    const auto& value = array(name).value;
    if (value.size() != 1) fail(fmt::format("variable '{}' has {} values; expected one", name, value.size()));
    return value[0];
  }

  int event_number(int k) const {
    if (!has("events")) return k;
    const auto& events = array("events").value;
    if (static_cast<std::size_t>(k) > events.size())
      fail(fmt::format("events lists {} events; expected one for pos_ev_{}", events.size(), k));
    return static_cast<int>(events[static_cast<std::size_t>(k) - 1]);
  }

  std::vector<Drive> drives_of(int event) const {
    const auto &first = array(fmt::format("ev_st_{}", event)).value, &last = array(fmt::format("ev_et_{}", event)).value;
    if (first.size() != last.size()) fail(fmt::format("ev_st_{0} and ev_et_{0} differ in length; expected one end per start", event));
    std::vector<Drive> out;
    for (std::size_t j = 0; j < first.size(); ++j) {
      if (!(first[j] >= 0 && last[j] >= first[j] && last[j] < 1e9))
        fail(fmt::format("drive {} of event {} ends before it starts; expected ev_st <= ev_et", j + 1, event));
      out.push_back({event, std::llround(first[j]), std::llround(last[j])});
    }
    return out;
  }

  // The smallest power of ten above every frame number.
  void find_stride() {
    std::int64_t highest = 1;
    for (int k = 1; has(fmt::format("pos_ev_{}", k)); ++k)
      for (const auto& drive : drives_of(event_number(k))) highest = std::max(highest, drive.last + 1);
    while (stride_ <= highest) stride_ *= 10;
  }

  void add_event(int k) {
    const auto& pos = array(fmt::format("pos_ev_{}", k));
    const bool moving = has(fmt::format("vel_ev_{}", k));
    const auto vel = moving ? array(fmt::format("vel_ev_{}", k)) : MatArray{};
    if (pos.dims.size() != 3 || pos.dims[1] < 2 || pos.dims[1] > 3) fail(fmt::format("pos_ev_{} is not individuals x 2 x frames", k));
    if (moving && vel.dims != pos.dims) fail(fmt::format("vel_ev_{0} has another size than pos_ev_{0}; expected the same", k));
    if (individuals_ != 0 && individuals_ != pos.dims[0])
      fail(fmt::format("pos_ev_{} has {} individuals; expected {}", k, pos.dims[0], individuals_));
    individuals_ = pos.dims[0];

    const auto drives = drives_of(event_number(k));
    std::int64_t total = 0;
    for (const auto& d : drives) total += d.last - d.first + 1;
    if (total != static_cast<std::int64_t>(pos.dims[2]))
      fail(fmt::format("pos_ev_{} has {} frames; expected the {} of its drives", k, pos.dims[2], total));
    std::size_t at = 0;
    for (const auto& d : drives) {
      const std::int64_t offset = stride_ * d.event;
      if (!table_.track.empty()) table_.episodes.push_back(offset + d.first);
      for (auto f = d.first; f <= d.last; ++f, ++at) add_frame(static_cast<double>(offset + f), pos, vel, at);
    }
  }

  void add_frame(double frame, const MatArray& pos, const MatArray& vel, std::size_t at) {
    constexpr std::array position = {FileColumn::x, FileColumn::y, FileColumn::z},
                         velocity = {FileColumn::vx, FileColumn::vy, FileColumn::vz};
    const std::size_t n = pos.dims[0], dims = pos.dims[1];
    for (std::size_t i = 0; i < n; ++i) {
      table_.track.push_back(static_cast<std::uint32_t>(i));
      table_[FileColumn::frame].push_back(frame);
      for (std::size_t axis = 0; axis < dims; ++axis) {
        const std::size_t cell = i + n * (axis + dims * at);
        table_[position[axis]].push_back(pos.value[cell]);
        if (!vel.value.empty()) table_[velocity[axis]].push_back(vel.value[cell]);
      }
    }
  }

  // The published file has 14 sheep, the dog and the shepherd, in this order; it does not say so itself.
  void name_individuals() {
    const bool published = individuals_ == 16;
    for (std::size_t i = 0; i < individuals_; ++i) {
      const auto name = !published ? std::to_string(i + 1) : i == 14 ? "dog" : i == 15 ? "shepherd" : fmt::format("sheep {:02}", i + 1);
      table_.names.number(name);
    }
    if (!published) return;
    for (const auto track : table_.track) table_[FileColumn::kind].push_back(track == 14 ? 1 : track == 15 ? 2 : 0);
    table_.kinds = {"sheep", "dog", "shepherd"};
    table_.notes.push_back(
        "rows 1 to 14 are sheep (kind 0), row 15 is the dog (kind 1), row 16 the shepherd (kind 2), after Jadhav et al. 2024");
  }

  const MatFile& mat_;
  const std::string& file_;
  RawTable table_;
  std::size_t individuals_ = 0;
  std::int64_t stride_ = 1;
};

}  // namespace

bool has_drives(const MatVariables& variables) {
  const auto* first = find(variables, "pos_ev_1");
  return first && first->numeric && first->dims.size() == 3 && find(variables, "dt");
}

std::vector<std::string> drive_variables(const MatVariables& variables) {
  std::vector<std::string> out;
  for (const auto& v : variables) {
    const bool wanted = v.name == "dt" || v.name == "events" || v.name.starts_with("ev_st_") || v.name.starts_with("ev_et_") ||
                        v.name.starts_with("pos_ev_") || v.name.starts_with("vel_ev_");
    if (wanted) out.push_back(v.name);
  }
  return out;
}

RawTable read_drives(const MatFile& mat, const std::string& file) { return Drives(mat, file).read(); }

}  // namespace swarmfit
