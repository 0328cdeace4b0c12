#include "build_costs.h"
#include "sample.h"

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

/// Adds one phase to a problem.
class PhaseBuilder {
 public:
  PhaseBuilder(Problem& problem, const Model& model, const Part& part, Free free)
      : problem_(problem),
        task_(*part.task),
        model_(model),
        free_(free),
        ends_(*part.ends),
        guess_(*part.guess),
        contacts_(task_.start.posture.contacts),
        out_{frames_of(task_, ends_, guess_.q.basis(), guess_.reactions.basis()), guess_.q.basis(),
             guess_.reactions.basis()} {}

  /// `before`: the phase to which this one is linked, or null; `share`: of its time in that of all.
  void run(const PhaseBuilder* before, double share) {
    share_ = share;
    before_ = before;
    add_coordinates();
    add_reactions();
    for (const Frames::Frame& frame : out_.frames.all) add_frame(frame);
    if (free_ == Free::kAll)
      for (const Via& via : task_.vias) add_via(via);
    add_regularity(problem_, task_, model_, out_, {free_, share_});
    if (task_.objective.maximum > 0) add_maximum();
  }
  /// Of the problem that was made.
  void finish(Assembly& nlp, bool exact) const {
    if (!task_.start.posture.torque_limits) free_torques(nlp);
    if (!exact) widen(nlp);
  }
  /// Contacts of the phase that is linked to this one: they end it too.
  void end_with(const std::vector<Contact>& contacts) { next_contacts_ = &contacts; }

