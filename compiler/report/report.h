// A model and what its functions cost -> one HTML page that people look at.
#pragma once
#include <string>
#include <vector>

#include "compile.h"

namespace arboc {

struct ReportInput {
  Setup setup;
  std::vector<std::string> options;         ///< those that differ from their defaults
  std::vector<CompiledFunction> functions;  ///< whose operations are counted
  std::vector<std::string> absent;          ///< functions that the model cannot have
  Diagnostics diagnostics;
};

/// The page stands alone.  Its skeleton is moved by the functions fk, of all links, and gravity,
/// emitted as JavaScript from the programs that C++ is made of.  The same bytes for the same input.
std::string html_report(const ReportInput& input);

}  // namespace arboc
