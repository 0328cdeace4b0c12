// Nlp -> Ipopt.  Everything goes over in units of the scales.
#if __has_include(<coin-or/IpTNLP.hpp>)
#include <coin-or/IpIpoptApplication.hpp>
#include <coin-or/IpTNLP.hpp>
#else
#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>
#endif

#include <dlfcn.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>

#include "solver.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

class Adapter : public Ipopt::TNLP {
 public:
  using Int = Ipopt::Index;
  using Real = Ipopt::Number;

  Adapter(Nlp& nlp, const SolverOptions& options, Solution& solution)
      : nlp_(nlp), options_(options), solution_(solution), x_(nlp.variables().size()) {}

  bool get_nlp_info(Int& n, Int& m, Int& jacobian, Int& hessian, IndexStyleEnum& style) override {
    n = static_cast<Int>(nlp_.variables().size());
    m = static_cast<Int>(nlp_.rows().size());
    jacobian = static_cast<Int>(nlp_.jacobian_pattern().size());
    hessian = static_cast<Int>(nlp_.hessian_pattern().size());
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Int, Real* xl, Real* xu, Int, Real* cl, Real* cu) override {
    bounds(nlp_.variables(), xl, xu);
    bounds(nlp_.rows(), cl, cu);
    return true;
  }

  bool get_starting_point(Int n, bool, Real* x, bool init_z, Real* zl, Real* zu, Int m,
                          bool init_lambda, Real* lambda) override {
    const Scales &v = nlp_.variables(), &r = nlp_.rows();
    const double one = options_.objective_scale;
    for (Int i = 0; i < n; ++i) x[i] = solution_.x[i] / v.scale[i];
    for (Int i = 0; init_z && i < n; ++i) {
      zl[i] = options_.warm->lower[i] * v.scale[i] / one;
      zu[i] = options_.warm->upper[i] * v.scale[i] / one;
    }
    for (Int k = 0; init_lambda && k < m; ++k)
      lambda[k] = options_.warm->rows[k] * r.scale[k] / one;
    return true;
  }

  bool eval_f(Int, const Real* x, bool is_new, Real& f) override {
    const Timer timer(*this);
    move(x, is_new);
    f = nlp_.objective() / options_.objective_scale;
    return std::isfinite(f);
  }

  bool eval_grad_f(Int n, const Real* x, bool is_new, Real* g) override {
    const Timer timer(*this);
    move(x, is_new);
    const std::vector<double>& slope = nlp_.gradient();
    for (Int i = 0; i < n; ++i)
      g[i] = slope[i] * nlp_.variables().scale[i] / options_.objective_scale;
    return true;
  }

  bool eval_g(Int, const Real* x, bool is_new, Int m, Real* c) override {
    const Timer timer(*this);
    move(x, is_new);
    const std::vector<double>& value = nlp_.constraints();
    for (Int k = 0; k < m; ++k) c[k] = value[k] / nlp_.rows().scale[k];
    return true;
  }

  bool eval_jac_g(Int, const Real* x, bool is_new, Int, Int count, Int* row, Int* col,
                  Real* values) override {
    const Pattern& at = nlp_.jacobian_pattern();
    if (!values) return give(at, row, col);
    const Timer timer(*this);
    move(x, is_new);
    const std::vector<double>& J = nlp_.jacobian();
    const Scales &v = nlp_.variables(), &r = nlp_.rows();
    for (Int k = 0; k < count; ++k) values[k] = J[k] * v.scale[at.col[k]] / r.scale[at.row[k]];
    return true;
  }

