// The articulated body as its author wrote it: named links and joints with their placements,
// inertias and limits.
//
// A front end fills in a Model in file order and validates it; configure() then applies the model
// options and puts links and joints depth first.  Everything behind reads the configured Model:
// the reference engine directly, the compiler through the DynamicTree.
// Units: m, kg, s, rad.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "spatial/axes.h"
#include "spatial/matrix3.h"

namespace arboc {

/// A length of the model that has a name: placements may be written in terms of it.
struct NamedLength {
  std::string name;
  double value = 0;  ///< m
};

/// How a placement follows a named length.
struct LengthTerm {
  int length = 0;           ///< index into Model::lengths
  Vector3<double> slope{};  ///< of xyz, m/m
};

/// Placement of a frame B in a frame A, as written: p_AB = xyz, R_AB = Rz(yaw) Ry(pitch) Rx(roll)
/// turn.
struct Pose {
  Vector3<double> xyz;  ///< m
  Vector3<double> rpy;  ///< rad; roll, pitch, yaw about the fixed axes x, y, z of A
  Matrix3<double> turn = Matrix3<double>::identity();  ///< a rotation: of a joint that was locked
  /// Where there are terms: xyz = rest + sum of slope * length.
  std::vector<LengthTerm> terms{};
  Vector3<double> rest{};  ///< m
};

/// xyz of a pose whose lengths are others; S is double or a symbol, `length` returns one by index.
template <class S, class Length>
Vector3<S> xyz_with(const Pose& pose, const Length& length) {
  if (pose.terms.empty()) return cast<S>(pose.xyz);
  Vector3<S> p = cast<S>(pose.rest);
  for (const LengthTerm& term : pose.terms)
    p = p + length(term.length) * cast<S>(term.slope);
  return p;
}

/// R_AB of a pose: sines and cosines by exact_sincos, entries within 4 eps of 0 or +-1 cleaned.
Matrix3<double> rotation(const Pose& pose);

struct Inertial {
  Pose origin;      ///< of the inertial frame in the link frame; its origin is the centre of mass
  double mass = 0;  ///< kg
  Symmetric3<double> inertia;  ///< kg m^2, about the centre of mass, axes of the inertial frame
  Location location{};
  const char* element = "";  ///< what it is called in the file, as "<inertial>: "
};

struct Link {
  std::string name;
  std::optional<Inertial> inertial;
  Location location;
  bool reported = false;  ///< a frame that the author wants to see: of those fk reports by default
};

enum class JointType {
  kFixed,
  kRevolute,
  kContinuous,
  kUnbounded,  ///< a continuous joint whose coordinates are cosine and sine of the angle
  kPrismatic,
  kFloating,
  kPlanar,
  kSpherical,
  // Only before configure(), which makes several joints of one:
  kHelical,    ///< turns by q about the axis and slides by pitch * q along it
  kUniversal,  ///< kMultiAxis with two rotations
  kMultiAxis,  ///< moves about or along several axes, one after the other
};

/// The URDF word for a joint type, or one like it.
const char* name(JointType type);

struct Limits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double lower = -kNone;    ///< rad or m
  double upper = kNone;     ///< rad or m
  double velocity = kNone;  ///< rad/s or m/s
  double effort = kNone;    ///< N m or N
  double effort_lower = -kNone;  ///< N m or N
};

/// q = multiplier * q_leader + offset.
struct Mimic {
  int leader = -1;  ///< index of the leading joint
  double multiplier = 1;
  double offset = 0;  ///< rad or m
  Location location{};
};

/// One of the axes of a joint that has several.
struct JointAxis {
  bool prismatic = false;
  Vector3<double> axis{1, 0, 0};  ///< unit, in the frame that the axes before this one have moved
  std::string name{};             ///< suffix of its joint after configure(); empty: its number
  Limits limits{};
};

struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  int parent = -1;  ///< link index; -1 is the world
  int child = -1;   ///< link index
  Pose origin;      ///< of the child link's frame in the parent's, at q = 0
  /// Unit vector in the child's frame: revolute, continuous, prismatic and helical joints move
  /// about or along it; planar ones move in the plane normal to it.
  Vector3<double> axis{1, 0, 0};
  double pitch = 0;  ///< m/rad, of a helical joint
  std::vector<JointAxis>
      axes;  ///< of a universal or multi-axis joint, from the parent to the child
  Limits limits;
  double damping = 0;        ///< N m s/rad or N s/m
  double friction = 0;       ///< N m or N
  double stiffness = 0;      ///< N m/rad or N/m, of a spring that is at rest at `neutral`
  double neutral = 0;        ///< rad or m
  double rotor_inertia = 0;  ///< kg m^2 or kg, of the drive as the joint feels it (gear squared)
  std::optional<Mimic> mimic;
  Location location;
  bool free_root = false;  ///< one of those by which the author lets the root move freely
};

