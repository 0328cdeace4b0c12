// The folder that `arboc compile` writes, used as its README says: built by its own CMakeLists.txt,
// tested by its own selftest, linked into another project; and the instructions that its compiled
// functions really have.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "support/engines.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

/// Those of `arboc eval`: the same bits come out.
const std::string kFlags = "-O2 -march=native -fno-tree-vectorize";

struct Case {
  const char* name;
  Base base;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class EmittedFolder : public testing::TestWithParam<Case> {
 protected:
  std::string name() const { return GetParam().name; }
  std::vector<std::string> with_model(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin() + 1,
                     ARBOC_SOURCE_DIR "/models/" + name() + "/" + name() + ".urdf");
    if (GetParam().base == Base::kFloating)
      arguments.insert(arguments.end(), {"--base", "floating"});
    return arguments;
  }

  void emit() const {
    const Outcome outcome = run_arboc(with_model({"compile", "-o", folder_.path()}));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  /// Configures and builds `source` in `build`, with nothing but kFlags.
  static void build(const std::string& source, const std::string& build) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{ARBOC_CMAKE, "-S", source, "-B", build, "-G", ARBOC_GENERATOR,
                                   "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=" + kFlags},
          std::vector<std::string>{ARBOC_CMAKE, "--build", build, "--parallel", "2"}}) {
      const Outcome outcome = run_program(command);
      ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    }
  }

  void expect_selftest_passes() const;
  void expect_consumer_gets_the_bits_of_eval() const;
  void expect_instructions_as_counted() const;

  TempDir folder_;
};

void EmittedFolder::expect_selftest_passes() const {
  const Outcome outcome = run_program({(folder_ / "build/") + name() + "_selftest"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out.find("WRONG"), std::string::npos) << outcome.out;
  for (const std::string& function : functions_of(own_model(name())))
    EXPECT_NE(outcome.out.find(function), std::string::npos) << outcome.out;
}

void EmittedFolder::expect_consumer_gets_the_bits_of_eval() const {
  const std::string user = folder_ / "user";
  ASSERT_EQ(run_program({"mkdir", user}).status, 0);
  write_text(user + "/CMakeLists.txt",
             "cmake_minimum_required(VERSION 3.16)\nproject(user CXX)\nadd_subdirectory(../" +
                 name() +
                 " model)\nadd_executable(user " ARBOC_SOURCE_DIR
                 "/tests/differential/emitted_consumer.cpp)\n"
                 "target_compile_definitions(user PRIVATE MODEL=" +
                 name() + " \"HEADER=<" + name() + "/" + name() +
                 ".hpp>\")\ntarget_link_libraries(user PRIVATE " + name() + "::" + name() + ")\n");
  build(user, user + "/build");

  ModelOptions options;
  options.base = GetParam().base;
  const Model model = own_model(name(), options);
  Random random(23);
  std::map<std::string, std::vector<std::vector<double>>> tables;
  std::string states;
  for (int k = 0; k < 5; ++k) {
    for (const auto& [input, values] : inputs_of(random_state(model, random)))
      tables[input].push_back(values);
    for (const char* input : {"q", "v", "a", "tau"}) states += csv_text({tables[input].back()});
  }
  for (char& c : states) c = c == ',' ? ' ' : c;
  RunOptions how;
  how.input = folder_ / "states";
  write_text(how.input, states);
  const Outcome consumer = run_program({user + "/build/user"}, how);
  ASSERT_EQ(consumer.status, 0) << consumer.err;
  std::map<std::string, std::string> lines;
  std::istringstream stream(consumer.out);
  for (std::string line; std::getline(stream, line);)
    lines[line.substr(0, line.find(':'))] += line.substr(line.find(':') + 1) + "\n";

  for (const auto& [input, rows] : tables) write_text(folder_ / input, csv_text(rows));
  for (const CompiledFunction& f : compilation_of(model, functions_of(model)).functions) {
    if (f.signature.outputs.size() > 1) continue;  // derivatives_emitted_test calls these
    std::vector<std::string> command{"eval", "--function", f.signature.name};
    for (const Argument& a : f.signature.inputs)
      command.insert(command.end(), {"--" + a.name, folder_ / a.name});
    const Outcome eval = run_arboc(with_model(command));
    EXPECT_EQ(eval.status, 0) << eval.err;
    EXPECT_EQ(lines[f.signature.name], eval.out) << f.signature.name;
  }
}

/// Floating-point instructions by function, but those of the sines and cosines.
std::map<std::string, int> disassembled(const std::string& library) {
  const Outcome dump = run_program({"objdump", "-d", "-C", "--no-show-raw-insn", library});
  EXPECT_EQ(dump.status, 0) << dump.err;
  const std::regex header(R"(raw::(\w+?)(_(?:parts|lanes)::(\w+))?<double>\(.*>:$)");
  const std::regex arithmetic(R"(\tv?((mul|add|sub|div|sqrt)|fn?m(add|sub)(132|213|231))[sp]d )");
  std::map<std::string, int> counts;
  std::string function;
  std::istringstream lines(dump.out);
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(">:")) {
      function.clear();
      if (std::regex_search(line, match, header) && match[3] != "angles") function = match[1];
    } else if (!function.empty() && std::regex_search(line, arithmetic)) {
      ++counts[function];
    }
  }
  return counts;
}

