// What Pinocchio computes for fifteen public robots, recorded as text beside the checkout.
//
// The record is not part of the project; tests that use it are skipped where it is absent.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/model.h"

namespace arboc::test {

struct OracleRobot {
  const char* name;
  Base base;
};

/// The fifteen, by name.
const std::vector<OracleRobot>& oracle_robots();

/// Path of the robot's URDF, whether it exists or not.
std::string oracle_urdf(const OracleRobot& robot);

/// `<robot>/<quantity>.csv`: one row a state, matrices row-major; no rows if it is absent.
/// q has cos and sin of continuous joints, qflat their angle.
Eigen::MatrixXd oracle(const OracleRobot& robot, const std::string& quantity);

/// Names of the moving joints, in the order of v (the root's floating joint is "root_joint").
std::vector<std::string> oracle_joints(const OracleRobot& robot);

}  // namespace arboc::test
