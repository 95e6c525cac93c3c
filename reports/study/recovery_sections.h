// SPDX-License-Identifier: MIT
// The parts of a page that show a recovery: what recover and power have in common.
#pragma once

#include <string>

#include "fit/results/recovery.h"
#include "reports/write/html_table.h"

namespace swarmfit::sections {

// Matrices of counts, a row per model that made recordings. Cells are shaded by their share of the row's recordings, in one colour where
// large counts are right and in another where they are wrong; the maker's own cell is framed.
Html confusion_matrix(const Recovery&);   // which model is ranked first
Html confidence_matrix(const Recovery&);  // which are not distinguishable from the best
Html rejection_matrix(const Recovery&);   // which are rejected
Html how_matrices_read();

Html overlap_table(const Recovery&);  // every two models: distinguished or not
Html planted_parameters(const Recovery&);
Html cases_table(const Recovery&);  // a row per recording, folded in

}  // namespace swarmfit::sections
