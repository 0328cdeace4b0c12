// Names as hostile as a model may have them: emitted code compiles without a warning, and the
// manifest gives the names back.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "emit/names.h"
#include "functions/catalogue.h"
#include "support/random.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLinks = 40;  // of a model; two names each

const std::vector<std::string> kPieces = {"a",
                                          "_",
                                          "__",
                                          "A",
                                          "0",
                                          "9",
                                          " ",
                                          "-",
                                          ".",
                                          "/",
                                          "\\",
                                          "\"",
                                          "'",
                                          "`",
                                          "?",
                                          "?\?/",
                                          "?\?)",
                                          "*/",
                                          "/*",
                                          "//",
                                          "\\\\",
                                          "\\n",
                                          "\\x41",
                                          "\\u0041",
                                          "%s",
                                          "%n",
                                          "{}",
                                          "{0}",
                                          "@",
                                          "@name@",
                                          "$",
                                          "${x}",
                                          "$(x)",
                                          "#",
                                          "#include",
                                          "R\"(",
                                          ")\"",
                                          "\")",
                                          ";",
                                          "}",
                                          "{",
                                          "<",
                                          ">",
                                          "&",
                                          "|",
                                          "~",
                                          "^",
                                          "!",
                                          "\xC3\xA9",
                                          "\xE6\x9C\xBA",
                                          "\xF0\x9F\xA4\x96",
                                          "\xE2\x80\xAE",
                                          "\xE2\x80\xA8",
                                          "\xCD\x8F",
                                          "int",
                                          "class",
                                          "register",
                                          "restrict",
                                          "T",
                                          "q",
                                          "w",
                                          "x1",
                                          "NULL",
                                          "EOF",
                                          "errno",
                                          "assert",
                                          "std",
                                          "arboc",
                                          "Eigen",
                                          "raw",
                                          "main",
                                          "nan",
                                          "I",
                                          "M_PI",
                                          "linux",
                                          "unix",
                                          "__FILE__",
                                          "_Pragma(\"x\")",
                                          "defined",
                                          "module",
                                          "import",
                                          "co_await",
                                          "and",
                                          "not",
                                          "operator",
                                          "CON",
                                          "NUL",
                                          "aux",
                                          "..",
                                          "../..",
                                          "-o",
                                          "--",
                                          "=",
                                          ",",
                                          "(",
                                          ")",
                                          "[",
                                          "]",
                                          "\xC2\xA0",
                                          "\xEF\xBB\xBF"};

std::string random_name(Random& random, int k) {
  std::string name;
  for (int n = 1 + random.integer(6); n > 0; --n)
    name += kPieces[static_cast<size_t>(random.integer(static_cast<int>(kPieces.size())))];
  if (random.chance(0.02)) name += std::string(static_cast<size_t>(random.integer(900)), 'n');
  return name + std::to_string(k);  // two links may not share a name
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '\'' ? "&#39;" : std::string(1, c);
  return out;
}

struct Named {
  std::string text;                        ///< URDF
  std::vector<std::string> links, joints;  ///< in order
};

Named chain(Random& random, const std::string& robot) {
  Named model;
  model.text = "<robot name='" + escaped(robot) + "'>";
  for (int k = 0; k <= kLinks; ++k) {
    model.links.push_back(random_name(random, k));
    model.text += "<link name='" + escaped(model.links.back()) +
                  "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
                  "izz='1'/></inertial></link>\n";
    if (k == 0) continue;
    model.joints.push_back(random_name(random, k));
    model.text += "<joint name='" + escaped(model.joints.back()) +
                  "' type='prismatic'><parent link='" +
                  escaped(model.links[model.links.size() - 2]) + "'/><child link='" +
                  escaped(model.links.back()) +
                  "'/><axis xyz='0 0 1'/><limit lower='0' upper='1' effort='1' velocity='1'/>"
                  "</joint>\n";
  }
  model.text += "</robot>\n";
  return model;
}

/// Every source of the folder, by both compilers.
void expect_clean(const std::string& folder) {
  for (const char* compiler : {"g++", "clang++"}) {
    if (run_program({compiler, "--version"}).status != 0) continue;
    RunOptions options;
    options.folder = folder;
    const Outcome outcome = run_program(
        {"sh", "-c",
         std::string("for f in */*.cpp; do ") + compiler +
             " -std=c++17 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I. -isystem " ARBOC_EIGEN
             " \"$f\" || exit 1; done"},
        options);
    EXPECT_EQ(outcome.status, 0) << compiler << "\n" << outcome.err.substr(0, 3000);
  }
}