void EmittedFolder::expect_instructions_as_counted() const {
  const Outcome macros =
      run_program({"c++", "-march=native", "-dM", "-E", "-x", "c++", "/dev/null"});
  if (macros.out.find("#define __x86_64__ ") == std::string::npos ||
      macros.out.find("#define __FMA__ ") == std::string::npos)
    return;  // the mnemonics, and the counts, are those of x86 with fused multiply-adds
  auto counts = disassembled((folder_ / "build/lib") + name() + ".a");
  const auto manifest = nlohmann::json::parse(read_text(folder_ / name() + "/manifest.json"));
  for (const auto& function : manifest["functions"]) {
    const bool lanes = function.contains("lanes");
    const auto& ops = lanes ? function["lanes"]["ops"] : function["ops"];
    int listed = 0;
    for (const char* op : {"mul", "add", "fma", "div", "sqrt"}) listed += ops[op].get<int>();
    // A sum over four lanes, which is counted apart, takes two or three additions.
    const int least = listed + (lanes ? 2 * ops["sums"].get<int>() : 0);
    const int most = listed + (lanes ? 3 * ops["sums"].get<int>() : 0);
    const std::string f = function["name"];
    EXPECT_GE(counts[f], 0.97 * least) << f;
    EXPECT_LE(counts[f], 1.03 * most) << f;
    RecordProperty(f, std::to_string(counts[f]) + " of " + std::to_string(listed));
  }
}

TEST_P(EmittedFolder, BuildsPassesItsTestAndGivesTheBitsOfEval) {
  ASSERT_NO_FATAL_FAILURE(emit());
  ASSERT_NO_FATAL_FAILURE(build(folder_ / name(), folder_ / "build"));
  expect_selftest_passes();
  expect_instructions_as_counted();
  expect_consumer_gets_the_bits_of_eval();
}

INSTANTIATE_TEST_SUITE_P(Models, EmittedFolder,
                         testing::Values(Case{"ur5", Base::kFixed},
                                         Case{"quadruped", Base::kFloating}),
                         [](const auto& c) { return std::string(c.param.name); });

/// Configures the folder alone; what is said, or nothing if all is well.
std::string configured(const std::string& folder, const std::string& option = "") {
  const TempDir build;
  std::vector<std::string> command{ARBOC_CMAKE, "-S", folder, "-B", build.path(), "-G",
                                   ARBOC_GENERATOR};
  if (!option.empty()) command.push_back(option);
  const Outcome outcome = run_program(command);
  return outcome.status == 0 ? "" : outcome.err;
}

TEST(EmittedCMake, RefusesFilesThatAreNotThoseOfTheManifest) {
  const TempDir folder;
  ASSERT_EQ(run_arboc({"compile", ARBOC_SOURCE_DIR "/models/double_pendulum/double_pendulum.urdf",
                       "-o", folder.path(), "--functions", "gravity"})
                .status,
            0);
  const std::string product = folder / "double_pendulum";
  EXPECT_EQ(configured(product), "");
  const std::string header = product + "/arboc/scalar.hpp", text = read_text(header);
  write_text(header, text + " ");
  const std::string said = configured(product);
  EXPECT_NE(said.find("arboc/scalar.hpp is not the file that manifest.json lists"),
            std::string::npos)
      << said;
  EXPECT_EQ(configured(product, "-DDOUBLE_PENDULUM_VERIFY=OFF"), "");
  std::remove(header.c_str());
  EXPECT_NE(configured(product, "-DDOUBLE_PENDULUM_VERIFY=ON"), "");
  write_text(header, text);
  EXPECT_EQ(configured(product), "");
  const std::string manifest = read_text(product + "/manifest.json");
  write_text(product + "/manifest.json", "{}");
  EXPECT_NE(configured(product).find("lists no files"), std::string::npos);
  std::remove((product + "/manifest.json").c_str());
  EXPECT_NE(configured(product), "");
}

}  // namespace
}  // namespace arboc::test
