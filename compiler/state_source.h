// Random states and inputs, the same for the same seed on every machine.
#pragma once
#include <cstdint>

#include "functions/trace.h"
#include "model/model.h"
#include "reference/differentiate.h"

namespace arboc {

class StateSource {
 public:
  explicit StateSource(std::uint64_t seed) : state_(seed) {}

  /// Angles within +-pi and the limits, lengths within +-1 m, quaternions of length 1; v within
  /// +-2, a within +-5, tau within +-10.
  State next(const Model& model);
  /// Every input that functions of this setup can have but lambda: a state, another configuration
  /// q1, wrenches within +-10, parameters some 20 % off the model's.
  Values inputs(const Setup& setup);
  /// Entries within +-bound.
  std::vector<double> vector(int size, double bound = 1);

 private:
  double uniform(double low, double high);
  std::vector<double> parameter(const Parameter& parameter);

  std::uint64_t state_;
};

}  // namespace arboc
