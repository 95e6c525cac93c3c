// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "libswarm/guide.h"

namespace swarmfit {

// Recorded individuals among simulated ones. In the frames in which they were recorded they are where they were recorded, whatever
// happens; simulated agents meet them like any other agent. In a gap they are absent, or fly by the model to where their track goes on;
// after their last recorded frame they leave, or fly on.
class Replay : public Guide {
 public:
  // An unbroken stretch of one individual: frames first .. first + rows - 1.
  struct Stretch {
    std::int64_t first = 0;
    Rows pos, vel;        // [unit], [unit/s]; the velocity of the last row is that with which it flies on
    bool bridged = true;  // does it fly from here to the next stretch, if there is one?
    std::int64_t last() const { return first + pos.rows() - 1; }
  };
  struct Individual {
    std::uint32_t id = 0;
    std::uint8_t kind = 0;
    std::vector<Stretch> stretches;  // ascending; never empty
    std::int64_t until = 0;          // last frame in which it is there; at least that of the last stretch
  };
  // Where the model had brought an individual to when its track went on.
  struct Arrival {
    std::uint32_t id;
    std::int64_t frame;
    Eigen::Array3d missed_by;  // recorded - simulated [unit]
  };

  // frame_dt: frame interval [s].
  Replay(std::vector<Individual> individuals, double frame_dt);
  std::unique_ptr<WorldPart> clone() const override { return std::make_unique<Replay>(*this); }
  void advance(const Clock&, const World&, State&) override;
  std::optional<Eigen::Array3d> goal(std::uint32_t id) const override;
  const std::vector<Arrival>& arrivals() const { return arrivals_; }

 private:
  enum class Where { absent, recorded, flying };
  struct Now {
    Where where = Where::absent;
    std::size_t stretch = 0;  // that it is on, or came from
  };
  static Now at(const Individual&, std::int64_t frame, int sub);
  void place(const Individual&, const Stretch&, const Clock&, State&, Index row) const;

  std::shared_ptr<const std::vector<Individual>> individuals_;  // shared by all copies
  double frame_dt_;
  std::vector<Now> now_;            // per individual
  std::vector<Index> row_;          // by id, of the moment; -1: absent
  std::vector<std::size_t> index_;  // by id: place in the list; SIZE_MAX: no such individual
  std::vector<Arrival> arrivals_;
};

}  // namespace swarmfit
