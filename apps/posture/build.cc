#include "build.h"

#include <algorithm>
#include <arboc/nlp/scalars.hpp>
#include <cmath>

namespace posture {
namespace {

using namespace arboc::nlp;

bool ignored(const Collision& c, const Sphere& a, const Sphere& b) {
  if (a.part == b.part || (a.frame.empty() && b.frame.empty())) return true;
  return std::any_of(c.ignore.begin(), c.ignore.end(), [&](const auto& pair) {
    return (pair.first == a.part && pair.second == b.part) ||
           (pair.first == b.part && pair.second == a.part);
  });
}

class Builder {
 public:
  Builder(const Task& task, const Model& model, const BuildOptions& options)
      : task_(task),
        model_(model),
        options_(options),
        relaxed_(relaxed_of(task, model)),
        stance_(problem_, model.robot, model.passive, options.aspect) {}

  Built run() {
    for (const Contact& contact : task_.contacts) stance_.add(contact);
    for (const Load& load : task_.loads) stance_.add(load);
    add_targets();
    for (const Look& look : task_.looks) add_look(look);
    add_collisions();
    if (task_.symmetric) add_symmetry();
    stance_.finish();
    if (options_.aspect == Aspect::kAll) add_objective();
    out_.q = stance_.q();
    out_.tau = stance_.tau();
    out_.driven = stance_.driven();
    out_.reactions = stance_.reactions();
    out_.nlp = std::make_unique<Assembly>(std::move(problem_));
    if (options_.aspect == Aspect::kAll && !task_.torque_limits)
      for (int k = 0; k < out_.tau.size(); ++k)
        out_.nlp->set_variable(out_.tau[k].index, -kInfinity, kInfinity);
    list_elastic();
    return std::move(out_);
  }

 private:
  void add_targets() {
    for (const Target& t : task_.targets)
      out_.targets.push_back(stance_.add_target(t.name, t.frame, t.point, t.place, t.align));
  }

  void add_look(const Look& look) {
    const AffineVector a = stance_.direction(look.frame, look.axis);
    const Vector3& d = look.direction;
    const Affine along = d.x() * a[0] + d.y() * a[1] + d.z() * a[2];
    if (look.within)
      stance_.add_cone(look.name, {look.axis, look.direction}, look.frame, *look.within);
    if (look.weight == 0) return;
    if (!look.at) return problem_.minimise(look.name, look.weight, 1.0 - along);
    const AffineVector eye = stance_.point(look.frame, look.eye);
    std::vector<Affine> arguments(a.begin(), a.end());
    for (std::size_t i = 0; i < 3; ++i)
      arguments.push_back(Affine((*look.at)[static_cast<Eigen::Index>(i)]) - eye[i]);
    problem_.minimise(look.name, look.weight, off_direction(), arguments);
  }

  void add_collisions() {
    const std::vector<Sphere>& s = task_.collision.spheres;
    for (const auto& [i, j] : options_.pairs)
      stance_.add_distance(s[static_cast<std::size_t>(i)], s[static_cast<std::size_t>(j)]);
  }

  void add_symmetry() {
    const int group = problem_.add_group("symmetry", "rad");
    for (const Mirror& m : task_.mirrors) {
      const Quantity left = stance_.q()[model_.robot.coordinate(m.left)],
                     right = stance_.q()[model_.robot.coordinate(m.right)];
      problem_.require(group, Affine(left) - m.sign * Affine(right), -task_.asymmetry,
                       task_.asymmetry);
    }
  }

  void add_displacement() {
    for (int i = 0; i < model_.robot.size(); ++i)
      if (!model_.passive[static_cast<std::size_t>(i)])
        problem_.minimise("displacement", task_.objective.displacement, square(),
                          {stance_.q()[i] - Affine(relaxed_[static_cast<std::size_t>(i)])});
  }

  void add_objective() {
    const Objective& o = task_.objective;
    add_displacement();
    const std::vector<int>& driven = stance_.driven();
    std::vector<int> limited;  // torques that have limits
    for (int k = 0; k < stance_.tau().size(); ++k) {
      problem_.minimise("torque", o.torque, square(), {stance_.tau()[k]});
      if (!std::isfinite(upper(driven[static_cast<std::size_t>(k)]))) continue;
      limited.push_back(k);
      const int i = driven[static_cast<std::size_t>(k)];
      problem_.minimise("normalised", o.normalised, normalised_square(lower(i), upper(i)),
                        {stance_.tau()[k]});
    }
    if (o.norm > 0) add_norm(limited);
    if (o.maximum > 0) add_maximum(limited);
    for (const Quantities& r : stance_.reactions())
      for (int i = 0; i < r.size(); ++i)
        problem_.minimise("reactions", o.reactions, square(), {0.01 * Affine(r[i])});
  }

