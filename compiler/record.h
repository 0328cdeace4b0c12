// Results of the reference engine at a few random states, for the selftest of generated code.
#pragma once
#include <cstdint>

#include "emit/target.h"
#include "functions/catalogue.h"
#include "model/model.h"
#include "reference/differentiate.h"

namespace arboc {

/// Random states: angles within +-pi and the limits, lengths within +-1 m, quaternions of length 1;
/// v within +-2, a within +-5, tau within +-10.  The same for the same seed on every machine.
class StateSource {
 public:
  explicit StateSource(std::uint64_t seed) : state_(seed) {}
  State next(const Model& model);

 private:
  double uniform(double low, double high);
  std::uint64_t state_;
};

/// The reference engine's results of `function`, dense and row-major, by output name.
Values evaluate_reference(const std::string& function, const Model& model,
                          const Reference& reference, const Values& inputs);

/// Fills in target.recordings.
void record(const Model& model, TargetModel& target);

}  // namespace arboc
