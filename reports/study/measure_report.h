// SPDX-License-Identifier: MIT
// What was measured of a group, as text, JSON, CSV and as a folder with a page.
#pragma once

#include <string>

#include "libeval/group/measured.h"
#include "reports/write/run_folder.h"
#include "reports/write/text_table.h"

namespace swarmfit {

// At most 80 columns wide.
std::string measure_text(const TrackMeta& meta, const Measured& measured, TextStyle style);
std::string to_json(const TrackMeta& meta, const Measured& measured, const Settings& settings);

std::string series_csv(const TrackMeta& meta, const MeasuredGroup& group);  // a row per frame, a column per order parameter
std::string means_csv(const TrackMeta& meta, const Measured& measured);     // a row per group and order parameter
std::string states_csv(const TrackMeta& meta, const Measured& measured);    // a row per group and window
std::string events_csv(const TrackMeta& meta, const Measured& measured);    // fissions and fusions

// measure.json (last), tables/*.csv, figures/*.svg, report.html, config.toml. Throws InputError, RunError.
void write_measured(const std::string& dir, const TrackMeta& meta, const Measured& measured, const Settings& settings,
                    const std::string& version);

}  // namespace swarmfit