TEST(EmittedNames, AnyNamesOfLinksJointsAndRobots) {
  int names = 0;
  for (const std::uint64_t seed : seeds(6)) {  // 120 in a full run: 10 000 names
    Random random(seed);
    const TempDir folder;
    const std::string robot = random_name(random, 0);
    const Named model = chain(random, robot);
    write_text(folder / "model.urdf", model.text);
    const Outcome outcome = run_arboc({"compile", folder / "model.urdf", "-o", folder / "out",
                                       "--functions", "gravity,fk", "--parameters", "masses"});
    ASSERT_EQ(outcome.status, 0) << "ARBOC_SEED=" << seed << "\n" << outcome.err;
    const std::string name = identifier(robot), product = folder / "out/" + name;
    const auto manifest = nlohmann::json::parse(read_text(product + "/manifest.json"));
    EXPECT_EQ(manifest["name"], name);
    ASSERT_EQ(manifest["joints"].size(), model.joints.size());
    ASSERT_EQ(manifest["frames"].size(), model.joints.size());
    for (size_t k = 0; k < model.joints.size(); ++k) {
      EXPECT_EQ(manifest["joints"][k]["name"], model.joints[k]);
      EXPECT_EQ(manifest["frames"][k], model.links[k + 1]);
    }
    std::set<std::string> lower_case;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "out")) {
      std::string path = fs::relative(entry.path(), folder / "out").string();
      EXPECT_TRUE(std::regex_match(path, std::regex("[A-Za-z0-9_/]+(\\.[a-zA-Z]+)?"))) << path;
      for (char& c : path) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      EXPECT_TRUE(lower_case.insert(path).second) << path;
    }
    expect_clean(folder / "out");
    names += 1 + static_cast<int>(model.links.size() + model.joints.size());
  }
  RecordProperty("names", names);
}

/// Whatever the standard headers, Eigen and emitted code itself declare, define or use as a word is
/// free to be a robot's name: identifier() steps aside where it would collide.
class HeaderWords : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(HeaderWords, AreNamesThatCompile) {
  const auto [compiler, standard] = GetParam();
  if (run_program({compiler, "--version"}).status != 0) GTEST_SKIP() << compiler << " is missing";
  const TempDir folder;
  ASSERT_EQ(run_arboc({"compile", ARBOC_SOURCE_DIR "/models/double_pendulum/double_pendulum.urdf",
                       "-o", folder.path(), "--functions", "all"})
                .status,
            0);
  RunOptions options;
  options.folder = folder.path();
  const std::string includes =
      "#include <math.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n"
      "#include <assert.h>\n#include <errno.h>\n#include <time.h>\n#include <unistd.h>\n"
      "#include <signal.h>\n#include <double_pendulum/double_pendulum.hpp>\n"
      "#include <double_pendulum/double_pendulum_batch.hpp>\n";
  write_text(folder / "includes.cc", includes);
  const std::string flags =
      std::string(" -std=") + standard + " -I. -isystem " ARBOC_EIGEN " includes.cc ";
  const Outcome words = run_program(
      {"sh", "-c", compiler + flags + "-E -P && " + compiler + flags + "-E -dM"}, options);
  ASSERT_EQ(words.status, 0) << words.err;
  std::set<std::string> names;
  const std::regex word("[A-Za-z_][A-Za-z0-9_]*");
  for (std::sregex_iterator at(words.out.begin(), words.out.end(), word), end; at != end; ++at)
    names.insert(identifier(at->str()));
  for (const std::string& function : function_names()) names.insert(identifier(function));
  names.erase(identifier("double_pendulum"));
  EXPECT_GT(names.size(), 5000u);
  std::string code = includes;
  for (const std::string& name : names)
    code += "namespace " + name + " { namespace raw { constexpr int nq = 1; } }\n";
  write_text(folder / "names.cc", code);
  const Outcome outcome =
      run_program({"sh", "-c",
                   std::string(compiler) + " -std=" + standard + " -I. -isystem " ARBOC_EIGEN +
                       (std::string(compiler) == "g++" ? " -fmax-errors=0" : " -ferror-limit=0") +
                       " -fsyntax-only names.cc 2>&1 | grep error"},
                  options);
  EXPECT_EQ(outcome.out, "");
}
INSTANTIATE_TEST_SUITE_P(Compilers, HeaderWords,
                         testing::Combine(testing::Values("g++", "clang++"),
                                          testing::Values("c++17", "gnu++20")),
                         [](const auto& at) {
                           const std::string standard = std::get<1>(at.param);
                           return std::string(std::get<0>(at.param)).substr(0, 1) + "xx_" +
                                  standard.substr(0, standard.find('+')) +
                                  standard.substr(standard.size() - 2);
                         });

}  // namespace
}  // namespace arboc::test
