// SPDX-License-Identifier: MIT
// Ranks of true values in their posteriors: how many lie below each share, with the band of uniform ones.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/study/parameter_recovery_html.h"

namespace swarmfit {
namespace {

constexpr double kLeft = 34, kTop = 15, kSide = 108, kRight = kLeft + kSide, kBottom = kTop + kSide, kTick = 2.5;
constexpr double kDrawing = 204;  // wide, as drawings of intervals are, so that letters are as large

std::string point(double x, double y) {
  return fmt::format("{:.2f} {:.2f}", kLeft + kSide * std::clamp(x, 0.0, 1.0), kBottom - kSide * std::clamp(y, 0.0, 1.0));
}

std::string path(std::string_view look, const std::string& d) { return fmt::format("<path class=\"{}\" d=\"{}\"/>", look, d); }

std::string axes() {
  std::string out = path("frame", fmt::format("M{}V{}H{}", point(0, 1), kBottom, kRight));
  for (const double at : {0.0, 0.5, 1.0}) {
    const double x = kLeft + kSide * at, y = kBottom - kSide * at;
    out += path("frame", fmt::format("M{:.2f} {}v{}M{} {:.2f}h{}", x, kBottom, kTick, kLeft, y, -kTick));
    out += fmt::format("<text x=\"{:.2f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x, kBottom + 10.5, at);
    out += fmt::format("<text x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>", kLeft - 4.5, y + 2.5, at);
  }
  out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">rank of the true value</text>", kLeft + kSide / 2, kBottom + 20.5);
  return out + fmt::format("<text x=\"2\" y=\"{}\">share of recordings below</text>", kTop - 7);
}

std::string steps(std::vector<double> ranks) {
  std::erase_if(ranks, [](double r) { return !std::isfinite(r); });
  std::sort(ranks.begin(), ranks.end());
  std::string d = "M" + point(0, 0);
  for (std::size_t k = 0; k < ranks.size(); ++k)
    d += fmt::format("H{:.2f}L{}", kLeft + kSide * ranks[k],
                     point(ranks[k], static_cast<double>(k + 1) / static_cast<double>(ranks.size())));
  return d + fmt::format("H{:.2f}", kRight);
}

}  // namespace

Html ranks_drawing(std::vector<double> ranks, double band, const std::string& name) {
  std::string out = fmt::format(
      "<svg class=\"recovered ranked\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Ranks of the true value of {} in its "
      "posterior\">",
      kDrawing, kBottom + 24, html_escaped(name));
  out += path("band", fmt::format("M{}L{}L{}L{}L{}L{}Z", point(0, 0), point(0, band), point(1 - band, 1), point(1, 1), point(1, 1 - band),
                                  point(band, 0)));
  out += axes() + path("equal whole", fmt::format("M{}L{}", point(0, 0), point(1, 1)));
  return {out + path("ranks", steps(std::move(ranks))) + "</svg>"};
}

}  // namespace swarmfit
