// Inverse dynamics as a linear map of the inertial parameters: q, v, a -> Y, tau = Y pi.
//
// The parameters of a body are about the origin of its link frame and along that frame's axes:
//   m, m c (3), Ixx, Ixy, Iyy, Ixz, Iyz, Izz.
// The wrench on a body is linear in them, f = m dv + U mc, n = mc x dv + G I; a joint coordinate
// whose unit motion is (d, t) in the link frame feels d . f + t . n, so its ten entries are
//   d . dv,   U^T d + dv x t,   G^T t.
// Unit motions of the joints are carried outward.  docs/theory.md section 7.
#pragma once
#include "algorithms/link_motion.h"
#include "algorithms/twist.h"

namespace arboc {

/// A joint as seen from a body behind it.  Single joints: the twist of their axis, rotation in
/// axis[0] and linear part in `arm`.  Others: the axes of the joint's body and the way from its
/// origin to the body's.
template <class T>
struct DistantJoint {
  int body = 0;
  Vector3<T> axis[3];
  Vector3<T> arm;
};

template <class T>
struct RegressorWorkspace {
  Poses<T> pose;
  std::vector<LinkMotion<T>> motion;
  std::vector<std::vector<DistantJoint<T>>> joints;  ///< of each body: its own and those before it

  template <class Tree>
  explicit RegressorWorkspace(const Tree& tree)
      : pose(tree), motion(tree.body.size()), joints(tree.body.size()) {
    motion[0] = world_motion<T>(tree);
  }
};

/// What the wrench on a body takes from its motion, along the axes of its link frame.
template <class T>
struct ParameterMap {
  Vector3<T> dv;
  Matrix3<T> U;
  Vector3<T> G[6];  ///< moment of Ixx Ixy Iyy Ixz Iyz Izz:  I dw + w x I w
};

/// `turn` rows of the rotation, link axes from body axes; p the link's origin on the body.
template <class T>
ParameterMap<T> parameter_map(const Vector3<T> (&turn)[3], const Vector3<T>& p,
                              const LinkMotion<T>& motion) {
  const auto turned = [&](const Vector3<T>& a) {
    return Vector3<T>{dot(turn[0], a), dot(turn[1], a), dot(turn[2], a)};
  };
  const Vector3<T> w = turned(motion.w), dw = turned(motion.dw);
  const T xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  const T xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
  return {turned(motion.dv + motion.U * p),
          acceleration_matrix(w, dw),
          {{dw.x, xz, -xy},
           {dw.y - xz, dw.x + yz, xx - yy},
           {-yz, dw.y, xy},
           {dw.z + xy, zz - xx, dw.x - yz},
           {yy - zz, dw.z - xy, dw.y + xz},
           {yz, -xz, dw.z}}};
}

/// The ten entries of a coordinate whose unit motion of the link frame is `unit`.
template <class T>
void parameter_row(const ParameterMap<T>& map, const Twist<T>& unit, T (&row)[10]) {
  const Vector3<T>&d = unit.linear, &t = unit.angular;
  const Vector3<T> moment = transpose_apply(map.U, d) + cross(map.dv, t);
  row[0] = dot(d, map.dv);
  for (int i = 0; i < 3; ++i) row[1 + i] = moment[i];
  for (int i = 0; i < 6; ++i) row[4 + i] = dot(t, map.G[i]);
}

template <class T>
DistantJoint<T> own_joint(int k, Motion motion) {
  const T o(0), one(1);
  DistantJoint<T> joint;
  joint.body = k;
  joint.arm = {o, o, o};
  const Vector3<T> z{o, o, one};
  if (freedoms(motion) > 1) {
    joint.axis[0] = {one, o, o};
    joint.axis[1] = {o, one, o};
    joint.axis[2] = z;
  } else {
    joint.axis[0] = motion == Motion::kRevolute ? z : joint.arm;
    if (motion == Motion::kPrismatic) joint.arm = z;
  }
  return joint;
}

/// The same joint (of motion `kind`) from the next body.
template <class B, class T>
DistantJoint<T> carried_out(Motion kind, DistantJoint<T> joint, const B& body,
                            const JointPose<T>& pose) {
  if (freedoms(kind) > 1) {
    joint.arm = down(body, pose, joint.arm + pose.p);
    for (Vector3<T>& x : joint.axis) x = down(body, pose, x);
  } else {
    joint.arm = down(body, pose, joint.arm + cross(joint.axis[0], pose.p));
    joint.axis[0] = down(body, pose, joint.axis[0]);
  }
  return joint;
}

/// Unit motion of coordinate d of the joint, of the body's point p.
template <class T>
Twist<T> unit_motion(Motion kind, const DistantJoint<T>& joint, const Vector3<T>& p, int d) {
  if (freedoms(kind) == 1) return {joint.arm + cross(joint.axis[0], p), joint.axis[0]};
  const int c = component(kind, d);
  return unit_twist(c, joint.axis[c % 3], joint.arm + p);
}

/// Writes the block of body k: rows of all joints that move it, columns 10 (k - 1) and following.
template <class Tree, class F, class T>
void regressor_block(const Tree& tree, const RegressorWorkspace<T>& work, int k, const F& frame,
                     T* Y) {
  Vector3<T> turn[3];
  for (int i = 0; i < 3; ++i) turn[i] = cast<T>(column(frame.R, i));
  const auto in_link = [&](const Vector3<T>& a) {
    return Vector3<T>{dot(turn[0], a), dot(turn[1], a), dot(turn[2], a)};
  };
  const Vector3<T> p = cast<T>(frame.p);
  const ParameterMap<T> map = parameter_map(turn, p, work.motion[k]);
  for (const DistantJoint<T>& joint : work.joints[k]) {
    const auto& body = tree.body[joint.body];
    for (int d = 0; d < freedoms(body.motion); ++d) {
      const Twist<T> unit = unit_motion(body.motion, joint, p, d);
      T row[10];
      parameter_row(map, {in_link(unit.linear), in_link(unit.angular)}, row);
      T* out = Y + (body.v + d) * 10 * tree.nb() + 10 * (k - 1);
      for (int i = 0; i < 10; ++i) out[i] = out[i] + body.multiplier * row[i];
    }
  }
}

/// q (nq), v, a (nv) -> Y (nv x 10 nb, row-major), bodies in the order of tree.body.
template <class Tree, class T>
void regressor(const Tree& tree, RegressorWorkspace<T>& work, const T* q, const T* v, const T* a,
               T* Y) {
  work.pose.update(tree, q);
  for (int i = 0; i < 10 * tree.nb() * tree.nv; ++i) Y[i] = T(0);
  std::vector<int> link(tree.body.size());
  for (int f = 0; f < static_cast<int>(tree.frame.size()); ++f)
    if (tree.frame[f].moving) link[tree.frame[f].body] = f;
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "regressor");
    advance<true>(body, work.pose[k], work.motion[body.parent], v, a, work.motion[k]);
    work.joints[k] = {own_joint<T>(k, body.motion)};
    for (const DistantJoint<T>& joint : work.joints[body.parent])
      work.joints[k].push_back(
          carried_out(tree.body[joint.body].motion, joint, body, work.pose[k]));
    regressor_block(tree, work, k, tree.frame[link[k]], Y);
  }
}

}  // namespace arboc
