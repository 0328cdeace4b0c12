@banner@
#pragma once

#include "arboc/lanes.hpp"

namespace @name@ {
namespace raw {
namespace @function@_parts {

using arboc::sincos;
using arboc::math::cos;
using arboc::math::sin;
using arboc::math::sqrt;

@parts@}  // namespace @function@_parts

/// The same as @function@, one value after the other, for every scalar.
template <class T>
@result@ @function@_plain(@parameters@) noexcept {
@body@}

#if defined(ARBOC_HAS_LANES)

// @limbs@
namespace @function@_lanes {

using arboc::sincos;
using arboc::math::sqrt;

@lane_parts@}  // namespace @function@_lanes

/// The same as @function@, of double or float; limbs that are alike go in the lanes of vectors.
template <class T>
@result@ @function@_in_lanes(@parameters@) noexcept {
@lane_body@}

#endif

@documentation@
template <class T>
@result@ @function@(@parameters@) noexcept {
#if defined(ARBOC_HAS_LANES)
  if constexpr (arboc::kHasLanes<T>)
    return @function@_in_lanes<T>(@arguments@);
  else
#endif
    return @function@_plain<T>(@arguments@);
}

}  // namespace raw
}  // namespace @name@
