// Libraries of rigid-body dynamics behind one interface, in the conventions of arboc.
//
// A peer is built from a plain description of the body through its own API.  Its rates of planar
// and floating joints may differ from ours by a linear map, which the base class applies:
// v_peer = J v, tau = J^T tau_peer.  What is timed is run() on a state that to_peer() has
// converted. Tests link these files; `arboc bench --peers` compiles them, each with the library
// that it needs, so they know nothing of the compiler: C++17 and Eigen.
#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "body.hpp"

namespace peers {

using Outputs = std::array<Eigen::MatrixXd, 3>;  ///< as many as the function has, from the front

struct State {
  Eigen::VectorXd q, v, a, tau;
};

inline int nq(Kind kind) {
  return kind == Kind::kFixed ? 0 : kind == Kind::kPlanar ? 3 : kind == Kind::kFloating ? 7 : 1;
}
inline int nv(Kind kind) {
  return kind == Kind::kFixed ? 0 : kind == Kind::kPlanar ? 3 : kind == Kind::kFloating ? 6 : 1;
}
inline Eigen::Matrix3d matrix(const double* rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows);
}
inline Eigen::Vector3d vector(const double* x) { return Eigen::Map<const Eigen::Vector3d>(x); }
inline Eigen::Matrix3d inertia(const Link& link) {
  Eigen::Matrix3d I;
  I << link.I[0], link.I[3], link.I[4], link.I[3], link.I[1], link.I[5], link.I[4], link.I[5],
      link.I[2];
  return I;
}

class Peer {
 public:
  explicit Peer(const Body& body);
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  virtual bool has(Function f) const = 0;
  /// Whether has(f) in a way that the library's users would choose.
  virtual bool worth_timing(Function f) const { return has(f); }

  /// A state as the library takes it.
  State to_peer(const State& ours) const;
  /// Evaluates; the result stays in the library's own storage.
  virtual void run(Function f, const State& peer) = 0;
  /// Runs, and gives the outputs in our conventions.
  Outputs evaluate(Function f, const State& ours);

 protected:
  /// Rates of a floating or planar joint: v_peer = J v, a_peer = J a + Jdot_v.
  struct Rates {
    Eigen::MatrixXd J;
    Eigen::VectorXd Jdot_v;
  };

  const Body& body() const { return body_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<Link>& links() const { return links_; }
  /// Whether the root is fixed in the world.
  bool welded() const { return joints_.empty() || joints_[0].parent >= 0; }

  /// Rates of a library whose translations are along the parent's axes: J = R on the linear part.
  static Rates parent_axes(const Joint& joint, const Eigen::VectorXd& q, const Eigen::VectorXd& v);

 private:
  /// Of a joint with more than one rate; here the same as ours.
  virtual Rates rates(const Joint& joint, const Eigen::VectorXd& q, const Eigen::VectorXd& v) const;
  /// What the library wants instead of our numbers, the rates already its own.
  virtual State converted(const State& x) const { return x; }
  /// Outputs of the last run, degrees of freedom in our order.
  virtual Outputs outputs(Function f) const = 0;

  Rates all_rates(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const;

  Body body_;  ///< what it refers to is here
  std::vector<Joint> joints_;
  std::vector<Link> links_;
  std::string folder_, compiler_, flags_;
};

/// Each file defines those of its library.  Null if the body has something that the library lacks.
std::unique_ptr<Peer> make_dart(const Body& body);
std::unique_ptr<Peer> make_kdl(const Body& body);
std::unique_ptr<Peer> make_mujoco(const Body& body);
std::unique_ptr<Peer> make_pinocchio(const Body& body);
std::unique_ptr<Peer> make_pinocchio_codegen(const Body& body);
std::unique_ptr<Peer> make_rbdl(const Body& body);

}  // namespace peers
