#include "differential/proof_identities.h"

#include <Eigen/Geometry>

#include "reference/differentiate.h"
#include "reference/momentum.h"
#include "reference/regressor.h"

namespace arboc::test {
namespace {

using Error = std::optional<double>;
constexpr Derivative kJacobian = Derivative::kJacobian, kGradient = Derivative::kGradient;

bool bare(const Case& c) { return c.f.setup().loads.empty() && !c.f.setup().joint_forces.any(); }
VectorXd rates(const Case& c) { return c.input("v"); }
VectorXd tau(const Case& c) { return c.vector("rnea", "tau"); }
MatrixXd inertia(const Case& c) { return c.square("crba", "M"); }
double kinetic(const Case& c) { return c.vector("energy", "T")[0]; }
/// C v.
VectorXd coriolis(const Case& c) { return c.vector("nle", "nle") - c.vector("gravity", "g"); }
double numbers_apart(double a, double b) {
  return apart(VectorXd::Constant(1, a), VectorXd::Constant(1, b));
}

Error power(const Case& c) {
  if (!bare(c)) return std::nullopt;
  const Values T = c.derivative(kGradient, "energy.T:q,v");
  const Values V = c.derivative(kGradient, "energy.V:q");
  const double rate = (as_vector(T.at("grad_q")) + as_vector(V.at("grad_q"))).dot(rates(c)) +
                      as_vector(T.at("grad_v")).dot(c.input("a"));
  return numbers_apart(tau(c).dot(rates(c)), rate);
}

/// A floating base is pushed by its own wrench, by weight and by wrenches from outside.
Error momentum(const Case& c) {
  const Setup& s = c.f.setup();
  const bool known = s.loads.empty() || s.axes == Axes::kWorld;
  if (s.model.joints.front().name != "root_joint" || !known || s.joint_forces.any() ||
      !s.parameters.empty())
    return std::nullopt;
  const VectorXd q = c.input("q"), t = tau(c), centre = c.vector("com", "c");
  const Eigen::Vector3d com = centre, base = q.head(3);
  const Eigen::Quaterniond turn(q[6], q[3], q[4], q[5]);
  const Eigen::Vector3d force = turn * t.segment<3>(0), moment = turn * t.segment<3>(3);
  const Vector3<double>& g = s.model.gravity;
  VectorXd rate(6);
  rate << force + moving_mass(s.model) * Eigen::Vector3d(g.x, g.y, g.z),
      moment + (base - com).cross(force);
  for (size_t k = 0; k < s.loads.size(); ++k) {
    const VectorXd w = c.input("f_ext").segment(static_cast<Eigen::Index>(6 * k), 6);
    rate.head(3) += w.head(3);
    rate.tail(3) += w.tail(3) - com.cross(Eigen::Vector3d(w.head(3)));
  }
  return apart(c.vector("centroidal", "dh"), rate);
}

/// v (dM/dt) v = 2 v C v.
Error skew(const Case& c) {
  if (!bare(c)) return std::nullopt;
  const int n = c.nv();
  const MatrixXd dM = as_matrix(c.derivative(kJacobian, "crba.M:q").at("dM_dq"), n * n);
  const MatrixXd rate = VectorXd(dM * rates(c)).reshaped(n, n);
  return numbers_apart(rates(c).dot(rate * rates(c)), 2 * rates(c).dot(coriolis(c)));
}

Error forward_of_inverse(const Case& c) {
  return apart(c.vector("aba", "qdd", c.with("tau", tau(c))), c.input("a"));
}

Error graph_derivatives(const Case& c) {
  const Values got = c.f({"rnea_derivatives"}, c.in);
  const Values J = c.derivative(kJacobian, "rnea.tau:q,v,a");
  const auto compare = [&](const char* a, const char* b) {
    return apart(as_vector(got.at(a)), as_vector(J.at(b)));
  };
  return std::max(
      {compare("dtau_dq", "dtau_dq"), compare("dtau_dv", "dtau_dv"), compare("M", "dtau_da")});
}

Error homogeneous(const Case& c) {
  if (!bare(c)) return std::nullopt;
  return apart(c.square("rnea_derivatives", "dtau_dv") * rates(c), 2 * coriolis(c));
}

Error implicit(const Case& c) {
  const Values at = c.with("a", c.vector("aba", "qdd"));
  const MatrixXd Minv = c.square("minv", "Minv");
  const auto compare = [&](const char* got, const char* of) {
    return apart(c.square("aba_derivatives", got),
                 -Minv * c.matrix("rnea_derivatives", of, c.nv(), at));
  };
  return std::max(compare("dqdd_dq", "dtau_dq"), compare("dqdd_dv", "dtau_dv"));
}

Error linear_in_a(const Case& c) {
  const Values rest = c.with("a", VectorXd::Zero(c.nv()));
  const MatrixXd change = c.square("rnea_derivatives", "dtau_dq") -
                          c.matrix("rnea_derivatives", "dtau_dq", c.nv(), rest);
  return apart(c.square("rnea_hessian", "H_qa") * c.input("a"),
               change.transpose() * c.input("lambda"));
}

Error quadratic_in_v(const Case& c) {
  if (!bare(c)) return std::nullopt;
  return apart(c.square("rnea_hessian", "H_vv") * rates(c),
               c.square("rnea_derivatives", "dtau_dv").transpose() * c.input("lambda"));
}

/// Entry (j, k): gradient^T d^2/ds dt difference(q, (q (+) s e_k) (+) t e_j), complex in t and by
/// differences in s.
MatrixXd connection(const Model& model, const VectorXd& q, const VectorXd& gradient) {
  const ComplexReference reference(model);
  const VectorOf<Complex> start = q.cast<Complex>();
  const int n = reference.nv();
  const double h = 0.01;
  MatrixXd result(n, n);
  for (int j = 0; j < n; ++j)
    for (int k = 0; k < n; ++k) {
      const auto slope = [&](double s) -> double {
        const VectorOf<Complex> first = VectorOf<Complex>::Unit(n, k) * Complex(s);
        const VectorOf<Complex> second =
            VectorOf<Complex>::Unit(n, j) * Complex(0, complex_step::kStep);
        const VectorOf<Complex> end =
            reference.integrate(reference.integrate(start, first), second);
        return gradient.dot(reference.difference(start, end).imag()) / complex_step::kStep;
      };
      const auto odd = [&](int m) { return slope(m * h) - slope(-m * h); };
      result(j, k) = (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h);
    }
  return result;
}

Error iterated(const Case& c) {
  if (!c.f.setup().iterated) return std::nullopt;
  Setup setup = c.f.setup();
  setup.iterated = false;
  ProofEngine symmetric(setup, c.f.lowering());
  const int n = c.nv();
  const VectorXd gradient = c.square("rnea_derivatives", "dtau_dq").transpose() * c.input("lambda");
  MatrixXd expected = as_matrix(symmetric({"rnea_hessian"}, c.in).at("H_qq"), n);
  expected += connection(setup.model, c.input("q"), gradient);
  return apart(c.square("rnea_hessian", "H_qq"), expected);
}

Error linear_in_masses(const Case& c) {
  if (!bare(c)) return std::nullopt;
  const Setup& s = c.f.setup();
  std::vector<std::vector<double>> values;
  for (const Parameter& p : s.parameters) values.push_back(c.in.at(p.name));
  return apart(
      c.square("regressor", "Y") * body_parameters(model_with(s.model, s.parameters, values)),
      tau(c));
}

}  // namespace

std::vector<Identity> dynamics_identities() {
  return {{"rnea", "v tau = d(T + V)/dt", power},
          {"rnea", "M a + nle",
           [](const Case& c) -> Error {
             return apart(inertia(c) * c.input("a") + c.vector("nle", "nle"), tau(c));
           }},
          {"rnea", "dh/dt = wrench of a floating base + weight", momentum},
          {"gravity", "dV/dq",
           [](const Case& c) -> Error {
             return apart(c.vector("gravity", "g"),
                          as_vector(c.derivative(kGradient, "energy.V:q").at("grad_q")));
           }},
          {"statics", "rnea at v = a = 0",
           [](const Case& c) -> Error {
             const VectorXd rest = VectorXd::Zero(c.nv());
             Values at = c.with("a", rest);
             at["v"] = c.with("v", rest).at("v");
             return apart(c.vector("statics", "tau"), c.vector("rnea", "tau", at));
           }},
          {"nle", "rnea at a = 0",
           [](const Case& c) -> Error {
             return apart(c.vector("nle", "nle"),
                          c.vector("rnea", "tau", c.with("a", VectorXd::Zero(c.nv()))));
           }},
          {"crba", "v (dM/dt - 2 C) v = 0", skew},
          {"crba", "T = v M v / 2",
           [](const Case& c) -> Error {
             if (c.f.setup().joint_forces.any()) return std::nullopt;
             return numbers_apart(rates(c).dot(inertia(c) * rates(c)) / 2, kinetic(c));
           }},
          {"minv", "Minv M = 1",
           [](const Case& c) -> Error {
             return apart(c.square("minv", "Minv") * inertia(c),
                          MatrixXd::Identity(c.nv(), c.nv()));
           }},
          {"aba", "aba(rnea(a)) = a", forward_of_inverse},
          {"rnea_derivatives", "the graph's derivative of rnea", graph_derivatives},
          {"rnea_derivatives", "dtau_dv v = 2 C v", homogeneous},
          {"aba_derivatives", "-Minv dtau at qdd", implicit},
          {"rnea_hessian", "H_qa a = change of dtau_dq with a", linear_in_a},
          {"rnea_hessian", "H_vv v = dtau_dv lambda", quadratic_in_v},
          {"rnea_hessian", "iterated - symmetric = connection of q (+) d", iterated},
          {"energy", "dT/dv = M v",
           [](const Case& c) -> Error {
             if (c.f.setup().joint_forces.any()) return std::nullopt;
             return apart(as_vector(c.derivative(kGradient, "energy.T:v").at("grad_v")),
                          inertia(c) * rates(c));
           }},
          {"regressor", "Y pi = tau", linear_in_masses}};
}

}  // namespace arboc::test
