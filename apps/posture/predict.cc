#include "predict.h"

#include <Eigen/QR>
#include <algorithm>
#include <arboc/nlp/project.hpp>
#include <chrono>
#include <cmath>
#include <ctime>

namespace posture {
namespace {

using namespace arboc::nlp;
using Clock = std::chrono::steady_clock;

constexpr double kOverlap = 1e-9;  ///< m
/// Ranges of coordinates without limits, to each side: rad of joints; m and rad of the whole body.
constexpr double kFreeRange = 3.1416, kFreeMotion = 0.5;

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

/// Everything but q, from q: the least reactions, torques and auxiliary forces, in units of their
/// scales, that meet the equality rows; these are linear in them.
void fill_forces(Assembly& nlp, const Quantities& q, std::vector<double>& x) {
  const Scales &v = nlp.variables(), &r = nlp.rows();
  nlp.move_to(x.data());
  const std::vector<double> c = nlp.constraints();
  const std::vector<double>& J = nlp.jacobian();
  const Pattern& at = nlp.jacobian_pattern();
  const auto rows = static_cast<Eigen::Index>(r.size());
  const auto cols = static_cast<Eigen::Index>(v.size()) - q.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, cols);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows);
  std::vector<bool> counts(r.size(), false);
  for (std::size_t k = 0; k < J.size(); ++k) {
    const auto row = static_cast<std::size_t>(at.row[k]), col = static_cast<std::size_t>(at.col[k]);
    if (r.lower[row] != r.upper[row] || at.col[k] < q.size() || v.lower[col] == v.upper[col])
      continue;
    A(at.row[k], at.col[k] - q.size()) = J[k] * v.scale[col] / r.scale[row];
    counts[row] = true;
  }
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (counts[k]) b[static_cast<Eigen::Index>(k)] = (r.lower[k] - c[k]) / r.scale[k];
  const Eigen::VectorXd u = A.completeOrthogonalDecomposition().solve(b);
  for (Eigen::Index i = 0; i < cols; ++i) {
    const auto k = static_cast<std::size_t>(i + q.size());
    x[k] = std::clamp(x[k] + u[i] * v.scale[k], v.lower[k], v.upper[k]);
  }
}

/// Zero where the bounds allow it, with q.
std::vector<double> initial(const Nlp& nlp, const std::vector<double>& q) {
  const Scales& v = nlp.variables();
  std::vector<double> x(v.size(), 0);
  std::copy(q.begin(), q.end(), x.begin());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::clamp(x[i], v.lower[i], v.upper[i]);
  return x;
}

}  // namespace

std::vector<double> start_posture(const Task& task, const Model& model, int k, int restart) {
  const Robot& robot = model.robot;
  std::vector<double> q = posture_of(task.guess, model, relaxed_of(task, model));
  std::seed_seq seeds{task.search.seed, static_cast<unsigned>(k), static_cast<unsigned>(restart)};
  std::mt19937_64 random(seeds);
  // Not std::uniform_real_distribution: its numbers differ between libraries.
  const auto uniform = [&] { return 2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1; };
  const bool is_guess = k == 0 && restart == 0 && !task.search.random;
  const double spread = is_guess ? 0 : task.search.spread;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double low = robot.q_lower[i], high = robot.q_upper[i], r = uniform();
    const bool limited = std::isfinite(low) && std::isfinite(high);
    const double half = limited ? (high - low) / 2 : model.passive[i] ? kFreeMotion : kFreeRange;
    const double middle = limited ? (low + high) / 2 : q[i];
    q[i] = std::clamp(q[i] + spread * (middle - q[i] + half * r), low, high);
  }
  return q;
}

namespace {

class Predictor {
 public:
  Predictor(const Task& task, const Model& model)
      : task_(task), model_(model), all_pairs_(pairs(task)) {}

  Result run(const std::optional<Vector3>& move) {
    if (move && (task_.targets.empty() || task_.targets[0].place.kind != Place::Kind::kPoint))
      throw std::invalid_argument("only a first target that is a point can be moved");
    const Clock::time_point begin = Clock::now();
    for (int k = 0; k < task_.search.starts; ++k) {
      result_.starts.push_back(search(k));
      const Start& s = result_.starts.back();
      if (s.status != Status::kOptimal) continue;
      if (result_.best < 0 || s.objective < result_.objective) keep(k);
    }
    if (result_.best < 0)
      explain();
    else
      report(task_, model_, full_problem(best_pairs_), best_.x, result_);
    result_.seconds = seconds_since(begin);
    if (result_.best >= 0 && move) again(*move);
    return std::move(result_);
  }

 private:
  SolverOptions solver_options() const {
    SolverOptions options;
    options.max_iterations = task_.search.iterations;
    return options;
  }

  Start search(int k) {
    const Clock::time_point begin = Clock::now();
    const std::clock_t cpu = std::clock();
    Start start;
    for (int restart = 0; restart <= task_.search.restarts; ++restart) {
      start.restarts = restart;
      attempt(start_posture(task_, model_, k, restart), start);
      if (start.status == Status::kOptimal) break;
    }
    start.seconds = seconds_since(begin);
    start.cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    return start;
  }

