// SPDX-License-Identifier: MIT
// What a group does, in a word: rules on order parameters of its largest component, averaged over a window of time.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libeval/group/moment.h"

namespace swarmfit {

// Two vocabularies, since words overlap: that of Strömbom 2011 and of Strömbom et al. 2015 (mills, chains, aligned groups, swarms), and
// that of Dieck Kattas et al. 2012 (vortex, comet, compact and cohesive flocks). Their rules of recognition are ours.
enum class StateWords { group, flock };

// Means over the window; of the largest component unless it says "of all". NaN where undefined, which no rule takes.
struct StateFeatures {
  int dims = 3;
  double link = 0;                       // distance within which individuals are connected [unit]
  double parts = 0, largest = 0;         // of all: number of parts, share of the largest component
  double polarisation = 0;               // P
  double net_rotation = 0;               // M, at mid-points of steps
  double rotation = 0;                   // Ma
  double axis_ratio = 0;                 // q
  double axis_turn = 0;                  // |mean rate| times extent over mean speed: how fast its ends turn beside how fast it could fly
  double core = 0;                       // share within half the median radius
  double halves = 0;                     // M of the two halves along the long axis, negative in opposite senses
  double extent = 0, median_radius = 0;  // [unit]
  double turning = 0;                    // angular speed about the centre times median radius over mean speed
  double span = 0;                       // how far it reaches across a periodic box, over the side; 0 in open space
  double tail = 0;                       // rms distance of all from its middle, over the median of these distances
  double straying = 0;                   // share of all that are farther from its middle than three times that median
};

// What went before in the same recording.
struct StateHistory {
  bool aligned = false;  // it began with P > 0.8
  bool split = false;    // it had two parts or more for a tenth of a window
  bool dense = false;    // it began with an rms extent of less than a third of the link distance
};

struct GroupState {
  std::string_view key;   // in tables and JSON
  std::string_view name;  // in words
  StateWords words;
  std::string_view rule;  // in words, with its thresholds
  bool (*holds)(const StateFeatures&, const StateHistory&);
};

// The first rule of a vocabulary that holds names the state; the last of each always does.
std::span<const GroupState> state_table();
std::string state_name(const std::string& key);  // the key itself, if it is none of them
const GroupState& state_of(const StateFeatures&, const StateHistory&, StateWords words);

// One window of time.
struct StateWindow {
  std::int64_t first = 0, last = 0;  // frames
  const GroupState* state = nullptr;
  StateFeatures features;
};

// The number of parts changed, and stayed changed for a tenth of a window.
struct GroupEvent {
  std::int64_t frame = 0;     // the first with the new number
  int before = 0, after = 0;  // parts; more after: fission, fewer: fusion
  bool fission() const { return after > before; }
};

struct StateCourse {
  std::vector<StateWindow> windows;
  std::vector<GroupEvent> events;
};

// Neighbouring windows in the same state.
struct StateSpell {
  std::int64_t first = 0, last = 0;  // frames
  const GroupState* state = nullptr;
};
std::vector<StateSpell> spells(const StateCourse& course);

// A stream's visitor: classifies windows of so many frames, one after the other. What is left at the end is a window if it is half as long
// at least, or the only one.
class StateWatch {
 public:
  StateWatch(StateWords words, std::int64_t window) : words_(words), window_(window) {}
  void add(const Moment& moment);
  StateCourse finish();

 private:
  void close();
  void watch_parts(std::int64_t frame, int parts);

  StateWords words_;
  std::int64_t window_;
  std::vector<StateFeatures> seen_;  // of the window that is open, one per frame
  std::vector<double> speed_;        // likewise
  std::vector<Eigen::Vector3d> turn_;
  std::vector<std::int64_t> frame_;
  std::vector<double> early_;  // polarisation at the start of the recording
  StateHistory history_;
  int parts_ = -1, candidate_ = -1;
  std::int64_t since_ = 0;
  StateCourse course_;
};

StateCourse state_course(const Tracks& tracks, const MomentOptions& options, StateWords words, std::int64_t window);

}  // namespace swarmfit
