// Independent dynamics libraries behind one interface, in the conventions of this project.
//
// A peer is built from a configured Model through its own API.  Its author's coordinates differ
// from ours only in the rates of floating and planar joints and in knowing no mimic followers;
// both are a linear map, which this class applies: v_peer = J v, tau = J^T tau_peer.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "model/model.h"

namespace arboc::test {

class Peer {
 public:
  explicit Peer(const Model& model);
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// As the generated functions of the same names; not const, as peers keep state.
  Eigen::VectorXd rnea(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                       const Eigen::VectorXd& a);
  Eigen::MatrixXd crba(const Eigen::VectorXd& q);

  /// The peer's own calls, for timing: the followers freed and rates as the peer takes them.
  Eigen::VectorXd native_rnea(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                              const Eigen::VectorXd& a) {
    return peer_rnea(q, v, a);
  }
  Eigen::MatrixXd native_crba(const Eigen::VectorXd& q) { return peer_crba(q); }

 protected:
  /// Rates of a floating or planar joint: v_peer = J v, a_peer = J a + Jdot_v.
  struct Rates {
    Eigen::MatrixXd J;
    Eigen::VectorXd Jdot_v;
  };

  /// The model with its followers freed: what the peer is to be built from.  Its degrees of
  /// freedom are numbered as where() says; the peer's are to have the same numbers.
  const Model& model() const { return model_; }
  const Coordinates& where() const { return where_; }

  /// Rates of a peer whose translations are along the parent's axes: J = R on the linear part.
  static Rates parent_axes(const Joint& joint, const Eigen::VectorXd& q, const Eigen::VectorXd& v);

 private:
  virtual Rates rates(const Joint& joint, const Eigen::VectorXd& q,
                      const Eigen::VectorXd& v) const = 0;
  /// Both on the freed model: q as ours, the rest in the peer's rates.
  virtual Eigen::VectorXd peer_rnea(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                    const Eigen::VectorXd& a) = 0;
  virtual Eigen::MatrixXd peer_crba(const Eigen::VectorXd& q) = 0;

  Eigen::VectorXd freed(const Eigen::VectorXd& q) const { return follow_q_ * q + offset_; }
  Rates all_rates(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const;

  Model model_;
  Coordinates where_;
  Eigen::MatrixXd follow_q_, follow_v_;  ///< freed = follow * given (+ offset for q)
  Eigen::VectorXd offset_;
};

struct PeerKind {
  const char* name;
  double tolerance;    ///< relative to the largest entry
  const char* reason;  ///< of the tolerance
  /// Null if the model has something that the peer lacks.
  std::unique_ptr<Peer> (*make)(const Model& model);
};

/// The peers that were installed when this was built.
const std::vector<PeerKind>& peers();

std::unique_ptr<Peer> make_dart(const Model& model);
std::unique_ptr<Peer> make_kdl(const Model& model);
std::unique_ptr<Peer> make_mujoco(const Model& model);

}  // namespace arboc::test
