// SPDX-License-Identifier: MIT
#include "libtrack/read/postures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "libtrack/error.h"

namespace swarmfit {

Postures::Postures(RawTable& table, const ReadOptions& options, std::vector<std::string> nodes, const std::string& usual)
    : table_(table), least_(options.min_confidence.value_or(-std::numeric_limits<double>::infinity())), nodes_(std::move(nodes)) {
  table.has_nodes = true;
  const std::string wanted = !options.node.empty() ? options.node : nodes_.size() == 1 ? nodes_[0] : usual;
  if (wanted.empty())
    throw InputError(fmt::format("{}: every individual has {} points, {}; expected `node` NAME or `node` mean", table.file, nodes_.size(),
                                 listed(nodes_)));
  const auto hit = std::find(nodes_.begin(), nodes_.end(), wanted);
  if (hit != nodes_.end()) {
    chosen_.push_back(static_cast<std::size_t>(hit - nodes_.begin()));
  } else if (wanted == "mean") {
    chosen_.resize(nodes_.size());
    std::iota(chosen_.begin(), chosen_.end(), std::size_t{0});
  } else {
    throw InputError(fmt::format("`node` {}: {} has no such point; expected mean or one of {}", wanted, table.file, listed(nodes_)));
  }
  choice_ = hit != nodes_.end() ? fmt::format("point '{}'", wanted) : fmt::format("mean of {} points", nodes_.size());
  table.columns = wanted;
}

void Postures::add(const Posture& p) {
  ++postures_;
  std::array<double, 3> sum{};
  std::size_t seen = 0;
  for (const std::size_t k : chosen_) {
    const double z = p.z.empty() ? 0 : p.z[k];
    if (!std::isfinite(p.x[k]) || !std::isfinite(p.y[k]) || !std::isfinite(z)) continue;
    ++points_;
    if (!p.confidence.empty()) table_.has_confidence = true;
    if (!p.confidence.empty() && p.confidence[k] < least_) {
      ++unsure_;
      continue;
    }
    ++seen;
    sum[0] += p.x[k];
    sum[1] += p.y[k];
    sum[2] += z;
  }
  if (seen == 0) {
    ++unseen_;
    return;
  }
  if (seen < chosen_.size()) ++partial_;
  const auto n = static_cast<double>(seen);
  table_.track.push_back(p.track);
  if (!std::isnan(p.frame)) table_[FileColumn::frame].push_back(p.frame);
  if (!std::isnan(p.time)) table_[FileColumn::t].push_back(p.time);
  table_[FileColumn::x].push_back(sum[0] / n);
  table_[FileColumn::y].push_back(sum[1] / n);
  if (!p.z.empty()) table_[FileColumn::z].push_back(sum[2] / n);
}

void Postures::finish() {
  if (table_.track.empty())
    throw InputError(fmt::format("{}: no posture has a position of the {}; expected at least one", table_.file, choice_));
  if (nodes_.size() > 1) table_.notes.push_back(fmt::format("positions are the {} of {}", choice_, listed(nodes_)));
  if (unsure_ > 0)
    table_.notes.push_back(fmt::format("{} of {} points were left out: their confidence is below {:.6g}", unsure_, points_, least_));
  if (partial_ > 0)
    table_.notes.push_back(
        fmt::format("in {} of {} postures some points are missing: the mean is that of the others", partial_, postures_ - unseen_));
  if (unseen_ > 0)
    table_.notes.push_back(fmt::format("{} of {} postures have no position and were left out (not seen)", unseen_, postures_));
}

}  // namespace swarmfit
