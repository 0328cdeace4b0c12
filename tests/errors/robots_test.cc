// Robots as the world writes them: all load, with the coordinates that Pinocchio finds.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "frontend/read_model.h"
#include "support/manifest.h"
#include "support/urdf_text.h"

namespace arboc::test {
namespace {

constexpr const char* kShared = ARBOC_SOURCE_DIR "/../shared/";

const std::set<std::string> kFloating = {"anymal_b",        "hyq",    "quadruped",    "romeo_small",
                                         "simple_humanoid", "solo12", "talos_reduced"};

TEST(Robots, LoadWithTheDegreesOfFreedomOfTheOracle) {
  const std::string folder = std::string(kShared) + "urdf";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not here";
  int robots = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".urdf") continue;
    ++robots;
    const std::string name = entry.path().stem().string();
    SCOPED_TRACE(name);
    const Reading reading =
        try_reading([&](Diagnostics& d) { return read_model(entry.path().string(), d); });
    ASSERT_TRUE(reading.model) << reading.messages() << reading.what;
    ModelOptions options;
    options.base = kFloating.contains(name) ? Base::kFloating : Base::kFixed;
    options.mimic = MimicPolicy::kIndependent;
    options.order = JointOrder::kAlphabetical;
    Diagnostics ignored;
    const Model model = configure(*reading.model, options, ignored);
    std::ifstream velocities(kShared + ("oracle/" + name + "/v.csv"));
    std::string line;
    ASSERT_TRUE(std::getline(velocities, line));
    EXPECT_EQ(static_cast<size_t>(coordinates(model).nv), cells_of(line).size());
  }
  EXPECT_EQ(robots, 15);
}

}  // namespace
}  // namespace arboc::test
