// Generated and generic dynamics of @name@, to be timed and compared: one translation unit, the same
// flags, the same states.
#include <cmath>
#include <vector>

#include "functions/engine.h"
@includes@
namespace {

using Engine = arboc::Engine<arboc::DynamicTree, double>;
using Inputs = Engine::Inputs;

/// With inertial parameters moved to where they do the same with fewer operations.
arboc::DynamicTree regrouped_tree() {
  arboc::DynamicTree tree;
@regrouped@  return tree;
}
/// With those of the bodies.
arboc::DynamicTree own_tree() {
  arboc::DynamicTree tree;
@own@  return tree;
}

/// What is timed.
template <class Call>
void pass(int states, double* out, const Call& call) {
  for (int s = 0; s < states; ++s) {
    call(s, out);
    asm volatile("" : : "r"(out) : "memory");
  }
}

/// Largest difference relative to the largest entry; row and col say where entry k of `got` stands
/// in the matrix `expected` with `cols` columns, or are null where both have n entries.
double difference(const double* got, const double* expected, int n, const int* row, const int* col,
                  int cols) {
  double error = 0, scale = 1e-9;
  for (int k = 0; k < n; ++k) {
    const double x = expected[row ? row[k] * cols + col[k] : k];
    if (!(std::fabs(got[k] - x) <= error)) error = std::fabs(got[k] - x);
    if (std::fabs(x) > scale) scale = std::fabs(x);
  }
  return error / scale;
}

}  // namespace

/// in: the function's inputs at all states; known: its outputs where there is no generic algorithm.
/// Passes through all states with the generated function (engine 0), the generic one (1) or the
/// generated one without limbs in lanes (3), or returns the largest relative difference of the first
/// two (2).
extern "C" double arboc_bench(int function, int engine, int states, const double* const* in,
                              const double* known) {
  static_cast<void>(known);
  static const arboc::DynamicTree regrouped_body = regrouped_tree(), own_body = own_tree();
  static Engine regrouped(regrouped_body, @frames@), own(own_body, @frames@);
  static std::vector<double> out(@size@), reference(@size@);
  double worst = 0;
  switch (function) {
@cases@  }
  return worst;
}
