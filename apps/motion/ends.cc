#include "ends.h"

#include <fmt/format.h>

#include <posture/build.h>
#include <algorithm>

#include "audit.h"
#include "rates.h"

namespace motion {
namespace {

using namespace arboc::nlp;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// m, 1: what posture prediction leaves of rows.
constexpr double kInPlace = 1e-6;
constexpr double kStill = 1e-12;  ///< rad/s, m/s: the rounding of curves

VectorXd vector_of(const std::vector<double>& x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// Of a posture's contacts, along their own axes where the task has them so.
VectorXd reactions_of(const Model& model, const posture::Task& task, const posture::Result& r) {
  VectorXd out(6 * static_cast<Eigen::Index>(task.contacts.size()));
  std::vector<double> placements(static_cast<std::size_t>(model.robot.placements->outputs()));
  model.robot.placements->values(1, r.q.data(), placements.data());
  for (std::size_t c = 0; c < task.contacts.size(); ++c) {
    Eigen::Matrix<double, 6, 1> wrench(r.reactions[c].data());
    if (task.contacts[c].own_axes) {
      const Eigen::Matrix3d R =
          Placement(placements.data() + 12 * model.robot.frame(task.contacts[c].frame)).R;
      wrench.head<3>() = (R.transpose() * wrench.head<3>()).eval();
      wrench.tail<3>() = (R.transpose() * wrench.tail<3>()).eval();
    }
    out.segment<6>(static_cast<Eigen::Index>(6 * c)) = wrench;
  }
  return out;
}

/// How long control points beside an end, of which velocities decide, are ahead of it.
double reach(const Task& task) {
  const Curves& c = task.curves;
  return 3 * task.duration / (c.control_points - c.degree) / c.degree;
}

VectorXd velocity_at_end(const Task& task, const Model& model, const VectorXd& q,
                         const Task* next) {
  RateLimits limits{task.start.posture.contacts, reach(task)};
  if (next) {
    const auto& more = next->start.posture.contacts;
    limits.contacts.insert(limits.contacts.end(), more.begin(), more.end());
    limits.reach = std::max(limits.reach, reach(*next));
  }
  return complete_velocity(model, q, task.end.velocity, limits, "end_velocity");
}

/// A posture that is known.
posture::Result known_posture(const State& state) {
  posture::Result out;
  out.status = Status::kOptimal;
  out.reason = "where the motion before ends";
  out.q.assign(state.q.data(), state.q.data() + state.q.size());
  return out;
}

/// A posture from `q`, with targets moved to a part of the way from where they are in `from`.
posture::Result step_towards(posture::Task task, const Model& model, const std::vector<double>& q,
                             const std::vector<double>& from, double part) {
  const Robot& robot = model.robot;
  std::vector<double> placements(static_cast<std::size_t>(robot.placements->outputs()));
  robot.placements->values(1, from.data(), placements.data());
  for (posture::Target& target : task.targets) {
    const Vector3 here =
        Placement(placements.data() + 12 * robot.frame(target.frame))(target.point);
    target.place.at = (1 - part) * here + part * target.place.at;
  }
  task.guess.clear();
  for (std::size_t i = 0; i < q.size(); ++i) task.guess[robot.coordinates[i]] = q[i];
  task.search.starts = 1;
  task.search.restarts = 0;
  task.search.random = false;
  return posture::predict(task, model);
}

/// The posture at the end, by steps from the one at the start, so that it belongs to the same
/// branch of all ways to hold on; where that leads nowhere, the best of all.
posture::Result continued(const posture::Task& task, const Model& model,
                          const posture::Result& start) {
  posture::Result end = step_towards(task, model, start.q, start.q, 1);
  if (end.status == Status::kOptimal) return end;
  constexpr int kSteps = 5;
  std::vector<double> q = start.q;
  for (int k = 1; k <= kSteps; ++k) {
    end = step_towards(task, model, q, start.q, static_cast<double>(k) / kSteps);
    if (end.status != Status::kOptimal) return posture::predict(task, model);
    q = end.q;
  }
  return end;
}

/// Contacts must be where they hold.
void expect_in_place(const Task& task, const Model& model, const State& state) {
  std::vector<double> placements(static_cast<std::size_t>(model.robot.placements->outputs()));
  model.robot.placements->values(1, state.q.data(), placements.data());
  for (const Contact& contact : task.start.posture.contacts) {
    const Misplacement off =
        misplacement(contact, Placement(placements.data() + 12 * model.robot.frame(contact.frame)));
    if (off.distance > kInPlace || off.sine > kInPlace)
      throw std::invalid_argument(
          fmt::format("'{}' begins where its contact '{}' is {:.2g} m and {:.2g} rad off its place",
                      task.name, contact.name, off.distance, off.sine));
  }
}

}  // namespace

Ends predict_ends(const Task& task, const Model& model, posture::Result& start,
                  posture::Result& end, const Joints& joints) {
  if (joints.after) expect_in_place(task, model, *joints.after);
  start = joints.after ? known_posture(*joints.after) : posture::predict(task.start.posture, model);
  if (start.status != Status::kOptimal)
    throw std::domain_error("no posture at the start: " + start.reason);
  end = continued(task.end.posture, model, start);
  if (end.status != Status::kOptimal)
    throw std::domain_error("no posture at the end: " + end.reason);
  const VectorXd still = VectorXd::Zero(model.robot.size());
  Ends ends;
  ends.linked = joints.linked;
  if (joints.after) {
    ends.at[0] = *joints.after;
    if (joints.jolts) ends.known[0] = Known::kVelocity;
  } else {
    const VectorXd q = vector_of(start.q);
    const VectorXd v =
        complete_velocity(model, q, task.start.velocity, {task.start.posture.contacts, reach(task)},
                          "start_velocity");
    ends.at[0] = {q, v, still, reactions_of(model, task.start.posture, start)};
    if (!v.isZero(0)) ends.known[0] = Known::kVelocity;
  }
  const VectorXd q = vector_of(end.q), v = velocity_at_end(task, model, q, joints.next);
  ends.at[1] = {q, v, still, reactions_of(model, task.end.posture, end)};
  if (!v.isZero(0)) ends.known[1] = Known::kVelocity;
  if (task.end.any_velocity) ends.known[1] = Known::kPosture;
  return ends;
}

State state_at_end(const Motion& motion) {
  const double t = motion.q.basis().end();
  State state{motion.q(t), motion.q(t, 1), motion.q(t, 2), motion.reactions(t)};
  if (state.v.isZero(kStill)) {
    state.v.setZero();
    state.a.setZero();
  }
  return state;
}

int contact_index(const std::vector<Contact>& contacts, const std::string& name) {
  const auto at = std::find_if(contacts.begin(), contacts.end(),
                               [&](const Contact& c) { return c.name == name; });
  return at == contacts.end() ? -1 : static_cast<int>(at - contacts.begin());
}

MatrixXd arranged(const MatrixXd& columns, const std::vector<Contact>& from,
                  const std::vector<Contact>& to) {
  MatrixXd out = MatrixXd::Zero(columns.rows(), static_cast<Eigen::Index>(6 * to.size()));
  for (std::size_t c = 0; c < to.size(); ++c)
    if (const int at = contact_index(from, to[c].name); at >= 0)
      out.middleCols<6>(static_cast<Eigen::Index>(6 * c)) = columns.middleCols<6>(6 * at);
  return out;
}

State handed_over(State state, const Task& before, const Task& next) {
  state.reactions = arranged(state.reactions.transpose(), before.start.posture.contacts,
                             next.start.posture.contacts)
                        .transpose();
  return state;
}

Joint joint_of(const Task& before, const Task& next) {
  if (before.end.at_rest()) return Joint::kRest;
  return new_contacts(before, next).empty() ? Joint::kSmooth : Joint::kJolt;
}

}  // namespace motion
