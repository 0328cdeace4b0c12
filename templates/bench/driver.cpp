// Times generated against generic dynamics of @name@: one translation unit, the same flags, the same
// states, results compared first.
#include <chrono>
#include <cmath>
#include <limits>
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

double now() {
  return std::chrono::duration<double, std::nano>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// ns per call in one window over all states.
template <class Call>
double window(int states, int repeat, double* out, Call& call) {
  const double start = now();
  for (int r = 0; r < repeat; ++r)
    for (int s = 0; s < states; ++s) {
      call(s, out);
      asm volatile("" : : "r"(out) : "memory");
    }
  return (now() - start) / (static_cast<double>(repeat) * states);
}

/// The least of many short windows, the three calls in turn.
template <class A, class B, class C>
void measure(int states, double* out, A a, B b, C c, double* a_ns, double* b_ns, double* c_ns) {
  *a_ns = *b_ns = *c_ns = std::numeric_limits<double>::infinity();
  const double once = window(states, 1, out, b);
  const int repeat = static_cast<int>(30e3 / (once * states)) + 1;  // windows of some 30 us
  const double end = now() + 0.25e9;
  while (now() < end) {
    const double x = window(states, repeat, out, a);
    const double y = window(states, repeat, out, b);
    if (x < *a_ns) *a_ns = x;
    if (y < *b_ns) *b_ns = y;
    const double z = window(states, repeat, out, c);
    if (z < *c_ns) *c_ns = z;
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
/// result: ns generated, ns generic, largest relative difference, ns generated without limbs in lanes.
extern "C" void arboc_bench(int function, int states, const double* const* in, const double* known,
                            double* result) {
  static_cast<void>(known);
  static const arboc::DynamicTree regrouped_body = regrouped_tree(), own_body = own_tree();
  static Engine regrouped(regrouped_body, @frames@), own(own_body, @frames@);
  std::vector<double> out(@size@), reference(@size@);
  result[2] = 0;
  switch (function) {
@cases@  }
}
