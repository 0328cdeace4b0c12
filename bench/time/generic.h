// The generic engine behind a plain interface, so that only its own file is built with
// -march=native: Eigen's layout depends on that flag and must agree between files.
#pragma once
#include <memory>

#include "tree/dynamic_tree.h"

namespace bench {

class Generic {
 public:
  /// `tree` outlives this object.
  explicit Generic(const arboc::DynamicTree& tree);
  ~Generic();
  void rnea(const double* q, const double* v, const double* a, double* tau);
  /// M: nv x nv, upper triangle.
  void crba(const double* q, double* M);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace bench
