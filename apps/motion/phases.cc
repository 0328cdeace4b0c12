#include "phases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace motion {
namespace {

using namespace arboc::nlp;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// m, 1: what posture prediction leaves of rows.
constexpr double kInPlace = 1e-6;
constexpr double kStill = 1e-12;  ///< rad/s, m/s

/// Its place among contacts, or -1.
int index_of(const std::vector<Contact>& contacts, const std::string& name) {
  const auto at = std::find_if(contacts.begin(), contacts.end(),
                               [&](const Contact& c) { return c.name == name; });
  return at == contacts.end() ? -1 : static_cast<int>(at - contacts.begin());
}

bool has_new_contact(const Task& before, const Task& next) {
  const auto& old = before.start.posture.contacts;
  return std::any_of(next.start.posture.contacts.begin(), next.start.posture.contacts.end(),
                     [&](const Contact& c) { return index_of(old, c.name) < 0; });
}

/// Six a contact of `to`, of columns that are six a contact of `from`.
MatrixXd arranged(const MatrixXd& columns, const std::vector<Contact>& from,
                  const std::vector<Contact>& to) {
  MatrixXd out = MatrixXd::Zero(columns.rows(), static_cast<Eigen::Index>(6 * to.size()));
  for (std::size_t c = 0; c < to.size(); ++c)
    if (const int at = index_of(from, to[c].name); at >= 0)
      out.middleCols<6>(static_cast<Eigen::Index>(6 * c)) = columns.middleCols<6>(6 * at);
  return out;
}

/// Contacts of the next phase must be where they hold.
void expect_in_place(const Task& next, const Model& model, const State& state) {
  std::vector<double> placements(static_cast<std::size_t>(model.robot.placements->outputs()));
  model.robot.placements->values(1, state.q.data(), placements.data());
  for (const Contact& contact : next.start.posture.contacts) {
    const Misplacement off =
        misplacement(contact, Placement(placements.data() + 12 * model.robot.frame(contact.frame)));
    if (off.distance > kInPlace || off.sine > kInPlace)
      throw std::invalid_argument(fmt::format(
          "phase '{}' begins where its contact '{}' is {:.2g} m and {:.2g} rad off its place",
          next.name, contact.name, off.distance, off.sine));
  }
}

State handed_over(const Task& before, const Motion& motion, const Task& next, const Model& model) {
  State state = state_at(motion, true);
  if (state.v.isZero(kStill)) {  // the rounding of curves
    state.v.setZero();
    state.a.setZero();
  }
  expect_in_place(next, model, state);
  state.reactions = arranged(state.reactions.transpose(), before.start.posture.contacts,
                             next.start.posture.contacts)
                        .transpose();
  return state;
}

}  // namespace

Course predict_phases(const Plan& plan, const Model& model, const Options& options,
                      const std::vector<Motion>& from) {
  const std::vector<Task>& tasks = plan.phases;
  Course course;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    Options here = options;
    if (!from.empty()) here.from = from[k];
    if (tasks.size() > 1) here.label = fmt::format("{} {}", k + 1, options.label);
    if (k + 1 < tasks.size()) here.joints.next = &tasks[k + 1];
    if (k > 0) {
      const Task& before = tasks[k - 1];
      here.joints.after = handed_over(before, *course.phases.back().motion, tasks[k], model);
      here.joints.jolts = !here.joints.after->v.isZero(0) && has_new_contact(before, tasks[k]);
    }
    course.phases.push_back(predict(tasks[k], model, here));
    const Result& result = course.phases.back();
    course.status = result.status;
    course.reason = tasks.size() > 1 ? tasks[k].name + ": " + result.reason : result.reason;
    course.audit_passes = result.audit_passes;
    course.seconds += result.seconds;
    if (result.status != Status::kOptimal) break;
  }
  if (tasks.size() > 1 && course.status == Status::kOptimal)
    course.reason = "optimal in all phases";
  return course;
}

Task whole(const Plan& plan) {
  const std::vector<Task>& tasks = plan.phases;
  Task all = tasks.front();
  if (tasks.size() == 1) return all;
  all.name = plan.name;
  all.end = tasks.back().end;
  std::vector<Contact>& contacts = all.start.posture.contacts;
  for (std::size_t k = 1; k < tasks.size(); ++k) {
    all.duration += tasks[k].duration;
    for (const Contact& c : tasks[k].start.posture.contacts)
      if (index_of(contacts, c.name) < 0) contacts.push_back(c);
  }
  return all;
}

namespace {

/// The instant of a joint is there once.
void append(Samples& all, Samples more, double later) {
  const Eigen::Index skip = all.t.size() > 0 ? 1 : 0, n = more.t.size() - skip;
  more.t.array() += later;
  const auto below = [&](MatrixXd& top, const MatrixXd& bottom) {
    MatrixXd joined(top.rows() + n, bottom.cols());
    joined << (top.rows() > 0 ? top : MatrixXd(0, bottom.cols())), bottom.bottomRows(n);
    top = std::move(joined);
  };
  VectorXd t(all.t.size() + n);
  t << all.t, more.t.tail(n);
  all.t = std::move(t);
  below(all.q, more.q);
  below(all.v, more.v);
  below(all.a, more.a);
  below(all.tau, more.tau);
  below(all.reactions, more.reactions);
  below(all.placements, more.placements);
}

}  // namespace

Result whole(const Plan& plan, const Course& course) {
  if (plan.phases.size() == 1) return course.phases.front();
  const std::vector<Contact> contacts = whole(plan).start.posture.contacts;
  Result all;
  all.status = course.status;
  all.reason = course.reason;
  all.audit_passes = course.audit_passes;
  all.seconds = course.seconds;
  all.start = course.phases.front().start;
  all.end = course.phases.back().end;
  double duration = 0, later = 0;
  for (std::size_t k = 0; k < course.phases.size(); ++k) duration += plan.phases[k].duration;
  for (std::size_t k = 0; k < course.phases.size(); ++k) {
    const Result& r = course.phases[k];
    const Task& task = plan.phases[k];
    all.posture_seconds += r.posture_seconds;
    all.stages.insert(all.stages.end(), r.stages.begin(), r.stages.end());
    all.audit.add(r.audit, later);
    for (const auto& [name, value] : r.measures)
      if (name == "maximum")
        all.measures[name] = std::max(all.measures[name], value);
      else
        all.measures[name] += value * task.duration / duration;
    Samples samples = r.samples;
    samples.reactions = arranged(samples.reactions, task.start.posture.contacts, contacts);
    append(all.samples, std::move(samples), later);
    later += task.duration;
  }
  return all;
}

}  // namespace motion
