#include "plan.h"

#include <arboc/motion/basis_matrix.hpp>
#include <arboc/motion/point_to_point.hpp>
#include <arboc/motion/quadrature.hpp>
#include <arboc/nlp/assembly.hpp>
#include <arboc/nlp/scalars.hpp>

#include "ladder/plan.h"

namespace optimal_control {
namespace {

namespace nlp = arboc::nlp;

/// The problem, and how its variables are laid out: joint after joint.
class Formulation {
 public:
  Formulation(const Question& q, bool limits) : q_(q), limits_(limits && q.limits) {
    const Model& m = *q.model;
    for (int j = 0; j < m.size(); ++j) {
      std::vector<nlp::Interval> range(static_cast<std::size_t>(points()));
      if (limits_)
        std::fill(range.begin(), range.end(), nlp::Interval{m.q_lower[j], m.q_upper[j], 1});
      points_.push_back(p_.add_variables(m.joints[static_cast<std::size_t>(j)], "rad", range));
    }
    add_torques();
    add_end("start", 0, q.start);
    add_end("end", q.duration, q.end);
    if (q.reach) add_reach();
  }

  const nlp::Problem& problem() const { return p_; }
  std::vector<double> start() const {
    std::vector<double> x;
    for (int j = 0; j < q_.guess.rows(); ++j)
      for (int k = 0; k < points(); ++k) x.push_back(q_.guess(j, k));
    return x;
  }
  arboc::BSpline motion(const std::vector<double>& x) const {
    return {q_.basis, Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(
                          x.data(), q_.guess.rows(), points())};
  }

 private:
  int points() const { return static_cast<int>(q_.guess.cols()); }

  /// The k-th derivative of a joint at an instant, a sum of its control points.
  nlp::Affine value(int joint, double t, int derivative) const {
    const arboc::BasisRows row =
        arboc::basis_rows(q_.basis, Eigen::VectorXd::Constant(1, t), derivative);
    nlp::Affine out;
    for (int k = 0; k < row.values.cols(); ++k)
      if (row.values(0, k) != 0)
        out += row.values(0, k) *
               nlp::Affine(points_[static_cast<std::size_t>(joint)][row.first[0] + k]);
    return out;
  }
  std::vector<nlp::Affine> state(double t, int derivatives) const {
    std::vector<nlp::Affine> out;
    for (int d = 0; d < derivatives; ++d)
      for (int j = 0; j < q_.model->size(); ++j) out.push_back(value(j, t, d));
    return out;
  }

  void add_torques() {
    const Model& m = *q_.model;
    const arboc::Quadrature rule = arboc::span_quadrature(q_.basis, q_.points_per_span);
    const int limits = limits_ ? p_.add_group("torques", "N m") : -1;
    for (Eigen::Index k = 0; k < rule.instants.size(); ++k) {
      const auto tau = p_.evaluate(m.torques, state(rule.instants[k], 3));
      const double root = std::sqrt(rule.weights[k]);
      for (int j = 0; j < m.size(); ++j) {
        p_.minimise("torque", 1, nlp::square(), {root * nlp::Affine(tau[j])});
        if (q_.smoothness > 0)
          p_.minimise("smoothness", q_.smoothness, nlp::square(),
                      {root * value(j, rule.instants[k], 2)});
        const double low = m.tau_lower[j], high = m.tau_upper[j];
        if (limits_ && (std::isfinite(low) || std::isfinite(high)))
          p_.require(limits, tau[j], low, high, std::isfinite(high) ? high : -low);
      }
    }
  }
  void add_end(const std::string& name, double t, const End& end) {
    const int group = p_.add_group(name, "rad");
    const Vector* parts[] = {&end.q, &end.v, &end.a};
    for (int d = 0; d < 3; ++d)
      for (Eigen::Index j = 0; j < parts[d]->size(); ++j)
        p_.require(group, value(static_cast<int>(j), t, d), (*parts[d])[j], (*parts[d])[j],
                   std::pow(q_.basis.greville().size() / q_.duration, d));
  }
  void add_reach() {
    const Reach& reach = *q_.reach;
    const int group = p_.add_group("reach", "m"), frame = 12 * q_.model->frame(reach.frame);
    const auto at = p_.evaluate(q_.model->placements, state(q_.duration, 1));
    for (int axis = 0; axis < 3; ++axis) {
      const auto& wanted = reach.place[static_cast<std::size_t>(axis)];
      if (!wanted) continue;
      nlp::Affine place = at[frame + 9 + axis];
      for (int c = 0; c < 3; ++c)
        if (reach.point[c] != 0) place += reach.point[c] * nlp::Affine(at[frame + 3 * axis + c]);
      p_.require(group, place, *wanted, *wanted);
    }
  }