  bool eval_h(Int, const Real* x, bool is_new, Real factor, Int m, const Real* lambda, bool,
              Int count, Int* row, Int* col, Real* values) override {
    const Pattern& at = nlp_.hessian_pattern();
    if (!values) return give(at, row, col);
    const Timer timer(*this, &solution_.hessian_seconds);
    move(x, is_new);
    const Scales &v = nlp_.variables(), &r = nlp_.rows();
    multipliers_.assign(lambda, lambda + m);
    for (Int k = 0; k < m; ++k) multipliers_[k] /= r.scale[k];
    const std::vector<double>& H =
        nlp_.hessian(factor / options_.objective_scale, multipliers_.data());
    for (Int k = 0; k < count; ++k) values[k] = H[k] * v.scale[at.row[k]] * v.scale[at.col[k]];
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn why, Int n, const Real* x, const Real* zl,
                         const Real* zu, Int m, const Real*, const Real* lambda, Real,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    const Scales &v = nlp_.variables(), &r = nlp_.rows();
    const double one = options_.objective_scale;
    Multipliers& out = solution_.multipliers;
    out.lower.resize(n);
    out.upper.resize(n);
    out.rows.resize(m);
    for (Int i = 0; i < n; ++i) {
      solution_.x[i] = x[i] * v.scale[i];
      out.lower[i] = zl[i] * one / v.scale[i];
      out.upper[i] = zu[i] * one / v.scale[i];
    }
    for (Int k = 0; k < m; ++k) out.rows[k] = lambda[k] * one / r.scale[k];
    const bool ended = why == Ipopt::SUCCESS || why == Ipopt::STOP_AT_ACCEPTABLE_POINT ||
                       why == Ipopt::STOP_AT_TINY_STEP || why == Ipopt::LOCAL_INFEASIBILITY;
    if (!ended && !best_.x.empty()) solution_.x = best_.x;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode mode, Int iteration, Real f, Real violation,
                             Real slope, Real, Real, Real, Real, Real, Int, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    solution_.iterations = iteration;
    const double seconds = seconds_since(begin_);
    if (mode == Ipopt::RegularMode) remember(f, violation);
    if (seconds > options_.max_seconds) return false;
    if (!options_.go_on) return true;
    const double error = std::max(violation / options_.row_tolerance, slope / options_.tolerance);
    if (iteration == 0) first_error_ = error;
    const double factors = std::log(first_error_ / error) / iteration;  // an iteration
    const double left =
        factors > 0 && error > 1 ? seconds / iteration * std::log(error) / factors : -1;
    return options_.go_on(
        {iteration, f * options_.objective_scale, violation, left, violations(nlp_, x_)});
  }

 private:
  struct Seen {
    std::vector<double> x;
    double objective = 0, violation = 0;
  };
  /// The last point at which derivatives were asked for is the iterate.  The best one: of those
  /// that hold all rows the least objective, else the least violation.
  void remember(double f, double violation) {
    violation = std::max(violation, options_.row_tolerance);  // good enough
    const bool better = best_.x.empty() || violation < best_.violation ||
                        (violation == best_.violation && f < best_.objective);
    if (better) best_ = {x_, f, violation};
  }

  /// Adds what it sees to the seconds of evaluation.
  class Timer {
   public:
    explicit Timer(Adapter& adapter, double* more = nullptr)
        : adapter_(adapter), more_(more), begin_(Clock::now()) {}
    ~Timer() {
      const double s = seconds_since(begin_);
      adapter_.solution_.derivative_seconds += s;
      if (more_) *more_ += s;
    }
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

   private:
    Adapter& adapter_;
    double* more_;
    Clock::time_point begin_;
  };

  static void bounds(const Scales& s, Real* lower, Real* upper) {
    for (std::size_t k = 0; k < s.size(); ++k) {
      lower[k] = s.lower[k] / s.scale[k];  // beyond 1e19 Ipopt has no bound
      upper[k] = s.upper[k] / s.scale[k];
    }
  }
  static bool give(const Pattern& at, Int* row, Int* col) {
    std::copy(at.row.begin(), at.row.end(), row);
    std::copy(at.col.begin(), at.col.end(), col);
    return true;
  }
  void move(const Real* x, bool is_new) {
    if (!is_new && moved_) return;
    moved_ = true;
    const Scales& v = nlp_.variables();
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = x[i] * v.scale[i];
    nlp_.move_to(x_.data());
  }

  Nlp& nlp_;
  const SolverOptions& options_;
  Solution& solution_;
  bool moved_ = false;
  std::vector<double> x_, multipliers_;
  Seen best_;
  double first_error_ = 0;
  Clock::time_point begin_ = Clock::now();
};

/// How far a warm start is kept off its bounds, in units of the scales.
constexpr double kWarmPush = 1e-6;

