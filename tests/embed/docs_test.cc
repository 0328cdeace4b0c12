// The examples of docs/embedding.md, which are copied out of the page.
//
// In a section (##) a block after a line that names a file in backquotes and ends in a colon is
// that file; a ```sh block is run in a folder with these files and the models of models/; a ```text
// block is what it prints.
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "support/page.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;

struct Section {
  std::map<std::string, std::string> files;
  std::string script;
  std::vector<std::string> output;  ///< lines
};

std::string read_block(std::istream& page) {
  std::string text;
  for (std::string line; std::getline(page, line) && line != "```";) text += line + "\n";
  return text;
}

std::map<std::string, Section> sections() {
  std::ifstream page(ARBOC_SOURCE_DIR "/docs/embedding.md");
  std::map<std::string, Section> all;
  std::string title, file;
  for (std::string line; std::getline(page, line);) {
    Section& section = all[title];
    if (line.starts_with("## ")) {
      title = line.substr(3);
    } else if (line.starts_with("`") && line.ends_with("`:")) {
      file = line.substr(1, line.size() - 3);
      continue;
    } else if (line == "```sh") {
      section.script += read_block(page);
    } else if (line == "```text") {
      std::istringstream lines(read_block(page));
      for (std::string text; std::getline(lines, text);) section.output.push_back(text);
    } else if (line.starts_with("```")) {
      const std::string text = read_block(page);
      if (!file.empty()) section.files[file] = text;
    }
    file.clear();
  }
  return all;
}

/// Runs a section with what is installed in `prefix`.
Outcome run_section(const Section& section, const std::string& folder, const std::string& prefix) {
  for (const char* model : {"ur5", "quadruped"})
    fs::copy_file(ARBOC_SOURCE_DIR "/models/" + std::string(model) + "/" + model + ".urdf",
                  folder + "/" + model + ".urdf");
  for (const auto& [name, text] : section.files) write_text(folder + "/" + name, text);
  RunOptions options;
  options.folder = folder;
  const char* path = std::getenv("PATH");
  const std::string bin = folder + "/bin";  // python3: the one that has numpy
  fs::create_directory(bin);
  if (*ARBOC_PYTHON) fs::create_symlink(ARBOC_PYTHON, bin + "/python3");
  options.environment = {{"PATH", bin + ":" + prefix + "/bin:" + (path ? path : "/usr/bin:/bin")},
                         {"CMAKE_PREFIX_PATH", prefix},
                         {"CMAKE_BUILD_TYPE", "Release"},
                         {"CMAKE_GENERATOR", "Ninja"},
                         {"PYTHONPATH", prefix + "/lib/python3/dist-packages"},
                         {"ARBOC_CACHE", folder + "/cache"}};
  return run_program({"bash", "-e", "-c", section.script}, options);
}

std::string single_word(const std::string& title) {
  std::string word;
  for (const char c : title)
    if (std::isalnum(static_cast<unsigned char>(c))) word += c;
  return word;
}

class EmbeddingPage : public testing::TestWithParam<const char*> {};

TEST_P(EmbeddingPage, DoesWhatItSays) {
  const auto all = sections();
  ASSERT_TRUE(all.contains(GetParam())) << "no such section";
  const Section& section = all.at(GetParam());
  if (std::string(GetParam()) == "Python" && !*ARBOC_PYTHON)
    GTEST_SKIP() << "no python3 with numpy";
  ASSERT_FALSE(section.script.empty() || section.output.empty());
  const TempDir prefix, folder;
  const Outcome installed =
      run_program({ARBOC_CMAKE, "--install", ARBOC_BINARY_DIR, "--prefix", prefix.path()});
  ASSERT_EQ(installed.status, 0) << installed.err;
  const Outcome outcome = run_section(section, folder.path(), prefix.path());
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  // What the page shows are the last lines: builds print more before.
  std::vector<std::string> lines;
  std::istringstream printed(outcome.out);
  for (std::string line; std::getline(printed, line);) lines.push_back(line);
  ASSERT_GE(lines.size(), section.output.size());
  for (size_t k = 0; k < section.output.size(); ++k) {
    const std::string& line = lines[lines.size() - section.output.size() + k];
    EXPECT_TRUE(prints_as(section.output[k], line)) << section.output[k] << "\n" << line;
  }
}

INSTANTIATE_TEST_SUITE_P(Sections, EmbeddingPage, testing::Values("CMake", "C and CasADi", "Python"),
                         [](const auto& c) { return single_word(c.param); });

}  // namespace
}  // namespace arboc::test
