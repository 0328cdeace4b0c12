#include "phases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace motion {
namespace {

using namespace arboc::nlp;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The phase after the last one that is linked to phase k.
std::size_t end_of_chain(const std::vector<Task>& tasks, std::size_t k) {
  for (++k; k < tasks.size() && joint_of(tasks[k - 1], tasks[k]) == Joint::kSmooth;) ++k;
  return k;
}

/// "2-3 ", as people count.
std::string label_of(std::size_t from, std::size_t to, std::size_t all) {
  if (all == 1) return "";
  return to - from == 1 ? fmt::format("{} ", to) : fmt::format("{}-{} ", from + 1, to);
}

}  // namespace

Course predict_phases(const Plan& plan, const Model& model, const Options& options,
                      const std::vector<Motion>& from) {
  const std::vector<Task>& tasks = plan.phases;
  Course course;
  course.status = Status::kOptimal;
  for (std::size_t k = 0; k < tasks.size() && course.status == Status::kOptimal;) {
    const std::size_t end = end_of_chain(tasks, k);
    Options here = options;
    const auto part = [&](const auto& all) {
      return std::vector(all.begin() + static_cast<std::ptrdiff_t>(k),
                         all.begin() + static_cast<std::ptrdiff_t>(end));
    };
    if (!from.empty()) here.from = part(from);
    here.label = label_of(k, end, tasks.size());
    if (end < tasks.size()) here.joints.next = &tasks[end];
    if (k > 0) {
      const State state = state_at_end(*course.phases.back().motion);
      here.joints.after = handed_over(state, tasks[k - 1], tasks[k]);
      here.joints.jolts = joint_of(tasks[k - 1], tasks[k]) == Joint::kJolt;
    }
    for (Result& result : predict_chain(part(tasks), model, here)) {
      const std::size_t phase = course.phases.size();
      if (course.status == Status::kOptimal) {
        course.status = result.status;
        course.reason = tasks.size() == 1 ? result.reason
                                          : fmt::format("phase {}, {}: {}", phase + 1,
                                                        tasks[phase].name, result.reason);
      }
      course.seconds += result.seconds;
      course.phases.push_back(std::move(result));
    }
    k = end;
  }
  course.audit_passes = std::all_of(course.phases.begin(), course.phases.end(),
                                    [](const Result& r) { return r.audit_passes; });
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
      if (contact_index(contacts, c.name) < 0) contacts.push_back(c);
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
