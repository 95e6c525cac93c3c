// SPDX-License-Identifier: MIT
// The one way from raw rows to Tracks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "libtrack/counting_sort.h"
#include "libtrack/error.h"
#include "libtrack/fill_gaps.h"
#include "libtrack/read/frame_steps.h"
#include "libtrack/read/missing.h"
#include "libtrack/read/number_frames.h"
#include "libtrack/read/project.h"
#include "libtrack/read/raw_table.h"
#include "libtrack/resample.h"
#include "libtrack/utf8.h"

namespace swarmfit {
namespace {

constexpr std::array kPosition = {FileColumn::x, FileColumn::y, FileColumn::z};
constexpr std::array kVelocity = {FileColumn::vx, FileColumn::vy, FileColumn::vz};
constexpr std::array kAcceleration = {FileColumn::ax, FileColumn::ay, FileColumn::az};

std::string plural(std::size_t n, std::string_view one, std::string_view many) { return fmt::format("{} {}", n, n == 1 ? one : many); }

// Whole numbers by value, then everything else by letters.
bool natural_order(const std::string& a, const std::string& b) {
  const auto whole = [](const std::string& s) { return !s.empty() && s.find_first_not_of("0123456789") == std::string::npos; };
  if (whole(a) != whole(b)) return whole(a);
  if (whole(a) && a.size() != b.size()) return a.size() < b.size();
  return a < b;
}

// The work of assemble(), in the order of its member functions.
class Assembly {
 public:
  Assembly(RawTable& table, const ReadOptions& options) : table_(table), options_(options), dims_(table.has(FileColumn::z) ? 3 : 2) {}

  Tracks run(std::string sha256) {
    check_columns();
    check_stated();
    leave_out_codes(table_, options_);
    if (table_.degrees) project_degrees(table_);
    demand_flags();
    std::vector<std::uint32_t> seen = drop_unseen();
    order_rows(seen);
    auto [frame, dt, t0] = number_frames(table_, options_, order_, first_);
    frame_ = std::move(frame), dt_ = dt, t0_ = t0;
    check_individuals();
    select();
    drop_duplicates();
    TrackMeta meta = describe(std::move(sha256));
    number_tracks();
    const bool by_track = options_.fill_gaps > 0 || options_.resample;
    if (!by_track) sort_by_frame();
    TrackColumns columns = gather();
    merge_steps(columns, meta);
    if (options_.resample) resample(columns, meta, *options_.resample);
    if (options_.fill_gaps > 0) fill_gaps(columns, options_.fill_gaps, meta.from.notes);
    table_ = {};
    return Tracks(std::move(columns), std::move(meta));
  }

 private:
  bool has(FileColumn c) const { return table_.has(c); }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(table_.file + ": " + what); }
  void note(std::string text) { table_.notes.push_back(std::move(text)); }

  // A vector is used only when all its components are there.
  bool complete(const std::array<FileColumn, 3>& vector) const {
    return has(vector[0]) && has(vector[1]) && (dims_ == 2 || has(vector[2]));
  }

  void check_columns() {
    if (table_.track.empty()) fail("there are no rows; expected at least one");
    if (!has(FileColumn::frame) && !has(FileColumn::t)) fail("there is neither a frame nor a time column; expected frame or t");
    note_if_incomplete(kVelocity, "velocity");
    note_if_incomplete(kAcceleration, "acceleration");
  }

  // What the file says of itself: usable numbers, a unit of one word or several.
  void check_stated() {
    constexpr double shortest = 1e-30, longest = 1e30;  // wider than any interval that times can have
    if (!(table_.dt == 0 || (table_.dt >= shortest && table_.dt <= longest)) || !std::isfinite(table_.t0))
      fail(
          fmt::format("the file states a frame interval of {:g} s and {:g} s for frame 0; expected finite numbers, the first from {:g} "
                      "to {:g}",
                      table_.dt, table_.t0, shortest, longest));
    table_.unit = plain_name(table_.unit);
  }

