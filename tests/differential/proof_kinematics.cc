#include "differential/proof_identities.h"

namespace arboc::test {
namespace {

using Error = std::optional<double>;
constexpr Derivative kJacobian = Derivative::kJacobian;

bool follows(const Case& c) {
  for (const Joint& joint : c.f.setup().model.joints)
    if (joint.mimic) return true;
  return false;
}
VectorXd rates(const Case& c) { return c.input("v"); }

/// Rows of placements are R by rows, then p; they turn by [w].
Error rigid(const Case& c) {
  if (c.f.setup().axes != Axes::kLocal) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(c.f.setup().frames.size());
  const MatrixXd dq =
      as_matrix(c.derivative(kJacobian, "fk.placements:q").at("dplacements_dq"), 12 * n);
  const VectorXd at = c.vector("fk", "placements"), rate = dq * rates(c);
  const VectorXd velocity = c.vector("frame_velocity", "velocity");
  double error = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const MatrixXd R = at.segment(12 * k, 9).reshaped<Eigen::RowMajor>(3, 3);
    const MatrixXd dR = rate.segment(12 * k, 9).reshaped<Eigen::RowMajor>(3, 3);
    const Eigen::Vector3d w = velocity.segment(6 * k + 3, 3);
    Eigen::Matrix3d cross;
    cross << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    error = std::max({error, apart(dR, R * cross),
                      apart(rate.segment(12 * k + 9, 3), R * velocity.segment(6 * k, 3)),
                      apart(R.transpose() * R, MatrixXd::Identity(3, 3))});
  }
  return error;
}

MatrixXd frames_matrix(const Case& c, const char* function, const char* output) {
  return c.matrix(function, output, static_cast<Eigen::Index>(6 * c.f.setup().frames.size()), c.in);
}

Error jacobian_rate(const Case& c) {
  const MatrixXd dJ = frames_matrix(c, "frame_jacobian_dot", "dJ");
  const MatrixXd by_q =
      as_matrix(c.derivative(kJacobian, "frame_jacobian.J:q").at("dJ_dq"), dJ.size());
  return apart(VectorXd(by_q * rates(c)).reshaped<Eigen::RowMajor>(dJ.rows(), dJ.cols()), dJ);
}

/// Each column of a frame's Jacobian is that of its coordinate, or zero.
Error shared_columns(const Case& c) {
  if (follows(c)) return std::nullopt;
  Setup setup = c.f.setup();
  setup.axes = Axes::kWorld;
  ProofEngine world(setup, c.f.lowering());
  const auto frames = static_cast<Eigen::Index>(setup.frames.size());
  const MatrixXd J = as_matrix(world({"frame_jacobian"}, c.in).at("J"), 6 * frames);
  const MatrixXd all = c.matrix("joint_jacobians", "J_world", 6, c.in);
  double error = 0;
  for (Eigen::Index k = 0; k < frames; ++k)
    for (int col = 0; col < c.nv(); ++col) {
      const VectorXd own = J.col(col).segment(6 * k, 6);
      if (own.any()) error = std::max(error, apart(own, all.col(col)));
    }
  return error;
}

Eigen::Index transform_rows(const Case& c) {
  return static_cast<Eigen::Index>(4 * c.f.setup().frames.size());
}

/// A frame's T is what fk has, and has its inverse.
Error transforms_of_fk(const Case& c) {
  const Eigen::Index rows = transform_rows(c);
  const MatrixXd T = c.matrix("transforms", "T", rows, c.in);
  const MatrixXd back = c.matrix("transforms", "T_inverse", rows, c.in);
  const VectorXd at = c.vector("fk", "placements");
  double error = 0;
  for (Eigen::Index f = 0; 4 * f < rows; ++f) {
    MatrixXd expected = MatrixXd::Identity(4, 4);
    expected.topLeftCorner(3, 3) = at.segment(12 * f, 9).reshaped<Eigen::RowMajor>(3, 3);
    expected.topRightCorner(3, 1) = at.segment(12 * f + 9, 3);
    const MatrixXd own = T.middleRows(4 * f, 4);
    error = std::max({error, apart(own, expected),
                      apart(own * back.middleRows(4 * f, 4), MatrixXd::Identity(4, 4))});
  }
  return error;
}

/// A derivative of transforms, of order 0 to 3, along v throughout: 4 rows and columns a frame.
MatrixXd along_rates(const Case& c, int order, const Values& at) {
  const char* names[] = {"T", "dT", "d2T", "d3T"};
  const MatrixXd all = as_matrix(at.at(names[order]), transform_rows(c));
  const VectorXd v = rates(c);
  MatrixXd sum = MatrixXd::Zero(all.rows(), 4);
  Eigen::Index block = 0;
  const auto add = [&](double weight) { sum += weight * all.middleCols(4 * block++, 4); };
  for (int l = 0; l < (order > 0 ? c.nv() : 1); ++l)
    for (int k = 0; k <= (order > 1 ? l : 0); ++k)
      for (int j = 0; j <= (order > 2 ? k : 0); ++j) {
        if (order == 0) add(1);
        if (order == 1) add(v[l]);
        if (order == 2) add((k == l ? 1 : 2) * v[k] * v[l]);
        if (order == 3) add((j == l ? 1 : j == k || k == l ? 3 : 6) * v[j] * v[k] * v[l]);
      }
  return sum;
}

/// The derivative of order - 1, taken on the graph, and that of the given order.
Error transform_derivative(const Case& c, int order) {
  if (c.f.setup().transform_order < order) return std::nullopt;
  const char* lower[] = {"T", "dT", "d2T"};
  const std::string name = lower[order - 1];
  const Values J = c.derivative(kJacobian, ("transforms." + name + ":q").c_str());
  const Values at = c.f({"transforms"}, c.in);
  const auto entries = static_cast<Eigen::Index>(at.at(name).size());
  Values moved;
  moved[name] = as_list(as_matrix(J.at("d" + name + "_dq"), entries) * rates(c));
  return apart(along_rates(c, order, at), along_rates(c, order - 1, moved));
}

Error velocity_of_jacobian(const Case& c) {
  return apart(c.vector("frame_velocity", "velocity"),
               frames_matrix(c, "frame_jacobian", "J") * rates(c));
}
Error acceleration_of_jacobian(const Case& c) {
  return apart(c.vector("frame_acceleration", "acceleration"),
               frames_matrix(c, "frame_jacobian", "J") * c.input("a") +
                   frames_matrix(c, "frame_jacobian_dot", "dJ") * rates(c));
}
Error velocity_derivatives(const Case& c) {
  const MatrixXd J = frames_matrix(c, "frame_jacobian", "J");
  const MatrixXd dJ = frames_matrix(c, "frame_jacobian_dot", "dJ");
  return std::max(apart(frames_matrix(c, "frame_velocity_derivatives", "dvelocity_dv"), J),
                  apart(frames_matrix(c, "frame_velocity_derivatives", "dvelocity_dq") * rates(c),
                        dJ * rates(c)));
}
Error acceleration_derivatives(const Case& c) {
  return apart(frames_matrix(c, "frame_acceleration_derivatives", "dacceleration_da"),
               frames_matrix(c, "frame_jacobian", "J"));
}

Error momentum_rate(const Case& c) {
  const Values J = c.derivative(kJacobian, "centroidal.h:q,v");
  return apart(c.vector("centroidal", "dh"),
               as_matrix(J.at("dh_dq"), 6) * rates(c) + as_matrix(J.at("dh_dv"), 6) * c.input("a"));
}

// Half of v: turns stay below pi, where difference() returns the shortest.
Error back_and_forth(const Case& c) {
  const VectorXd step = rates(c) / 2;
  const Values there = c.with("q1", c.vector("integrate", "q_next", c.with("v", step)));
  return apart(c.vector("difference", "d", there), step);
}
Error there(const Case& c) {
  Values end = c.with("v", c.vector("difference", "d"));
  end["q"] = as_list(c.vector("integrate", "q_next", end));
  return apart(c.vector("difference", "d", end), VectorXd::Zero(c.nv()));
}
Error inverse_steps(const Case& c) {
  const Values step = c.with("v", rates(c) / 2);
  const Values there = c.with("q1", c.vector("integrate", "q_next", step));
  const MatrixXd by_v = c.matrix("integrate_derivatives", "dq_next_dv", c.nv(), step);
  return apart(c.matrix("difference_derivatives", "dd_dq1", c.nv(), there) * by_v,
               MatrixXd::Identity(c.nv(), c.nv()));
}
Error moving_start(const Case& c) {
  const Values step = c.with("v", c.vector("difference", "d"));
  return apart(c.square("difference_derivatives", "dd_dq1") *
                   c.matrix("integrate_derivatives", "dq_next_dq", c.nv(), step),
               -c.square("difference_derivatives", "dd_dq"));
}

}  // namespace

