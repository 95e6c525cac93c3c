// SPDX-License-Identifier: MIT
#include "libeval/group/order_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "libeval/group/order_formulas.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

using namespace order_formulas;

const std::array kTable{
    OrderParameter{"individuals", "individuals", "n", 0, 0, "number in the frame", individuals},
    OrderParameter{"polarisation", "polarisation", "P", 0, 0, "|Σ ê|/n, ê = v/|v|; 0 to 1; random: sqrt(π/(4n)) (plane), sqrt(8/(3πn))",
                   polarisation},
    OrderParameter{"milling", "milling", "M₀", 0, 0, "|Σ r̂×ê|/n, r from the centroid of the frame; 0 to 1", milling},
    OrderParameter{"net_rotation", "net rotation", "M", 0, 0, "milling at mid-points of steps: 1 in a mill, however long its steps",
                   net_rotation},
    OrderParameter{"rotation", "rotation, either sense", "Mₐ", 0, 0, "Σ|r̂×ê|/n at mid-points; random: 2/π (plane), π/4", rotation},
    OrderParameter{"speed", "speed of individuals", "v", 1, -1, "mean |v|", speed},
    OrderParameter{"group_speed", "speed of the group", "V", 1, -1, "|Σ v|/n", group_speed},
    OrderParameter{"angular_speed", "angular speed about the centre", "w", 0, -1,
                   "mean angle that the place about the centroid turns by, per second", angular_speed},
    OrderParameter{"extent", "extent", "L", 1, 0, "root-mean-square distance to the centroid", extent},
    OrderParameter{"median_radius", "median radius", "r₅₀", 1, 0, "median distance to the centroid", median_radius},
    OrderParameter{"elongation", "elongation along the motion", "λ", 0, 0,
                   "sd along the mean velocity over that across; 1: as long as wide", elongation},
    OrderParameter{"axis_ratio", "axis ratio", "q", 0, 0, "second principal variance over the largest; 0: a line, 1: round", axis_ratio},
    OrderParameter{"axis_turn", "turning of the long axis", "ω", 0, -1, "rotation rate of the first principal axis; signed in the plane",
                   axis_turn},
    OrderParameter{"core", "share in the core", "c", 0, 0,
                   "share within half the median radius; ring: 0, uniform disc: 1/8, uniform ball: 1/16", core},
    OrderParameter{"halves", "rotation of the two halves", "M₂", 0, 0,
                   "lesser |M| of the halves along the long axis; negative: in opposite senses", halves},
    OrderParameter{"nearest", "nearest-neighbour distance", "d", 1, 0, "mean over individuals", nearest},
    OrderParameter{"nearest_cv", "CV of the nearest-neighbour distance", "CV", 0, 0, "sd over mean; Poisson: 0.52 (plane), 0.36",
                   nearest_cv},
    OrderParameter{"nearest_ratio", "nearest neighbour over Poisson", "d/d₀", 0, 0,
                   "d over that of a Poisson process in the ellipsoid with the frame's covariance", nearest_ratio},
    OrderParameter{"parts", "subgroups", "k", 0, 0, "components of linked individuals that hold at least a tenth of all, and two", parts},
    OrderParameter{"largest", "share of the largest subgroup", "s", 0, 0, "individuals in the largest component over n", largest},
    OrderParameter{"mixing", "internal mixing", "x", 0, -1, "changes of the nearest neighbour, per individual and second", mixing},
    OrderParameter{"ahead", "neighbours ahead or behind", "⟨cos⟩", 0, 0,
                   "mean cosine of the nearest neighbour's bearing; 1: ahead, −1: behind", ahead},
    OrderParameter{"abreast", "neighbours abreast", "⟨|sin|⟩", 0, 0,
                   "mean |sine| of the nearest neighbour's bearing; random: 2/π (plane), π/4", abreast},
    OrderParameter{"lanes", "lane order", "Φ", 0, 0,
                   "mean of ((same − opposite)/(same + opposite))² among those in one's lane, 1.5 d to either side", lanes},
    OrderParameter{"radial_force", "effective radial force", "a_r", 1, -2, "mean acceleration away from the centroid; negative: inwards",
                   radial_force},
};

const std::array<std::string_view, 6> kUsual{"polarisation", "net_rotation", "rotation", "extent", "nearest", "largest"};

}  // namespace

std::span<const OrderParameter> order_table() { return kTable; }

const OrderParameter* find_order_parameter(std::string_view key) {
  const auto found = std::find_if(kTable.begin(), kTable.end(), [&](const OrderParameter& p) { return p.key == key; });
  return found == kTable.end() ? nullptr : &*found;
}

std::vector<const OrderParameter*> order_parameters_named(const std::vector<std::string>& keys) {
  std::vector<const OrderParameter*> out;
  const auto add = [&](const OrderParameter& p) {
    if (std::find(out.begin(), out.end(), &p) == out.end()) out.push_back(&p);
  };
  for (const std::string& key : keys) {
    if (key == "all") {
      for (const OrderParameter& p : kTable) add(p);
    } else if (key == "usual") {
      for (const auto usual : kUsual) add(*find_order_parameter(usual));
    } else if (const OrderParameter* p = find_order_parameter(key)) {
      add(*p);
    } else {
      throw InputError(fmt::format(
          "'{}' is not an order parameter; expected all, usual or names such as polarisation, extent (docs/group.md)", key.substr(0, 60)));
    }
  }
  return out;
}

void OrderRecord::add(const Moment& moment) {
  frame_.push_back(moment.places().frame);
  for (std::size_t k = 0; k < what_.size(); ++k) values_[k].push_back(what_[k]->of(moment));
}

const std::vector<double>& OrderRecord::values(std::string_view key) const {
  for (std::size_t k = 0; k < what_.size(); ++k)
    if (what_[k]->key == key) return values_[k];
  throw std::out_of_range(std::string(key));
}

OrderRecord order_record(const Tracks& tracks, const MomentOptions& options, std::vector<const OrderParameter*> what) {
  OrderRecord record(std::move(what));
  for_each_moment(tracks, options, [&](const Moment& moment) { record.add(moment); });
  return record;
}

}  // namespace swarmfit