  void add_norm(const std::vector<int>& limited) {
    const auto n = static_cast<Eigen::Index>(limited.size());
    Eigen::VectorXd low(n), high(n);
    std::vector<Affine> tau;
    for (Eigen::Index k = 0; k < n; ++k) {
      const int at = limited[static_cast<std::size_t>(k)];
      low[k] = lower(stance_.driven()[static_cast<std::size_t>(at)]);
      high[k] = upper(stance_.driven()[static_cast<std::size_t>(at)]);
      tau.emplace_back(stance_.tau()[at]);
    }
    problem_.minimise("norm", task_.objective.norm, normalised_norm(low, high, task_.objective.p),
                      tau);
  }

  void add_maximum(const std::vector<int>& limited) {
    std::vector<LimitedTorque> torques;
    for (const int k : limited) {
      const int i = stance_.driven()[static_cast<std::size_t>(k)];
      torques.push_back({stance_.tau()[k], lower(i), upper(i)});
    }
    const Quantity s = add_largest_normalised(problem_, torques);
    problem_.minimise("maximum", task_.objective.maximum, s);
    out_.maximum = s.index;
  }

  double lower(int i) const { return model_.robot.tau_lower[static_cast<std::size_t>(i)]; }
  double upper(int i) const { return model_.robot.tau_upper[static_cast<std::size_t>(i)]; }

  /// Targets first, then what holds the body, then its torques.
  void list_elastic() {
    out_.elastic = out_.targets;
    const auto& groups = out_.nlp->row_groups();
    const auto is_target = [&](int g) {
      return std::find(out_.targets.begin(), out_.targets.end(), g) != out_.targets.end();
    };
    for (int g = 0; g < static_cast<int>(groups.size()); ++g)
      if (!is_target(g) && !groups[static_cast<std::size_t>(g)].members.empty())
        out_.elastic.push_back(g);
  }

  const Task& task_;
  const Model& model_;
  const BuildOptions& options_;
  std::vector<double> relaxed_;
  Problem problem_;
  Stance stance_;
  Built out_;
};

}  // namespace

Built build(const Task& task, const Model& model, const BuildOptions& options) {
  return Builder(task, model, options).run();
}

std::vector<double> posture_of(const std::map<std::string, double>& posture, const Model& model,
                               std::vector<double> otherwise) {
  for (const auto& [name, x] : posture)
    otherwise[static_cast<std::size_t>(model.robot.coordinate(name))] = x;
  return otherwise;
}

std::vector<double> relaxed_of(const Task& task, const Model& model) {
  std::vector<double> q(static_cast<std::size_t>(model.robot.size()), 0);
  if (!task.relaxed_posture.empty()) {
    const auto named = model.robot.postures.find(task.relaxed_posture);
    if (named == model.robot.postures.end())
      throw std::invalid_argument(task.model + " has no posture '" + task.relaxed_posture + "'");
    q = named->second;
  }
  return posture_of(task.relaxed, model, q);
}

std::vector<Pair> pairs(const Task& task) {
  std::vector<Pair> out;
  const std::vector<Sphere>& s = task.collision.spheres;
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t j = i + 1; j < s.size(); ++j)
      if (!ignored(task.collision, s[i], s[j]))
        out.emplace_back(static_cast<int>(i), static_cast<int>(j));
  return out;
}

std::vector<double> gaps(const Task& task, const Model& model, const std::vector<Pair>& pairs,
                         const std::vector<double>& q) {
  std::vector<double> placements(static_cast<std::size_t>(model.robot.placements->outputs()));
  model.robot.placements->values(1, q.data(), placements.data());
  const auto place = [&](int k) -> Vector3 {
    const Sphere& s = task.collision.spheres[static_cast<std::size_t>(k)];
    if (s.frame.empty()) return s.centre;
    return Placement(placements.data() + 12 * model.robot.frame(s.frame))(s.centre);
  };
  std::vector<double> out;
  for (const auto& [i, j] : pairs)
    out.push_back((place(i) - place(j)).norm() -
                  task.collision.spheres[static_cast<std::size_t>(i)].radius -
                  task.collision.spheres[static_cast<std::size_t>(j)].radius);
  return out;
}

}  // namespace posture
