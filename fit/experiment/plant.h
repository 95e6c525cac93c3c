// SPDX-License-Identifier: MIT
// Synthetic recordings: a model with known parameters, filmed by a camera with known faults.
#pragma once

#include "fit/results/comparison.h"
#include "libswarm/model.h"
#include "libtrack/tracks.h"

namespace swarmfit {

struct Scenario;  // libswarm/scenario/scenario.h

// What a camera does to a scene.
struct Camera {
  double sigma = 0;     // localisation error per axis [unit]
  double dropout = 0;   // probability per individual and frame that a gap begins
  int longest_gap = 5;  // gaps last 1 .. longest_gap frames, all equally likely
};

struct Film {
  Tracks tracks;   // ids are agent numbers
  Tracks stimuli;  // and goals: those that there are, seen without error; kind 0 attracts, 1 repels
  Counters count;
};

// Plays a scene in front of a camera. Throws InputError if the model refuses it, or the simulation blows up.
Film film(const Scenario& scene, const Camera& camera);

// A group in an arena, nothing else: a scene in short.
struct PlantOptions {
  int dims = 3;
  int agents = 20;
  std::int64_t frames = 500;
  double dt = 0.01;          // frame interval [s]
  int substeps = 1;          // steps per frame
  std::int64_t warm_up = 0;  // frames simulated before the recording starts
  Bounds arena;              // open by default
  double start_radius = 1;   // agents start uniformly in a ball (disc) of this radius about the origin, or the arena's centre [unit]
  Scales scales;             // what the model is told of the group's size and speed
  double start_speed = 1;    // and in random directions at this speed [unit/s]
  double sigma = 0;          // of the camera
  double dropout = 0;
  int longest_gap = 5;
  const Tracks* reference = nullptr;  // for models that learn from a recording
  std::uint64_t seed = 1;
  std::string unit = "su";
  std::string path;  // shown as where it comes from
  std::vector<std::string> notes;
};

// Simulates and films. Ids of tracks are agent numbers. Throws InputError if the simulation blows up.
Tracks plant(const ModelChoice& model, const std::vector<double>& parameters, const PlantOptions& options);

// Throws InputError if a parameter that only acts on a part of the world, which neither scenes nor recordings have, is asked to do
// something.
void refuse_idle(const char* flag, const Parameter& row, double value);

// The parameter table's defaults for scenes, with some set by name; throws InputError on an unknown name, or one that would do nothing.
std::vector<double> scene_parameters(const ModelChoice& model, const std::map<std::string, double>& set);

// The rows of the parameter table that these settings use, with these values, in length units and seconds.
std::vector<ParameterResult> scene_table(const ModelChoice& model, const std::vector<double>& parameters, const std::string& unit);

// The built-in recording `demo`: a midge-like swarm of bswarm with curl noise, made by plant() with the constants of demo.cpp.
Tracks demo_recording();

}  // namespace swarmfit
