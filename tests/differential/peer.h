// Independent dynamics libraries in the conventions of this project, mimic followers included.
//
// The libraries know no followers: they are built from the freed model, and here its coordinates
// are expressed by those of the leaders (v_freed = G v, tau = G^T tau_freed).
#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "describe.h"
#include "model/model.h"
#include "peer.hpp"

namespace arboc::test {

using MakePeer = std::unique_ptr<peers::Peer> (*)(const peers::Body& body);

class Peer {
 public:
  /// Null if the model has something that the library lacks.
  static std::unique_ptr<Peer> make(const Model& model, MakePeer make);

  /// As the generated functions of the same names; not const, as peers keep state.
  Eigen::VectorXd rnea(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                       const Eigen::VectorXd& a);
  Eigen::MatrixXd crba(const Eigen::VectorXd& q);
  /// Without followers, and where the library has it.
  bool has_aba() const;
  Eigen::VectorXd aba(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                      const Eigen::VectorXd& tau);

 private:
  explicit Peer(const Model& model);

  Eigen::VectorXd freed(const Eigen::VectorXd& q) const { return follow_q_ * q + offset_; }

  Eigen::MatrixXd follow_q_, follow_v_;  ///< freed = follow * given (+ offset for q)
  Eigen::VectorXd offset_;
  std::unique_ptr<peers::Peer> peer_;
};

struct PeerKind {
  const char* name;
  double tolerance;    ///< relative to the largest entry
  const char* reason;  ///< of the tolerance
  MakePeer make;
};

/// The libraries that were installed when this was built.
const std::vector<PeerKind>& peer_kinds();

}  // namespace arboc::test
