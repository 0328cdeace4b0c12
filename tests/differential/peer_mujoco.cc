// MuJoCo: the model as an MJCF text, with everything off that would change it.
//
// A floating joint is three slides and a ball, a planar one two slides and a hinge, whose
// translations are along the parent's axes.  Bodies moved by a joint need a mass of their own, and
// inertias have to be possible.
#include <mujoco/mujoco.h>

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "base/number.h"
#include "differential/peer.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string text(const Vector3<double>& a) {
  return fmt::format("{} {} {}", shortest(a.x), shortest(a.y), shortest(a.z));
}

std::string inertial_element(const Inertial& inertial) {
  const Matrix3<double> R = rotation(inertial.origin);
  const Matrix3<double> I = R * full(inertial.inertia) * transpose(R);
  return fmt::format("<inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{} {} {} {} {} {}\"/>\n",
                     text(inertial.origin.xyz), shortest(inertial.mass), shortest(I(0, 0)),
                     shortest(I(1, 1)), shortest(I(2, 2)), shortest(I(0, 1)), shortest(I(0, 2)),
                     shortest(I(1, 2)));
}

/// MuJoCo's joints of a joint, named PREFIX.0, PREFIX.1 ... in the order of its rates.
std::string joint_elements(const Joint& joint, const std::string& prefix) {
  std::string out;
  int count = 0;
  const auto add = [&](const char* type, const Vector3<double>& axis) {
    out += fmt::format("<joint name=\"{}.{}\" type=\"{}\" axis=\"{}\"/>\n", prefix, count++, type,
                       text(axis));
  };
  const Matrix3<double> F = axis_frame(joint.axis);
  switch (joint.type) {
    case JointType::kFixed: break;
    case JointType::kRevolute:
    case JointType::kContinuous: add("hinge", joint.axis); break;
    case JointType::kPrismatic: add("slide", joint.axis); break;
    case JointType::kPlanar:
      add("slide", column(F, 0));
      add("slide", column(F, 1));
      add("hinge", column(F, 2));
      break;
    case JointType::kFloating:
      add("slide", {1, 0, 0});
      add("slide", {0, 1, 0});
      add("slide", {0, 0, 1});
      add("ball", {0, 0, 1});
      break;
    default: throw std::logic_error("no URDF joint");
  }
  return out;
}

