// A function of a shared library, called as CasADi calls external functions.
#pragma once
#include <string>
#include <vector>

#include "cli/build.h"

namespace arboc::test {

/// rows, columns, where each column begins, and the rows of the non-zeros.
struct CompressedColumns {
  int rows = 0, cols = 0;
  std::vector<int> colptr, row;

  int entries() const { return static_cast<int>(row.size()); }
  /// The dense matrix, row by row.
  std::vector<double> dense(const std::vector<double>& values) const;
};

class External {
 public:
  /// Looks everything up that the convention has; expects what it demands.
  External(const cli::Library& library, const std::string& name);

  using Vectors = std::vector<std::vector<double>>;
  /// Empty inputs are handed over as null, outputs that are not `wanted` too and come back empty.
  /// Expects that nothing beyond the sizes told is written.
  Vectors operator()(const Vectors& inputs, const std::vector<bool>& wanted = {},
                     int* status = nullptr) const;

  std::vector<std::string> input_names, output_names;
  std::vector<CompressedColumns> inputs, outputs;

 private:
  using Function = int (*)(const double**, double**, long long*, double*, int);
  Function call_ = nullptr;
  int (*checkout_)() = nullptr;
  void (*release_)(int) = nullptr;
  long long arg_ = 0, res_ = 0, iw_ = 0, w_ = 0;
};

}  // namespace arboc::test
