// The kinematic algorithms by name on any scalar, every output one after the other.
#pragma once
#include <numeric>
#include <string>
#include <vector>

#include "algorithms/centroidal.h"
#include "algorithms/com.h"
#include "algorithms/difference.h"
#include "algorithms/energy.h"
#include "algorithms/frame_jacobian.h"
#include "algorithms/frame_motion.h"
#include "algorithms/integrate.h"
#include "algorithms/joint_jacobians.h"
#include "algorithms/regressor.h"

namespace arboc::test {

inline const std::vector<std::string> kFrameFunctions = {"frame_velocity", "frame_acceleration",
                                                         "frame_jacobian", "frame_jacobian_dot"};
inline const std::vector<std::string> kOtherFunctions = {
    "joint_jacobians", "com",
    "com_jacobian",    "centroidal",
    "energy",          "regressor",
    "integrate",       "integrate_derivatives",
    "difference",      "difference_derivatives"};

template <class T>
struct KinematicInputs {
  std::vector<T> q, v, a, q1;
};

template <class T>
std::vector<T> run_frames(const std::string& name, const DynamicTree& tree,
                          const KinematicInputs<T>& in, const std::vector<int>& frames, Axes axes) {
  const T *q = in.q.data(), *v = in.v.data(), *a = in.a.data();
  const bool matrix = name.find("jacobian") != std::string::npos;
  std::vector<T> out(6 * frames.size() * static_cast<size_t>(matrix ? tree.nv : 1));
  FrameMotionWorkspace<T> motion(tree);
  FrameJacobianWorkspace<T> jacobian(tree);
  if (name == "frame_velocity") frame_velocity(tree, motion, q, v, frames, axes, out.data());
  if (name == "frame_acceleration")
    frame_acceleration(tree, motion, q, v, a, frames, axes, out.data());
  if (name == "frame_jacobian") frame_jacobian(tree, jacobian, q, frames, axes, out.data());
  if (name == "frame_jacobian_dot")
    frame_jacobian_dot(tree, jacobian, q, v, frames, axes, out.data());
  return out;
}

/// Sizes of the outputs of one of kOtherFunctions.
inline std::vector<int> output_sizes(const std::string& name, const DynamicTree& tree) {
  const int n = tree.nv;
  if (name == "joint_jacobians") return {6 * n};
  if (name == "com") return {3, 3};
  if (name == "com_jacobian") return {3 * n};
  if (name == "centroidal") return {6, 6 * n, 6};
  if (name == "energy") return {1, 1};
  if (name == "regressor") return {10 * n * tree.nb()};
  if (name == "integrate") return {tree.nq};
  if (name == "difference") return {n};
  return {n * n, n * n};
}

template <class T>
std::vector<T> run_other(const std::string& name, const DynamicTree& tree,
                         const KinematicInputs<T>& in) {
  const T *q = in.q.data(), *v = in.v.data(), *a = in.a.data(), *q1 = in.q1.data();
  const std::vector<int> sizes = output_sizes(name, tree);
  std::vector<T> all(static_cast<size_t>(std::accumulate(sizes.begin(), sizes.end(), 0)));
  T* out = all.data();
  T* second = out + sizes[0];
  ComWorkspace<T> moments(tree);
  if (name == "joint_jacobians") {
    JointJacobiansWorkspace<T> work(tree);
    joint_jacobians(tree, work, q, out);
  }
  if (name == "com") com(tree, moments, q, v, out, second);
  if (name == "com_jacobian") com_jacobian(tree, moments, q, out);
  if (name == "centroidal") {
    CentroidalWorkspace<T> work(tree);
    centroidal(tree, work, q, v, a, out, second, second + sizes[1]);
  }
  if (name == "energy") {
    EnergyWorkspace<T> work(tree);
    energy(tree, work, q, v, out, second);
  }
  if (name == "regressor") {
    RegressorWorkspace<T> work(tree);
    regressor(tree, work, q, v, a, out);
  }
  if (name == "integrate") integrate(tree, q, v, out);
  if (name == "integrate_derivatives") integrate_derivatives(tree, q, v, out, second);
  if (name == "difference") difference(tree, q, q1, out);
  if (name == "difference_derivatives") difference_derivatives(tree, q, q1, out, second);
  return all;
}

}  // namespace arboc::test