  // Names that fit on a line, and stay different.
  std::vector<std::string> plain_names() {
    std::vector<std::string> out;
    std::set<std::string> taken;
    std::size_t odd = 0;
    for (const auto& name : table_.names.names()) {
      auto plain = plain_name(name);
      odd += plain != name;
      if (plain.empty()) plain = "unnamed";  // no text could tell it from a missing one
      out.push_back(plain);
      for (int k = 2; !taken.insert(out.back()).second; ++k) out.back() = fmt::format("{}-{}", plain, k);
    }
    if (odd > 0)
      note(plural(odd, "name has", "names have") +
           " blanks around it, control characters, or bytes that are no UTF-8; they were taken off or written as \\x0a");
    return out;
  }

  void note_if_incomplete(const std::array<FileColumn, 3>& vector, std::string_view name) {
    const bool some = has(vector[0]) || has(vector[1]) || has(vector[2]);
    if (some && !complete(vector)) note(fmt::format("the recorded {} lacks a component and was left out", name));
  }

  // Frame rate and unit come from the file or from the user; both are asked for at once.
  void demand_flags() const {
    if (options_.resample && !(*options_.resample > 0 && std::isfinite(1 / *options_.resample)))
      throw InputError(fmt::format("`resample`: {} is not a frame rate; expected a number above 0", *options_.resample));
    const bool rate = options_.fps || table_.dt > 0 || has(FileColumn::t);
    const bool unit = !options_.unit.empty() || !table_.unit.empty();
    if (!rate && !unit) fail("neither frame rate nor length unit is in the file; expected both, for example `fps` 25 `unit` m");
    if (!rate) fail("the frame rate is not in the file; expected `fps`, for example `fps` 25");
    if (!unit) fail("the length unit is not in the file; expected `unit`, for example `unit` mm");
    const auto same = [](const std::string& a, const std::string& b) { return length_unit(a).value_or(a) == length_unit(b).value_or(b); };
    if (!options_.unit.empty() && !table_.unit.empty() && !same(options_.unit, table_.unit))
      fail(fmt::format("the file states the unit {} but `unit` says {}; expected the same or none given", table_.unit, options_.unit));
    if (options_.fps && !(*options_.fps > 0 && std::isfinite(*options_.fps)))
      throw InputError(fmt::format("`fps`: {} is not a frame rate; expected a number above 0", *options_.fps));
    if (options_.fps && table_.dt > 0) check_rate(table_, options_, 1 / table_.dt, "the file states");
  }

  std::vector<std::uint32_t> drop_unseen() {
    std::vector<std::uint32_t> seen;
    seen.reserve(table_.track.size());
    std::size_t nowhere = 0, nobody = 0;
    for (std::size_t i = 0; i < table_.track.size(); ++i) {
      bool finite = true;
      for (int axis = 0; axis < dims_; ++axis) finite = finite && std::isfinite(table_[kPosition[axis]][i]);
      if (table_.track[i] == RawTable::no_track)
        ++nobody;
      else if (!finite)
        ++nowhere;
      else
        seen.push_back(static_cast<std::uint32_t>(i));
    }
    if (nowhere > 0) note(plural(nowhere, "row without a position was", "rows without a position were") + " dropped (not seen)");
    if (nobody > 0) note(plural(nobody, "row without a track id was", "rows without a track id were") + " dropped");
    if (seen.empty()) fail("no row has a position; expected at least one");
    return seen;
  }

  // Groups the rows by individual, in natural order of the names, and sorts each by time.
  void order_rows(const std::vector<std::uint32_t>& seen) {
    const auto all = plain_names();
    std::vector<std::size_t> count(all.size(), 0);
    for (const auto row : seen) ++count[table_.track[row]];
    std::vector<std::uint32_t> used;
    for (std::uint32_t k = 0; k < all.size(); ++k)
      if (count[k] > 0) used.push_back(k);
    std::sort(used.begin(), used.end(), [&](auto a, auto b) { return natural_order(all[a], all[b]); });

    std::vector<std::size_t> cursor(all.size(), 0);
    first_.assign(1, 0);
    for (const auto k : used) {
      names_.push_back(all[k]);
      cursor[k] = first_.back();
      first_.push_back(first_.back() + count[k]);
    }
    order_.resize(seen.size());
    for (const auto row : seen) order_[cursor[table_.track[row]]++] = row;
    sort_each();
  }

