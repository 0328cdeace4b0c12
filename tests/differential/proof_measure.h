// One cell of the proof: a row on the random bodies of one kind and base.
#pragma once
#include <optional>

#include "differential/proof_engine.h"
#include "differential/proof_rows.h"

namespace arboc::test {

/// Worst errors relative to the largest entry (at least to 1).
struct Measured {
  std::optional<double> reference;      ///< against the reference engine
  std::optional<double> identity;       ///< of the worst identity
  std::optional<double> differences;    ///< against differences of the function underneath
  std::vector<std::string> identities;  ///< that held something
  std::string gap;                      ///< why nothing was measured
  /// What is wrong whatever the committed table says.
  std::vector<std::string> wrong;

  /// The sharper ones.
  std::optional<double> exact() const;
};

Measured measure(const Row& row, const Kind& kind, Base base);

}  // namespace arboc::test
