@banner@
//
// The functions of @name@ as types, for arboc::Batch and other code that is written once for all
// functions.  Include the header of each function that you use as well.  Entry e of output k stands
// at (output_row[k][e], output_col[k][e]), of symmetric ones in the upper triangle; null: dense, by
// rows.
#pragma once

#include "@name@_raw.hpp"
#include "arboc/batch.hpp"

namespace @name@ {

@functions@}  // namespace @name@