void set_options(Ipopt::IpoptApplication& app, const SolverOptions& options) {
  Ipopt::OptionsList& o = *app.Options();
  o.SetIntegerValue("print_level", 0);
  o.SetStringValue("sb", "yes");
  o.SetNumericValue("tol", options.tolerance);
  o.SetNumericValue("constr_viol_tol", options.row_tolerance);
  o.SetNumericValue("compl_inf_tol", options.tolerance);
  o.SetNumericValue("dual_inf_tol", 1e3 * options.tolerance);
  o.SetIntegerValue("max_iter", options.max_iterations);
  o.SetIntegerValue("acceptable_iter", 0);
  o.SetNumericValue("bound_relax_factor", 0);
  o.SetStringValue("mu_strategy", "adaptive");
  o.SetStringValue("nlp_scaling_method", "none");
  o.SetStringValue("fixed_variable_treatment", "make_parameter");
  // Minimum degree: a tenth to a fifth of the time less than what MUMPS chooses by itself, in
  // postures, motions and their warm starts alike.
  o.SetIntegerValue("mumps_pivot_order", 0);
  if (!options.warm) return;
  o.SetStringValue("warm_start_init_point", "yes");
  for (const char* push :
       {"warm_start_bound_push", "warm_start_bound_frac", "warm_start_slack_bound_push",
        "warm_start_slack_bound_frac", "warm_start_mult_bound_push"})
    o.SetNumericValue(push, kWarmPush);
}

/// Which BLAS it is, the system decides when the program starts.
void set_blas_threads(int threads) {
  using Set = void (*)(int);
  static const auto set = reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  if (set) set(threads);
}

const char* words(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded: return "optimal to the tolerances";
    case Ipopt::Solved_To_Acceptable_Level: return "nearly optimal";
    case Ipopt::Infeasible_Problem_Detected: return "converged to a point of local infeasibility";
    case Ipopt::Search_Direction_Becomes_Too_Small: return "steps became too small";
    case Ipopt::Diverging_Iterates: return "the iterates diverge";
    case Ipopt::User_Requested_Stop: return "stopped by the caller or by the time limit";
    case Ipopt::Maximum_Iterations_Exceeded: return "the iteration limit was reached";
    case Ipopt::Restoration_Failed: return "no point with a smaller violation was found";
    case Ipopt::Error_In_Step_Computation: return "a step could not be computed";
    case Ipopt::Not_Enough_Degrees_Of_Freedom: return "more equalities than free variables";
    case Ipopt::Invalid_Number_Detected: return "a value was not a finite number";
    default: return "the solver gave up";
  }
}

}  // namespace

Solution solve(Nlp& nlp, std::vector<double> x, const SolverOptions& options) {
  const Clock::time_point begin = Clock::now();
  const std::clock_t cpu = std::clock();
  Solution solution;
  solution.x = std::move(x);
  if (solution.x.size() != nlp.variables().size())
    throw std::invalid_argument("solve: x has not as many entries as there are variables");
  // Ipopt owns what it is given by a SmartPtr; console output off.
  Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
  app->RethrowNonIpoptException(true);
  set_options(*app, options);
  set_blas_threads(options.blas_threads);
  if (app->Initialize("") != Ipopt::Solve_Succeeded)
    throw std::runtime_error("Ipopt cannot be initialised");
  const Ipopt::SmartPtr<Ipopt::TNLP> adapter = new Adapter(nlp, options, solution);
  const Ipopt::ApplicationReturnStatus status = app->OptimizeTNLP(adapter);
  solution.reason = words(status);
  if (solution.multipliers.rows.empty() && solution.multipliers.lower.empty()) {
    solution.multipliers = {std::vector<double>(nlp.rows().size(), 0),
                            std::vector<double>(nlp.variables().size(), 0),
                            std::vector<double>(nlp.variables().size(), 0)};
  }
  solution.kkt_error = kkt_error(nlp, solution.x, solution.multipliers, options.objective_scale);
  solution.violation = largest_violation(nlp, solution.x);
  solution.objective = nlp.objective();
  const bool fine = solution.kkt_error <= 10 * options.tolerance &&
                    solution.violation <= 10 * options.row_tolerance;
  if (status == Ipopt::Solve_Succeeded || fine)
    solution.status = Status::kOptimal;
  else if (status == Ipopt::Infeasible_Problem_Detected)
    solution.status = Status::kInfeasible;
  if (fine && status != Ipopt::Solve_Succeeded) solution.reason = words(Ipopt::Solve_Succeeded);
  solution.seconds = seconds_since(begin);
  solution.cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  return solution;
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc
