// Robots for the checks of docs/conventions.md: of models/, and of one joint; `arboc eval` on them.
#pragma once
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "support/temp_dir.h"

namespace arboc::test {

using Inputs = std::map<std::string, std::vector<double>>;

/// What `arboc eval` prints for one state.  `options` are words between blanks.
std::vector<double> eval(const std::string& model, const std::string& options,
                         const Inputs& inputs = {});
/// The same as a matrix by rows.
Eigen::MatrixXd eval_matrix(const std::string& model, const std::string& options,
                            const Inputs& inputs, int cols);

std::string own(const std::string& name);  ///< path of models/NAME/NAME.urdf
extern const std::string kCube;            ///< options that make a free cube of the double pendulum

/// Link `body` of 1 kg on a base, by a joint of a type with what is written inside of it.
class OneJoint {
 public:
  OneJoint(const std::string& type, const std::string& inside);
  std::string path() const { return folder_ / "robot.urdf"; }

  struct Pose {
    Eigen::Matrix3d R;
    Eigen::Vector3d p;
  };
  /// Of the body in the world.
  Pose pose(const std::vector<double>& q) const;

 private:
  TempDir folder_;
};

}  // namespace arboc::test