  /// Onto the contacts and targets, then to the objective; pairs of spheres are added until none
  /// overlap.
  void attempt(const std::vector<double>& q0, Start& start) {
    std::vector<Pair> pairs = with({}, q0, task_.collision.margin);
    Built& first = projection_problem(pairs);
    const Projection onto = project(*first.nlp, initial(*first.nlp, q0));
    start.iterations += onto.iterations;
    start.violation = onto.violation;
    start.q.assign(onto.x.begin(), onto.x.begin() + first.q.size());
    if (!onto.met) {
      start.status = Status::kStopped;
      start.reason = "contacts and targets were not reached from this start";
      return;
    }
    pairs = with(std::move(pairs), start.q, task_.collision.margin);
    for (bool clear = false; !clear;) {
      Built& full = full_problem(pairs);
      std::vector<double> x = initial(*full.nlp, start.q);
      fill_forces(*full.nlp, full.q, x);
      if (full.maximum >= 0) x[static_cast<std::size_t>(full.maximum)] = 1;
      solution_ = solve(*full.nlp, x, solver_options());
      count(solution_, start);
      start.q.assign(solution_.x.begin(), solution_.x.begin() + full.q.size());
      const std::size_t before = pairs.size();
      pairs = with(std::move(pairs), start.q, -kOverlap);
      clear = pairs.size() == before || solution_.status != Status::kOptimal;
    }
  }

  static void count(const Solution& s, Start& start) {
    start.status = s.status;
    start.reason = s.reason;
    start.iterations += s.iterations;
    start.derivative_seconds += s.derivative_seconds;
    start.hessian_seconds += s.hessian_seconds;
    start.violation = s.violation;
    start.kkt_error = s.kkt_error;
    start.objective = s.objective;
  }

  Built& projection_problem(const std::vector<Pair>& pairs) {
    if (!projection_.nlp || pairs != projection_pairs_) {
      projection_ = build(task_, model_, {Aspect::kProjection, pairs});
      projection_pairs_ = pairs;
    }
    return projection_;
  }
  Built& full_problem(const std::vector<Pair>& pairs) {
    if (!full_.nlp || pairs != full_pairs_) {
      full_ = build(task_, model_, {Aspect::kAll, pairs});
      full_pairs_ = pairs;
    }
    return full_;
  }

  /// `pairs` and those that are closer than `least`.
  std::vector<Pair> with(std::vector<Pair> pairs, const std::vector<double>& q, double least) {
    if (all_pairs_.empty()) return pairs;
    const std::vector<double> gap = gaps(task_, model_, all_pairs_, q);
    for (std::size_t k = 0; k < gap.size(); ++k)
      if (gap[k] < least && std::find(pairs.begin(), pairs.end(), all_pairs_[k]) == pairs.end())
        pairs.push_back(all_pairs_[k]);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  void keep(int k) {
    const Start& s = result_.starts.back();
    best_ = solution_;
    best_pairs_ = full_pairs_;
    result_.best = k;
    result_.status = s.status;
    result_.reason = s.reason;
    result_.objective = s.objective;
    result_.kkt_error = s.kkt_error;
    result_.max_violation = s.violation;
    result_.iterations = s.iterations;
  }

  /// No start has succeeded: first without forces, which is the simpler question.
  void explain() {
    const auto nearest =
        std::min_element(result_.starts.begin(), result_.starts.end(),
                         [](const Start& a, const Start& b) { return a.violation < b.violation; });
    result_.status = nearest->status;
    result_.reason = nearest->reason;
    result_.kkt_error = nearest->kkt_error;
    result_.iterations = nearest->iterations;
    const auto at = [](const Diagnosis& d) { return d.has_nearest ? d.nearest_x : d.x; };
    const Built kinematic = build(task_, model_, {Aspect::kKinematics, all_pairs_});
    Diagnosis& diagnosis = result_.diagnosis;
    diagnosis = diagnose(*kinematic.nlp, initial(*kinematic.nlp, nearest->q), kinematic.elastic,
                         solver_options());
    Built& full = full_problem(all_pairs_);
    std::vector<double> q = at(diagnosis);
    q.resize(static_cast<std::size_t>(model_.robot.size()));
    std::vector<double> x = initial(*full.nlp, q);
    fill_forces(*full.nlp, full.q, x);
    if (diagnosis.feasible) {
      diagnosis = diagnose(*full.nlp, x, full.elastic, solver_options());
      x = at(diagnosis);
    }
    if (!diagnosis.feasible) {
      result_.status = Status::kInfeasible;
      result_.reason = explanation(diagnosis);
    }
    report(task_, model_, full, x, result_);
    result_.max_violation = largest_violation(*full.nlp, x);
    full.nlp->move_to(x.data());
    result_.objective = full.nlp->objective();
  }

  void again(const Vector3& move) {
    Built& full = full_problem(best_pairs_);
    for (int i = 0; i < 3; ++i) {
      const double to = task_.targets[0].place.at[i] + move[i];
      full.nlp->set_row(full.targets[0], i, to, to);
    }
    SolverOptions options = solver_options();
    options.warm = &best_.multipliers;
    const Solution s = solve(*full.nlp, best_.x, options);
    result_.again = Again{s.status, s.iterations, s.seconds, s.cpu_seconds, s.objective};
  }

  const Task& task_;
  const Model& model_;
  std::vector<Pair> all_pairs_;
  Built projection_, full_;
  std::vector<Pair> projection_pairs_, full_pairs_, best_pairs_;
  Solution solution_, best_;
  Result result_;
};

}  // namespace

Result predict(const Task& task, const Model& model, const std::optional<Vector3>& move) {
  return Predictor(task, model).run(move);
}

}  // namespace posture
