#include "audit.h"

#include <posture/build.h>
#include <algorithm>
#include <arboc/nlp/scalars.hpp>
#include <cmath>

namespace motion {
namespace {

using namespace arboc::nlp;
using arboc::BSplineBasis;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Half widths of the boxes where there are more frames than a curve can meet exactly.
constexpr double kBoxForce = 1, kBoxPlace = 5e-4;  ///< N or N m; m or 1

/// Integrals of products of k-th derivatives, over the duration.
MatrixXd mean_square(const BSplineBasis& basis, int k) {
  return MatrixXd(arboc::gram_matrix(basis, k, k)) / (basis.end() - basis.begin());
}

class Builder {
 public:
  Builder(const Task& task, const Model& model, const Ends& ends, const Motion& guess, Free free)
      : task_(task),
        model_(model),
        free_(free),
        ends_(ends),
        contacts_(task.start.posture.contacts),
        out_{nullptr,
             frames_of(task, ends, guess.q.basis(), guess.reactions.basis()),
             guess.q.basis(),
             guess.reactions.basis(),
             {},
             {},
             -1},
        guess_(guess) {}

  Built run() {
    add_coordinates();
    add_reactions();
    for (const Frames::Frame& frame : out_.frames.all) add_frame(frame);
    if (free_ == Free::kAll)
      for (const Via& via : task_.vias) add_via(via);
    add_regularity();
    if (task_.objective.maximum > 0) add_maximum();
    out_.nlp = std::make_unique<Assembly>(std::move(problem_));
    if (!task_.start.posture.torque_limits) free_torques();
    if (!out_.frames.exact) widen();
    return std::move(out_);
  }

 private:
  /// Bounds of control points are bounds of the curve.
  void add_coordinates() {
    if (free_ == Free::kReactions) return give_coordinates();
    const Robot& robot = model_.robot;
    const int n = out_.q_basis.size(), first = ends_.fixed(0), last = n - ends_.fixed(1);
    const MatrixXd begin = end_points(out_.q_basis, ends_.at[0], false),
                   end = end_points(out_.q_basis, ends_.at[1], true);
    for (int j = 0; j < robot.size(); ++j) {
      const Interval range{robot.q_lower[j], robot.q_upper[j], 1};
      const Quantities free = problem_.add_variables("joint limits", "rad, m",
                                                     std::vector<Interval>(last - first, range));
      std::vector<Affine>& row = out_.q.points.emplace_back();
      for (int i = 0; i < n; ++i)
        row.push_back(i < first   ? Affine(begin(j, i))
                      : i >= last ? Affine(end(j, i - n + 3))
                                  : Affine(free[i - first]));
    }
  }

  void give_coordinates() {
    const MatrixXd& P = guess_.q.points();
    for (Eigen::Index j = 0; j < P.rows(); ++j) {
      std::vector<Affine>& row = out_.q.points.emplace_back();
      for (Eigen::Index i = 0; i < P.cols(); ++i) row.emplace_back(P(j, i));
    }
  }

  /// So are those of reactions, and friction cones, as they are convex.
  void add_reactions() {
    const int n = out_.r_basis.size();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const std::vector<Interval> range = reaction_range(contacts_[c]),
                                  last = reaction_range(task_.end.posture.contacts[c]);
      for (std::size_t i = 0; i < 6; ++i)
        add_reaction(6 * c + i, contacts_[c].name, range[i], last[i]);
      for (int k = 0; k < n; ++k) {
        Reaction reaction;
        for (std::size_t i = 0; i < 6; ++i)
          reaction[i] = out_.r.points[6 * c + i][static_cast<std::size_t>(k)];
        if (std::any_of(reaction.begin(), reaction.end(),
                        [](const Affine& a) { return !a.terms.empty(); }))
          add_friction(problem_, contacts_[c], reaction);
      }
    }
  }
  /// `last`: limits at the end, which may be narrower there.
  void add_reaction(std::size_t component, const std::string& name, const Interval& range,
                    const Interval& last) {
    const int n = out_.r_basis.size();
    std::vector<Affine>& row = out_.r.points.emplace_back();
    const auto at = static_cast<Eigen::Index>(component);
    for (int k = 0; k < n; ++k) {
      const std::size_t e = k == 0 ? 0 : 1;
      const Interval& here = k == n - 1 ? last : range;
      if (here.lower == here.upper)
        row.emplace_back(here.lower);
      else if ((k == 0 || k == n - 1) && ends_.given[e])
        row.emplace_back(ends_.at[e].reactions[at]);
      else
        row.emplace_back(problem_.add_variables(name + ", reaction limits", "N, N m", {here})[0]);
    }
  }

