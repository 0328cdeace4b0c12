// Task files over others, exit statuses and files of programs.
#include <gtest/gtest.h>

#include <fstream>

#include "common/program.h"
#include "common/task_file.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

TEST(TaskFile, OneOverAnother) {
  const TempDir folder;
  const std::string at = std::string(folder.path()) + "/";
  write(at + "under.toml",
        "a = 1\nlist = [1, 2]\n[t]\nx = 1\ny = 2\n[[step]]\nname = \"one\"\nk = 1\n");
  write(at + "over.toml",
        "base = \"under.toml\"\nlist = [3]\n[t]\ny = 5\n[[step]]\nname = \"one\"\nk = 7\n"
        "[[step]]\nname = \"two\"\n");
  const toml::table all = study::read_document(at + "over.toml");
  study::Table table(all, "task");
  EXPECT_EQ(table.number("a", 0), 1);
  EXPECT_EQ(table.table("t")->number("x", 0), 1);
  EXPECT_EQ(table.table("t")->number("y", 0), 5);
  const auto steps = table.tables("step");
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(const_cast<study::Table&>(steps[0]).whole("k", 0, 0), 7);
  EXPECT_EQ(all["list"].as_array()->size(), 1U);
  write(at + "circle.toml", "base = \"circle.toml\"\n");
  EXPECT_THROW(study::read_document(at + "circle.toml"), study::TaskError);
}

TEST(TaskFile, ComplaintsSayWhere) {
  const TempDir folder;
  const std::string path = std::string(folder.path()) + "/task.toml";
  write(path, "a = 1\nb = \"x\"\n");
  const toml::table all = study::read_document(path);
  study::Table table(all, "task");
  table.number("a", 0);
  try {
    table.finish();
    FAIL();
  } catch (const study::TaskError& e) {
    EXPECT_EQ(e.what(), path + ":2:1: error: task: there is no key 'b'");
  }
  EXPECT_THROW(table.number("b", 0), study::TaskError);
}

TEST(Program, StatusesAndFiles) {
  EXPECT_EQ(study::exit_status([] { return 5; }), 5);
  EXPECT_EQ(study::exit_status([]() -> int { throw study::TaskError("t"); }), 2);
  EXPECT_EQ(study::exit_status([]() -> int { throw std::invalid_argument("i"); }), 2);
  EXPECT_EQ(study::exit_status([]() -> int { throw study::WriteError("w"); }), 3);
  EXPECT_EQ(study::exit_status([]() -> int { throw std::domain_error("d"); }), 5);
  EXPECT_EQ(study::exit_status([]() -> int { throw std::logic_error("l"); }), 4);
  const TempDir folder;
  study::write_files(std::string(folder.path()) + "/a/b", {{"x.txt", "hello"}});
  std::ifstream in(std::string(folder.path()) + "/a/b/x.txt");
  std::string text;
  in >> text;
  EXPECT_EQ(text, "hello");
  // Where one cannot be written the others stay as they are.
  const std::string b = std::string(folder.path()) + "/a/b";
  EXPECT_THROW(study::write_files(b, {{"x.txt", "new"}, {"no/y.txt", ""}}), study::WriteError);
  EXPECT_EQ(read_text(b + "/x.txt"), "hello");
  EXPECT_FALSE(std::filesystem::exists(b + "/x.txt.part"));
  EXPECT_THROW(study::write_files("/proc/none", {{"x", ""}}), study::WriteError);
}

}  // namespace
}  // namespace arboc::test
