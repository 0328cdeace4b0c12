// A user of an emitted quadruped with external forces, parameters and derivatives: reads inputs
// (q v a tau f_ext gravity masses lambda, separated by blanks) and prints what each function makes
// of them through the Eigen interface, a line an output, row by row.
#include <cstdio>
#include <quadruped/quadruped.hpp>

namespace {

namespace robot = quadruped;
using robot::Config;
using robot::Matrix;
using robot::Tangent;
using Wrenches = Eigen::Matrix<double, 12, 1>;
using Gravity = Eigen::Matrix<double, 3, 1>;
using Masses = Eigen::Matrix<double, robot::parameter::masses::count, 1>;

static_assert(robot::load::left_front_foot == 0 && robot::load::right_hind_foot == 1, "");
static_assert(robot::frame::trunk == 0 && robot::frame::left_front_foot == 1, "");
static_assert(robot::parameter::gravity::nominal[robot::parameter::gravity::gravity_z] == -9.81,
              "");
static_assert(robot::parameter::masses::trunk_mass == 0, "");
static_assert(robot::sparsity::crba_M_colptr[robot::nv] == robot::sparsity::crba_M_nnz, "");

struct Inputs {
  Config q;
  Tangent v, a, tau, lambda;
  Wrenches f_ext;
  Gravity gravity;
  Masses masses;
};

template <class Vector>
bool read(Vector& x) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (std::scanf("%lf", &x[i]) != 1) return false;
  return true;
}

template <class Values>
void print(const char* what, const Values& values) {
  std::printf("%s:", what);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      std::printf("%s%.17g", i + j ? "," : "", values(i, j));
  std::printf("\n");
}

bool several(const Inputs& x) {
  Matrix dqdd_dq, Minv;
  robot::AbaDerivatives derivatives;
  derivatives.dqdd_dq = &dqdd_dq;
  derivatives.Minv = &Minv;
  if (robot::aba_derivatives(x.q, x.v, x.tau, x.f_ext, x.gravity, x.masses, derivatives) != 0)
    return false;
  print("aba_derivatives.dqdd_dq", dqdd_dq);
  print("aba_derivatives.Minv", Minv);
  double kinetic = 0, potential = 0;
  robot::Energy energy;
  energy.T_ = &kinetic;
  energy.V = &potential;
  robot::energy(x.q, x.v, x.gravity, x.masses, energy);
  std::printf("energy.T:%.17g\nenergy.V:%.17g\n", kinetic, potential);
  // Without mass no pivot is positive: the first that is wrong is named, and all is nan.
  const Masses none = Masses::Zero();
  return robot::aba_derivatives(x.q, x.v, x.tau, x.f_ext, x.gravity, none, derivatives) > 0 &&
         Minv.hasNaN();
}

bool call(const Inputs& x) {
  print("rnea.tau", robot::rnea(x.q, x.v, x.a, x.f_ext, x.gravity, x.masses));
  print("gravity.g", robot::gravity(x.q, x.gravity, x.masses));
  const auto placements = robot::fk(x.q, x.gravity, x.masses);
  static_assert(decltype(robot::fk(x.q, x.gravity, x.masses))::IsRowMajor, "");
  print("fk.placements", placements);
  print("frame_jacobian.J", robot::frame_jacobian(x.q, x.gravity, x.masses));
  const Eigen::Matrix<double, robot::nv, 12> by_wrenches =
      robot::rnea_tau_jacobian_f_ext(x.q, x.v, x.a, x.f_ext, x.gravity, x.masses);
  print("rnea_tau_jacobian_f_ext.dtau_df_ext", by_wrenches);
  Tangent by_v;
  Masses by_masses;
  robot::RneaTauVjpVMasses vjp;
  vjp.vjp_v = &by_v;
  vjp.vjp_masses = &by_masses;
  robot::rnea_tau_vjp_v_masses(x.q, x.v, x.a, x.f_ext, x.gravity, x.masses, x.lambda, vjp);
  print("rnea_tau_vjp_v_masses.vjp_v", by_v);
  print("rnea_tau_vjp_v_masses.vjp_masses", by_masses);
  return several(x);
}

}  // namespace

int main() {
  Inputs x;
  if (!(read(x.q) && read(x.v) && read(x.a) && read(x.tau) && read(x.f_ext) && read(x.gravity) &&
        read(x.masses) && read(x.lambda)))
    return 2;
  return call(x) ? 0 : 1;
}