  void add_frame(const Frames::Frame& frame) {
    const double t = frame.t;
    const bool holds = frame.holds && free_ == Free::kAll;
    const BasisAt q = basis_at(out_.q_basis, t, 2), r = basis_at(out_.r_basis, t, 0);
    Stance stance(problem_, model_.robot, model_.passive, Aspect::kAll,
                  {out_.q.all(q, 0), out_.q.all(q, 1), out_.q.all(q, 2)});
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (holds) stance.add_place(contacts_[c]);
      Reaction reaction;
      for (std::size_t i = 0; i < 6; ++i) reaction[i] = out_.r(static_cast<int>(6 * c + i), r, 0);
      stance.add_reaction(contacts_[c], reaction);
    }
    for (const Load& load : task_.start.posture.loads) stance.add(load);
    if (holds) add_collisions(stance, t);
    for (const posture::Look& look : task_.start.posture.looks)
      if (holds && look.within)
        stance.add_cone(look.name, {look.axis, look.direction}, look.frame, *look.within);
    stance.finish(frame.balances);
    driven_ = stance.driven();
    tau_.push_back(stance.tau());
    add_torque_costs(frame.weight);
  }

  void add_torque_costs(double weight) {
    const Objective& o = task_.objective;
    for (int k = 0; k < tau_.back().size(); ++k) {
      const int i = driven_[static_cast<std::size_t>(k)];
      if (o.torque > 0) problem_.minimise("torque", o.torque * weight, square(), {tau_.back()[k]});
      if (o.normalised > 0 && std::isfinite(upper(i)))
        problem_.minimise("normalised", o.normalised * weight,
                          normalised_square(lower(i), upper(i)), {tau_.back()[k]});
    }
  }

  /// Pairs of spheres that are closer than the margin in the guess.
  void add_collisions(Stance& stance, double t) {
    const posture::Collision& collision = task_.start.posture.collision;
    if (collision.spheres.empty()) return;
    const std::vector<posture::Pair> pairs = posture::pairs(task_.start.posture);
    const VectorXd q = guess_.q(t);
    const std::vector<double> gaps =
        posture::gaps(task_.start.posture, model_, pairs, {q.data(), q.data() + q.size()});
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (gaps[k] <= collision.margin)
        stance.add_distance(collision.spheres[static_cast<std::size_t>(pairs[k].first)],
                            collision.spheres[static_cast<std::size_t>(pairs[k].second)]);
  }

  void add_via(const Via& via) {
    const BasisAt q = basis_at(out_.q_basis, via.time, 0);
    Stance stance(problem_, model_.robot, model_.passive, Aspect::kKinematics,
                  {out_.q.all(q, 0), {}, {}});
    stance.add_target(via.target.name, via.target.frame, via.target.point, via.target.place,
                      via.target.align);
  }

