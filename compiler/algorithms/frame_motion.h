// Velocities and accelerations of frames: q, v, a -> 6 numbers a frame, linear before angular.
//
// The acceleration is the time derivative of the velocity's coordinates in the same axes, J a +
// dJ/dt v, without gravity:
//   kLocal    spatial acceleration along the frame's axes
//   kAligned  classical acceleration of the frame's origin and angular acceleration
//   kWorld    spatial acceleration about the world's origin
// Three recursions: along the frame's axes outward with the bodies' axes; along the world's axes
// inward from the frame, which rotates five vectors a joint instead of three rows and four vectors,
// unless many frames share their joints.  docs/theory.md section 7.
#pragma once
#include "algorithms/placement.h"
#include "algorithms/twist.h"
#include "spatial/axes.h"

namespace arboc {

/// Velocity and its derivative of a point and what it is fixed to.
template <class T>
struct PointMotion {
  Twist<T> v, a;
};

template <class T>
struct FrameMotionWorkspace {
  Placements<T> placement;
  std::vector<PointMotion<T>> motion;  ///< of the bodies' origins

  template <class Tree>
  explicit FrameMotionWorkspace(const Tree& tree)
      : placement(tree),
        motion(tree.body.size(), PointMotion<T>{zero_twist<T>(), zero_twist<T>()}) {}
};

/// a, or zeros where only velocities are asked for.
template <bool kAccelerated, class B, class T>
Twist<T> joint_acceleration(const B& body, const T* a) {
  if constexpr (kAccelerated) return joint_twist(body, a);
  return zero_twist<T>();
}

/// Spatial velocity and acceleration of a body along its own axes, from its parent's.
template <bool kAccelerated, class B, class T>
PointMotion<T> local_motion(const B& body, const JointPose<T>& pose, const PointMotion<T>& parent,
                            const T* v, const T* a) {
  const auto carried = [&](const Twist<T>& x) {
    return Twist<T>{down(body, pose, x.linear + cross(x.angular, pose.p)),
                    down(body, pose, x.angular)};
  };
  const Twist<T> joint = joint_twist(body, v);
  PointMotion<T> motion{carried(parent.v), zero_twist<T>()};
  if constexpr (kAccelerated) {
    motion.a = carried(parent.a);
    motion.a += cross(motion.v, joint);
    motion.a += joint_twist(body, a);
  }
  motion.v += joint;
  return motion;
}

/// The same along the world's axes; the acceleration is the classical one of the origin.
template <bool kAccelerated, class B, class T>
PointMotion<T> aligned_motion(const B& body, const JointPose<T>& pose,
                              const BodyPlacement<T>& parent_at, const BodyPlacement<T>& at,
                              const PointMotion<T>& parent, const T* v, const T* a) {
  const auto in_world = [&](const Twist<T>& x) {
    return Twist<T>{turned(at.row, x.linear), turned(at.row, x.angular)};
  };
  const Vector3<T>& w = parent.v.angular;
  const Vector3<T> arm = turned(parent_at.row, pose.p);
  const Vector3<T> swing = cross(w, arm);
  const Twist<T> joint = in_world(joint_twist(body, v));
  PointMotion<T> motion = parent;
  motion.v.linear += swing + joint.linear;
  motion.v.angular += joint.angular;
  if constexpr (kAccelerated) {
    const Twist<T> gain = in_world(joint_twist(body, a));
    motion.a.linear += cross(parent.a.angular, arm) + cross(w, swing + joint.linear) +
                       cross(motion.v.angular, joint.linear) + gain.linear;
    motion.a.angular += cross(w, joint.angular) + gain.angular;
  }
  return motion;
}

/// Moves the classical motion of a point to one that is `arm` further on the same body.
template <class T>
PointMotion<T> at_arm(PointMotion<T> motion, const Vector3<T>& arm) {
  const Vector3<T> swing = cross(motion.v.angular, arm);
  motion.v.linear += swing;
  motion.a.linear += cross(motion.a.angular, arm) + cross(motion.v.angular, swing);
  return motion;
}

/// Classical motion of the point x -> spatial motion about the world's origin.
template <class T>
void move_to_origin(const Vector3<T>& x, PointMotion<T>& motion) {
  const Vector3<T> drift = motion.v.linear;
  motion.v.linear = drift - cross(motion.v.angular, x);
  motion.a.linear = motion.a.linear - cross(motion.a.angular, x) - cross(motion.v.angular, drift);
}

/// Classical motion of a frame along the world's axes, inward: that of a point r relative to body
/// after body.  With the joint's (l, o) and their derivatives (al, ao)
///   v += o x r + l,   a += o x v_before + o x v_after + ao x r + al,   likewise angular.
template <bool kAccelerated, class Tree, class F, class T>
PointMotion<T> inward_motion(const Tree& tree, const Poses<T>& pose, const F& frame, Axes axes,
                             const T* v, const T* a) {
  PointMotion<T> motion{zero_twist<T>(), zero_twist<T>()};
  Vector3<T> r = cast<T>(frame.p);
  for (int k = frame.body; k != 0; k = tree.body[k].parent) {
    const auto& body = tree.body[k];
    const Twist<T> joint = joint_twist(body, v);
    const Twist<T> gain = joint_acceleration<kAccelerated>(body, a);
    const Vector3<T>& o = joint.angular;
    const Vector3<T> before = motion.v.linear;
    motion.v.linear += cross(o, r) + joint.linear;
    motion.a.linear +=
        cross(o, before) + cross(o, motion.v.linear) + cross(gain.angular, r) + gain.linear;
    motion.a.angular += cross(o, motion.v.angular) + gain.angular;
    motion.v.angular += o;
    for (Vector3<T>* x :
         {&motion.v.linear, &motion.v.angular, &motion.a.linear, &motion.a.angular, &r})
      *x = up(body, pose[k], *x);
    r += pose[k].p;
  }
  if (axes == Axes::kWorld) move_to_origin(r, motion);
  return motion;
}

/// Whether the joints are so often shared by the frames that their bodies are better done once.
template <class Tree>
bool frames_share_joints(const Tree& tree, const std::vector<int>& frames) {
  std::vector<char> met(tree.body.size(), 0);
  int joints = 0, distinct = 0;
  for (const int f : frames) {
    for (int k = tree.frame[f].body; k != 0; k = tree.body[k].parent) {
      ++joints;
      distinct += met[k] ? 0 : 1;
      met[k] = 1;
    }
  }
  return 2 * joints > 3 * distinct;
}

/// Motion of a frame from that of its body; `local` along the body's axes, otherwise the world's.
template <class F, class T>
PointMotion<T> frame_on_body(const F& frame, const BodyPlacement<T>& at, PointMotion<T> motion,
                             Axes axes) {
  if (axes == Axes::kLocal) {
    const Vector3<T> p = cast<T>(frame.p);
    for (Twist<T>* x : {&motion.v, &motion.a}) {
      Vector3<T> row[3];
      for (int i = 0; i < 3; ++i) row[i] = cast<T>(column(frame.R, i));
      *x = {turned(row, x->linear + cross(x->angular, p)), turned(row, x->angular)};
    }
    return motion;
  }
  const Vector3<T> arm = turned(at.row, cast<T>(frame.p));
  motion = at_arm(motion, arm);
  if (axes == Axes::kWorld) move_to_origin(at.x + arm, motion);
  return motion;
}

/// The recursion of all bodies, in the axes that the frames will need.
template <bool kAccelerated, class Tree, class T>
void move_bodies(const Tree& tree, FrameMotionWorkspace<T>& work, const T* q, const T* v,
                 const T* a, Axes axes) {
  const Placements<T>& at = work.placement;
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "motion");
    const PointMotion<T>& parent = work.motion[body.parent];
    work.motion[k] =
        axes == Axes::kLocal
            ? local_motion<kAccelerated>(body, at.pose[k], parent, v, a)
            : aligned_motion<kAccelerated>(body, at.pose[k], at[body.parent], at[k], parent, v, a);
  }
}

