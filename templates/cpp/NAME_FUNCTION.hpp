@banner@
#pragma once

#include "arboc/angles.hpp"

namespace @name@ {
namespace raw {
namespace @function@_parts {

using arboc::sincos;
using arboc::math::cos;
using arboc::math::sin;
using arboc::math::sqrt;

@parts@}  // namespace @function@_parts

@documentation@
template <class T>
@result@ @function@(@parameters@) noexcept {
@body@}

}  // namespace raw
}  // namespace @name@
