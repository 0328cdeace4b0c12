@banner@
#include "@name@_@function@.hpp"

#include "@name@_raw.hpp"
@includes@
template @result@ @name@::raw::@function@<@scalar@>(@parameters@) noexcept;