  void sort_each() {
    const auto& key = has(FileColumn::frame) ? table_[FileColumn::frame] : table_[FileColumn::t];
    std::size_t backwards = 0, place = 0;
    for (std::size_t k = 0; k + 1 < first_.size(); ++k) {
      const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first_[k]),
                 end = order_.begin() + static_cast<std::ptrdiff_t>(first_[k + 1]);
      const std::size_t before = backwards;
      for (auto i = begin + 1; i < end; ++i) {
        if (key[*i] >= key[i[-1]]) continue;
        if (backwards++ == 0) place = *i;
      }
      if (backwards > before) std::stable_sort(begin, end, [&](auto a, auto b) { return key[a] < key[b]; });
    }
    if (backwards > 0)
      note(fmt::format("time goes backwards within a track at {} (first at {}); the rows were sorted by time",
                       plural(backwards, "place", "places"), table_.place(place)));
  }

  // An id that is new in every row numbers rows, unless the file is one that knows its frames, as what `convert` writes does.
  void check_individuals() {
    const auto [low, high] = std::minmax_element(frame_.begin(), frame_.end());
    if (names_.size() < 3 || names_.size() < order_.size() || *low == *high) return;
    if (options_.columns.empty() && !(table_.dt > 0))
      fail("the id is new in every row, so it numbers rows and not individuals; expected `columns` to name the individual (id=NAME,...)");
    note("the id is new in every row: no individual is seen twice");
  }

  void select() {
    if (!options_.frames && !options_.times) return;
    const double slack = 1e-6 * dt_;
    const auto [low, high] = std::minmax_element(frame_.begin(), frame_.end());
    const auto first_frame = *low, last_frame = *high;
    keep_if([&](std::size_t i) {
      const auto frame = static_cast<double>(frame_[i]);
      const double t = t0_ + frame * dt_;
      const bool timely =
          !options_.times || options_.times->contains(t) || options_.times->contains(t + slack) || options_.times->contains(t - slack);
      return timely && (!options_.frames || options_.frames->contains(frame));
    });
    if (!order_.empty()) return;
    throw InputError(fmt::format("{}: no row lies in that range of {} of {}; the recording has frames {} to {}, times {:.6g} to {:.6g} s",
                                 options_.frames ? "`frames`" : "`times`", options_.frames ? "frames" : "times", table_.file, first_frame,
                                 last_frame, t0_ + static_cast<double>(first_frame) * dt_, t0_ + static_cast<double>(last_frame) * dt_));
  }

  // Keeps the ordered rows for which keep(position) holds, individuals without a row being forgotten.
  template <class Keep>
  void keep_if(Keep&& keep) {
    std::vector<std::size_t> first = {0};
    std::vector<std::string> names;
    std::size_t out = 0;
    for (std::size_t k = 0; k + 1 < first_.size(); ++k) {
      for (std::size_t i = first_[k]; i < first_[k + 1]; ++i) {
        if (!keep(i)) continue;
        order_[out] = order_[i];
        frame_[out++] = frame_[i];
      }
      if (out == first.back()) continue;
      first.push_back(out);
      names.push_back(std::move(names_[k]));
    }
    order_.resize(out);
    frame_.resize(out);
    first_ = std::move(first);
    names_ = std::move(names);
  }

  void drop_duplicates() {
    std::vector<bool> repeated(order_.size(), false);
    std::size_t count = 0, place = 0;
    for (std::size_t k = 0; k + 1 < first_.size(); ++k) {
      for (std::size_t i = first_[k] + 1; i < first_[k + 1]; ++i) {
        if (frame_[i] != frame_[i - 1]) continue;
        check_same(order_[i - 1], order_[i], names_[k], frame_[i]);
        if (count++ == 0) place = order_[i];
        repeated[i] = true;
      }
    }
    if (count == 0) return;
    note(fmt::format("{} of an earlier one (first at {}) and {} dropped",
                     plural(count, "row is an exact repetition", "rows are exact repetitions"), table_.place(place),
                     count == 1 ? "was" : "were"));
    keep_if([&](std::size_t i) { return !repeated[i]; });
  }

