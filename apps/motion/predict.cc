#include "predict.h"

#include <chrono>
#include <numeric>

namespace motion {
namespace {

using namespace arboc::nlp;
using arboc::BSplineBasis;
using Clock = std::chrono::steady_clock;
using Eigen::VectorXd;

constexpr int kAuditPerFrame = 10, kLeastInstants = 401;
/// Least maxima are met between frames to this part; rounds of more frames of torques until they
/// are.
constexpr double kPeak = 1e-6;
constexpr int kMostRounds = 12;
/// KKT error of reactions alone.  Regularity decides on those that ask for no torques; its
/// curvature is 2e-6 an (100 N)^2, so that 1e-6 leaves up to some N open.  One iteration more than
/// 1e-6 takes.
constexpr double kReactionsKkt = 1e-10;

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

/// Without torques: a smooth motion that holds on to its contacts within all limits.
Objective smooth_only(const Objective& o) {
  Objective out = o;
  out.displacement = out.torque = out.normalised = out.maximum = 0;
  return out;
}

bool asks_for_more(const Task& task) {
  const Objective& o = task.objective;
  return o.displacement > 0 || o.torque > 0 || o.normalised > 0 || o.maximum > 0;
}

bool smooth_first(const Task& task) { return task.search.smooth_first; }

}  // namespace

Motion first_guess(const Task& task, const Ends& ends) {
  const Curves& c = task.curves;
  const int reactions = c.reaction_points > 0 ? c.reaction_points : c.control_points;
  return straight(ends, BSplineBasis::clamped_uniform(c.degree, c.control_points, 0, task.duration),
                  BSplineBasis::clamped_uniform(c.degree, reactions, 0, task.duration));
}

namespace {

void note_sizes(const Built& built, Stage& stage) {
  for (const Phase& phase : built.phases) {
    stage.control_points = std::max(stage.control_points, phase.q_basis.size());
    for (const Frames::Frame& f : phase.frames.all) {
      stage.frames += f.balances;
      stage.contact_frames += f.holds;
      stage.torque_frames += !f.balances;
    }
  }
  stage.variables = built.nlp->variables().size();
  stage.rows = built.nlp->rows().size();
  stage.jacobian = built.nlp->jacobian_pattern().size();
  stage.hessian = built.nlp->hessian_pattern().size();
}

void note_solution(const Built& built, const Solution& s, Stage& stage) {
  stage.status = s.status;
  stage.reason = s.reason;
  stage.iterations = s.iterations;
  stage.objective = s.objective;
  stage.kkt_error = s.kkt_error;
  stage.violation = s.violation;
  for (const Phase& phase : built.phases)
    stage.maxima.push_back(phase.maximum >= 0 ? s.x[static_cast<std::size_t>(phase.maximum)] : 0);
  stage.cpu_seconds = s.cpu_seconds;
  stage.derivative_seconds = s.derivative_seconds;
  stage.hessian_seconds = s.hessian_seconds;
  stage.time = built.nlp->time();
}

std::vector<Motion> solve_problem(const Model& model, const std::vector<Part>& parts, Free free,
                                  Stage& stage, const Options& options) {
  const Clock::time_point begin = Clock::now();
  const Search& search = parts.front().task->search;
  Built built = build(model, parts, free);
  built.nlp->use_threads(options.threads);
  std::vector<Motion> guesses;
  for (const Part& part : parts) guesses.push_back(*part.guess);
  const std::vector<double> x = variables_of(built, guesses);
  note_sizes(built, stage);
  stage.build_seconds = seconds_since(begin);
  SolverOptions solver;
  solver.tolerance = free == Free::kAll ? search.kkt : std::min(search.kkt, kReactionsKkt);
  solver.row_tolerance = 1e-8;  // 1e-6 N, 1e-8 m
  solver.max_iterations = search.iterations;
  solver.max_seconds = search.seconds;
  solver.blas_threads = options.blas_threads;
  if (options.go_on)
    solver.go_on = [&](const Progress& p) {
      return options.go_on({stage, p, seconds_since(begin)});
    };
  const Solution s = solve(*built.nlp, x, solver);
  note_solution(built, s, stage);
  // Rounding may forbid more than the task asks for.
  if (s.status != Status::kOptimal && s.kkt_error <= search.kkt &&
      s.violation <= solver.row_tolerance) {
    stage.status = Status::kOptimal;
    stage.reason = "optimal to what the task asks for";
  }
  stage.seconds = seconds_since(begin);
  return motions_of(built, s.x);
}

}  // namespace

std::vector<Motion> improve(const Model& model, const std::vector<Part>& parts, Stage& stage,
                            const Options& options) {
  return solve_problem(model, parts, Free::kAll, stage, options);
}

std::vector<Motion> react(const Model& model, const std::vector<Part>& parts, Stage& stage,
                          const Options& options) {
  return solve_problem(model, parts, Free::kReactions, stage, options);
}

namespace {

class Predictor {
 public:
  Predictor(const std::vector<Task>& tasks, const Model& model, const Options& options)
      : tasks_(tasks), model_(model), options_(options), results_(tasks.size()) {
    model.robot.dynamics->use_threads(options.threads);
    model.robot.placements->use_threads(options.threads);
  }

  std::vector<Result> run() {
    const Clock::time_point begin = Clock::now();
    add_ends();
    results_.front().posture_seconds = seconds_since(begin);
    if (options_.reactions_only && options_.from.empty())
      throw std::invalid_argument("reactions of what? a motion is missing");
    motions_ = options_.from;
    for (std::size_t k = motions_.size(); k < tasks_.size(); ++k)
      motions_.push_back(first_guess(tasks_[k], ends_[k]));
    if (options_.reactions_only)
      solve_stage("reactions", tasks_);
    else
      solve_all();
    conclude();
    results_.front().seconds = seconds_since(begin);
    return std::move(results_);
  }

