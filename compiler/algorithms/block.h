// The algorithms say whose work begins, so that generated code can be read link by link.
//
// The traced scalar's overload is found through its argument; for numbers this costs nothing.
#pragma once
#include <string>

namespace arboc {

template <class T>
void enter_block(const T* /*inputs*/, const std::string& /*link*/, const char* /*phase*/) {}

/// Work that follows is not to be mixed with what came before: nothing else fixes the order within
/// a block (graph/canonical.h).
template <class T>
inline void next_step(const T* /*inputs*/) {}

}  // namespace arboc
