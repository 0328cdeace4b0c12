#include "stance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "scalars.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

constexpr double kForce = kForceScale;
constexpr double kRounding = 1e-3;   ///< N, of friction cones at their apex
constexpr double kUnlimited = 1000;  ///< N m: scale of torques without a limit

Affine dot(const Vector3& n, const AffineVector& p) {
  return n.x() * p[0] + n.y() * p[1] + n.z() * p[2];
}
template <class Six>
AffineVector vector_of(const Six& x, int first) {
  AffineVector v;
  for (int i = 0; i < 3; ++i) v[i] = x[first + i];
  return v;
}

Instant at_rest(const Quantities& q) {
  Instant instant;
  for (int i = 0; i < q.size(); ++i) instant.q.emplace_back(q[i]);
  return instant;
}
Quantities posture(Problem& problem, const Robot& robot) {
  std::vector<Interval> range;
  for (int i = 0; i < robot.size(); ++i) range.push_back({robot.q_lower[i], robot.q_upper[i], 1});
  return problem.add_variables("joint limits", "rad, m", range);
}

}  // namespace

std::array<Vector3, 2> across(const Vector3& n) {
  int least = 0;
  n.cwiseAbs().minCoeff(&least);
  const Vector3 unit = n.normalized(), e1 = unit.cross(Vector3::Unit(least)).normalized();
  return {e1, unit.cross(e1)};
}

