// Statements of a Program as C++: its chunks as noinline functions, and what calls them.
#pragma once
#include <string>

#include "emit/target.h"

namespace arboc {

struct ProgramText {
  std::string parts;  ///< function templates, to stand in a namespace of their own
  std::string body;   ///< of the function that calls them
};

/// `space`: the namespace of the parts.
ProgramText program_text(const Program& program, const Signature& signature,
                         const std::string& space);

}  // namespace arboc
