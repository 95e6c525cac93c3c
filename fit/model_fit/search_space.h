// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fit/optimise/differential_evolution.h"
#include "fit/results/comparison.h"
#include "libswarm/model.h"

namespace swarmfit {

// What the user said about parameters. Keys are "parameter" or "model.parameter", model being the bare or the full name.
struct ParameterRequests {
  std::map<std::string, double> set;                        // --set: value; not searched unless bounds are given too
  std::map<std::string, bool> fix;                          // --fix: keep at its default
  std::map<std::string, std::pair<double, double>> bounds;  // --bounds: searched within these [physical units]
  bool published = false;  // of a model whose published fit is known, only what that searched (Parameter::published)
};

// The parameters of one model in one recording: what is searched, between which bounds, and what the rest is.
class SearchSpace {
 public:
  // Bounds and defaults from the model's table in the recording's scales, then the user's requests.
  // Throws InputError when a value lies outside what is legal or bounds are empty.
  SearchSpace(const ModelChoice& model, const Scales& scales, const ParameterRequests& requests);

  int dimensions() const { return static_cast<int>(searched_.size()); }
  const std::vector<std::size_t>& searched() const { return searched_; }  // rows of the parameter table
  std::vector<double> parameters(const Point& x) const;                   // all rows, physical units
  Point start() const { return point(base_); }                            // the defaults, or what was set
  Point point(const std::vector<double>& parameters) const;               // inverse on the searched rows, clamped to the cube
  // x, but what is also searched in `other` is as at its point `there`, or as near as the bounds allow.
  Point adopt(const Point& x, const SearchSpace& other, const Point& there) const;
  const ModelChoice& model() const { return model_; }
  std::vector<ParameterResult> describe(const Point& x, const std::string& length_unit) const;

 private:
  struct Axis {
    double lower, upper;
    bool log, integer;
    double value(double u) const;           // u in [0, 1]
    double coordinate(double value) const;  // its inverse, clamped
  };
  static void look_up_speed(const Scales& scales, double& value, Axis& axis);
  void apply(const ModelChoice& model, const ParameterRequests& requests);

  ModelChoice model_;
  std::vector<double> base_;  // value of every row
  std::vector<Axis> axes_;    // bounds of every row
  std::vector<std::size_t> searched_;
};

// Throws InputError if a key of the requests names no parameter of any of the models.
void check_requests(const ParameterRequests& requests, const std::vector<ModelChoice>& models);

}  // namespace swarmfit
