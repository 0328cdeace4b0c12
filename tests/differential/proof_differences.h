// Derivatives against differences of the function underneath, along one random direction.
#pragma once
#include <optional>

#include "differential/proof_engine.h"
#include "state_source.h"

namespace arboc::test {

/// `got`: what the request gave at `in`.  Nothing for functions that are no derivatives, for
/// integrate_derivatives, and for iterated second derivatives.
std::optional<double> difference_error(ProofEngine& f, const Request& request,
                                       const Reference& reference, const Values& in,
                                       const Values& got, StateSource& source);

}  // namespace arboc::test
