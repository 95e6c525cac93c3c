// SPDX-License-Identifier: MIT
#include "libeval/lags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "libeval/localisation.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr int kLongestNamed = 1'000'000;

// Frames behind one jerk.
Index span_of(int lag) { return 3 * Index{lag} + 1; }

Index longest_run(const Tracks& tracks) {
  Index longest = 0;
  for_each_segment(tracks, 1, [&](std::span<const Index> run) { longest = std::max(longest, static_cast<Index>(run.size())); });
  return longest;
}

Index jerks(const Tracks& tracks, int lag) {
  Index count = 0;
  for_each_segment(tracks, span_of(lag), [&](std::span<const Index> run) { count += static_cast<Index>(run.size()) - span_of(lag) + 1; });
  return count;
}

bool error_dominated(const Tracks& tracks, const Eigen::Array3d& sigma, double limit, std::uint64_t seed, int lag) {
  const PerColumn<double> share = error_share(tracks, sigma, seed, {lag});
  return std::any_of(share.begin(), share.begin() + kMotionMetrics, [limit](double s) { return s > limit; });
}

}  // namespace

std::vector<int> parse_lags(const std::string& text) {
  if (text == "auto") return {};
  std::vector<int> lags;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    int lag = 0;
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), lag);
    if (error != std::errc() || stop != part.data() + part.size() || lag < 1 || lag > kLongestNamed)
      throw InputError(
          fmt::format("`lags` {}: '{}' is not a number of frames; expected auto or positive whole numbers such as 1,4,16", text, part));
    lags.push_back(lag);
    begin = end + 1;
  }
  std::sort(lags.begin(), lags.end());
  if (const auto twice = std::adjacent_find(lags.begin(), lags.end()); twice != lags.end())
    throw InputError(fmt::format("`lags` {}: {} is named twice; expected different lags", text, *twice));
  return lags;
}

std::string lags_text(const std::vector<int>& lags) { return fmt::format("{}", fmt::join(lags, ",")); }

void require_lags(const Tracks& tracks, const std::vector<int>& lags) {
  const int lag = lags.empty() ? 1 : lags.back();
  const Index longest = longest_run(tracks);
  if (lag > 1 && longest < span_of(lag))
    throw InputError(fmt::format("`lags` {}: a jerk at lag {} takes {} frames in a row, the longest unbroken track has {}; expected {}",
                                 lags_text(lags), lag, span_of(lag), longest,
                                 longest < span_of(2) ? "1" : fmt::format("lags of at most {}", (longest - 1) / 3)));
}

int longest_lag(const Tracks& tracks) {
  if (tracks.frames().empty()) return 1;
  const Index all = jerks(tracks, 1), frames = tracks.frames().back().number - tracks.frames().front().number + 1;
  int lag = 1;
  while (8 * span_of(2 * lag) <= frames && 2 * jerks(tracks, 2 * lag) >= all && all > 0) lag *= 2;
  return lag;
}

std::vector<int> choose_lags(const Tracks& tracks, const Eigen::Array3d& sigma, double limit, std::uint64_t seed) {
  const int longest = longest_lag(tracks);
  if (longest == 1 || !(sigma > 0).any() || !error_dominated(tracks, sigma, limit, seed, 1)) return {1};
  int lag = 2;
  while (lag < longest && error_dominated(tracks, sigma, limit, seed, lag)) lag *= 2;
  return {1, lag};
}

}  // namespace swarmfit
