// Two emitted folders in one translation unit, on other scalars than double: float, long double,
// and dual numbers that carry a derivative.  Prints what disagrees; exit status 1 if anything does.
#include <double_pendulum/double_pendulum_rnea.hpp>
#include <ur5/ur5_aba.hpp>
#include <ur5/ur5_crba.hpp>
#include <ur5/ur5_fk.hpp>
#include <ur5/ur5_raw.hpp>
#include <ur5/ur5_rnea.hpp>

#include <cmath>
#include <cstdio>

namespace dual {

/// x + dx e with e^2 = 0.
struct Dual {
  double x = 0, dx = 0;
  Dual() = default;
  explicit Dual(double value, double derivative = 0) : x(value), dx(derivative) {}
};

inline Dual operator-(Dual a) { return Dual(-a.x, -a.dx); }
inline Dual operator+(Dual a, Dual b) { return Dual(a.x + b.x, a.dx + b.dx); }
inline Dual operator-(Dual a, Dual b) { return Dual(a.x - b.x, a.dx - b.dx); }
inline Dual operator*(Dual a, Dual b) { return Dual(a.x * b.x, a.dx * b.x + a.x * b.dx); }
inline Dual operator/(Dual a, Dual b) {
  return Dual(a.x / b.x, (a.dx * b.x - a.x * b.dx) / (b.x * b.x));
}
inline Dual sin(Dual a) { return Dual(std::sin(a.x), std::cos(a.x) * a.dx); }
inline Dual cos(Dual a) { return Dual(std::cos(a.x), -std::sin(a.x) * a.dx); }
inline Dual sqrt(Dual a) { return Dual(std::sqrt(a.x), a.dx / (2 * std::sqrt(a.x))); }
inline bool operator>(Dual a, Dual b) { return a.x > b.x; }

}  // namespace dual

namespace {

using dual::Dual;

constexpr int n = 6;
constexpr double q[n] = {0.3, -0.8, 1.1, 0.4, -1.9, 2.5};
constexpr double v[n] = {1, -0.5, 0.7, 1.3, -2, 0.1};
constexpr double a[n] = {-3, 2, 0.5, 4, -1, 2.2};

int failures = 0;

void near(double got, double expected, double tolerance, const char* what) {
  if (std::fabs(got - expected) <= tolerance) return;
  std::printf("%s: %.17g, expected %.17g\n", what, got, expected);
  ++failures;
}

template <class T>
void evaluate(double* tau, double* qdd, double* placements) {
  T qs[n], vs[n], as[n], tau_t[n], qdd_t[n], fk_t[12 * n];
  for (int i = 0; i < n; ++i) {
    qs[i] = T(q[i]);
    vs[i] = T(v[i]);
    as[i] = T(a[i]);
  }
  ur5::raw::rnea<T>(qs, vs, as, tau_t);
  ur5::raw::fk<T>(qs, fk_t);
  if (ur5::raw::aba<T>(qs, vs, tau_t, qdd_t) != 0) ++failures;
  for (int i = 0; i < n; ++i) {
    tau[i] = static_cast<double>(tau_t[i]);
    qdd[i] = static_cast<double>(qdd_t[i]);
  }
  for (int i = 0; i < 12 * n; ++i) placements[i] = static_cast<double>(fk_t[i]);
}

template <class T>
void compare(double tolerance, const char* what) {
  double tau[n], qdd[n], placements[12 * n], tau_t[n], qdd_t[n], placements_t[12 * n];
  evaluate<double>(tau, qdd, placements);
  evaluate<T>(tau_t, qdd_t, placements_t);
  for (int i = 0; i < n; ++i) {
    near(tau_t[i], tau[i], 100 * tolerance, what);
    near(qdd_t[i], a[i], 1e5 * tolerance, what);  // the inertia's condition
  }
  for (int i = 0; i < 12 * n; ++i) near(placements_t[i], placements[i], tolerance, what);
}

/// Columns of dtau/da are those of M; dtau/dq against differences.
void derivatives() {
  double entries[ur5::sparsity::crba_M_nnz], M[n][n] = {};
  ur5::raw::crba<double>(q, entries);
  for (int k = 0; k < ur5::sparsity::crba_M_nnz; ++k)
    M[ur5::sparsity::crba_M_row[k]][ur5::sparsity::crba_M_col[k]] = entries[k];
  for (int j = 0; j < n; ++j) {
    Dual qs[n], vs[n], as[n], tau[n];
    for (int i = 0; i < n; ++i) {
      qs[i] = Dual(q[i], i == j);
      vs[i] = Dual(v[i]);
      as[i] = Dual(a[i]);
    }
    ur5::raw::rnea<Dual>(qs, vs, as, tau);
    constexpr double h = 1e-5;
    double ahead[n], behind[n], moved[n];
    for (int i = 0; i < n; ++i) moved[i] = q[i] + (i == j ? h : 0);
    ur5::raw::rnea<double>(moved, v, a, ahead);
    for (int i = 0; i < n; ++i) moved[i] = q[i] - (i == j ? h : 0);
    ur5::raw::rnea<double>(moved, v, a, behind);
    for (int i = 0; i < n; ++i) near(tau[i].dx, (ahead[i] - behind[i]) / (2 * h), 1e-7, "dtau/dq");

    for (int i = 0; i < n; ++i) {
      qs[i] = Dual(q[i]);
      as[i] = Dual(a[i], i == j);
    }
    ur5::raw::rnea<Dual>(qs, vs, as, tau);
    for (int i = 0; i <= j; ++i) near(tau[i].dx, M[i][j], 1e-12, "dtau/da");
  }
}

void other_model() {
  double tau[2];
  const double still[2] = {0, 0};
  double_pendulum::raw::rnea<double>(q, still, still, tau);
  near(tau[0], 2.773389192761204, 1e-14, "double pendulum");
  near(tau[1], -0.7054746800560847, 1e-14, "double pendulum");
}

}  // namespace

int main() {
  compare<float>(1e-5, "float");
  compare<long double>(1e-14, "long double");
  derivatives();
  other_model();
  return failures == 0 ? 0 : 1;
}
