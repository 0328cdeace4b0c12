// Checks of docs/conventions.md in words: mimic joints, momentum, regressor, derivatives.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "differential/conventions_checks.h"
#include "differential/conventions_robot.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::vector<double> kAtRest{0, 0, 0, 0, 0, 0, 1};

void expect_equal(const MatrixXd& actual, const MatrixXd& expected, double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), tolerance) << actual << "\n\n" << expected;
}

/// Numbers from -1 to 1 that have no pattern.
std::vector<double> some(int n, double seed) {
  std::vector<double> x;
  for (int k = 0; k < n; ++k) x.push_back(std::sin(seed + 1.7 * k + 0.3 * k * k));
  return x;
}

/// A state of all_joints: spin 0, swing 1, slide 2, puck 3, drift 6, tail 13 (rates: 12).
const std::vector<double> kAllJoints{0.3, -0.7, 0.1,  0.2, -0.4, 1.1,  0.3,
                                     0.2, -0.1, 0.48, 0.6, 0.0,  0.64, -0.5};

/// The same with followers of their own: spin swing slide counter feed puck echo drift tail.
std::vector<double> independent(const std::vector<double>& q) {
  std::vector<double> out{q[0], q[1], q[2], -1.5 * q[1] + 0.2, 0.05 * q[0] - 0.1};
  out.insert(out.end(), q.begin() + 3, q.begin() + 6);
  out.push_back(-0.75 * q[1] - 0.2);
  out.insert(out.end(), q.begin() + 6, q.end());
  return out;
}

void follower_positions() {
  const std::string fk = "--function fk --frames counter_link,echo_link ";
  expect_equal(eval_matrix(own("all_joints"), fk, {{"q", kAllJoints}}, 12),
               eval_matrix(own("all_joints"), fk + "--mimic independent",
                           {{"q", independent(kAllJoints)}}, 12),
               1e-14);
}

void follower_columns() {
  const std::string J = "--function frame_jacobian --frames slide_link,counter_link,echo_link ";
  const MatrixXd own_columns = eval_matrix(own("all_joints"), J + "--mimic independent",
                                           {{"q", independent(kAllJoints)}}, 16);
  const MatrixXd columns = eval_matrix(own("all_joints"), J, {{"q", kAllJoints}}, 13);
  const MatrixXd sum = own_columns.col(1) - 1.5 * own_columns.col(3) - 0.75 * own_columns.col(8);
  expect_equal(columns.col(1), sum, 1e-14);
}

std::vector<double> quadruped_q() {
  std::vector<double> q{0.1, -0.2, 0.4, 0.48, 0.6, 0.0, 0.64};
  for (const double x : some(12, 1)) q.push_back(x);
  return q;
}

void free_fall() {
  const std::string quadruped = own("quadruped"), base = "--base floating ";
  const Inputs state{{"q", quadruped_q()}, {"v", some(18, 2)}};
  Inputs motion = state, forces = state;
  forces["tau"] = std::vector<double>(18, 0.0);
  motion["a"] = eval(quadruped, base + "--function aba", forces);
  const auto dh = eval(quadruped, base + "--function centroidal --output dh", motion);
  const double weight = eval(quadruped, base + "--function gravity",
                             {{"q",
                               [] {
                                 std::vector<double> q(19, 0.0);
                                 q[6] = 1;
                                 return q;
                               }()}})
                            .at(2);
  VectorXd expected = VectorXd::Zero(6);
  expected[2] = -weight;
  // Accelerations of light legs are some hundred rad/s^2, and their momenta cancel.
  expect_equal(Eigen::Map<const VectorXd>(dh.data(), 6), expected, 1e-10);
}