 private:
  void add_ends() {
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      Joints joints = options_.joints;
      if (k > 0) {
        joints.after = handed_over(ends_[k - 1].at[1], tasks_[k - 1], tasks_[k]);
        joints.jolts = false;
        joints.linked = true;
      }
      if (k + 1 < tasks_.size()) joints.next = &tasks_[k + 1];
      ends_.push_back(predict_ends(tasks_[k], model_, results_[k].start, results_[k].end, joints));
    }
  }

  void solve_all() {
    const std::vector<Motion> guess = motions_;
    const bool more = std::any_of(tasks_.begin(), tasks_.end(), asks_for_more),
               detour = std::any_of(tasks_.begin(), tasks_.end(), smooth_first);
    if (!more || !detour) solve_stage("objective", tasks_);
    if (more && !stopped_ && (detour || !good())) {
      std::vector<Task> smooth = tasks_;
      for (Task& task : smooth) task.objective = smooth_only(task.objective);
      motions_ = guess;
      solve_stage("smooth", smooth);
      if (good()) solve_stage("objective", tasks_);
    }
    bool goes_on = good() && !stopped_;
    for (int round = 0; goes_on; ++round) goes_on = refine(round) && good() && !stopped_;
  }

  /// What the audit asks for: watched torques, or every span halved; false where there is nothing
  /// to do.
  bool refine(int round) {
    bool peaks = false;
    for (std::size_t k = 0; k < tasks_.size() && round < kMostRounds; ++k) {
      const std::vector<double> more = peaks_between_frames(k);
      peaks = peaks || !more.empty();
      tasks_[k].watched.insert(tasks_[k].watched.end(), more.begin(), more.end());
    }
    const bool finer = !passes() && !(peaks && balanced());
    if (finer && !can_be_finer()) return false;
    if (finer) {
      for (std::size_t k = 0; k < tasks_.size(); ++k) {
        tasks_[k].search.frames *= 2;
        motions_[k] = {motions_[k].q.refined(), motions_[k].reactions.refined()};
      }
      solve_stage("refined", tasks_);
    } else if (peaks) {
      solve_stage("watched", tasks_);
    }
    return finer || peaks;
  }
  bool can_be_finer() const {
    for (std::size_t k = 0; k < tasks_.size(); ++k)
      if (2 * motions_[k].q.basis().size() - tasks_[k].curves.degree >
          tasks_[k].search.most_control_points)
        return false;
    return true;
  }
  /// Where torques between frames are beyond what frames allow: their limits by more than the
  /// audit lets pass, or a maximum that shall be least.
  std::vector<double> peaks_between_frames(std::size_t k) const {
    const double at_frames = stages_.back().maxima[k];
    const Samples& samples = results_[k].samples;
    if (at_frames > 0) return torque_peaks(model_, samples, (1 + kPeak) * at_frames);
    if (!tasks_[k].start.posture.torque_limits) return {};
    return torque_peaks(model_, samples, 1 + tasks_[k].tolerance.torque);
  }
  /// All audits, but for torques.
  bool balanced() const {
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      Audit but_torques = results_[k].audit;
      but_torques.torque_excess = {};
      if (!but_torques.passes(tasks_[k].tolerance)) return false;
    }
    return true;
  }

  bool good() const { return stages_.back().status == Status::kOptimal; }
  bool passes() const {
    return std::all_of(results_.begin(), results_.end(),
                       [](const Result& r) { return r.audit_passes; });
  }

  void solve_stage(const std::string& name, const std::vector<Task>& tasks) {
    Stage stage;
    stage.name = options_.label + name;
    Options options = options_;
    if (options_.go_on)
      options.go_on = [this](const Iteration& i) { return !(stopped_ = !options_.go_on(i)); };
    std::vector<Part> parts;
    for (std::size_t k = 0; k < tasks.size(); ++k)
      parts.push_back({&tasks[k], &ends_[k], &motions_[k]});
    motions_ = options_.reactions_only ? react(model_, parts, stage, options)
                                       : improve(model_, parts, stage, options);
    double later = 0;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      Result& result = results_[k];
      const int frames = stage.frames / static_cast<int>(tasks.size());
      result.samples = sample(tasks[k], model_, motions_[k],
                              std::max(kLeastInstants, kAuditPerFrame * frames + 1));
      result.audit = audit(tasks[k], model_, result.samples);
      result.audit_passes = result.audit.passes(tasks_[k].tolerance);
      stage.audit.add(result.audit, later);
      later += tasks[k].duration;
    }
    stages_.push_back(std::move(stage));
  }

  void conclude() {
    const Stage& last = stages_.back();
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      Result& result = results_[k];
      result.status = last.status;
      result.reason = last.reason;
      result.measures = measures(tasks_[k], model_, motions_[k], result.samples);
      result.motion = motions_[k];
      if (good() && !result.audit_passes) {
        result.status = Status::kStopped;
        result.reason = "the audit between frames fails: more control points are needed";
      }
    }
    results_.front().stages = stages_;
  }

  std::vector<Task> tasks_;
  const Model& model_;
  const Options& options_;
  std::vector<Ends> ends_;
  std::vector<Motion> motions_;
  std::vector<Stage> stages_;
  std::vector<Result> results_;
  bool stopped_ = false;  ///< by the caller
};

}  // namespace

std::vector<Result> predict_chain(const std::vector<Task>& tasks, const Model& model,
                                  const Options& options) {
  return Predictor(tasks, model, options).run();
}

Result predict(const Task& task, const Model& model, const Options& options) {
  return std::move(predict_chain({task}, model, options).front());
}

}  // namespace motion