  void check_same(std::uint32_t a, std::uint32_t b, const std::string& name, std::int64_t frame) const {
    const auto same = [](double u, double v) { return u == v || (std::isnan(u) && std::isnan(v)); };
    const bool equal =
        std::all_of(table_.number.begin(), table_.number.end(), [&](const auto& c) { return c.empty() || same(c[a], c[b]); });
    if (equal) return;
    throw InputError(fmt::format("{}: individual '{}' has another row for frame {} at {}; expected one row per individual and frame",
                                 table_.place(std::max(a, b)), name, frame, table_.place(std::min(a, b))));
  }

  TrackMeta describe(std::string sha256) {
    TrackMeta meta;
    meta.dims = dims_;
    meta.dt = dt_;
    meta.t0 = t0_;
    meta.unit = plain_name(options_.unit.empty() ? table_.unit : options_.unit);
    meta.from = {.path = table_.file,
                 .sha256 = std::move(sha256),
                 .format = table_.format,
                 .columns = table_.columns,
                 .notes = std::move(table_.notes),
                 .synthetic = table_.synthetic};
    meta.kinds = std::move(table_.kinds);
    return meta;
  }

  Rows vectors(const std::array<FileColumn, 3>& from) {
    Rows out(static_cast<Index>(order_.size()), 3);
    for (int axis = 0; axis < 3; ++axis) {
      if (axis >= dims_) {
        out.col(axis) = 0;
        continue;
      }
      auto& column = table_[from[axis]];
      for (std::size_t i = 0; i < order_.size(); ++i) out(static_cast<Index>(i), axis) = column[order_[i]];
      column = {};  // the raw column is not needed any more, and recordings can be large
    }
    return out;
  }

  void number_tracks() {
    track_.reserve(order_.size());
    for (std::uint32_t k = 0; k + 1 < first_.size(); ++k) track_.insert(track_.end(), first_[k + 1] - first_[k], k);
  }

  // Into the final order of Tracks, so that every column is moved only once.
  void sort_by_frame() {
    const auto by_frame = sorted_by(frame_, identity_order<std::uint32_t>(frame_.size()));
    const auto reorder = [&](auto& values) {
      std::remove_reference_t<decltype(values)> out;
      out.reserve(values.size());
      for (const auto i : by_frame) out.push_back(values[i]);
      values = std::move(out);
    };
    reorder(order_);
    reorder(frame_);
    reorder(track_);
  }

  TrackColumns gather() {
    TrackColumns columns;
    columns.episodes = std::move(table_.episodes);
    if (has(FileColumn::kind))
      for (const auto row : order_) columns.kind.push_back(kind(row));
    const bool velocity = complete(kVelocity), acceleration = complete(kAcceleration);
    columns.pos = vectors(kPosition);
    if (velocity) columns.vel = vectors(kVelocity);
    if (acceleration) columns.acc = vectors(kAcceleration);
    columns.names = std::move(names_);
    columns.frame = std::move(frame_);
    columns.track = std::move(track_);
    return columns;
  }

  std::uint8_t kind(std::uint32_t row) const {
    const double value = table_[FileColumn::kind][row];
    if (value >= 0 && value <= 255 && value == std::floor(value)) return static_cast<std::uint8_t>(value);
    throw InputError(fmt::format("{}: kind {} is not allowed; expected an integer from 0 to 255", table_.place(row), value));
  }

  RawTable& table_;
  const ReadOptions& options_;
  const int dims_;
  std::vector<std::uint32_t> order_;  // raw rows, grouped by individual, ascending in time
  std::vector<std::size_t> first_;    // individual k has order_[first_[k] .. first_[k + 1])
  std::vector<std::string> names_;    // of the individuals
  std::vector<std::int64_t> frame_;   // along order_
  std::vector<std::uint32_t> track_;  // along order_
  double dt_ = 0, t0_ = 0;
};

}  // namespace

Tracks assemble(RawTable table, const ReadOptions& options, std::string sha256) { return Assembly(table, options).run(std::move(sha256)); }

}  // namespace swarmfit