void regressor_times_parameters() {
  const Inputs motion{{"q", {0.3, -0.8}}, {"v", {1, 2}}, {"a", {3, -1}}};
  VectorXd parameters(20);
  parameters << 1.2, 0, 0, -0.6, 0.10003 + 1.2 * 0.25, 0, 0.10003 + 1.2 * 0.25, 0, 0, 6e-5,  //
      0.6, 0, 0, -0.15, 0.012515 + 0.6 * 0.0625, 0, 0.012515 + 0.6 * 0.0625, 0, 0, 3e-5;
  const MatrixXd Y = eval_matrix(own("double_pendulum"), "--function regressor", motion, 20);
  ASSERT_EQ(Y.rows(), 2);
  expect_equal(Y * parameters, eval_matrix(own("double_pendulum"), "--function rnea", motion, 1),
               1e-13);
}

void integrate_after_a_turn() {
  const MatrixXd J = eval_matrix(own("double_pendulum"),
                                 kCube + "--function integrate_derivatives --output dq_next_dq",
                                 {{"q", kAtRest}, {"v", {1, 0, 0, 0, 0, 0}}}, 6);
  ASSERT_EQ(J.rows(), 6);
  VectorXd expected = VectorXd::Zero(6);
  expected[1] = expected[5] = 1;
  expect_equal(J.col(5), expected, 1e-15);
}

void difference_of_angles() {
  const auto d = eval(own("double_pendulum"), "--function difference_derivatives",
                      {{"q", {0.3, -0.8}}, {"q1", {1, 2}}});
  EXPECT_EQ(d, (std::vector<double>{-1, 0, 0, -1, 1, 0, 0, 1}));
}

/// q (+) epsilon e_k of the cube.
std::vector<double> moved(const std::vector<double>& q, size_t k, double epsilon) {
  std::vector<double> v(6, 0.0);
  v[k] = epsilon;
  return eval(own("double_pendulum"), kCube + "--function integrate", {{"q", q}, {"v", v}});
}

void moves_along_own_x() {
  const double h = std::sqrt(0.5);
  const auto q = moved({0, 0, 0, 0, 0, h, h}, 0, 1e-3);
  EXPECT_NEAR(q.at(0), 0, 1e-18);
  EXPECT_NEAR(q.at(1), 1e-3, 1e-18);
}
void turns_about_own_z() {
  const auto q = moved(kAtRest, 5, 1e-6);
  EXPECT_NEAR(q.at(5), 5e-7, 1e-19);  // next is the cube of epsilon / 2
  EXPECT_NEAR(q.at(6), 1, 1e-12);
}

void derivatives_of_both_dynamics() {
  const std::string quadruped = own("quadruped"), base = "--base floating ";
  Inputs state{{"q", quadruped_q()}, {"v", some(18, 2)}};
  Inputs forces = state, motion = state;
  forces["tau"] = some(18, 3);
  motion["a"] = eval(quadruped, base + "--function aba", forces);
  const MatrixXd M = eval_matrix(quadruped, base + "--function crba", {{"q", state["q"]}}, 18);
  const auto of = [&](const std::string& function, const std::string& output, const Inputs& in) {
    return eval_matrix(quadruped, base + "--function " + function + " --output " + output, in, 18);
  };
  for (const std::string x : {"q", "v"}) {
    const MatrixXd dqdd = of("aba_derivatives", "dqdd_d" + x, forces);
    const MatrixXd dtau = of("rnea_derivatives", "dtau_d" + x, motion);
    expect_equal(M * dqdd, -dtau, 1e-12 * std::max(1.0, dqdd.cwiseAbs().maxCoeff()));
  }
}

/// (linear, angular) of unit rates 3 to 11 of all_joints: planar along z of its own axes, floating.
Eigen::Matrix<double, 6, 1> twist(int coordinate) {
  Eigen::Matrix<double, 6, 1> t = Eigen::Matrix<double, 6, 1>::Zero();
  if (coordinate < 6)
    t[coordinate == 5 ? 5 : coordinate - 3] = 1;
  else
    t[coordinate - 6] = 1;
  return t;
}

