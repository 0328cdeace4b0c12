// One of two traces of the same outputs.
#pragma once
#include "functions/trace.h"

namespace arboc {

/// The one that will have fewer operations; of each matrix what is not zero in the other either,
/// since each may show zeros that the other does not.
Traced cheaper(Traced a, Traced b);

}  // namespace arboc
