// SPDX-License-Identifier: MIT
// Recording beside every model: what is around an individual, how it responds, where everybody goes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/comparison/figure_parts.h"
#include "reports/comparison/words.h"
#include "reports/draw/paths.h"
#include "reports/draw/square_map.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit::parts {
namespace {

constexpr std::size_t kFewest = 4, kMost = 6;  // maps in a row
constexpr double kGap = 7, kTitle = 12, kBar = 34, kLeft = 2;

// One that is drawn: the recording, or a model.
struct Taken {
  std::string name;
  const Pictures* pictures;
  const Tracks* film;
};

std::vector<Taken> taken(const Comparison& c, std::size_t models) {
  std::vector<Taken> out{{what_was_seen(c), &c.recording.pictures.recording, &c.film}};
  for (std::size_t k = 0; k < std::min(models, c.models.size()); ++k)
    out.push_back({c.models[k].model, &c.models[k].likeness.pictures.mean, &c.models[k].film});
  return out;
}

// Squares in rows, with a bar to the right.
struct Grid {
  std::size_t across;
  double side, left, top;
  svg::Box box(std::size_t k) const {
    const std::size_t row = k / across;
    return {left + static_cast<double>(k % across) * (side + kGap), top + static_cast<double>(row) * (side + kTitle + 4), side, side};
  }
  svg::Box bar(std::size_t count) const { return {left + static_cast<double>(std::min(count, across)) * (side + kGap), top, 7, side}; }
  double bottom(std::size_t count) const { return box(count - 1).bottom(); }
};

Grid grid_at(const svg::Sheet& sheet, double top, std::size_t count) {
  const std::size_t across = std::clamp(count, kFewest, kMost);
  const double side = (sheet.width() - kLeft - kBar) / static_cast<double>(across) - kGap;
  return {across, side, kLeft, top + kTitle};
}

// As long as the name fits the square.
std::string short_name(const std::string& name, double width) {
  std::string out = name;
  for (std::size_t keep = name.size(); keep > 1 && svg::plain(out).width > width;) {
    --keep;
    while (keep > 1 && (static_cast<unsigned char>(name[keep]) & 0xC0U) == 0x80U) --keep;  // not within a character
    out = name.substr(0, keep) + "…";
  }
  return out;
}

using Values = std::vector<double> Pictures::*;

// The value that a share of the squares of the recording and the models lie below, by size.
double largest(const std::vector<Taken>& all, Values member, double share) {
  std::vector<double> sizes;
  for (const Taken& t : all)
    for (const double v : t.pictures->*member)
      if (std::isfinite(v) && v != 0) sizes.push_back(std::abs(v));
  if (sizes.empty()) return 0;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  return *at;
}

void mark_focal(svg::Sheet& sheet, const svg::Box& b) {
  const double x = b.left + b.width / 2, y = b.top + b.height / 2;
  sheet.path(fmt::format("M{:.1f} {:.1f}l3 7h-6z", x, y - 4), {"#ffffff", 0.5, ""}, svg::kInk);
}

// A row of maps of one kind; the top of what follows.
double draw_maps(svg::Sheet& sheet, double top, const std::vector<Taken>& all, Values member, std::size_t side, const plot::MapScale& scale,
                 const std::string& title, bool focal) {
  sheet.text({kLeft, top + 7}, svg::plain(title));
  const Grid grid = grid_at(sheet, top + 11, all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const svg::Box box = grid.box(k);
    sheet.text({box.left, box.top - 3}, svg::plain(short_name(all[k].name, box.width)), svg::Anchor::start, svg::kSoft);
    plot::draw_square_map(sheet, box, all[k].pictures->*member, side, scale);
    if (focal) mark_focal(sheet, box);
  }
  plot::draw_colour_bar(sheet, grid.bar(all.size()), scale, "");
  return grid.bottom(all.size()) + 12;
}

// Recording and models from above, in one frame.
struct Ground {
  plot::Window recording, shown;
};

bool wider(const Ground& ground) { return ground.shown.half > 1.1 * ground.recording.half; }

Ground ground_of(const std::vector<Taken>& all) {
  std::vector<const Tracks*> films;
  for (const Taken& t : all) films.push_back(t.film);
  return {plot::window_of(*films.front()), plot::window_for(films)};
}

void draw_ground(svg::Sheet& sheet, const svg::Box& box, const Taken& one, const Ground& ground) {
  plot::draw_paths(sheet, box, *one.film, ground.shown);
  if (wider(ground)) plot::draw_window(sheet, box, ground.recording, ground.shown);
}

// What the frame is, and who leaves it.
std::string ground_words(const std::vector<Taken>& all, const Ground& ground, const std::string& unit) {
  constexpr double kWorthSaying = 0.005;
  std::string out = wider(ground)
                        ? fmt::format(" Dashed: the square of {} {} that holds the recording.", rounded(2 * ground.recording.half, 2), unit)
                        : "";
  std::vector<std::string> leave;
  for (const Taken& t : all)
    if (const double outside = plot::share_outside(*t.film, ground.shown); outside > kWorthSaying)
      leave.push_back(fmt::format("{} ({} of its positions)", t.name, percent(outside)));
  if (!leave.empty()) out += fmt::format(" Beyond the frame {} {}.", leave.size() > 1 ? "are" : "is", enumerate(leave));
  return out;
}

bool nothing(const Comparison& c) { return c.recording.pictures.recording.density.empty(); }

std::string frame_of_focal(const Comparison& c) {
  const PictureGrid& g = c.recording.pictures.grid;
  return fmt::format(
      "Each map is {} {} wide, centred on a focal animal that moves upwards{}.", rounded(2 * g.reach, 2), c.recording.data.unit,
      g.dims == 2 ? "; its left is left"
                  : " and turned about its heading until the neighbour lies to the right, so that the left half stays empty");
}

}  // namespace

