// Every algorithm behind one call: inputs by name, dense outputs.  With T = double this is the
// generic engine, with T = Expr what is traced.
//
// C++17 without dependencies, because the benchmark compiles it next to generated code.  Workspaces
// are made when they are first needed and kept.
#pragma once
#include <memory>

#include "algorithms/aba_derivatives.h"
#include "algorithms/centroidal.h"
#include "algorithms/com.h"
#include "algorithms/difference.h"
#include "algorithms/energy.h"
#include "algorithms/fk.h"
#include "algorithms/frame_jacobian.h"
#include "algorithms/frame_motion.h"
#include "algorithms/gravity.h"
#include "algorithms/integrate.h"
#include "algorithms/joint_jacobians.h"
#include "algorithms/minv.h"
#include "algorithms/nle.h"
#include "algorithms/regressor.h"
#include "algorithms/rnea.h"
#include "algorithms/rnea_derivatives.h"
#include "algorithms/statics.h"
#include "algorithms/transforms.h"

/// X(name) for each method of Engine.
#define ARBOC_ENGINE_METHODS(X)                                                           \
  X(fk)                                                                                   \
  X(rnea)                                                                                 \
  X(gravity)                                                                              \
  X(statics)                                                                              \
  X(nle)                                                                                  \
  X(crba)                                                                                 \
  X(minv)                                                                                 \
  X(aba) X(rnea_derivatives) X(aba_derivatives) X(frame_velocity) X(frame_acceleration)   \
      X(frame_jacobian) X(frame_jacobian_dot) X(joint_jacobians) X(transforms) X(com)     \
          X(com_jacobian) X(centroidal) X(energy) X(regressor) X(integrate) X(difference) \
              X(integrate_derivatives) X(difference_derivatives)

namespace arboc {

/// Which frames functions report, and on which external wrenches act: indices into tree.frame.
struct EngineFrames {
  std::vector<int> reported;
  std::vector<int> loaded;
  Axes axes = Axes::kLocal;
  int transform_order = 1;  ///< derivatives that transforms() has
};

template <class Tree, class T>
class Engine {
 public:
  /// Null where the function does not ask.
  struct Inputs {
    const T* q = nullptr;
    const T* v = nullptr;
    const T* a = nullptr;
    const T* tau = nullptr;
    const T* q1 = nullptr;
    const T* f_ext = nullptr;
  };
  /// Outputs in the order of the catalogue, dense and row-major, zeroed by the caller (of symmetric
  /// ones the upper triangle is written); after them the pivots, if the function has any.
  using Outputs = T* const*;

  Engine(const Tree& tree, EngineFrames frames) : tree_(tree), frames_(std::move(frames)) {}

  void fk(const Inputs& in, Outputs out) {
    arboc::fk(tree_, use(fk_), in.q, frames_.reported, out[0]);
  }
  void rnea(const Inputs& in, Outputs out) {
    const FrameLoads<T> loads = this->loads(in);
    arboc::rnea(tree_, use(rnea_), in.q, in.v, in.a, out[0], some(loads));
  }
  void gravity(const Inputs& in, Outputs out) {
    arboc::gravity(tree_, use(gravity_), in.q, out[0]);
  }
  void statics(const Inputs& in, Outputs out) {
    const FrameLoads<T> loads = this->loads(in);
    arboc::statics(tree_, use(statics_), in.q, out[0], some(loads));
  }
  void nle(const Inputs& in, Outputs out) {
    const FrameLoads<T> loads = this->loads(in);
    arboc::nle(tree_, use(rnea_), in.q, in.v, out[0], some(loads));
  }
  void crba(const Inputs& in, Outputs out) { arboc::crba(tree_, use(crba_), in.q, upper(out[0])); }
  void minv(const Inputs& in, Outputs out) {
    auto& work = use(minv_);
    arboc::minv(tree_, work, in.q, upper(out[0]));
    for (int k = 0; k < tree_.nv; ++k) out[1][k] = work.M[k * tree_.nv + k];
  }
  void aba(const Inputs& in, Outputs out) {
    const FrameLoads<T> loads = this->loads(in);
    arboc::aba(tree_, use(aba_), in.q, in.v, in.tau, out[0], out[1], some(loads));
  }
  void rnea_derivatives(const Inputs& in, Outputs out) {
    const FrameLoads<T> loads = this->loads(in);
    arboc::rnea_derivatives(tree_, use(rnea_derivatives_), in.q, in.v, in.a, square(out[0]),
                            square(out[1]), upper(out[2]), some(loads));
  }
  void aba_derivatives(const Inputs& in, Outputs out) {
    const FrameLoads<T> loads = this->loads(in);
    arboc::aba_derivatives(tree_, use(aba_derivatives_), in.q, in.v, in.tau, square(out[0]),
                           square(out[1]), upper(out[2]), out[3], some(loads));
  }

  void frame_velocity(const Inputs& in, Outputs out) {
    arboc::frame_velocity(tree_, use(frame_motion_), in.q, in.v, frames_.reported, frames_.axes,
                          out[0]);
  }
  void frame_acceleration(const Inputs& in, Outputs out) {
    arboc::frame_acceleration(tree_, use(frame_motion_), in.q, in.v, in.a, frames_.reported,
                              frames_.axes, out[0]);
  }
  void frame_jacobian(const Inputs& in, Outputs out) {
    arboc::frame_jacobian(tree_, use(frame_jacobian_), in.q, frames_.reported, frames_.axes,
                          out[0]);
  }
  void frame_jacobian_dot(const Inputs& in, Outputs out) {
    arboc::frame_jacobian_dot(tree_, use(frame_jacobian_), in.q, in.v, frames_.reported,
                              frames_.axes, out[0]);
  }
  void joint_jacobians(const Inputs& in, Outputs out) {
    arboc::joint_jacobians(tree_, use(joint_jacobians_), in.q, out[0]);
  }
  void transforms(const Inputs& in, Outputs out) {
    arboc::transforms(tree_, use(transforms_), in.q, frames_.reported, frames_.transform_order,
                      out);
  }
  void com(const Inputs& in, Outputs out) {
    arboc::com(tree_, use(com_), in.q, in.v, out[0], out[1]);
  }
  void com_jacobian(const Inputs& in, Outputs out) {
    arboc::com_jacobian(tree_, use(com_), in.q, out[0]);
  }
  void centroidal(const Inputs& in, Outputs out) {
    arboc::centroidal(tree_, use(centroidal_), in.q, in.v, in.a, out[0], out[1], out[2]);
  }
  void energy(const Inputs& in, Outputs out) {
    arboc::energy(tree_, use(energy_), in.q, in.v, out[0], out[1]);
  }
  void regressor(const Inputs& in, Outputs out) {
    arboc::regressor(tree_, use(regressor_), in.q, in.v, in.a, out[0]);
  }
  void integrate(const Inputs& in, Outputs out) { arboc::integrate(tree_, in.q, in.v, out[0]); }
  void difference(const Inputs& in, Outputs out) { arboc::difference(tree_, in.q, in.q1, out[0]); }
  void integrate_derivatives(const Inputs& in, Outputs out) {
    arboc::integrate_derivatives(tree_, in.q, in.v, out[0], out[1]);
  }
  void difference_derivatives(const Inputs& in, Outputs out) {
    arboc::difference_derivatives(tree_, in.q, in.q1, out[0], out[1]);
  }

 private:
  template <class Workspace>
  Workspace& use(std::unique_ptr<Workspace>& work) {
    if (!work) work = std::make_unique<Workspace>(tree_);
    return *work;
  }
  FrameLoads<T> loads(const Inputs& in) const { return {&frames_.loaded, frames_.axes, in.f_ext}; }
  const FrameLoads<T>* some(const FrameLoads<T>& loads) const {
    return frames_.loaded.empty() ? nullptr : &loads;
  }
  UpperTriangle<T> upper(T* data) const { return {data, tree_.nv}; }
  SquareMatrix<T> square(T* data) const { return {data, tree_.nv}; }

  const Tree& tree_;
  EngineFrames frames_;
  std::unique_ptr<FkWorkspace<T>> fk_;
  std::unique_ptr<RneaWorkspace<T>> rnea_;
  std::unique_ptr<GravityWorkspace<T>> gravity_;
  std::unique_ptr<StaticsWorkspace<T>> statics_;
  std::unique_ptr<CrbaWorkspace<T>> crba_;
  std::unique_ptr<MinvWorkspace<T>> minv_;
  std::unique_ptr<AbaWorkspace<T>> aba_;
  std::unique_ptr<RneaDerivativesWorkspace<T>> rnea_derivatives_;
  std::unique_ptr<AbaDerivativesWorkspace<T>> aba_derivatives_;
  std::unique_ptr<FrameMotionWorkspace<T>> frame_motion_;
  std::unique_ptr<FrameJacobianWorkspace<T>> frame_jacobian_;
  std::unique_ptr<JointJacobiansWorkspace<T>> joint_jacobians_;
  std::unique_ptr<TransformsWorkspace<T>> transforms_;
  std::unique_ptr<ComWorkspace<T>> com_;
  std::unique_ptr<CentroidalWorkspace<T>> centroidal_;
  std::unique_ptr<EnergyWorkspace<T>> energy_;
  std::unique_ptr<RegressorWorkspace<T>> regressor_;
};

}  // namespace arboc
