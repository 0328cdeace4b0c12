#include "predict.h"

#include <posture/build.h>
#include <chrono>

#include "rates.h"

namespace motion {
namespace {

using namespace arboc::nlp;
using arboc::BSplineBasis;
using Clock = std::chrono::steady_clock;
using Eigen::VectorXd;

constexpr int kAuditPerFrame = 10, kLeastInstants = 401;
/// Least maxima are met between frames to this part; rounds of more frames of torques until they
/// are.
constexpr double kPeak = 1e-4;
constexpr int kMostRounds = 12;
/// KKT error of reactions alone.  Regularity decides on those that ask for no torques; its
/// curvature is 2e-6 an (100 N)^2, so that 1e-6 leaves up to some N open.  One iteration more than
/// 1e-6 takes.
constexpr double kReactionsKkt = 1e-10;

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

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

/// Without torques: a smooth motion that holds on to its contacts within all limits.
Objective smooth_only(const Objective& o) {
  Objective out = o;
  out.displacement = out.torque = out.normalised = out.maximum = 0;
  return out;
}

bool asks_for_more(const Objective& o) {
  return o.displacement > 0 || o.torque > 0 || o.normalised > 0 || o.maximum > 0;
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

}  // namespace

Ends predict_ends(const Task& task, const Model& model, posture::Result& start,
                  posture::Result& end, const Joints& joints) {
  start = joints.after ? known_posture(*joints.after) : posture::predict(task.start.posture, model);
  if (start.status != Status::kOptimal)
    throw std::domain_error("no posture at the start: " + start.reason);
  end = continued(task.end.posture, model, start);
  if (end.status != Status::kOptimal)
    throw std::domain_error("no posture at the end: " + end.reason);
  const VectorXd still = VectorXd::Zero(model.robot.size());
  Ends ends;
  if (joints.after) {
    ends.at[0] = *joints.after;
    ends.given[0] = !joints.jolts;
  } else {
    const VectorXd q = vector_of(start.q);
    const VectorXd v =
        complete_velocity(model, q, task.start.velocity, {task.start.posture.contacts, reach(task)},
                          "start_velocity");
    ends.at[0] = {q, v, still, reactions_of(model, task.start.posture, start)};
    ends.given[0] = v.isZero(0);
  }
  const VectorXd q = vector_of(end.q), v = velocity_at_end(task, model, q, joints.next);
  ends.at[1] = {q, v, still, reactions_of(model, task.end.posture, end)};
  ends.given[1] = v.isZero(0);
  return ends;
}

State state_at(const Motion& motion, bool at_end) {
  const double t = at_end ? motion.q.basis().end() : motion.q.basis().begin();
  return {motion.q(t), motion.q(t, 1), motion.q(t, 2), motion.reactions(t)};
}

Motion first_guess(const Task& task, const Ends& ends) {
  const Curves& c = task.curves;
  const int reactions = c.reaction_points > 0 ? c.reaction_points : c.control_points;
  return straight(ends, BSplineBasis::clamped_uniform(c.degree, c.control_points, 0, task.duration),
                  BSplineBasis::clamped_uniform(c.degree, reactions, 0, task.duration));
}

namespace {

Motion solve_problem(const Task& task, const Model& model, const Ends& ends, const Motion& guess,
                     Free free, Stage& stage, const Options& options) {
  const Clock::time_point begin = Clock::now();
  Built built = build(task, model, ends, guess, free);
  built.nlp->use_threads(options.threads);
  const std::vector<double> x = variables_of(built, guess);
  stage.control_points = built.q_basis.size();
  for (const Frames::Frame& f : built.frames.all) {
    stage.frames += f.balances;
    stage.contact_frames += f.holds;
    stage.torque_frames += !f.balances;
  }
  stage.variables = built.nlp->variables().size();
  stage.rows = built.nlp->rows().size();
  stage.jacobian = built.nlp->jacobian_pattern().size();
  stage.hessian = built.nlp->hessian_pattern().size();
  stage.build_seconds = seconds_since(begin);
  SolverOptions solver;
  solver.tolerance =
      free == Free::kAll ? task.search.kkt : std::min(task.search.kkt, kReactionsKkt);
  solver.row_tolerance = 1e-8;  // 1e-6 N, 1e-8 m
  solver.max_iterations = task.search.iterations;
  solver.max_seconds = task.search.seconds;
  solver.blas_threads = options.blas_threads;
  if (options.go_on)
    solver.go_on = [&](const Progress& p) {
      return options.go_on({stage, p, seconds_since(begin)});
    };
  const Solution s = solve(*built.nlp, x, solver);
  // Rounding may forbid more than the task asks for.
  const bool enough = s.kkt_error <= task.search.kkt && s.violation <= solver.row_tolerance;
  stage.status = enough ? Status::kOptimal : s.status;
  stage.reason = s.reason;
  stage.iterations = s.iterations;
  stage.objective = s.objective;
  stage.kkt_error = s.kkt_error;
  if (built.maximum >= 0) stage.maximum = s.x[static_cast<std::size_t>(built.maximum)];
  stage.violation = s.violation;
  stage.cpu_seconds = s.cpu_seconds;
  stage.derivative_seconds = s.derivative_seconds;
  stage.hessian_seconds = s.hessian_seconds;
  stage.time = built.nlp->time();
  Motion motion = motion_of(built, s.x);
  stage.seconds = seconds_since(begin);
  return motion;
}

}  // namespace

Motion improve(const Task& task, const Model& model, const Ends& ends, const Motion& guess,
               Stage& stage, const Options& options) {
  return solve_problem(task, model, ends, guess, Free::kAll, stage, options);
}

Motion react(const Task& task, const Model& model, const Ends& ends, const Motion& given,
             Stage& stage, const Options& options) {
  return solve_problem(task, model, ends, given, Free::kReactions, stage, options);
}

namespace {

class Predictor {
 public:
  Predictor(const Task& task, const Model& model, const Options& options)
      : task_(task), model_(model), options_(options) {
    model.robot.dynamics->use_threads(options.threads);
    model.robot.placements->use_threads(options.threads);
  }

