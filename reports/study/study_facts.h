// SPDX-License-Identifier: MIT
#pragma once

#include "reports/write/html_table.h"
#include "reports/write/run_folder.h"

namespace swarmfit {

// How planted recordings were filmed and compared, from the settings of recover; what is not set is left out.
Html study_facts(const Settings&);

}  // namespace swarmfit
