// Times generated against generic dynamics of @name@: one translation unit, the same flags, the same
// states, results compared first.
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/aba.h"
#include "algorithms/fk.h"
#include "algorithms/gravity.h"
#include "algorithms/minv.h"
#include "algorithms/nle.h"
#include "algorithms/rnea.h"
#include "algorithms/rnea_derivatives.h"
@includes@
namespace {

arboc::DynamicTree make_tree() {
  arboc::DynamicTree tree;
@tree@  return tree;
}

/// The generic algorithms with their workspaces, one signature for all.
struct Generic {
  arboc::DynamicTree tree = make_tree();
  std::vector<int> frames = moving_frames();
  arboc::FkWorkspace<double> fk_work{tree};
  arboc::RneaWorkspace<double> rnea_work{tree};
  arboc::GravityWorkspace<double> gravity_work{tree};
  arboc::CrbaWorkspace<double> crba_work{tree};
  arboc::MinvWorkspace<double> minv_work{tree};
  arboc::AbaWorkspace<double> aba_work{tree};
  arboc::RneaDerivativesWorkspace<double> rnea_derivatives_work{tree};
  std::vector<double> pivots = std::vector<double>(static_cast<std::size_t>(tree.nv));

  std::vector<int> moving_frames() const {
    std::vector<int> list;
    for (std::size_t k = 0; k < tree.frame.size(); ++k)
      if (tree.frame[k].moving) list.push_back(static_cast<int>(k));
    return list;
  }
  void fk(const double* q, double* out) { arboc::fk(tree, fk_work, q, frames, out); }
  void rnea(const double* q, const double* v, const double* a, double* out) {
    arboc::rnea(tree, rnea_work, q, v, a, out);
  }
  void gravity(const double* q, double* out) { arboc::gravity(tree, gravity_work, q, out); }
  void nle(const double* q, const double* v, double* out) { arboc::nle(tree, rnea_work, q, v, out); }
  void crba(const double* q, double* out) {
    arboc::crba(tree, crba_work, q, arboc::UpperTriangle<double>{out, tree.nv});
  }
  void minv(const double* q, double* out) {
    arboc::minv(tree, minv_work, q, arboc::UpperTriangle<double>{out, tree.nv});
  }
  void aba(const double* q, const double* v, const double* tau, double* out) {
    arboc::aba(tree, aba_work, q, v, tau, out, pivots.data());
  }
  void rnea_derivatives(const double* q, const double* v, const double* a, double* dtau_dq,
                        double* dtau_dv, double* M) {
    arboc::rnea_derivatives(tree, rnea_derivatives_work, q, v, a,
                            arboc::SquareMatrix<double>{dtau_dq, tree.nv},
                            arboc::SquareMatrix<double>{dtau_dv, tree.nv},
                            arboc::UpperTriangle<double>{M, tree.nv});
  }
};

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

/// The least of many short windows, the two calls in turn.
template <class A, class B>
void measure(int states, double* out, A a, B b, double* a_ns, double* b_ns) {
  *a_ns = *b_ns = std::numeric_limits<double>::infinity();
  const double once = window(states, 1, out, b);
  const int repeat = static_cast<int>(30e3 / (once * states)) + 1;  // windows of some 30 us
  const double end = now() + 0.25e9;
  while (now() < end) {
    const double x = window(states, repeat, out, a);
    const double y = window(states, repeat, out, b);
    if (x < *a_ns) *a_ns = x;
    if (y < *b_ns) *b_ns = y;
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

/// result: ns generated, ns generic, largest relative difference.
extern "C" void arboc_bench(int function, int states, const double* q, const double* v, const double* a,
                            const double* tau, double* result) {
  static_cast<void>(v);
  static_cast<void>(a);
  static_cast<void>(tau);
  constexpr int nq = @name@::nq, nv = @name@::nv;
  static_cast<void>(nv);
  static Generic generic;
  std::vector<double> out(@size@), expected(@size@);
  result[2] = 0;
  switch (function) {
@cases@  }
}
