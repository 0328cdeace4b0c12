#include "audit.h"

#include <posture/build.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <arboc/measures/torque.hpp>
#include <cmath>

namespace motion {
namespace {

using namespace arboc::nlp;
using Eigen::VectorXd;

/// How far a point is off its place, m.
double off_place(const Place& place, const Vector3& p) {
  double sum = 0;
  for (const Vector3& n : place.normals()) {
    const double d = n.dot(p - place.at);
    if (place.kind != Place::Kind::kAbove || d < 0) sum += d * d;
  }
  return std::sqrt(sum);
}

}  // namespace

Misplacement misplacement(const Contact& contact, const Placement& at) {
  Misplacement off{off_place(contact.place, at(contact.point)), 0};
  for (const Alignment& a : contact.align)
    off.sine =
        std::max(off.sine, (at.R * a.axis.normalized()).cross(a.direction.normalized()).norm());
  return off;
}

void Worst::note(double x, double t, const std::string& what) {
  if (!(x > value)) return;
  value = x;
  time = t;
  where = what;
}

bool Audit::passes(const Tolerance& t) const {
  return force.value <= t.force && moment.value <= t.moment && drift.value <= t.drift &&
         torque_excess.value <= t.torque && overlap.value <= t.drift;
}

void Audit::add(const Audit& other, double later) {
  instants += other.instants;
  for (const auto worst :
       {&Audit::force, &Audit::moment, &Audit::drift, &Audit::turn, &Audit::torque_excess,
        &Audit::joint_excess, &Audit::friction_excess, &Audit::overlap}) {
    const Worst& of = other.*worst;
    (this->*worst).note(of.value, of.time + later, of.where);
  }
  largest_normalised = std::max(largest_normalised, other.largest_normalised);
}

namespace {

class Auditor {
 public:
  Auditor(const Task& task, const Model& model, const Samples& samples)
      : task_(task),
        model_(model),
        s_(samples),
        translation_(translations(model)),
        pairs_(posture::pairs(task.start.posture)) {}

  Audit run() {
    out_.instants = static_cast<int>(s_.t.size());
    for (Eigen::Index k = 0; k < s_.t.size(); ++k) {
      balance(k);
      torques(k);
      for (std::size_t c = 0; c < task_.start.posture.contacts.size(); ++c) contact(k, c);
      if (!pairs_.empty()) spheres(k);
    }
    return out_;
  }

 private:
  void balance(Eigen::Index k) {
    double force = 0, moment = 0;
    for (std::size_t i = 0; i < model_.passive.size(); ++i) {
      if (!model_.passive[i]) continue;
      const double miss = s_.tau(k, static_cast<Eigen::Index>(i));
      (translation_[i] ? force : moment) += miss * miss;
    }
    out_.force.note(std::sqrt(force), s_.t[k], "");
    out_.moment.note(std::sqrt(moment), s_.t[k], "");
  }

  void torques(Eigen::Index k) {
    const Robot& robot = model_.robot;
    for (std::size_t i = 0; i < model_.passive.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      out_.joint_excess.note(
          std::max(robot.q_lower[i] - s_.q(k, at), s_.q(k, at) - robot.q_upper[i]), s_.t[k],
          robot.coordinates[i]);
      if (model_.passive[i] || !std::isfinite(robot.tau_upper[i])) continue;
      const double n =
          arboc::normalised_torque(s_.tau(k, at), robot.tau_lower[i], robot.tau_upper[i]);
      out_.largest_normalised = std::max(out_.largest_normalised, n);
      if (task_.start.posture.torque_limits)
        out_.torque_excess.note(n - 1, s_.t[k], robot.coordinates[i]);
    }
  }

  void contact(Eigen::Index k, std::size_t c) {
    const Contact& contact = task_.start.posture.contacts[c];
    Eigen::Matrix<double, 12, 1> placement =
        s_.placements.row(k).segment<12>(12 * model_.robot.frame(contact.frame)).transpose();
    const Placement at(placement.data());
    const Misplacement off = misplacement(contact, at);
    out_.drift.note(off.distance, s_.t[k], contact.name);
    out_.turn.note(off.sine, s_.t[k], contact.name);
    if (!std::isfinite(contact.friction)) return;
    Vector3 f = s_.reactions.row(k).segment<3>(static_cast<Eigen::Index>(6 * c)).transpose();
    if (contact.own_axes) f = at.R.transpose() * f;
    const Vector3 n = contact.normal.normalized();
    out_.friction_excess.note((f - n * n.dot(f)).norm() - contact.friction * n.dot(f), s_.t[k],
                              contact.name);
  }

  void spheres(Eigen::Index k) {
    const VectorXd q = s_.q.row(k).transpose();
    const std::vector<double> gaps =
        posture::gaps(task_.start.posture, model_, pairs_, {q.data(), q.data() + q.size()});
    const auto& names = task_.start.posture.collision.spheres;
    for (std::size_t i = 0; i < gaps.size(); ++i)
      out_.overlap.note(-gaps[i], s_.t[k],
                        names[static_cast<std::size_t>(pairs_[i].first)].name + ", " +
                            names[static_cast<std::size_t>(pairs_[i].second)].name);
  }

  const Task& task_;
  const Model& model_;
  const Samples& s_;
  std::vector<bool> translation_;
  std::vector<posture::Pair> pairs_;
  Audit out_;
};

}  // namespace

Audit audit(const Task& task, const Model& model, const Samples& samples) {
  return Auditor(task, model, samples).run();
}

}  // namespace motion