  /// What is quadratic in the curves, integrated exactly.
  void add_regularity() {
    const Objective& o = task_.objective;
    const double T6 = std::pow(task_.duration, 6);
    const std::vector<double> relaxed = posture::relaxed_of(task_.start.posture, model_);
    for (std::size_t j = 0; j < out_.q.points.size() && free_ == Free::kAll; ++j) {
      add_square("smoothness", o.smoothness * T6, out_.q_basis, 3, out_.q.points[j]);
      add_square("acceleration", o.acceleration, out_.q_basis, 2, out_.q.points[j]);
      add_square("jerk", o.jerk, out_.q_basis, 3, out_.q.points[j]);
      if (model_.passive[j] || o.displacement == 0) continue;
      std::vector<Affine> off = out_.q.points[j];
      for (Affine& a : off) a.constant -= relaxed[j];
      add_square("displacement", o.displacement, out_.q_basis, 0, off);
    }
    const double one = kForceScale * kForceScale;
    for (const std::vector<Affine>& row : out_.r.points) {
      if (std::all_of(row.begin(), row.end(), [](const Affine& a) { return a.terms.empty(); }))
        continue;
      add_square("reactions", o.reactions / one, out_.r_basis, 0, row);
      add_square("smoothness of reactions", o.reaction_smoothness * T6 / one, out_.r_basis, 3, row);
    }
  }
  void add_square(const std::string& name, double weight, const BSplineBasis& basis, int k,
                  const std::vector<Affine>& points) {
    if (weight > 0) problem_.minimise(name, weight, quadratic(2 * mean_square(basis, k)), points);
  }

  /// s >= n at all frames, and at ends where torques are known.
  void add_maximum() {
    double least = 0;
    for (std::size_t e = 0; e < 2; ++e)
      if (ends_.given[e]) least = std::max(least, largest_normalised(task_, model_, ends_.at[e]));
    std::vector<LimitedTorque> torques;
    for (const Quantities& tau : tau_)
      for (int k = 0; k < tau.size(); ++k) {
        const int i = driven_[static_cast<std::size_t>(k)];
        if (std::isfinite(upper(i))) torques.push_back({tau[k], lower(i), upper(i)});
      }
    const Quantity s = add_largest_normalised(problem_, torques, least);
    problem_.minimise("maximum", task_.objective.maximum, s);
    out_.maximum = s.index;
  }

  void free_torques() {
    for (const Quantities& tau : tau_)
      for (int k = 0; k < tau.size(); ++k)
        out_.nlp->set_variable(tau[k].index, -kInfinity, kInfinity);
  }

  void widen() {
    const auto& groups = out_.nlp->row_groups();
    for (int g = 0; g < static_cast<int>(groups.size()); ++g) {
      const std::string& name = groups[static_cast<std::size_t>(g)].name;
      const bool place = std::any_of(contacts_.begin(), contacts_.end(), [&](const Contact& c) {
        return name == c.name + ", position" || name == c.name + ", orientation";
      });
      const double half = place ? kBoxPlace : name == "equations of motion" ? kBoxForce : 0;
      if (half == 0) continue;
      const auto& members = groups[static_cast<std::size_t>(g)].members;
      for (int k = 0; k < static_cast<int>(members.size()); ++k) {
        const auto row = static_cast<std::size_t>(members[static_cast<std::size_t>(k)]);
        const double at = out_.nlp->rows().lower[row];
        if (at == out_.nlp->rows().upper[row]) out_.nlp->set_row(g, k, at - half, at + half);
      }
    }
  }

  double lower(int i) const { return model_.robot.tau_lower[static_cast<std::size_t>(i)]; }
  double upper(int i) const { return model_.robot.tau_upper[static_cast<std::size_t>(i)]; }

  const Task& task_;
  const Model& model_;
  Free free_;
  const Ends& ends_;
  const std::vector<Contact>& contacts_;
  Problem problem_;
  Built out_;
  const Motion& guess_;
  std::vector<Quantities> tau_;
  std::vector<int> driven_;
};

}  // namespace

Built build(const Task& task, const Model& model, const Ends& ends, const Motion& guess,
            Free free) {
  return Builder(task, model, ends, guess, free).run();
}

}  // namespace motion
