@banner@
#include "@name@_@function@.hpp"

#include "@name@_raw.hpp"

template @result@ @name@::raw::@function@<double>(@parameters@) noexcept;
