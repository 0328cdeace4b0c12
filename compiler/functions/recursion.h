// Jacobians of which algorithms of the catalogue have the columns.
//
// What the graph of inverse dynamics gives when it is differentiated, rnea_derivatives has from one
// pass over pairs of joints, mostly from fewer operations; columns by wrenches are those of
// frame_jacobian.
#pragma once
#include <string>
#include <vector>

#include "functions/request.h"
#include "functions/setup.h"

namespace arboc {

struct JacobianRecursion {
  const char* of;        ///< what it is the derivative of: rnea.tau
  const char* function;  ///< the algorithm, which takes what that function has not as zero
  struct Column {
    const char *input, *output;
  };
  std::vector<Column> columns;
  bool wrenches = false;  ///< by f_ext it is -J^T of the loaded frames

  /// The output with the columns by an input; "" if there is none.
  std::string output(const std::string& input) const;
};

/// The recursion that has all columns of `request`; null if there is none.
const JacobianRecursion* recursion_of(const Request& request, const Setup& setup);

}  // namespace arboc
