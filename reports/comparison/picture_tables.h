// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "reports/comparison/tables.h"

namespace swarmfit {

// tables/pictures.csv: the numbers behind the pictures of recording and models (libeval/group/pictures.h), one row per value. x and y are a
// place around the focal animal [unit], a place in space [unit], a distance [unit], a delay or a time [s]; sd is over final replicates.
std::string pictures_csv(const Comparison&);

}  // namespace swarmfit