std::vector<Identity> kinematics_identities() {
  return {
      {"fk", "dR/dt = R [w], dp/dt = R l", rigid},
      {"frame_velocity", "J v", velocity_of_jacobian},
      {"frame_acceleration", "J a + dJ v", acceleration_of_jacobian},
      {"frame_jacobian", "J v = velocity", velocity_of_jacobian},
      {"frame_jacobian_dot", "(dJ/dq) v", jacobian_rate},
      {"frame_velocity_derivatives", "dvelocity_dv = J, dvelocity_dq v = dJ v",
       velocity_derivatives},
      {"frame_acceleration_derivatives", "dacceleration_da = J", acceleration_derivatives},
      {"joint_jacobians", "columns of frames' J", shared_columns},
      {"transforms", "T = fk, T T_inverse = 1", transforms_of_fk},
      {"transforms", "dT v = (dT/dq) v", [](const Case& c) { return transform_derivative(c, 1); }},
      {"transforms", "d2T v v = (d(dT)/dq v) v",
       [](const Case& c) { return transform_derivative(c, 2); }},
      {"transforms", "d3T v v v = (d(d2T)/dq v) v v",
       [](const Case& c) { return transform_derivative(c, 3); }},
      {"com", "vc = Jc v",
       [](const Case& c) -> Error {
         return apart(c.vector("com", "vc"), c.matrix("com_jacobian", "Jc", 3, c.in) * rates(c));
       }},
      {"com_jacobian", "dc/dq",
       [](const Case& c) -> Error {
         return apart(c.matrix("com_jacobian", "Jc", 3, c.in),
                      as_matrix(c.derivative(kJacobian, "com.c:q").at("dc_dq"), 3));
       }},
      {"centroidal", "dh = (dh/dq) v + (dh/dv) a", momentum_rate},
      {"centroidal", "h = A_G v",
       [](const Case& c) -> Error {
         return apart(c.vector("centroidal", "h"),
                      c.matrix("centroidal", "A_G", 6, c.in) * rates(c));
       }},
      {"integrate", "difference(q, q (+) d) = d", back_and_forth},
      {"difference", "q (+) difference(q, q1) = q1", there},
      {"integrate_derivatives", "inverse of difference's", inverse_steps},
      {"difference_derivatives", "dd_dq = -dd_dq1 dq_next_dq", moving_start}};
}

}  // namespace arboc::test