std::vector<Vector3> Place::normals() const {
  switch (kind) {
    case Kind::kPoint: return {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
    case Kind::kLine: {
      const auto [e1, e2] = across(direction);
      return {e1, e2};
    }
    case Kind::kPlane:
    case Kind::kAbove: return {direction.normalized()};
    case Kind::kFree: break;
  }
  return {};
}

Stance::Stance(Problem& problem, const Robot& robot, const std::vector<bool>& passive,
               Aspect aspect)
    : problem_(problem), robot_(robot), passive_(passive), aspect_(aspect) {
  q_ = posture(problem, robot);
  instant_ = at_rest(q_);
  wrenches_.resize(6 * robot.loads.size());
}

Stance::Stance(Problem& problem, const Robot& robot, const std::vector<bool>& passive,
               Aspect aspect, Instant instant)
    : problem_(problem),
      robot_(robot),
      passive_(passive),
      aspect_(aspect),
      instant_(std::move(instant)) {
  if (!instant_.v.empty() && !robot.dynamics)
    throw std::invalid_argument(robot.name + " is generated without rnea and its derivatives");
  wrenches_.resize(6 * robot.loads.size());
}

const Quantities& Stance::placements() {
  if (placements_.size() == 0) placements_ = problem_.evaluate(robot_.placements, instant_.q);
  return placements_;
}

AffineVector Stance::direction(const std::string& frame, const Vector3& local) {
  const int first = 12 * robot_.frame(frame);
  AffineVector a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (local[j] != 0) a[i] += local[j] * Affine(placements()[first + 3 * i + j]);
  return a;
}

AffineVector Stance::point(const std::string& frame, const Vector3& local) {
  AffineVector p = direction(frame, local);
  const int first = 12 * robot_.frame(frame) + 9;
  for (int i = 0; i < 3; ++i) p[i] += placements()[first + i];
  return p;
}

void Stance::add_rows(int group, const AffineVector& p, const Place& place) {
  for (const Vector3& n : place.normals()) {
    const double at = n.dot(place.at);
    problem_.require(group, dot(n, p), at, place.kind == Place::Kind::kAbove ? kInfinity : at);
  }
}

void Stance::add_rows(int group, const std::string& frame, const std::vector<Alignment>& align) {
  for (std::size_t k = 0; k < align.size(); ++k) {
    const AffineVector a = direction(frame, align[k].axis.normalized());
    const Vector3 d = align[k].direction.normalized();
    if (aspect_ == Aspect::kProjection && !align[k].either_way) {
      for (int i = 0; i < 3; ++i) problem_.require(group, a[i], d[i], d[i]);
      continue;
    }
    if (k == 0) {
      for (const Vector3& e : across(align[0].direction)) problem_.require(group, dot(e, a), 0, 0);
    } else {
      const Vector3 n = align[0].direction.cross(align[k].direction);
      if (n.norm() < 1e-6) throw std::invalid_argument("alignments of a frame are parallel");
      problem_.require(group, dot(n.normalized(), a), 0, 0);
    }
    if (!align[k].either_way) problem_.require(group, dot(d, a), 0, kInfinity);
  }
}

int Stance::add_target(const std::string& name, const std::string& frame, const Vector3& local,
                       const Place& place, const std::vector<Alignment>& align) {
  const int group = problem_.add_group(name, "m");
  add_rows(group, point(frame, local), place);
  if (!align.empty()) add_rows(problem_.add_group(name + ", direction", "1"), frame, align);
  return group;
}

void Stance::add_cone(const std::string& name, const Alignment& look, const std::string& frame,
                      double within) {
  const AffineVector a = direction(frame, look.axis);
  problem_.require(problem_.add_group(name, "1"), dot(look.direction, a), std::cos(within),
                   kInfinity);
}

AffineVector Stance::centre(const Ball& ball) {
  if (!ball.frame.empty()) return point(ball.frame, ball.centre);
  return {ball.centre.x(), ball.centre.y(), ball.centre.z()};
}

void Stance::add_distance(const Ball& a, const Ball& b) {
  const AffineVector p = centre(a), q = centre(b);
  const double least = (a.radius + b.radius) * (a.radius + b.radius);
  problem_.require(problem_.add_group("collision", "m^2"), squared_norm(3),
                   {p[0] - q[0], p[1] - q[1], p[2] - q[2]}, {}, least, kInfinity, least);
}

/// Three of a contact's own variables along the world's axes: f = R own, by variables of their own.
AffineVector Stance::in_world(const std::string& name, const std::string& unit,
                              const Contact& contact, const AffineVector& given) {
  if (!contact.own_axes) return given;
  const Quantities f =
      problem_.add_variables(name, unit, std::vector<Interval>(3, {-kInfinity, kInfinity, kForce}));
  const int group = problem_.add_group(name, unit);
  const AffineVector columns[3] = {direction(contact.frame, Vector3::UnitX()),
                                   direction(contact.frame, Vector3::UnitY()),
                                   direction(contact.frame, Vector3::UnitZ())};
  for (int i = 0; i < 3; ++i)
    problem_.require(group, nlp::dot(3),
                     {columns[0][i], columns[1][i], columns[2][i], given[0], given[1], given[2]},
                     -Affine(f[i]), 0, 0, kForce);
  return vector_of(f, 0);
}

/// The moment about the frame's origin of a wrench at a point of it: n + R point x f.
AffineVector Stance::about_origin(const std::string& name, const std::string& frame,
                                  const Vector3& point, const AffineVector& f,
                                  const AffineVector& n) {
  if (point.isZero(0)) return n;
  const Quantities m = problem_.add_variables(
      name, "N m", std::vector<Interval>(3, {-kInfinity, kInfinity, kForce}));
  const int group = problem_.add_group(name, "N m");
  const AffineVector arm = direction(frame, point);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    problem_.require(group, nlp::dot(2), {arm[j], -arm[k], f[k], f[j]}, n[i] - m[i], 0, 0, kForce);
  }
  return vector_of(m, 0);
}

void Stance::apply(const std::string& frame, const AffineVector& f, const AffineVector& n) {
  const std::size_t at = 6 * static_cast<std::size_t>(robot_.load(frame));
  for (std::size_t i = 0; i < 3; ++i) {
    wrenches_[at + i] += f[i];
    wrenches_[at + 3 + i] += n[i];
  }
}

void Stance::add_place(const Contact& contact) {
  if (contact.align.size() > 2)
    throw std::invalid_argument("contact '" + contact.name + "': more than two axes are aligned");
  const int position = problem_.add_group(contact.name + ", position", "m");
  add_rows(position, point(contact.frame, contact.point), contact.place);
  if (!contact.align.empty())
    add_rows(problem_.add_group(contact.name + ", orientation", "1"), contact.frame, contact.align);
}

std::vector<Interval> reaction_range(const Contact& contact) {
  std::vector<Interval> range;
  for (const auto* limits : {&contact.force, &contact.moment})
    for (const Limits& l : *limits) range.push_back({l.lower, l.upper, kForce});
  return range;
}

