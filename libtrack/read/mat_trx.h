// SPDX-License-Identifier: MIT
// The structure array trx of Ctrax, JAABA and FlyTracker: an element per fly. Branson et al., Nature Methods 6:451 (2009),
// doi:10.1038/nmeth.1328; fields: http://jaaba.sourceforge.net/DataFormat.html
#pragma once

#include <string>

#include "libtrack/read/mat_file.h"
#include "libtrack/read/raw_table.h"

namespace swarmfit {

// The file has a structure trx with x, y and firstframe.
bool has_trx(const MatVariables& variables);

// x_mm and y_mm where all flies have them, else x and y in pixels; frames from firstframe on; individuals by id, else by their place;
// the frame rate from fps. `mat` holds trx. Throws InputError.
RawTable read_trx(const MatFile& mat, const std::string& file);

}  // namespace swarmfit
