@banner@
//
// Declarations, constants and sparsity of @name@; pointers only.  Arrays are the caller's; inputs
// and outputs must not overlap.  Pure functions: no state, allocation or exceptions; any thread.
#pragma once

#include <limits>

#include "arboc/scalar.hpp"

namespace @name@ {

inline constexpr int nq = @nq@;  ///< entries of q
inline constexpr int nv = @nv@;  ///< entries of v, a, tau

@constants@
namespace raw {

@declarations@}  // namespace raw
}  // namespace @name@