/// Calls use(motion) for each frame in turn.
template <bool kAccelerated, class Tree, class T, class Use>
void for_each_frame_motion(const Tree& tree, FrameMotionWorkspace<T>& work, const T* q, const T* v,
                           const T* a, const std::vector<int>& frames, Axes axes, Use&& use) {
  const bool inward = axes != Axes::kLocal && !frames_share_joints(tree, frames);
  if (inward || axes == Axes::kLocal)
    work.placement.pose.update(tree, q);
  else
    work.placement.update(tree, q);
  if (!inward) move_bodies<kAccelerated>(tree, work, q, v, a, axes);
  for (const int f : frames) {
    const auto& frame = tree.frame[f];
    enter_block(q, frame.name, "frame");
    if (inward)
      use(inward_motion<kAccelerated>(tree, work.placement.pose, frame, axes, v, a));
    else
      use(frame_on_body(frame, work.placement[frame.body], work.motion[frame.body], axes));
  }
}

/// q (nq), v (nv) -> 6 per entry of `frames` (indices into tree.frame): m/s, rad/s.
template <class Tree, class T>
void frame_velocity(const Tree& tree, FrameMotionWorkspace<T>& work, const T* q, const T* v,
                    const std::vector<int>& frames, Axes axes, T* out) {
  for_each_frame_motion<false>(tree, work, q, v, static_cast<const T*>(nullptr), frames, axes,
                               [&](const PointMotion<T>& motion) {
                                 write_twist(motion.v, out);
                                 out += 6;
                               });
}

/// q (nq), v, a (nv) -> 6 per entry of `frames`: m/s^2, rad/s^2.
template <class Tree, class T>
void frame_acceleration(const Tree& tree, FrameMotionWorkspace<T>& work, const T* q, const T* v,
                        const T* a, const std::vector<int>& frames, Axes axes, T* out) {
  for_each_frame_motion<true>(tree, work, q, v, a, frames, axes, [&](const PointMotion<T>& motion) {
    write_twist(motion.a, out);
    out += 6;
  });
}

}  // namespace arboc
