// From a link's own coordinates to those that the public interface asks for.
#pragma once
#include "model/model.h"
#include "reference/joint.h"
#include "reference/spatial6.h"

namespace arboc {

/// Motion vectors of a link at `T`, in its own frame and angular first, become those in `axes`,
/// linear first.  The transpose takes forces back, because power is the same in both.
template <class S>
spatial6::Matrix6<S> to_axes(const PlacementOf<S>& T, Axes axes) {
  using spatial6::Mat3;
  spatial6::Matrix6<S> X;
  X << Mat3<S>::Zero(), T.R, T.R, Mat3<S>::Zero();
  if (axes == Axes::kWorld) X.template topLeftCorner<3, 3>() = spatial6::skew(T.p) * T.R;
  if (axes == Axes::kLocal)
    X << Mat3<S>::Zero(), Mat3<S>::Identity(), Mat3<S>::Identity(), Mat3<S>::Zero();
  return X;
}

}  // namespace arboc
