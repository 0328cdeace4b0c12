// MuJoCo: the model as an MJCF text, with everything off that would change it.
//
// A floating joint is three slides and a ball, a planar one two slides and a hinge, whose
// translations are along the parent's axes.  Bodies moved by a joint need a mass of their own, and
// inertias have to be possible.
#include <mujoco/mujoco.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "peer.hpp"

namespace peers {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Numbers as MJCF wants them, all their digits.
template <class... Numbers>
std::string text(Numbers... numbers) {
  std::ostringstream out;
  out.precision(17);
  (void(out << numbers << ' '), ...);
  return out.str();
}
std::string text(const Eigen::Vector3d& a) { return text(a.x(), a.y(), a.z()); }

std::string inertial_element(const Link& link) {
  const double* I = link.I;
  return "<inertial pos=\"" + text(vector(link.c)) + "\" mass=\"" + text(link.mass) +
         "\" fullinertia=\"" + text(I[0], I[1], I[2], I[3], I[4], I[5]) + "\"/>\n";
}

/// MuJoCo's joints of a joint, named PREFIX.0, PREFIX.1 ... in the order of its rates.
std::string joint_elements(const Joint& joint, const std::string& prefix) {
  std::string out;
  int count = 0;
  const auto add = [&](const char* type, const Eigen::Vector3d& axis) {
    out += "<joint name=\"" + prefix + "." + std::to_string(count++) + "\" type=\"" + type +
           "\" axis=\"" + text(axis) + "\"/>\n";
  };
  const Eigen::Matrix3d F = matrix(joint.plane);
  switch (joint.kind) {
    case Kind::kFixed: break;
    case Kind::kRevolute: add("hinge", vector(joint.axis)); break;
    case Kind::kPrismatic: add("slide", vector(joint.axis)); break;
    case Kind::kPlanar:
      add("slide", F.col(0));
      add("slide", F.col(1));
      add("hinge", F.col(2));
      break;
    case Kind::kFloating:
      add("slide", {1, 0, 0});
      add("slide", {0, 1, 0});
      add("slide", {0, 0, 1});
      add("ball", {0, 0, 1});
      break;
  }
  return out;
}

/// Each joint's parent is among the open bodies.
std::string mjcf(const Body& body) {
  std::string out =
      "<mujoco>\n<compiler angle=\"radian\" coordinate=\"local\" balanceinertia=\"false\" "
      "boundmass=\"0\" boundinertia=\"0\" fusestatic=\"false\" inertiafromgeom=\"false\"/>\n"
      "<option gravity=\"" +
      text(vector(body.gravity)) + "\"/>\n<worldbody>\n";
  std::vector<int> open;  // links
  const auto add = [&](const Joint& joint, const std::string& prefix) {
    while (!open.empty() && open.back() != joint.parent) {
      out += "</body>\n";
      open.pop_back();
    }
    const Eigen::Quaterniond turn(matrix(joint.R));
    out += "<body name=\"link" + std::to_string(joint.child) + "\" pos=\"" + text(vector(joint.p)) +
           "\" quat=\"" + text(turn.w(), turn.x(), turn.y(), turn.z()) + "\">\n";
    if (body.link[joint.child].massive) out += inertial_element(body.link[joint.child]);
    out += joint_elements(joint, prefix);
    open.push_back(joint.child);
  };
  Joint weld;
  weld.child = body.root;
  if (body.joints == 0 || body.joint[0].parent >= 0) add(weld, "");
  for (int k = 0; k < body.joints; ++k) add(body.joint[k], std::to_string(k));
  for (size_t i = 0; i < open.size(); ++i) out += "</body>\n";
  return out + "</worldbody>\n</mujoco>\n";
}

mjModel* load(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "model.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char error[1000] = "";
  mjModel* result = mj_loadXML("model.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (!result) throw std::runtime_error("MuJoCo: " + std::string(error));
  return result;
}

class MujocoPeer : public Peer {
 public:
  explicit MujocoPeer(const Body& given)
      : Peer(given), m_(load(mjcf(body()))), d_(mj_makeData(m_.get())) {
    if (m_->nv != body().nv) throw std::runtime_error("MuJoCo: other degrees of freedom");
    index_.resize(static_cast<size_t>(m_->nv));
    for (size_t k = 0; k < joints().size(); ++k)
      for (int i = 0; i < nv(joints()[k].kind); ++i)  // a ball holds a floating joint's last three
        index_[joints()[k].v + i] =
            m_->jnt_dofadr[joint_id(k, std::min(i, 3))] + std::max(0, i - 3);
    forces_.resize(m_->nv);
    inertia_.resize(m_->nv, m_->nv);
  }

  bool has(Function f) const override { return f == Function::kRnea || f == Function::kCrba; }

  void run(Function f, const State& x) override {
    std::copy_n(x.q.data(), m_->nq, d_->qpos);
    mj_kinematics(m_.get(), d_.get());
    mj_comPos(m_.get(), d_.get());
    if (f == Function::kCrba) {
      mj_crb(m_.get(), d_.get());
      mj_fullM(m_.get(), inertia_.data(), d_->qM);
      return;
    }
    std::copy_n(x.v.data(), m_->nv, d_->qvel);
    std::copy_n(x.a.data(), m_->nv, d_->qacc);
    mj_comVel(m_.get(), d_.get());
    mj_rne(m_.get(), d_.get(), 1, forces_.data());
  }

 private:
  struct Delete {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };

  Rates rates(const Joint& joint, const VectorXd& q, const VectorXd& v) const override {
    return parent_axes(joint, q, v);
  }

  State converted(const State& x) const override {
    return {positions(x.q), to_mujoco(x.v), to_mujoco(x.a), to_mujoco(x.tau)};
  }

  Outputs outputs(Function f) const override {
    const int n = m_->nv;
    if (f == Function::kRnea)
      return {MatrixXd::NullaryExpr(
          n, 1, [&](Eigen::Index i, Eigen::Index) { return forces_[index_[i]]; })};
    return {MatrixXd::NullaryExpr(
        n, n, [&](Eigen::Index i, Eigen::Index j) { return inertia_(index_[i], index_[j]); })};
  }

  VectorXd to_mujoco(const VectorXd& x) const {
    VectorXd result(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) result[index_[i]] = x[i];
    return result;
  }

  VectorXd positions(const VectorXd& q) const {
    VectorXd result(m_->nq);
    for (size_t k = 0; k < joints().size(); ++k) {
      const Joint& joint = joints()[k];
      const bool ball = joint.kind == Kind::kFloating;
      for (int i = 0; i < (ball ? 3 : nq(joint.kind)); ++i)
        result[m_->jnt_qposadr[joint_id(k, i)]] = q[joint.q + i];
      if (!ball) continue;
      double* w_first = &result[m_->jnt_qposadr[joint_id(k, 3)]];
      *w_first = q[joint.q + 6];
      std::copy_n(&q[joint.q + 3], 3, w_first + 1);
    }
    return result;
  }

  int joint_id(size_t k, int i) const {
    const std::string name = std::to_string(k) + "." + std::to_string(i);
    return mj_name2id(m_.get(), mjOBJ_JOINT, name.c_str());
  }

  std::unique_ptr<mjModel, Delete> m_;
  std::unique_ptr<mjData, Delete> d_;
  std::vector<int> index_;  ///< of each degree of freedom in MuJoCo's vectors
  VectorXd forces_;
  MatrixXd inertia_;
};

/// MuJoCo refuses inertias that no body can have: each principal moment is at most the sum of the
/// other two.  Its own diagonalisation decides, so that takes a margin.
bool possible(const Link& link) {
  if (!link.massive) return true;
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia(link)).eigenvalues();
  return link.mass > 0 && moments[0] > 0 && moments[0] + moments[1] > (1 + 1e-5) * moments[2];
}

bool supported(const Body& body) {
  const auto moves_mass = [&](const Joint& joint) {
    return joint.kind == Kind::kFixed || body.link[joint.child].massive;
  };
  return std::all_of(body.link, body.link + body.links, possible) &&
         std::all_of(body.joint, body.joint + body.joints, moves_mass);
}

}  // namespace

std::unique_ptr<Peer> make_mujoco(const Body& body) {
  return supported(body) ? std::make_unique<MujocoPeer>(body) : nullptr;
}

}  // namespace peers
