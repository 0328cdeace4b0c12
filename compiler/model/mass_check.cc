// Whether the masses of a Model are those of bodies.
//
// Fixed joints weld links into bodies; a tensor that looks impossible on one link (a correction
// written as a link of its own) may be fine on the body.  Bodies are merged about their common
// centre of mass, which needs no subtraction:
//   I = I_1 + I_2 + m_1 m_2 / (m_1 + m_2) (d^2 1 - d d^T),   d = c_2 - c_1.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/number.h"
#include "model/validate.h"

namespace arboc {
namespace {

/// Relative to the largest principal moment: what files with few digits get wrong by rounding.
constexpr double kIndefinite = 1e-6;
constexpr double kTriangle = 1e-4;

size_t at(int index) { return static_cast<size_t>(index); }

struct Body {
  double mass = 0;
  Vector3<double> com;         // in the frame of the link
  Symmetric3<double> inertia;  // about com, axes of the link
};

Symmetric3<double> rotated(const Matrix3<double>& R, const Symmetric3<double>& I) {
  return symmetric(R * (full(I) * transpose(R)));
}

Body placed(const Pose& pose, const Body& body) {
  const Matrix3<double> R = rotation(pose);
  return {body.mass, pose.xyz + R * body.com, rotated(R, body.inertia)};
}

Body merged(const Body& a, const Body& b) {
  const double mass = a.mass + b.mass;
  if (mass == 0) return {0, a.com, a.inertia + b.inertia};
  const double share = b.mass / mass;
  const Vector3<double> d = b.com - a.com;
  const double m = a.mass * share;
  const Symmetric3<double> apart{m * (d.y * d.y + d.z * d.z),
                                 m * (d.x * d.x + d.z * d.z),
                                 m * (d.x * d.x + d.y * d.y),
                                 -m * d.x * d.y,
                                 -m * d.x * d.z,
                                 -m * d.y * d.z};
  return {mass, a.com + share * d, a.inertia + b.inertia + apart};
}

bool is_zero(const Symmetric3<double>& I) {
  return I.xx == 0 && I.yy == 0 && I.zz == 0 && I.xy == 0 && I.xz == 0 && I.yz == 0;
}

/// Principal moments in ascending order, divided by the tensor's largest entry; 0 if not finite.
Eigen::Vector3d principal_moments(const Symmetric3<double>& I) {
  Eigen::Matrix3d m;
  m << I.xx, I.xy, I.xz, I.xy, I.yy, I.yz, I.xz, I.yz, I.zz;
  const double scale = m.cwiseAbs().maxCoeff();
  if (scale == 0 || !m.allFinite()) return Eigen::Vector3d::Zero();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m / scale, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

bool indefinite(const Symmetric3<double>& I) {
  const Eigen::Vector3d moments = principal_moments(I);
  return moments[0] < -kIndefinite * moments.cwiseAbs().maxCoeff();
}

class MassCheck {
 public:
  MassCheck(const Model& model, Findings& findings)
      : model_(model),
        findings_(findings),
        joint_of_(joints_onto(model)),
        order_(outward(model, joint_of_)) {}

  void run() {
    for (const Link& link : model_.links) check_signs(link);
    if (findings_.error_count() > 0) return;  // what follows from wrong numbers is no news
    merge();
    for (const int k : order_) {
      check_range(k);
      check_tensor(k);
      if (is_moving_top(k)) check_emptiness(k);
    }
  }

 private:
  /// The link that a moving joint carries; what is fixed to it is merged into it.
  bool is_moving_top(int k) const {
    return joint_of_[at(k)] >= 0 && nv(model_.joints[at(joint_of_[at(k)])]) > 0;
  }

  void check_signs(const Link& link) {
    if (!link.inertial) return;
    const Symmetric3<double>& I = link.inertial->inertia;
    const auto check = [&](const char* what, double value) {
      if (value < 0)
        findings_.error(
            {link.inertial->location, named("link", link.name),
             fmt::format("{}{} is negative ({})", link.inertial->element, what, shortest(value))});
    };
    check("mass", link.inertial->mass);
    check("moment of inertia ixx", I.xx);
    check("moment of inertia iyy", I.yy);
    check("moment of inertia izz", I.zz);
  }

  void merge() {
    bodies_.resize(model_.links.size());
    top_.resize(model_.links.size());
    carries_mass_.resize(model_.links.size());
    for (const int k : order_)
      top_[at(k)] = joint_of_[at(k)] < 0 || is_moving_top(k)
                        ? k
                        : top_[at(model_.joints[at(joint_of_[at(k)])].parent)];
    for (auto it = order_.rbegin(); it != order_.rend(); ++it) {
      const size_t k = at(*it);
      if (const auto& own = model_.links[k].inertial) {
        carries_mass_[k] = carries_mass_[k] || own->mass > 0 || !is_zero(own->inertia);
        bodies_[k] = merged(bodies_[k], placed(own->origin, {own->mass, {}, own->inertia}));
      }
      if (joint_of_[k] < 0) continue;
      const Joint& joint = model_.joints[at(joint_of_[k])];
      const size_t parent = at(joint.parent);
      carries_mass_[parent] = carries_mass_[parent] || carries_mass_[k];
      if (joint.type == JointType::kFixed)
        bodies_[parent] = merged(bodies_[parent], placed(joint.origin, bodies_[k]));
    }
  }

  void check_range(int k) {
    const Body& body = bodies_[at(k)];
    const Symmetric3<double>& I = body.inertia;
    if (std::isfinite(body.mass + dot(body.com, body.com) + I.xx + I.yy + I.zz)) return;
    const Link& link = model_.links[at(k)];
    findings_.error({link.location, named("link", link.name),
                     "mass and inertia of it and what is fixed to it are too large",
                     "check the units: m, kg, kg m^2"});
  }

  void check_tensor(int k) {
    const Link& link = model_.links[at(k)];
    if (!link.inertial) return;
    const Inertial& own = *link.inertial;
    const std::string element = named("link", link.name);
    const Eigen::Vector3d moments = principal_moments(own.inertia);
    if (indefinite(own.inertia)) {
      const int top = top_[at(k)];
      const bool harmful = is_moving_top(top) && indefinite(bodies_[at(top)].inertia);
      findings_.report(harmful ? Severity::kError : Severity::kWarning,
                       {own.location, element,
                        std::string(own.element) + "inertia tensor is not positive definite",
                        "no body has negative principal moments; check ixy, ixz and iyz"});
    } else if (moments[2] > (1 + kTriangle) * (moments[0] + moments[1])) {
      findings_.warning(
          {own.location, element,
           std::string(own.element) + "inertia tensor violates the triangle inequality",
           "of a real body no principal moment exceeds the sum of the other two"});
    }
    if (own.mass == 0 && !is_zero(own.inertia))
      findings_.warning(
          {own.location, element, std::string(own.element) + "mass is 0 but inertia is not"});
  }

  void check_emptiness(int k) {
    const Link& link = model_.links[at(k)];
    const Joint& joint = model_.joints[at(joint_of_[at(k)])];
    if (!carries_mass_[at(k)]) {
      findings_.warning({link.location, named("link", link.name),
                         fmt::format("{} moves it, but neither it nor what hangs on it has mass "
                                     "or inertia",
                                     named("joint", joint.name)),
                         "the mass matrix is singular: no forward dynamics"});
    } else if (bodies_[at(k)].mass == 0 && link.inertial && is_zero(link.inertial->inertia)) {
      findings_.warning({link.inertial->location, named("link", link.name),
                         fmt::format("{}mass is 0, but {} moves it", link.inertial->element,
                                     named("joint", joint.name))});
    }
  }

  const Model& model_;
  Findings& findings_;
  std::vector<int> joint_of_;
  std::vector<int> order_;
  std::vector<Body> bodies_;        // per link: it and what is fixed to it
  std::vector<int> top_;            // per link: the link whose body it is part of
  std::vector<char> carries_mass_;  // per link: mass or inertia here or further out
};

}  // namespace

void check_masses(const Model& model, Findings& findings) { MassCheck(model, findings).run(); }

}  // namespace arboc
