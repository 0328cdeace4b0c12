// Emitted inverse dynamics of the arm on Eigen's AutoDiffScalar: the derivatives that come with the
// values are those of rnea_derivatives.  Prints what disagrees; exit status 1 if anything does.
#include <ur5/ur5_raw.hpp>
#include <ur5/ur5_rnea.hpp>

#include <Eigen/Core>
#include <cmath>
#include <cstdio>

#include <unsupported/Eigen/AutoDiff>  // wants Eigen/Core before it

namespace {

constexpr int n = ur5::nv;
using Derivatives = Eigen::Matrix<double, 3 * n, 1>;
using Scalar = Eigen::AutoDiffScalar<Derivatives>;

constexpr double q[n] = {0.3, -0.8, 1.1, 0.4, -1.9, 2.5};
constexpr double v[n] = {1, -0.5, 0.7, 1.3, -2, 0.1};
constexpr double a[n] = {-3, 2, 0.5, 4, -1, 2.2};

}  // namespace

int main() {
  namespace sparsity = ur5::sparsity;
  Scalar qs[n], vs[n], as[n], tau[n];
  for (int i = 0; i < n; ++i) {
    qs[i] = Scalar(q[i], 3 * n, i);
    vs[i] = Scalar(v[i], 3 * n, n + i);
    as[i] = Scalar(a[i], 3 * n, 2 * n + i);
  }
  ur5::raw::rnea<Scalar>(qs, vs, as, tau);

  double value[n], q_entries[sparsity::rnea_derivatives_dtau_dq_nnz],
      v_entries[sparsity::rnea_derivatives_dtau_dv_nnz],
      M_entries[sparsity::rnea_derivatives_M_nnz], dense[3][n * n];
  ur5::raw::rnea<double>(q, v, a, value);
  ur5::raw::rnea_derivatives<double>(q, v, a, q_entries, v_entries, M_entries);
  ur5::raw::scatter_rnea_derivatives_dtau_dq(q_entries, dense[0]);
  ur5::raw::scatter_rnea_derivatives_dtau_dv(v_entries, dense[1]);
  ur5::raw::scatter_rnea_derivatives_M(M_entries, dense[2]);

  int failures = 0;
  const auto near = [&](double got, double expected, const char* what) {
    if (std::fabs(got - expected) <= 1e-11) return;  // of some 100 N m
    std::printf("%s: %.17g, expected %.17g\n", what, got, expected);
    ++failures;
  };
  for (int i = 0; i < n; ++i) {
    near(tau[i].value(), value[i], "tau");
    for (int j = 0; j < 3 * n; ++j)
      near(tau[i].derivatives()[j], dense[j / n][i * n + j % n], "derivative of tau");
  }
  return failures == 0 ? 0 : 1;
}
