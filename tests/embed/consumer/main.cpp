// Reads states of the arm, q v a a line, and prints tau; with an argument states of the walker, q v
// tau, and prints qdd.
#include <arm/arm.hpp>
#include <cstdio>
#include <iostream>
#include <walker/walker.hpp>

namespace {

template <class Vector>
bool read(Vector& x) {
  for (double& entry : x)
    if (!(std::cin >> entry)) return false;
  return true;
}

template <class Vector>
void print(const Vector& x) {
  for (int i = 0; i < x.size(); ++i) std::printf("%s%.17g", i ? "," : "", x[i]);
  std::printf("\n");
}

}  // namespace

int main(int argc, char**) {
  static_assert(walker::sparsity::rnea_tau_jacobian_v_a_dtau_da_nnz > 0, "");
  if (argc > 1) {
    walker::Config q;
    walker::Tangent v, tau;
    while (read(q) && read(v) && read(tau)) print(walker::aba(q, v, tau));
  } else {
    arm::Config q;
    arm::Tangent v, a;
    while (read(q) && read(v) && read(a)) print(arm::rnea(q, v, a));
  }
}
