// The printed form of every stage for small models: one case file each, so that a change of any
// stage is seen in review.
//
// A case is a model, then sections `--- expected STAGE FUNCTION [OPTION ...]` with what
// `arboc compile --print=STAGE --functions=FUNCTION` prints.  ARBOC_UPDATE=1 rewrites the sections.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "compile.h"
#include "frontend/urdf.h"
#include "functions/lane_trace.h"
#include "support/golden.h"

namespace arboc::test {
namespace {

constexpr const char* kFolder = ARBOC_SOURCE_DIR "/tests/golden/cases";
constexpr std::string_view kMark = "--- expected ";

/// The groups, and what is made of them.
std::string printed_limbs(const Setup& setup, const CompiledFunction& f) {
  const LoweringOptions& lowering = f.lanes ? f.lanes->lowering : f.lowering;
  const std::string groups = print(lower(setup, lowering), limbs_in_lanes(setup, lowering));
  return f.lanes ? groups + print(f.lanes->graph) + print(f.lanes->program) : groups;
}

std::string printed(const Model& as_read, const std::string& section) {
  std::istringstream words(section);
  std::string stage, function;
  words >> stage >> function;
  CompileOptions options;
  options.requests = {{function}};
  for (std::string option; words >> option;) {
    if (option == "floating") options.model.base = Base::kFloating;
    if (option == "expand") options.model.expand = true;
  }
  Diagnostics diagnostics;
  const Compilation compilation = compile(as_read, options, diagnostics);
  const CompiledFunction& f = compilation.functions.front();
  if (stage == "model") return print(compilation.setup.model);
  if (stage == "tree") return print(lower(compilation.setup, f.lowering));
  if (stage == "limbs") return printed_limbs(compilation.setup, f);
  if (stage == "graph") return print(f.graph);
  if (stage == "program") return print(f.program);
  throw std::invalid_argument("unknown stage " + stage);
}

std::vector<std::string> cases() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

class Printed : public testing::TestWithParam<std::string> {};

TEST_P(Printed, Stages) {
  const std::string path = std::string(kFolder) + "/" + GetParam() + ".txt";
  const std::string text = read_file(path);
  size_t at = text.find(kMark);
  ASSERT_NE(at, std::string::npos);
  const std::string input = text.substr(0, at);
  Diagnostics diagnostics;
  const Model model = parse_urdf(input, GetParam() + ".urdf", diagnostics);
  std::string now = input;
  for (; at != std::string::npos; at = text.find(kMark, at + 1)) {
    const size_t begin = at + kMark.size(), end = text.find('\n', begin);
    const std::string section = text.substr(begin, end - begin);
    now += std::string(kMark) + section + "\n" + printed(model, section);
  }
  expect_golden(path, now);
}

// The newcomer's page shows real output.
TEST(Documentation, PipelineShowsWhatIsPrinted) {
  const std::string page = read_file(ARBOC_SOURCE_DIR "/docs/pipeline.md");
  const size_t begin = page.find("<robot"), end = page.find("```", begin);
  ASSERT_NE(end, std::string::npos);
  Diagnostics diagnostics;
  const Model model = parse_urdf(page.substr(begin, end - begin), "pendulum.urdf", diagnostics);
  for (const char* stage : {"model", "tree", "graph", "program"}) {
    const std::string text = printed(model, std::string(stage) + " rnea");
    EXPECT_NE(page.find("```\n" + text + "```\n"), std::string::npos) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Printed, testing::ValuesIn(cases()),
                         [](const auto& at) { return at.param; });

}  // namespace
}  // namespace arboc::test
