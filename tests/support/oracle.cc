#include "support/oracle.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "base/number.h"

namespace arboc::test {
namespace {

const std::string kShared = ARBOC_SOURCE_DIR "/../shared/";

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) result.push_back(field);
  return result;
}

}  // namespace

const std::vector<OracleRobot>& oracle_robots() {
  static const std::vector<OracleRobot> kRobots = {{"allegro_left_hand", Base::kFixed},
                                                   {"anymal_b", Base::kFloating},
                                                   {"baxter", Base::kFixed},
                                                   {"double_pendulum", Base::kFixed},
                                                   {"hyq", Base::kFloating},
                                                   {"kinova", Base::kFixed},
                                                   {"panda", Base::kFixed},
                                                   {"quadruped", Base::kFloating},
                                                   {"romeo_small", Base::kFloating},
                                                   {"simple_humanoid", Base::kFloating},
                                                   {"solo12", Base::kFloating},
                                                   {"talos_reduced", Base::kFloating},
                                                   {"tiago_no_hand", Base::kFixed},
                                                   {"ur5", Base::kFixed},
                                                   {"z1", Base::kFixed}};
  return kRobots;
}

std::string oracle_urdf(const OracleRobot& robot) {
  return kShared + "urdf/" + robot.name + ".urdf";
}

Eigen::MatrixXd oracle(const OracleRobot& robot, const std::string& quantity) {
  const std::string path = kShared + "oracle/" + robot.name + "/" + quantity + ".csv";
  std::ifstream file(path);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) rows.push_back(fields(line));
  if (rows.empty()) return {};
  Eigen::MatrixXd result(rows.size(), rows[0].size());
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != rows[0].size()) throw std::runtime_error(path + ": ragged rows");
    for (size_t j = 0; j < rows[i].size(); ++j) {
      const auto value = parse_finite(rows[i][j]);
      if (!value) throw std::runtime_error(path + ": not a number: " + rows[i][j]);
      result(i, j) = *value;
    }
  }
  return result;
}

std::vector<std::string> oracle_joints(const OracleRobot& robot) {
  std::ifstream file(kShared + "oracle/" + robot.name + "/joints.csv");
  std::vector<std::string> result;
  std::string line;
  std::getline(file, line);
  std::getline(file, line);
  while (std::getline(file, line)) result.push_back(fields(line).at(1));
  return result;
}

}  // namespace arboc::test