  const Question& q_;
  bool limits_;
  nlp::Problem p_;
  std::vector<nlp::Quantities> points_;
};

Vector posture(const Model& model, const std::map<std::string, double>& angles) {
  Vector q = Vector::Zero(model.size());
  for (const auto& [name, angle] : angles) q[model.joint(name)] = angle;
  return q;
}

/// The states of a period's ends in the tree of the hand that holds.
Known ladder_period(const LadderPeriod& of, Question& q) {
  const ladder::Plan plan = ladder::plan(ladder::read_task(of.task));
  if (of.period >= static_cast<int>(plan.periods.size()))
    throw std::invalid_argument("the traverse has no period " + std::to_string(of.period));
  const ladder::Period period = plan.periods[static_cast<std::size_t>(of.period)];
  const ladder::Tree& tree = ladder::tree(period.held);
  q.model = &model(tree.name);
  q.duration = period.duration();
  const Known known = [period, &tree](double t, Vector& x, Vector& v, Vector& a) {
    const ladder::State s = period.at(period.begin + t);
    x = tree.own(s.q), v = tree.own(s.v), a = tree.own(s.a);
  };
  known(0, q.start.q, q.start.v, q.start.a);
  known(q.duration, q.end.q, q.end.v, q.end.a);
  return known;
}

/// Int sum tau^2 dt, as the program adds it up.
double torque_part(nlp::Assembly& program, const std::vector<double>& x) {
  program.move_to(x.data());
  return program.costs().at("torque");
}

Answer newton(const Formulation& f, const Question& q) {
  nlp::Assembly program(f.problem());
  nlp::LagrangeNewtonOptions options;
  options.max_iterations = q.max_iterations;
  const nlp::LagrangeNewtonResult r = nlp::lagrange_newton(program, f.start(), options);
  const double cost = torque_part(program, r.x);
  return {Method::kLagrangeNewton,
          r.converged,
          r.stop_reason,
          cost,
          static_cast<int>(r.log.size()),
          r.minimum,
          r.violation,
          r.seconds,
          r.log,
          f.motion(r.x)};
}

Answer ipopt(const Formulation& f, const Question& q) {
  nlp::Assembly program(f.problem());
  program.move_to(f.start().data());
  nlp::SolverOptions options;
  options.tolerance = 1e-8;
  options.max_iterations = 4 * q.max_iterations;
  options.objective_scale = std::max(1e-3, program.objective() / 10);
  const nlp::Solution s = nlp::solve(program, f.start(), options);
  double violation = 0;
  for (const auto& group : nlp::violations(program, s.x))
    violation = std::max(violation, group.largest);
  return {Method::kIpopt,
          s.status == nlp::Status::kOptimal,
          s.reason,
          torque_part(program, s.x),
          s.iterations,
          false,
          violation,
          s.seconds,
          {},
          f.motion(s.x)};
}

}  // namespace

Question question(const Task& task, Known& plan) {
  Question q;
  Known guess;
  if (task.ladder) {
    guess = plan = ladder_period(*task.ladder, q);
  } else {
    q.model = &model(task.model);
    const Vector from = posture(*q.model, task.start), to = posture(*q.model, task.end);
    const Vector rest = Vector::Zero(q.model->size()), open;
    q.duration = task.duration;
    q.start = {from, rest, task.smooth_ends ? rest : open};
    q.end = {task.reach ? open : to, rest, task.smooth_ends ? rest : open};
    q.reach = task.reach;
    guess = quintic(from, to, task.duration);
  }
  q.basis = arboc::BSplineBasis::clamped_uniform(task.degree, task.control_points, 0, q.duration);
  q.points_per_span = task.points_per_span;
  q.smoothness = task.smoothness;
  q.limits = task.limits;
  q.max_iterations = task.max_iterations;
  Eigen::MatrixXd values(q.model->size(), task.control_points);
  const Eigen::VectorXd instants = q.basis.greville();
  Vector x, v, a;
  for (Eigen::Index k = 0; k < instants.size(); ++k) {
    guess(instants[k], x, v, a);
    values.col(k) = x;
  }
  q.guess = arboc::fit(q.basis, instants, values).points();
  return q;
}

Answer solve(const Question& question, Method method) {
  const Formulation formulation(question, method == Method::kIpopt);
  return method == Method::kIpopt ? ipopt(formulation, question) : newton(formulation, question);
}

double torque_cost(const study::FixedModel& model, const Known& motion, double duration, int spans,
                   int points) {
  const arboc::Quadrature rule = arboc::gauss_legendre(points);
  Vector q, v, a, tau;
  double sum = 0;
  for (int s = 0; s < spans; ++s)
    for (int k = 0; k < points; ++k) {
      const double half = duration / spans / 2;
      motion(half * (2 * s + 1 + rule.instants[k]), q, v, a);
      model.rnea(q, v, a, tau);
      sum += half * rule.weights[k] * tau.squaredNorm();
    }
  return sum;
}

Known known(const arboc::BSpline& motion) {
  return [motion](double t, Vector& q, Vector& v, Vector& a) {
    q = motion(t);
    v = motion(t, 1);
    a = motion(t, 2);
  };
}

Known quintic(const Vector& from, const Vector& to, double duration) {
  const auto path = arboc::MotionPath::quintic({from, to, 0, duration});
  return [path](double t, Vector& q, Vector& v, Vector& a) {
    const auto s = path(t);
    q = s.position;
    v = s.velocity;
    a = s.acceleration;
  };
}

}  // namespace optimal_control
