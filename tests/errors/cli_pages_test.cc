// Pages on the command line: what is no motion and what cannot be written.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/run_program.h"

namespace arboc::test {
namespace {

const std::string kPendulum = ARBOC_SOURCE_DIR "/models/double_pendulum/double_pendulum.urdf";

TEST(CliPages, WhatIsNoMotionExitsWith2) {
  const TempDir folder;
  const struct {
    const char* text;
    const char* said;
  } cases[] = {{"", "not JSON"},
               {"{\"format\": ", "not JSON"},
               {"[1, 2]", "no motion"},
               {"3", "no motion"},
               {"{}", "no motion"},
               {"{\"format\": 1, \"title\": {}}", "no motion"},
               {"{\"format\": \"arboc-motion/2\"}", "no motion"}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.text);
    write_text(folder / "motion.json", c.text);
    const Outcome outcome = run_arboc({"animate", folder / "motion.json", "-o", folder / "page"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(std::string("motion.json: error: ") + c.said), std::string::npos)
        << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "page"));
  }
  EXPECT_EQ(run_arboc({"animate", folder / "nothing", "-o", folder / "page"}).status, 2);
  EXPECT_EQ(run_arboc({"animate", folder.path(), "-o", folder / "page"}).status, 2);
  EXPECT_EQ(run_arboc({"animate", "/dev/zero", "-o", folder / "page"}).status, 2);
  EXPECT_EQ(run_arboc({"animate", folder / "motion.json"}).status, 1);
}

TEST(CliPages, WhatCannotBeWrittenExitsWith3) {
  const TempDir folder;
  write_text(folder / "motion.json", "{\"format\": \"arboc-motion/1\", \"title\": []}");
  const std::string nowhere = folder / "no/page.html";
  EXPECT_EQ(run_arboc({"animate", folder / "motion.json", "-o", nowhere}).status, 3);
  EXPECT_EQ(run_arboc({"inspect", kPendulum, "--html", nowhere}).status, 3);
  EXPECT_EQ(run_arboc({"animate", folder / "motion.json", "-o", folder / "page"}).status, 0);
  EXPECT_NE(read_text(folder / "page").find("<title>motion</title>"), std::string::npos);
}

TEST(CliPages, AReportNeedsWhatMoves) {
  const TempDir folder;
  write_text(folder / "rock.urdf", "<robot name=\"rock\"><link name=\"rock\"/></robot>");
  const Outcome rock = run_arboc({"inspect", folder / "rock.urdf", "--html", folder / "page"});
  EXPECT_EQ(rock.status, 2);
  EXPECT_NE(rock.err.find("no joint moves"), std::string::npos) << rock.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "page"));
}

}  // namespace
}  // namespace arboc::test
