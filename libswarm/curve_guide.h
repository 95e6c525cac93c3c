// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "libswarm/guide.h"
#include "libtrack/curve.h"

namespace swarmfit {

// A curve that agents are led along.
struct CurveToFollow {
  Curve curve;
  double reach = 0;  // within which a key point is reached, > 0 [unit]
};

// A quarter of the spacing: Xiang et al. leave it open.
inline double usual_reach(const Curve& curve) { return 0.25 * curve.spacing(); }

// Leads every agent from key point to key point of a curve, in a direction drawn for each: Xiang et al. 2020 (doi:10.1002/cav.1957), Eq 15.
// Who reaches its key point heads for the next; at the end of an open curve it turns round. An agent that appears
// heads for the neighbour of the key point nearest to it.
class CurveGuide : public Guide {
 public:
  explicit CurveGuide(CurveToFollow way) : curve_(std::make_shared<const Curve>(std::move(way.curve))), reach_(way.reach) {}
  std::unique_ptr<WorldPart> clone() const override { return std::make_unique<CurveGuide>(*this); }
  void advance(const Clock&, const World&, State&) override;
  std::optional<Eigen::Array3d> goal(std::uint32_t id) const override;

 private:
  struct Errand {
    int direction = 0;  // +1, -1; 0: not here yet
    std::size_t key = 0;
  };
  void next(Errand& errand) const;

  std::shared_ptr<const Curve> curve_;
  double reach_;
  std::vector<Errand> errands_;  // by id
};

}  // namespace swarmfit