/// [E_j, E_i] f of two coordinates of one joint, from the gradient of f.
double along_bracket(int j, int i, const VectorXd& gradient) {
  const Eigen::Matrix<double, 6, 1> a = twist(j), b = twist(i);
  Eigen::Matrix<double, 6, 1> bracket;
  bracket << a.tail<3>().cross(b.head<3>()) + a.head<3>().cross(b.tail<3>()),
      a.tail<3>().cross(b.tail<3>());
  double sum = 0;
  const int first = i < 6 ? 3 : 6, end = i < 6 ? 6 : 12;
  for (int k = first; k < end; ++k) sum += twist(k).dot(bracket) * gradient[k];
  return sum;
}

void iterated_hessian() {
  const Inputs state{
      {"q", kAllJoints}, {"v", some(13, 4)}, {"a", some(13, 5)}, {"lambda", some(13, 6)}};
  const std::string model = own("all_joints");
  const MatrixXd H = eval_matrix(model, "--hessian rnea.tau:q", state, 13);
  const MatrixXd H_it = eval_matrix(model, "--hessian rnea.tau:q --hessian iterated", state, 13);
  const VectorXd gradient = eval_matrix(model, "--vjp rnea.tau:q", state, 1);
  const double rounding = 1e-12 * std::max(1.0, H.cwiseAbs().maxCoeff());
  expect_equal((H_it + H_it.transpose()) / 2, H, rounding);
  MatrixXd expected = MatrixXd::Zero(13, 13);
  for (int i = 3; i < 12; ++i)
    for (int j = i < 6 ? 3 : 6; j < (i < 6 ? 6 : 12); ++j)
      expected(i, j) = along_bracket(j, i, gradient);
  EXPECT_GT(expected.cwiseAbs().maxCoeff(), 0.1);
  expect_equal(H_it - H_it.transpose(), expected, rounding);
}

}  // namespace

std::vector<WordCheck> derivative_checks() {
  return {
      {"FollowerPositions",
       "models/all_joints: q_counter = −1.5 q_swing + 0.2, and q_echo = −0.75 q_swing − 0.2",
       follower_positions},
      {"FollowerColumns",
       "models/all_joints: column swing = swing − 1.5 counter − 0.75 echo with --mimic independent",
       follower_columns},
      {"FreeFall", "models/quadruped, floating, a = aba(q, v, 0): dh = (0, 0, −9.81 m, 0, 0, 0)",
       free_fall},
      {"RegressorTimesParameters",
       "π of the pendulum at q = (0.3, −0.8), v = (1, 2), a = (3, −1): Y π = rnea",
       regressor_times_parameters},
      {"IntegrateAfterATurn",
       "integrate_derivatives of the cube at v = (1, 0, 0, 0, 0, 0): a turn δ about z moves it δ "
       "along y",
       integrate_after_a_turn},
      {"DifferenceOfAngles", "difference_derivatives of the pendulum: −1 and 1",
       difference_of_angles},
      {"MovesAlongOwnX",
       "q = (0, 0, 0, 0, 0, 0.7071, 0.7071), δ = (ε, 0, 0, 0, 0, 0): p becomes (0, ε, 0)",
       moves_along_own_x},
      {"TurnsAboutOwnZ",
       "q = (0, 0, 0, 0, 0, 0, 1), δ = (0, 0, 0, 0, 0, ε): quaternion becomes (0, 0, ε/2, 1)",
       turns_about_own_z},
      {"DerivativesOfBothDynamics",
       "aba_derivatives of models/quadruped: M dqdd_dq + dtau_dq = 0 and M dqdd_dv + dtau_dv = 0",
       derivatives_of_both_dynamics},
      {"IteratedHessian",
       "models/all_joints, λ, v and a not zero: H = ½ (H_it + H_itᵀ), and H_it − H_itᵀ is the "
       "bracket's",
       iterated_hessian},
  };
}

}  // namespace arboc::test
