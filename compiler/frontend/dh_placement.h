// Placements and masses of a DH file, in terms of its lengths, as those of a Model.
#pragma once
#include <vector>

#include "frontend/dh_file.h"

namespace arboc {

/// A placement whose translation may be written in terms of lengths.
struct DhPlacement {
  DhLinear x{}, y{}, z{};
  Vector3<double> rpy{};
  Matrix3<double> turn = Matrix3<double>::identity();

  bool is_identity() const;
};

Pose pose_of(const DhPlacement& placement, const std::vector<NamedLength>& lengths);

/// About the centre of mass, whatever point the file gives the inertia about.
Inertial inertial_of(const DhMass& mass, const std::vector<NamedLength>& lengths);

}  // namespace arboc
