// What is said of task files that cannot be right.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "predict.h"
#include "support/temp_dir.h"

namespace arboc::test {
namespace {

std::string complaint(const std::string& text) {
  const TempDir folder;
  const std::string path = (std::filesystem::path(folder.path()) / "task.toml").string();
  std::ofstream(path) << text;
  try {
    const posture::Task t = posture::read_task(path);
    posture::build(t, posture::model(t.model), {});
  } catch (const std::exception& e) {
    const std::string what = e.what();
    return what.rfind(path, 0) == 0 ? what.substr(path.size()) : what;
  }
  return "";
}

TEST(PostureTask, SaysWhatIsWrongAndWhere) {
  const struct {
    const char *text, *message;
  } cases[] = {
      {"", ":1:1: error: task: model is missing"},
      {"model = 1", ":1:9: error: task: model is not a text"},
      {"model = \"santos\"\nmodle = 2", ":2:1: error: task: there is no key 'modle'"},
      {"model = \"santos\"\n[objective]\ntorque = -1",
       ":2:1: error: objective: torque is not a weight"},
      {"model = \"santos\"\n[[contact]]\nname = \"a\"",
       ":2:1: error: contact 'a': frame is missing"},
      {"model = \"santos\"\n[[contact]]\nname = \"a\"\nframe = \"r_hand\"\nforce = [[2, 1], 0, 0]",
       ":5:10: error: contact 'a': force: the lower limit is above the upper"},
      {"model = \"santos\"\n[[target]]\nname = \"a\"\nframe = \"hip\"\nposition = [0, 0]",
       ":5:12: error: target 'a': position is not a list of three numbers"},
      {"model = \"santos\"\n[search]\nstarts = 0",
       ":3:10: error: search: starts is not a whole number of at least 1"},
      {"model = \"santos\"\nbase = \"none.toml\"", nullptr},
      {"model = \"hal\"",
       "there is no model 'hal'; those in this program are humanoid, nine_dof, "
       "santos (apps/posture/CMakeLists.txt and models.cc add others)"},
      {"model = \"nine_dof\"\n[relaxed]\nq9 = 1",
       "coordinate 'q9' is not among those generated: x, y, q2, q3, q4, q5, q6, q7, q8"},
      {"model = \"nine_dof\"\n[[contact]]\nname = \"a\"\nframe = \"foot\"\nposition = [0, 0, 0]",
       nullptr},
  };
  for (const auto& c : cases) {
    const std::string said = complaint(c.text);
    EXPECT_NE(said, "") << c.text;
    if (c.message) {
      EXPECT_EQ(said, c.message);
    }
  }
}

TEST(PostureTask, AFrameThatWasNotGeneratedNamesTheOptionThatAddsIt) {
  const std::string said = complaint(
      "model = \"nine_dof\"\n[[contact]]\nname = \"a\"\nframe = \"foot\"\nposition = [0, 0, 0]");
  EXPECT_NE(said.find("add it to `arboc compile ... --frames` of nine_dof"), std::string::npos)
      << said;
  const std::string load = complaint(
      "model = \"nine_dof\"\n[[load]]\nname = \"a\"\nframe = \"trunk\"\nforce = [0, 0, 0]");
  EXPECT_NE(load.find("`arboc compile ... --external-forces` of nine_dof"), std::string::npos)
      << load;
}

TEST(PostureTask, ATaskSaysOnlyWhatDiffersFromItsBase) {
  const posture::Task t =
      posture::read_task(ARBOC_SOURCE_DIR "/apps/posture/tasks/santos_friction.toml");
  ASSERT_EQ(t.contacts.size(), 4U);
  EXPECT_EQ(t.contacts[2].friction, 0.1);
  EXPECT_EQ(t.contacts[2].frame, "r_ball");  // of the base's base
  EXPECT_EQ(t.contacts[0].friction, nlp::kInfinity);
  EXPECT_EQ(t.objective.normalised, 1);  // of its base
}

}  // namespace
}  // namespace arboc::test