Figure neighbours(const Comparison& c) {
  if (nothing(c)) return {"neighbours", "", ""};
  const auto all = taken(c, c.models.size());
  svg::Sheet sheet(svg::kTwoColumns);
  const double most = std::max(1e-9, largest(all, &Pictures::density, 0.98));
  const double height =
      draw_maps(sheet, 0, all, &Pictures::density, kMapSide, {0, most, plot::Scheme::sequential}, "neighbour density (1 = uniform)", true);
  const std::string caption = "Where neighbours are: density of all neighbours around a focal animal. " + frame_of_focal(c) +
                              (c.models.empty() ? "" : " Models: mean of the final replicates.");
  return {"neighbours", caption, sheet.document(height, "Neighbour density around a focal animal", caption)};
}

Figure responses(const Comparison& c) {
  if (nothing(c)) return {"responses", "", ""};
  const auto all = taken(c, c.models.size());
  svg::Sheet sheet(svg::kTwoColumns);
  const auto scale = [&](Values member) {
    const double most = std::max(1e-9, largest(all, member, 0.95));
    return plot::MapScale{-most, most, plot::Scheme::diverging};
  };
  const bool plane = c.recording.pictures.grid.dims == 2;
  double y = draw_maps(sheet, 0, all, &Pictures::turning, kMapSide, scale(&Pictures::turning),
                       fmt::format("turning [rad/s], {}", plane ? "orange: to the right" : "orange: towards the neighbour"), true);
  y = draw_maps(sheet, y, all, &Pictures::acceleration, kMapSide, scale(&Pictures::acceleration),
                fmt::format("acceleration [{}/s²], orange: speeds up", c.recording.data.unit), true);
  const std::string caption =
      "How an animal responds to a neighbour at each place: mean turning rate and mean acceleration along its heading. " +
      frame_of_focal(c) + " Grey: no neighbour was there.";
  return {"responses", caption, sheet.document(y, "Turning and acceleration by neighbour position", caption)};
}

Figure space(const Comparison& c) {
  if (nothing(c) || c.film.rows() == 0) return {"space", "", ""};
  const auto all = taken(c, c.models.size());
  svg::Sheet sheet(svg::kTwoColumns);
  const PictureGrid& g = c.recording.pictures.grid;
  const Ground ground = ground_of(all);
  sheet.text({kLeft, 7}, svg::plain("trajectories, dark to light: from first to last frame shown"));
  const Grid grid = grid_at(sheet, 11, all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const svg::Box box = grid.box(k);
    sheet.text({box.left, box.top - 3}, svg::plain(short_name(all[k].name, box.width)), svg::Anchor::start, svg::kSoft);
    draw_ground(sheet, box, all[k], ground);
  }
  const double most = std::max(1e-9, largest(all, &Pictures::space, 0.98));
  const double height = draw_maps(sheet, grid.bottom(all.size()) + 12, all, &Pictures::space, kSpaceSide,
                                  {0, most, plot::Scheme::sequential}, "use of space (1 = uniform)", false);
  const std::string caption = fmt::format(
      "Where the animals go, seen from above. Top: trajectories of the first {} s{} in a frame of {} {}.{} Bottom: share of positions per "
      "square over the whole recording, {} {} wide{}.",
      brief(static_cast<double>(c.film.frames().back().number - c.film.frames().front().number) * c.film.dt(), 3),
      c.models.empty() ? "" : ", the models' of one scored simulation,", rounded(2 * ground.shown.half, 2), c.recording.data.unit,
      ground_words(all, ground, c.recording.data.unit), rounded(2 * g.half, 2), c.recording.data.unit,
      c.models.empty() ? "" : "; models: mean of the final replicates");
  return {"space", caption, sheet.document(height, "Trajectories and use of space", caption)};
}

Figure trajectory_strip(const Comparison& c) {
  if (c.film.rows() == 0) return {"strip", "", ""};
  const auto all = taken(c, 1);
  svg::Sheet sheet(all.size() > 1 ? svg::kTwoColumns : svg::kOneColumn);
  const Ground ground = ground_of(all);
  const double side = (sheet.width() - 10) / static_cast<double>(all.size()) - 6, shown = std::min(side, 170.0);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double left = 2 + static_cast<double>(k) * (side + 10);
    const svg::Box box{left, 12, side, shown};
    sheet.text({left, 8}, svg::plain(k == 0 ? "recording" : all[k].name + ", the best model"), svg::Anchor::start, svg::kSoft);
    draw_ground(sheet, box, all[k], ground);
  }
  const std::string caption =
      fmt::format("Trajectories of the recording{}, seen from above, dark to light from first to last frame; panels are {} {} high.{}",
                  all.size() > 1 ? fmt::format(" (left) and of {}, the best model (right)", all[1].name) : "",
                  rounded(2 * ground.shown.half, 2), c.recording.data.unit, ground_words(all, ground, c.recording.data.unit));
  return {"strip", caption, sheet.document(16 + shown, "Trajectories of the recording and the best model", caption)};
}

}  // namespace swarmfit::parts