/// Places of joints that the author gave a name; joints that are not listed are at 0.
struct Posture {
  std::string name;
  std::vector<std::pair<std::string, double>> q{};  ///< joint, and rad or m
};

/// Invariants after validation: names of links and of joints are unique; every link but `root` is
/// the child of exactly one joint; the joints form a tree; mimic graphs have no cycle, and leader
/// and follower have one coordinate each; numbers are finite; axes of moving joints are units.
struct Model {
  std::string name;
  std::string file;           ///< base name of the file it came from
  std::string source_sha256;  ///< of the bytes of that file
  std::vector<Link> links;
  std::vector<Joint> joints;
  int root = -1;                         ///< link index
  Vector3<double> gravity{0, 0, -9.81};  ///< m/s^2, in the root's fixed frame
  std::vector<NamedLength> lengths{};
  std::vector<Posture> postures{};
  bool kinematic = false;  ///< the file gives no masses at all, so dynamics would be zeros
};

/// Coordinates of one joint: 0/0 fixed, 1/1 revolute, continuous, prismatic and helical, 2/1
/// unbounded (cos, sin | rate), 3/3 planar (x, y, theta | vx, vy, wz), 7/6 floating (x y z qx qy qz
/// qw | linear, angular, body frame), 4/3 spherical (qx qy qz qw | angular, body frame), and one
/// and its rate an axis of a universal or multi-axis joint.
int nq(const Joint& joint);
int nv(const Joint& joint);
/// The same by type alone; behind configure() a type says all.
int nq(JointType type);
int nv(JointType type);

/// Whether Joint::axis means something.
bool has_axis(JointType type);
/// Where a joint's quaternion begins among its coordinates; -1 if it has none.
int quaternion_at(JointType type);

/// Axes of a planar joint's coordinates in the child frame: columns x, y and z = axis.  The
/// identity for axis z; for x and y the cyclic permutation (y z x, z x y); for a negative axis the
/// same with the first two columns' second one reversed; otherwise x is the projection of the
/// coordinate axis nearest to the plane (the first one if several are).
Matrix3<double> axis_frame(const Vector3<double>& axis);

/// How the root is attached to the world: as the file says (URDF: fixed), fixed, or by a joint with
/// a quaternion.
enum class Base { kFile, kFixed, kFloating };
enum class MimicPolicy { kFollow, kIndependent };
enum class JointOrder { kFile, kAlphabetical };
enum class ContinuousAs { kAngle, kCosSin };

/// A joint that is to be held at a place.
struct Lock {
  std::string joint;
  std::vector<double> q;  ///< nq entries, rad or m
};

struct ModelOptions {
  Base base = Base::kFile;
  MimicPolicy mimic = MimicPolicy::kFollow;
  JointOrder order = JointOrder::kFile;
  ContinuousAs continuous = ContinuousAs::kAngle;
  bool expand = false;  ///< joints of several freedoms become chains of axes, without quaternions
  std::string name;     ///< replaces the model's name; empty: keep
  std::vector<Lock> locks;
  std::string root;               ///< link whose subtree is kept; empty: the model's root
  std::string hang_from;          ///< link that the whole body hangs from; empty: the root
  std::vector<std::string> tips;  ///< links that the kept chains lead to; empty: all
  double snap =
      1e-9;  ///< rad; written angles this close to a multiple of 15 degrees become it; 0: off
};

/// Applies the options: snaps written angles and axis components (each reported as a note), frees
/// mimic followers, makes locked joints fixed ones, keeps the subchain between root and tips,
/// hangs it from another link, attaches the root to the world by a floating joint ("root_joint"), takes joints of several
/// freedoms as chains of axes, gives continuous joints cosine and sine for coordinates, makes a
/// chain of joints of every helical, universal and multi-axis one, and sorts links and joints depth
/// first (children in file order, or by joint name bytewise).  Afterwards parents come before
/// children: joints[k].parent is the root or the child of an earlier joint.  Linear in the number
/// of links; no recursion.  Throws UsageError for names that the model lacks, InputError if a kept
/// joint follows one that is cut off.
Model configure(Model model, const ModelOptions& options, Diagnostics& diagnostics);

/// Where each joint of a configured model finds its coordinates.
struct Coordinates {
  struct Entry {
    int q = -1;             ///< first index into q; of the leader if the joint is a mimic follower
    int v = -1;             ///< first index into v, a, tau
    double multiplier = 1;  ///< q_joint = multiplier * q[q] + offset, chains of followers resolved
    double offset = 0;
  };
  int nq = 0;
  int nv = 0;
  std::vector<Entry> joint;  ///< per joint of the model
};
Coordinates coordinates(const Model& model);

/// The printed form (`--print=model`): one line a link and a joint.
std::string print(const Model& model);

}  // namespace arboc