/// `model` is configured, so each joint's parent is among the open bodies.
std::string mjcf(const Model& model) {
  std::string out = fmt::format(
      "<mujoco>\n<compiler angle=\"radian\" coordinate=\"local\" eulerseq=\"XYZ\" "
      "balanceinertia=\"false\" boundmass=\"0\" boundinertia=\"0\" fusestatic=\"false\" "
      "inertiafromgeom=\"false\"/>\n<option gravity=\"{}\"/>\n<worldbody>\n",
      text(model.gravity));
  std::vector<int> open;  // links
  const auto add = [&](const Joint& joint, const std::string& prefix) {
    while (!open.empty() && open.back() != joint.parent) {
      out += "</body>\n";
      open.pop_back();
    }
    out += fmt::format("<body name=\"link{}\" pos=\"{}\" euler=\"{}\">\n", joint.child,
                       text(joint.origin.xyz), text(joint.origin.rpy));
    if (const auto& inertial = model.links[joint.child].inertial)
      out += inertial_element(*inertial);
    out += joint_elements(joint, prefix);
    open.push_back(joint.child);
  };
  Joint weld;
  weld.child = model.root;
  if (model.joints.empty() || model.joints[0].parent >= 0) add(weld, "");
  for (size_t k = 0; k < model.joints.size(); ++k) add(model.joints[k], std::to_string(k));
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
  explicit MujocoPeer(const Model& given)
      : Peer(given), m_(load(mjcf(model()))), d_(mj_makeData(m_.get())) {
    if (m_->nv != where().nv) throw std::runtime_error("MuJoCo: other degrees of freedom");
    index_.resize(where().nv);
    for (size_t k = 0; k < model().joints.size(); ++k) {
      const int n = nv(model().joints[k].type);
      for (int i = 0; i < n; ++i)  // a ball holds the last three rates of a floating joint
        index_[where().joint[k].v + i] =
            m_->jnt_dofadr[joint_id(k, std::min(i, 3))] + std::max(0, i - 3);
    }
  }

 private:
  struct Delete {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };

  Rates rates(const Joint& joint, const VectorXd& q, const VectorXd& v) const override {
    return parent_axes(joint, q, v);
  }

  VectorXd peer_rnea(const VectorXd& q, const VectorXd& v, const VectorXd& a) override {
    set_configuration(q);
    for (int i = 0; i < m_->nv; ++i) {
      d_->qvel[index_[i]] = v[i];
      d_->qacc[index_[i]] = a[i];
    }
    mj_comVel(m_.get(), d_.get());
    VectorXd forces(m_->nv);
    mj_rne(m_.get(), d_.get(), 1, forces.data());
    return VectorXd::NullaryExpr(m_->nv, [&](Eigen::Index i) { return forces[index_[i]]; });
  }

  MatrixXd peer_crba(const VectorXd& q) override {
    set_configuration(q);
    mj_crb(m_.get(), d_.get());
    MatrixXd M(m_->nv, m_->nv);
    mj_fullM(m_.get(), M.data(), d_->qM);
    return MatrixXd::NullaryExpr(
        m_->nv, m_->nv, [&](Eigen::Index i, Eigen::Index j) { return M(index_[i], index_[j]); });
  }

  void set_configuration(const VectorXd& q) {
    for (size_t k = 0; k < model().joints.size(); ++k) {
      const Joint& joint = model().joints[k];
      const int first = where().joint[k].q;
      const bool ball = joint.type == JointType::kFloating;
      for (int i = 0; i < (ball ? 3 : nq(joint.type)); ++i)
        d_->qpos[m_->jnt_qposadr[joint_id(k, i)]] = q[first + i];
      if (!ball) continue;
      double* w_first = d_->qpos + m_->jnt_qposadr[joint_id(k, 3)];
      *w_first = q[first + 6];
      std::copy_n(&q[first + 3], 3, w_first + 1);
    }
    mj_kinematics(m_.get(), d_.get());
    mj_comPos(m_.get(), d_.get());
  }

  int joint_id(size_t k, int i) const {
    return mj_name2id(m_.get(), mjOBJ_JOINT, fmt::format("{}.{}", k, i).c_str());
  }

  std::unique_ptr<mjModel, Delete> m_;
  std::unique_ptr<mjData, Delete> d_;
  std::vector<int> index_;  ///< of each degree of freedom in MuJoCo's vectors
};

/// MuJoCo refuses inertias that no body can have: each principal moment is at most the sum of the
/// other two.  Its own diagonalisation decides, so that takes a margin.
bool possible(const Inertial& inertial) {
  const Symmetric3<double>& S = inertial.inertia;
  Eigen::Matrix3d I;
  I << S.xx, S.xy, S.xz, S.xy, S.yy, S.yz, S.xz, S.yz, S.zz;
  const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(I).eigenvalues();
  return inertial.mass > 0 && moments[0] > 0 && moments[0] + moments[1] > (1 + 1e-5) * moments[2];
}

bool supported(const Model& model) {
  const auto link_possible = [](const Link& link) {
    return !link.inertial || possible(*link.inertial);
  };
  const auto moves_mass = [&](const Joint& joint) {
    return joint.type == JointType::kFixed || model.links[joint.child].inertial;
  };
  return std::all_of(model.links.begin(), model.links.end(), link_possible) &&
         std::all_of(model.joints.begin(), model.joints.end(), moves_mass);
}

}  // namespace

std::unique_ptr<Peer> make_mujoco(const Model& model) {
  return supported(model) ? std::make_unique<MujocoPeer>(model) : nullptr;
}

}  // namespace arboc::test
