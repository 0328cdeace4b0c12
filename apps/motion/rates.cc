#include "rates.h"

#include <fmt/format.h>

#include <posture/build.h>
#include <Eigen/Dense>
#include <cmath>

namespace motion {
namespace {

using namespace arboc::nlp;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using posture::Model;

/// Contacts hold where none moves faster, m/s or 1/s.
constexpr double kRateTolerance = 1e-9;
/// Singular values that count, of the largest: below are arms that are straight.
constexpr double kRank = 1e-9;

/// d placements / dq, dense.
MatrixXd placement_rates(const Model& model, const VectorXd& q) {
  Function& f = *model.robot.placements;
  const Pattern& at = f.jacobian_pattern();
  std::vector<double> entries(at.size());
  f.jacobian(1, q.data(), entries.data());
  MatrixXd J = MatrixXd::Zero(f.outputs(), f.inputs());
  for (std::size_t k = 0; k < entries.size(); ++k) J(at.row[k], at.col[k]) = entries[k];
  return J;
}

/// Rows J of which J v is how a contact moves: along the normals of its place, then across the
/// directions of its axes.
MatrixXd contact_rows(const Model& model, const Contact& contact, const MatrixXd& J) {
  const Eigen::Index first = 12 * model.robot.frame(contact.frame);
  const auto direction = [&](const Vector3& local) {
    MatrixXd rows = MatrixXd::Zero(3, J.cols());
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j) rows.row(i) += local[j] * J.row(first + 3 * i + j);
    return rows;
  };
  std::vector<Eigen::RowVectorXd> rows;
  if (contact.place.kind != Place::Kind::kAbove)
    for (const Vector3& n : contact.place.normals())
      rows.emplace_back(n.transpose() * (direction(contact.point) + J.middleRows<3>(first + 9)));
  for (const Alignment& a : contact.align)
    for (const Vector3& e : across(a.direction))
      rows.emplace_back(e.transpose() * direction(a.axis.normalized()));
  MatrixXd out(static_cast<Eigen::Index>(rows.size()), J.cols());
  for (Eigen::Index k = 0; k < out.rows(); ++k) out.row(k) = rows[static_cast<std::size_t>(k)];
  return out;
}

double largest(const VectorXd& x) { return x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0; }

/// M(q), by columns of rnea.
MatrixXd mass_matrix(const Model& model, const VectorXd& q) {
  Function& f = *model.robot.dynamics;
  const Eigen::Index n = q.size();
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> x, tau(n + 1, n);
  x.setZero(n + 1, f.inputs());
  x.leftCols(n).rowwise() = q.transpose();
  x.block(0, 2 * n, n, n).setIdentity();
  f.values(static_cast<int>(n) + 1, x.data(), tau.data());
  return (tau.topRows(n).rowwise() - tau.row(n)).transpose();
}

class Completion {
 public:
  Completion(const Model& model, const VectorXd& q, const RateLimits& limits)
      : model_(model), q_(q), limits_(limits), rates_(placement_rates(model, q)) {
    MatrixXd rows = MatrixXd::Zero(1, q.size());  // decompositions need one
    for (const Contact& contact : limits.contacts) {
      const MatrixXd more = contact_rows(model, contact, rates_);
      rows.conservativeResize(rows.rows() + more.rows(), Eigen::NoChange);
      rows.bottomRows(more.rows()) = more;
    }
    rows_ = rows;
    mass_ = mass_matrix(model, q);
    v_ = VectorXd::Zero(q.size());
    known_.assign(static_cast<std::size_t>(q.size()), false);
  }

  void give(int i, double value) {
    v_[i] = value;
    known_[static_cast<std::size_t>(i)] = true;
  }

  /// All that is not known.
  void solve() {
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < v_.size(); ++i) {
      if (known_[static_cast<std::size_t>(i)]) continue;
      v_[i] = 0;
      free.push_back(i);
    }
    if (free.empty()) return;
    const MatrixXd C = rows_(Eigen::all, free), M = mass_(free, free);
    const VectorXd b = rows_ * v_, momentum = (mass_ * v_)(free);
    const Eigen::JacobiSVD<MatrixXd> svd(C, Eigen::ComputeThinU | Eigen::ComputeFullV);
    const VectorXd& s = svd.singularValues();
    const Eigen::Index rank = (s.array() > kRank * s[0]).count();
    const VectorXd inverse = s.head(rank).cwiseInverse();
    VectorXd u = -svd.matrixV().leftCols(rank) * inverse.asDiagonal() *
                 svd.matrixU().leftCols(rank).transpose() * b;
    const MatrixXd N = svd.matrixV().rightCols(u.size() - rank);
    if (N.cols() > 0)
      u -= N * (N.transpose() * M * N).ldlt().solve(N.transpose() * (M * u + momentum));
    v_(free) = u;
  }

  /// "contact 'left hand' would move at 0.1": empty where all hold.
  std::string moving() const {
    std::string text;
    for (const Contact& contact : limits_.contacts) {
      const double rate = largest(contact_rows(model_, contact, rates_) * v_);
      if (rate > kRateTolerance)
        text += fmt::format("{}'{}' would move at {:.2g} m/s or rad/s", text.empty() ? "" : ", ",
                            contact.name, rate);
    }
    return text;
  }

  /// Coordinates that are not known and leave their limits within the reach; those become still.
  bool stop_at_limits() {
    bool stopped = false;
    for (int i = 0; i < model_.robot.size(); ++i)
      if (!known_[static_cast<std::size_t>(i)] && leaves(i)) {
        give(i, 0);
        stopped = true;
      }
    return stopped;
  }
  bool leaves(int i) const {
    const auto at = static_cast<std::size_t>(i);
    const double most = std::fabs(v_[i]) * limits_.reach;
    return most > 0 &&
           (q_[i] + most > model_.robot.q_upper[at] || q_[i] - most < model_.robot.q_lower[at]);
  }

  const VectorXd& velocity() const { return v_; }

 private:
  const Model& model_;
  const VectorXd& q_;
  const RateLimits& limits_;
  MatrixXd rates_, rows_, mass_;
  VectorXd v_;
  std::vector<bool> known_;
};

}  // namespace

VectorXd complete_velocity(const Model& model, const VectorXd& q,
                           const std::map<std::string, double>& given, const RateLimits& limits,
                           const std::string& what) {
  if (given.empty()) return VectorXd::Zero(q.size());
  Completion completion(model, q, limits);
  for (const auto& [name, value] : given) completion.give(model.robot.coordinate(name), value);
  for (const auto& [name, value] : given)
    if (completion.leaves(model.robot.coordinate(name)))
      throw std::invalid_argument(what + ": '" + name + "' is about to leave its limits");
  do completion.solve();
  while (completion.stop_at_limits());
  if (const std::string moving = completion.moving(); !moving.empty())
    throw std::invalid_argument(what + ": contacts do not allow it: " + moving);
  return completion.velocity();
}

}  // namespace motion