  Result run() {
    const Clock::time_point begin = Clock::now();
    ends_ = predict_ends(task_, model_, result_.start, result_.end, options_.joints);
    result_.posture_seconds = seconds_since(begin);
    if (options_.reactions_only) return reactions_of_given(begin);
    const Motion guess = options_.from ? *options_.from : first_guess(task_, ends_);
    Motion motion = guess;
    const bool more = asks_for_more(task_.objective);
    if (!more || !task_.search.smooth_first) motion = solve_stage("objective", task_, guess);
    if (more && !stopped_ && (task_.search.smooth_first || !good())) {
      Task smooth = task_;
      smooth.objective = smooth_only(task_.objective);
      motion = solve_stage("smooth", smooth, guess);
      if (good()) motion = solve_stage("objective", task_, motion);
    }
    for (int round = 0; good() && !stopped_; ++round) {
      const std::vector<double> peaks = peaks_between_frames();
      const bool watch = !peaks.empty() && round < kMostRounds;
      const bool finer = !result_.audit_passes && !(watch && balanced());
      if (finer &&
          2 * motion.q.basis().size() - task_.curves.degree > task_.search.most_control_points)
        break;
      if (!watch && !finer) break;
      task_.watched.insert(task_.watched.end(), peaks.begin(), peaks.end());
      motion = finer ? refine(motion) : solve_stage("watched", task_, motion);
    }
    conclude(motion);
    result_.seconds = seconds_since(begin);
    return std::move(result_);
  }

 private:
  /// Where torques between frames are beyond what frames allow: their limits by more than the
  /// audit lets pass, or a maximum that shall be least.
  std::vector<double> peaks_between_frames() const {
    const double at_frames = result_.stages.back().maximum;
    if (at_frames > 0) return torque_peaks(model_, result_.samples, (1 + kPeak) * at_frames);
    if (!task_.start.posture.torque_limits) return {};
    return torque_peaks(model_, result_.samples, 1 + task_.tolerance.torque);
  }
  /// The audit passes but for torques.
  bool balanced() const {
    Audit but_torques = result_.stages.back().audit;
    but_torques.torque_excess = {};
    return but_torques.passes(task_.tolerance);
  }

  /// With every span halved.
  Motion refine(const Motion& motion) {
    task_.search.frames *= 2;
    return solve_stage("refined", task_, {motion.q.refined(), motion.reactions.refined()});
  }

  Result reactions_of_given(Clock::time_point begin) {
    if (!options_.from) throw std::invalid_argument("reactions of what? a motion is missing");
    const Motion motion = solve_stage("reactions", task_, *options_.from);
    conclude(motion);
    result_.seconds = seconds_since(begin);
    return std::move(result_);
  }

  bool good() const { return result_.stages.back().status == Status::kOptimal; }

  Motion solve_stage(const std::string& name, const Task& task, const Motion& guess) {
    Stage stage;
    stage.name = options_.label + name;
    Options options = options_;
    if (options_.go_on)
      options.go_on = [this](const Iteration& i) { return !(stopped_ = !options_.go_on(i)); };
    Motion motion = options_.reactions_only ? react(task, model_, ends_, guess, stage, options)
                                            : improve(task, model_, ends_, guess, stage, options);
    result_.samples =
        sample(task, model_, motion, std::max(kLeastInstants, kAuditPerFrame * stage.frames + 1));
    stage.audit = audit(task, model_, result_.samples);
    result_.audit_passes = stage.audit.passes(task_.tolerance);
    result_.stages.push_back(std::move(stage));
    return motion;
  }

  void conclude(const Motion& motion) {
    const Stage& last = result_.stages.back();
    result_.status = last.status;
    result_.reason = last.reason;
    result_.audit = last.audit;
    result_.measures = measures(task_, model_, motion, result_.samples);
    result_.motion = motion;
    if (good() && !result_.audit_passes) {
      result_.status = Status::kStopped;
      result_.reason = "the audit between frames fails: more control points are needed";
    }
  }

  Task task_;
  const Model& model_;
  const Options& options_;
  Ends ends_;
  Result result_;
  bool stopped_ = false;  ///< by the caller
};

}  // namespace

Result predict(const Task& task, const Model& model, const Options& options) {
  return Predictor(task, model, options).run();
}

}  // namespace motion