  const Phase& phase() const { return out_; }

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
      if (before_) link(static_cast<std::size_t>(j), range);
    }
  }
  /// The first three points of a coordinate, from the last three of the phase before.
  void link(std::size_t j, const Interval& range) {
    const Eigen::Matrix3d E = linked_points(before_->out_.q_basis, out_.q_basis);
    const std::vector<Affine>& from = before_->out_.q.points[j];
    for (std::size_t i = 0; i < 3; ++i) {
      Affine& point = out_.q.points[j][i];
      point = 0;
      for (std::size_t k = 0; k < 3; ++k)
        if (const double e = E(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)); e != 0)
          point += e * from[from.size() - 3 + k];
      if (!point.terms.empty() && std::isfinite(range.upper - range.lower))
        problem_.require(problem_.add_group("joint limits at joints of phases", "rad, m"), point,
                         range.lower, range.upper);
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
      const std::vector<Interval> range = reaction_range(contacts_[c]), last = range_at_end(c);
      for (std::size_t i = 0; i < 6; ++i) add_reaction(c, i, range[i], last[i]);
      for (int k = before_ ? 1 : 0; k < n; ++k) {
        Reaction reaction;
        for (std::size_t i = 0; i < 6; ++i)
          reaction[i] = out_.r.points[6 * c + i][static_cast<std::size_t>(k)];
        if (std::any_of(reaction.begin(), reaction.end(),
                        [](const Affine& a) { return !a.terms.empty(); }))
          add_friction(problem_, contacts_[c], reaction);
      }
    }
  }
  /// May be narrower at the end, and is that of the phase that is linked too.
  std::vector<Interval> range_at_end(std::size_t c) const {
    std::vector<Interval> range = reaction_range(task_.end.posture.contacts[c]);
    if (!next_contacts_) return range;
    for (const Contact& next : *next_contacts_) {
      if (next.name != contacts_[c].name) continue;
      const std::vector<Interval> other = reaction_range(next);
      for (std::size_t i = 0; i < 6; ++i)
        range[i] = {std::max(range[i].lower, other[i].lower),
                    std::min(range[i].upper, other[i].upper), range[i].scale};
    }
    return range;
  }
  void add_reaction(std::size_t c, std::size_t i, const Interval& range, const Interval& last) {
    const int n = out_.r_basis.size();
    std::vector<Affine>& row = out_.r.points.emplace_back();
    const auto at = static_cast<Eigen::Index>(6 * c + i);
    for (int k = 0; k < n; ++k) {
      const int e = k == 0 ? 0 : 1;
      const Interval& here = k == n - 1 ? last : range;
      if (here.lower == here.upper)
        row.emplace_back(here.lower);
      else if (k == 0 && before_)
        row.push_back(linked_reaction(c, i));
      else if ((k == 0 || k == n - 1) && ends_.all(e))
        row.emplace_back(ends_.at[static_cast<std::size_t>(e)].reactions[at]);
      else
        row.emplace_back(
            problem_.add_variables(contacts_[c].name + ", reaction limits", "N, N m", {here})[0]);
    }
  }
  Affine linked_reaction(std::size_t c, std::size_t i) const {
    for (std::size_t b = 0; b < before_->contacts_.size(); ++b)
      if (before_->contacts_[b].name == contacts_[c].name)
        return before_->out_.r.points[6 * b + i].back();
    return 0;
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
    add_torque_costs(share_ * frame.weight);
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

  /// s >= n at all frames, and at ends where torques are known.
  void add_maximum() {
    double least = 0;
    for (std::size_t e = 0; e < 2; ++e)
      if (ends_.known[e] == Known::kAll && !(e == 0 && before_))
        least = std::max(least, largest_normalised(task_, model_, ends_.at[e]));
    std::vector<LimitedTorque> torques;
    for (const Quantities& tau : tau_)
      for (int k = 0; k < tau.size(); ++k) {
        const int i = driven_[static_cast<std::size_t>(k)];
        if (std::isfinite(upper(i))) torques.push_back({tau[k], lower(i), upper(i)});
      }
    const Quantity s = add_largest_normalised(problem_, torques, least);
    problem_.minimise("maximum", share_ * task_.objective.maximum, s);
    out_.maximum = s.index;
  }

  void free_torques(Assembly& nlp) const {
    for (const Quantities& tau : tau_)
      for (int k = 0; k < tau.size(); ++k) nlp.set_variable(tau[k].index, -kInfinity, kInfinity);
  }

  void widen(Assembly& nlp) const {
    const auto& groups = nlp.row_groups();
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
        const double at = nlp.rows().lower[row];
        if (at == nlp.rows().upper[row]) nlp.set_row(g, k, at - half, at + half);
      }
    }
  }

  double lower(int i) const { return model_.robot.tau_lower[static_cast<std::size_t>(i)]; }
  double upper(int i) const { return model_.robot.tau_upper[static_cast<std::size_t>(i)]; }

  Problem& problem_;
  const Task& task_;
  const Model& model_;
  Free free_;
  const Ends& ends_;
  const Motion& guess_;
  const std::vector<Contact>& contacts_;
  const std::vector<Contact>* next_contacts_ = nullptr;
  const PhaseBuilder* before_ = nullptr;
  double share_ = 1;
  Phase out_;
  std::vector<Quantities> tau_;
  std::vector<int> driven_;
};

}  // namespace

Built build(const Model& model, const std::vector<Part>& parts, Free free) {
  Problem problem;
  double duration = 0;
  std::vector<PhaseBuilder> builders;
  builders.reserve(parts.size());
  for (const Part& part : parts) {
    builders.emplace_back(problem, model, part, free);
    duration += part.task->duration;
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k + 1 < parts.size() && parts[k + 1].ends->linked)
      builders[k].end_with(parts[k + 1].task->start.posture.contacts);
    builders[k].run(parts[k].ends->linked ? &builders[k - 1] : nullptr,
                    parts[k].task->duration / duration);
  }
  Built built{std::make_unique<Assembly>(std::move(problem)), {}};
  const bool exact = std::all_of(builders.begin(), builders.end(),
                                 [](const PhaseBuilder& b) { return b.phase().frames.exact; });
  for (const PhaseBuilder& builder : builders) {
    builder.finish(*built.nlp, exact);
    built.phases.push_back(builder.phase());
  }
  return built;
}

}  // namespace motion
