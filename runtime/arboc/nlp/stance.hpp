// A robot at an instant, as parts of a problem: its posture, what holds it, what it shall reach.
//
//   statics(q, loads) = tau            at rest; one row a coordinate, 0 where nothing drives it
//   rnea(q, v, a, loads) = tau         in motion
// The torques are variables, so that limits are bounds and costs of torques have diagonal Hessians.
// Of a contact the reaction is a variable: force and moment at its point, on the body, along the
// world's axes or its frame's.  Positions and directions are linear in what the generated fk gives;
// orientations are two rows an axis, e1.a = e2.a = 0, and never differences of vectors, which would
// be three rows of rank two.
#ifndef ARBOC_NLP_STANCE_HPP
#define ARBOC_NLP_STANCE_HPP

#include <Eigen/Core>
#include <array>

#include "problem.hpp"
#include "robot.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

using Vector3 = Eigen::Vector3d;
using AffineVector = std::array<Affine, 3>;

/// Where a point shall be.
struct Place {
  enum class Kind { kFree, kPoint, kLine, kPlane, kAbove };
  Kind kind = Kind::kFree;
  Vector3 at = Vector3::Zero();
  Vector3 direction = Vector3::Zero();  ///< of a line; normal of a plane, `above` is its side

  /// Orthonormal directions n of the rows n.p = n.at.
  std::vector<Vector3> normals() const;
};

/// Where a frame is, of twelve numbers as Robot::placements gives them.
struct Placement {
  explicit Placement(const double* twelve)
      : R(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(twelve)), p(twelve + 9) {}

  /// In the world, of a point in the frame.
  Vector3 operator()(const Vector3& local) const { return R * local + p; }

  Eigen::Matrix3d R;
  Vector3 p;
};

/// An axis of a frame points along a direction of the world.
struct Alignment {
  Vector3 axis, direction;
  bool either_way = false;  ///< or against it
};

/// Limits of a component; equal ones fix it.
struct Limits {
  double lower = 0, upper = 0;
};

struct Contact {
  std::string name, frame;
  Vector3 point = Vector3::Zero();  ///< in the frame, m
  Place place{};
  std::vector<Alignment> align{};  ///< two at most
  std::array<Limits, 3> force{}, moment{};
  bool own_axes = false;              ///< force and moment are along the frame's axes
  double friction = kInfinity;        ///< |tangential| <= friction * normal
  Vector3 normal = Vector3::UnitY();  ///< in the same axes as the force
};

/// A force of the world on a point of the body.
struct Load {
  std::string name, frame;
  Vector3 point = Vector3::Zero();  ///< in the frame, m
  Vector3 force = Vector3::Zero();  ///< world axes, N
};

/// A ball on the body; without a frame it stands in the world.
struct Ball {
  std::string frame;
  Vector3 centre = Vector3::Zero();  ///< in the frame, m
  double radius = 0;
};

/// What of a robot at rest a problem is about.
enum class Aspect {
  kAll,         ///< posture, reactions, torques
  kKinematics,  ///< posture only
  /// The same for project(): aligned axes a are pulled by rows a - d = 0, which turn them the short
  /// way from anywhere; as they are dependent, they are not for solvers.
  kProjection,
};

/// How the robot moves at an instant: sums of variables, one a coordinate.  At rest v and a are
/// empty.
struct Instant {
  std::vector<Affine> q, v, a;
};

/// Force and moment of a contact at its point, along its axes.
using Reaction = std::array<Affine, 6>;

class Stance {
 public:
  /// At rest, in a posture whose coordinates become variables.  `passive`: coordinates that nothing
  /// drives.
  Stance(Problem& problem, const Robot& robot, const std::vector<bool>& passive, Aspect aspect);
  Stance(Problem& problem, const Robot& robot, const std::vector<bool>& passive, Aspect aspect,
         Instant instant);

  /// Variables, of the first constructor.
  const Quantities& q() const { return q_; }
  AffineVector point(const std::string& frame, const Vector3& local);
  AffineVector direction(const std::string& frame, const Vector3& local);

  /// Rows of its place, and a reaction that is variables.
  void add(const Contact& contact);
  /// Rows of its place only; these are groups `name, position` and `name, orientation`.
  void add_place(const Contact& contact);
  /// What it pushes with, and nothing else.
  void add_reaction(const Contact& contact, const Reaction& reaction);
  void add(const Load& load);
  /// Rows of a place and of alignments, as a group; its index.
  int add_target(const std::string& name, const std::string& frame, const Vector3& local,
                 const Place& place, const std::vector<Alignment>& align = {});
  /// The row a.d >= cos(within) of an axis of a frame and a direction of the world, a group `name`.
  void add_cone(const std::string& name, const Alignment& look, const std::string& frame,
                double within);
  /// The row |p - q|^2 >= (r + s)^2 of two balls, in group `collision`.
  void add_distance(const Ball& a, const Ball& b);
  /// After all contacts and loads: the rows of torques, and unless told otherwise those of passive
  /// coordinates.
  void finish(bool balance = true);

  /// After finish(), of the coordinates that are driven, in their order.
  const std::vector<int>& driven() const { return driven_; }
  const Quantities& tau() const { return tau_; }
  /// Of a contact, six variables along its axes; in the order in which contacts were added.
  const std::vector<Quantities>& reactions() const { return reactions_; }

 private:
  AffineVector centre(const Ball& ball);
  void add_rows(int group, const AffineVector& p, const Place& place);
  void add_rows(int group, const std::string& frame, const std::vector<Alignment>& align);
  AffineVector in_world(const std::string& name, const std::string& unit, const Contact& contact,
                        const AffineVector& own);
  AffineVector about_origin(const std::string& name, const std::string& frame, const Vector3& point,
                            const AffineVector& f, const AffineVector& n);
  void apply(const std::string& frame, const AffineVector& f, const AffineVector& n);
  /// Of frames; evaluated if something asks for them.
  const Quantities& placements();

  Problem& problem_;
  const Robot& robot_;
  std::vector<bool> passive_;
  Aspect aspect_;
  Quantities q_, placements_, tau_;
  Instant instant_;
  std::vector<int> driven_;
  std::vector<Quantities> reactions_;
  std::vector<Affine> wrenches_;  ///< f_ext: per load six sums along the world's axes
};

/// The variables of a contact's reaction, within its limits.
std::vector<Interval> reaction_range(const Contact& contact);
/// The row of its friction cone, if it has one.
void add_friction(Problem& problem, const Contact& contact, const Reaction& reaction);
/// A torque that has limits.
struct LimitedTorque {
  Quantity tau;
  double lower, upper;
};
/// A variable s that is at least `least` and at least each tau / limit, by rows L s <= tau <= U s;
/// both groups are `largest normalised torque`.
Quantity add_largest_normalised(Problem& problem, const std::vector<LimitedTorque>& torques,
                                double least = 0);
/// What counts as 1 of forces and moments, N and N m.
constexpr double kForceScale = 100;

/// Two unit vectors that make a right-handed triple with n.
std::array<Vector3, 2> across(const Vector3& n);

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_STANCE_HPP
