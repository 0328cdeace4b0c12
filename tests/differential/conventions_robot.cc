#include "differential/conventions_robot.h"

#include <gtest/gtest.h>

#include <sstream>

#include "support/run_program.h"

namespace arboc::test {

const std::string kCube = "--base floating --tip base ";

std::string own(const std::string& name) {
  return ARBOC_SOURCE_DIR "/models/" + name + "/" + name + ".urdf";
}

std::vector<double> eval(const std::string& model, const std::string& options,
                         const Inputs& inputs) {
  const TempDir folder;
  std::vector<std::string> command{"eval", model, "--engine", "generic"};
  std::istringstream words(options);
  for (std::string word; words >> word;) command.push_back(word);
  for (const auto& [name, values] : inputs) {
    const std::string path = folder / (name + ".csv");
    write_text(path, csv_text({values}));
    command.insert(command.end(), {"--" + name, path});
  }
  const Outcome outcome = run_arboc(command);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto rows = numbers(outcome.out);
  return rows.size() == 1 ? rows[0] : std::vector<double>();
}

Eigen::MatrixXd eval_matrix(const std::string& model, const std::string& options,
                            const Inputs& inputs, int cols) {
  const std::vector<double> values = eval(model, options, inputs);
  using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const ByRows>(values.data(), static_cast<Eigen::Index>(values.size()) / cols,
                                  cols);
}

OneJoint::OneJoint(const std::string& type, const std::string& inside) {
  write_text(path(), R"(<robot name="robot"><link name="base"/><joint name="joint" type=")" + type +
                         R"("><parent link="base"/><child link="body"/>)" + inside +
                         R"(<limit lower="-9" upper="9" effort="9" velocity="9"/></joint>
<link name="body"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>)");
}

OneJoint::Pose OneJoint::pose(const std::vector<double>& q) const {
  const Eigen::MatrixXd numbers = eval_matrix(path(), "--function fk", {{"q", q}}, 3);
  if (numbers.rows() != 4) return {};
  return {numbers.topRows(3), numbers.row(3).transpose()};
}

}  // namespace arboc::test
