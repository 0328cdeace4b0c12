// arboc bench --peers: who takes part, and what is said of those who do not.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace arboc::test {
namespace {

const std::string kUr5 = ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf";

std::string first_line(const std::vector<std::string>& command) {
  const Outcome outcome = run_arboc(command);
  EXPECT_EQ(outcome.status, 1);
  return outcome.err.substr(0, outcome.err.find('\n'));
}

TEST(CliPeers, WhatCannotBeComparedIsRefused) {
  EXPECT_EQ(first_line({"bench", kUr5, "--peers", "kdl,mujocco"}),
            "arboc: error: --peers: there is no peer 'mujocco' (did you mean 'mujoco'?)");
  const std::string all_joints = ARBOC_SOURCE_DIR "/models/all_joints/all_joints.urdf";
  EXPECT_EQ(first_line({"bench", all_joints, "--peers"}),
            "arboc: error: --peers: no peer knows mimic joints; --mimic independent frees them");
  EXPECT_EQ(first_line({"bench", kUr5, "--peers", "--external-forces", "flange"}),
            "arboc: error: --peers: not with --external-forces, --joint-forces or --parameters");
}

TEST(CliPeers, AgreeAndAreTimed) {
  const Outcome bench = run_arboc({"bench", kUr5, "--functions", "rnea,crba", "--peers",
                                   "kdl,pinocchio", "--json", "--cxxflags", "-std=c++17 -O1"});
  EXPECT_EQ(bench.status, 0) << bench.err;
  EXPECT_NE(bench.err.find("note: without Pinocchio: name a checkout with --pinocchio DIR"),
            std::string::npos)
      << bench.err;
  const auto functions = nlohmann::json::parse(bench.out, nullptr, false);
  ASSERT_EQ(functions.size(), 2u) << bench.out;
  const bool installed = std::filesystem::exists("/usr/include/kdl/tree.hpp");
  for (const auto& f : functions) {
    const auto& by = f.at("by");
    ASSERT_EQ(by.size(), installed ? 3u : 2u) << bench.out;
    EXPECT_EQ(by[0].at("name"), "generated");
    EXPECT_EQ(by[1].at("name"), "generic");
    for (const auto& row : by) {
      EXPECT_GT(row.at("ns").get<double>(), 1);
      EXPECT_LT(row.at("difference").get<double>(), 1e-12);
    }
    if (installed) EXPECT_EQ(by[2].at("name"), "KDL");
  }
}

}  // namespace
}  // namespace arboc::test