void Stance::add(const Contact& contact) {
  add_place(contact);
  if (aspect_ != Aspect::kAll) return;
  const Quantities own =
      problem_.add_variables(contact.name + ", reaction limits", "N, N m", reaction_range(contact));
  reactions_.push_back(own);
  Reaction reaction;
  for (int i = 0; i < 6; ++i) reaction[i] = own[i];
  add_reaction(contact, reaction);
  add_friction(problem_, contact, reaction);
}

void Stance::add_reaction(const Contact& contact, const Reaction& own) {
  const auto nothing = [](const Affine& a) { return a.terms.empty() && a.constant == 0; };
  if (std::all_of(own.begin(), own.end(), nothing)) return;
  const AffineVector f = in_world(contact.name + ", force", "N", contact, vector_of(own, 0));
  const AffineVector n = in_world(contact.name + ", moment", "N m", contact, vector_of(own, 3));
  apply(contact.frame, f,
        about_origin(contact.name + ", moment arm", contact.frame, contact.point, f, n));
}

Quantity add_largest_normalised(Problem& problem, const std::vector<LimitedTorque>& torques,
                                double least) {
  const char* name = "largest normalised torque";
  const Quantity s = problem.add_variables(name, "1", {{least, kInfinity, 1}})[0];
  const int group = problem.add_group(name, "1");
  for (const LimitedTorque& t : torques) {
    problem.require(group, (1 / t.upper) * Affine(t.tau) - s, -kInfinity, 0);
    problem.require(group, (1 / t.lower) * Affine(t.tau) - s, -kInfinity, 0);
  }
  return s;
}

/// sqrt(|F_t|^2 + e^2) <= mu F_n: never outside of the cone, smooth at its apex.
void add_friction(Problem& problem, const Contact& contact, const Reaction& reaction) {
  const bool pushes = std::any_of(contact.force.begin(), contact.force.end(),
                                  [](const Limits& l) { return l.lower != 0 || l.upper != 0; });
  if (!std::isfinite(contact.friction) || !pushes) return;
  const AffineVector f = vector_of(reaction, 0);
  const auto [t1, t2] = across(contact.normal);
  const int group = problem.add_group(contact.name + ", friction", "N");
  problem.require(group, rounded_norm(2, kRounding), {dot(t1, f), dot(t2, f)},
                  -contact.friction * dot(contact.normal.normalized(), f), -kInfinity, 0, kForce);
}

void Stance::add(const Load& load) {
  if (aspect_ != Aspect::kAll) return;
  const AffineVector f{load.force.x(), load.force.y(), load.force.z()};
  apply(load.frame, f, about_origin(load.name + ", moment arm", load.frame, load.point, f, {}));
}

void Stance::finish(bool balance) {
  if (aspect_ != Aspect::kAll) return;
  std::vector<Affine> inputs = instant_.q;
  for (const auto* more : {&instant_.v, &instant_.a, &wrenches_})
    inputs.insert(inputs.end(), more->begin(), more->end());
  const Quantities needed =
      problem_.evaluate(instant_.v.empty() ? robot_.statics : robot_.dynamics, inputs);
  std::vector<Interval> range;
  for (int i = 0; i < robot_.size(); ++i) {
    if (passive_[i]) continue;
    driven_.push_back(i);
    const double largest = std::max(-robot_.tau_lower[i], robot_.tau_upper[i]);
    range.push_back({robot_.tau_lower[i], robot_.tau_upper[i],
                     std::isfinite(largest) && largest > 0 ? largest : kUnlimited});
  }
  tau_ = problem_.add_variables("torque limits", "N m, N", range);
  const int base =
      problem_.add_group(instant_.v.empty() ? "equilibrium" : "equations of motion", "N, N m");
  const int joints = problem_.add_group("torques", "N m, N");
  for (int i = 0, k = 0; i < robot_.size(); ++i) {
    if (passive_[i]) {
      if (balance) problem_.require(base, needed[i], 0, 0, kForce);
      continue;
    }
    problem_.require(joints, Affine(needed[i]) - tau_[k], 0, 0, range[k].scale);
    ++k;
  }
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc
