// Pinocchio, called as its manual says: one Data, outputs that the caller owns.
#include "pinocchio_model.hpp"
// After its headers.
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

namespace peers {
namespace {

using Eigen::MatrixXd;

class Pinocchio : public Peer {
 public:
  explicit Pinocchio(const Body& given)
      : Peer(given),
        model_(pinocchio_model(body())),
        data_(model_),
        dtau_dq_(MatrixXd::Zero(model_.nv, model_.nv)),
        dtau_dv_(dtau_dq_),
        M_(dtau_dq_) {}

  bool has(Function) const override { return true; }

  void run(Function f, const State& x) override {
    namespace pin = pinocchio;
    switch (f) {
      case Function::kRnea: pin::rnea(model_, data_, x.q, x.v, x.a); break;
      case Function::kCrba: pin::crba(model_, data_, x.q, pin::Convention::LOCAL); break;
      case Function::kAba: pin::aba(model_, data_, x.q, x.v, x.tau, pin::Convention::LOCAL); break;
      case Function::kMinv: pin::computeMinverse(model_, data_, x.q); break;
      case Function::kRneaDerivatives:
        pin::computeRNEADerivatives(model_, data_, x.q, x.v, x.a, dtau_dq_, dtau_dv_, M_);
        break;
    }
  }

 private:
  static MatrixXd symmetric(const MatrixXd& upper) { return upper.selfadjointView<Eigen::Upper>(); }

  Outputs outputs(Function f) const override {
    switch (f) {
      case Function::kRnea: return {data_.tau};
      case Function::kCrba: return {symmetric(data_.M)};
      case Function::kAba: return {data_.ddq};
      case Function::kMinv: return {symmetric(data_.Minv)};
      default: return {dtau_dq_, dtau_dv_, symmetric(M_)};
    }
  }

  pinocchio::Model model_;
  pinocchio::Data data_;
  MatrixXd dtau_dq_, dtau_dv_, M_;
};

}  // namespace

std::unique_ptr<Peer> make_pinocchio(const Body& body) {
  return pinocchio_has(body) ? std::make_unique<Pinocchio>(body) : nullptr;
}

}  // namespace peers
