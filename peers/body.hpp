// A rigid body system in plain numbers: what peers are built from, and which functions they have.
//
// Plain, because it crosses the border between programs that different compilers built.
#pragma once

namespace peers {

enum class Kind : int { kFixed, kRevolute, kPrismatic, kPlanar, kFloating };

/// Pose of a joint's child at q = 0 in its parent: p (m), R by rows.
struct Joint {
  Kind kind = Kind::kFixed;
  int parent = -1;  ///< index of a link; -1 is the world
  int child = -1;
  int q = 0, v = 0;  ///< where its coordinates begin
  double R[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  double p[3] = {0, 0, 0};
  double axis[3] = {0, 0, 1};                     ///< unit, in the child's frame
  double plane[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< of a planar joint: columns x, y, normal
};

struct Link {
  int massive = 0;  ///< whether the model gives it an inertia
  double mass = 0;  ///< kg
  double c[3] = {0, 0, 0};
  double I[6] = {0, 0, 0, 0, 0, 0};  ///< kg m^2 about c, link axes: xx yy zz xy xz yz
};

/// Where a peer that generates code puts it, and with what it is compiled: the path of a compiler
/// that knows `-x c`, and its flags between single spaces.
struct Toolchain {
  const char* folder = "";
  const char* compiler = "";
  const char* flags = "";
};

/// Parents come before children; a fixed root hangs on no joint.  Configurations as in arboc: x y z
/// qx qy qz qw of a floating joint, its rates in the body's axes, linear before angular.
struct Body {
  int nq = 0, nv = 0;
  int joints = 0, links = 0, root = 0;
  const Joint* joint = nullptr;
  const Link* link = nullptr;
  double gravity[3] = {0, 0, -9.81};
  Toolchain toolchain;
};

/// rnea: tau; crba: M; aba: a; minv: Minv; rnea_derivatives: dtau_dq, dtau_dv, M.
enum class Function : int { kRnea, kCrba, kAba, kMinv, kRneaDerivatives };

}  // namespace peers
