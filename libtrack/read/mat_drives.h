// SPDX-License-Identifier: MIT
// The sheep herding drives of Jadhav et al., Communications Biology 7:1543 (2024), doi:10.1038/s42003-024-07245-8.
#pragma once

#include <string>

#include "libtrack/read/mat_file.h"
#include "libtrack/read/raw_table.h"

namespace swarmfit {

// The file has arrays pos_ev_1, pos_ev_2, ... of individuals x dimensions x frames, and a frame interval dt.
bool has_drives(const MatVariables& variables);

// The names of the variables that read_drives() needs.
std::vector<std::string> drive_variables(const MatVariables& variables);

// All drives as one recording with an episode per drive. pos_ev_k (and vel_ev_k, where there is one) holds the drives of event
// n = events(k), one after the other; they last from frame ev_st_n(j) to ev_et_n(j) inclusive. Frame numbers are
// (a power of ten) * n + frame within the event, so that drives neither overlap nor touch. Throws InputError.
RawTable read_drives(const MatFile& mat, const std::string& file);

}  // namespace swarmfit
