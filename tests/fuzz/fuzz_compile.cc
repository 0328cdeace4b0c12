// A robot -> its text -> Model -> emitted files, and the numbers on the way.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/sha256.h"
#include "compile.h"
#include "emit/emit.h"
#include "emit/names.h"
#include "frontend/urdf.h"
#include "fuzz/robot.h"
#include "fuzz/targets.h"
#include "state_source.h"
#include "support/interpreter.h"
#include "truth.h"

namespace arboc::fuzz {
namespace {

void expect_read_as_meant(const Robot& robot, const Model& model) {
  ARBOC_FUZZ_EXPECT(model.name == robot.name);
  ARBOC_FUZZ_EXPECT(model.links.size() == robot.links.size());
  for (const std::string& name : robot.links)
    ARBOC_FUZZ_EXPECT(std::any_of(model.links.begin(), model.links.end(),
                                  [&](const Link& link) { return link.name == name; }));
  for (size_t k = 0; k < robot.joints.size(); ++k) {
    const RobotJoint& meant = robot.joints[k];
    const auto joint = std::find_if(model.joints.begin(), model.joints.end(),
                                    [&](const Joint& j) { return j.name == meant.name; });
    ARBOC_FUZZ_EXPECT(joint != model.joints.end());
    const auto link = [&](int i) { return model.links[static_cast<size_t>(i)].name; };
    ARBOC_FUZZ_EXPECT(link(joint->parent) == robot.links[static_cast<size_t>(meant.parent)]);
    ARBOC_FUZZ_EXPECT(link(joint->child) == robot.links[k + 1]);
    ARBOC_FUZZ_EXPECT(name(joint->type) == meant.type);
    ARBOC_FUZZ_EXPECT(joint->mimic.has_value() == (meant.leader >= 0));
  }
}

/// Without comments and what stands between quotes.
std::string code_alone(const std::string& text) {
  std::string code;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size());
      ARBOC_FUZZ_EXPECT(text[i - 1] != '\\');
    } else if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"'; ++i) {
        ARBOC_FUZZ_EXPECT(text[i] != '\n');
        if (text[i] == '\\') ++i;
      }
    } else {
      code += text[i];
    }
  }
  return code;
}

/// Generated code is ASCII, and a name occurs as an escaped literal or not at all.
void expect_safe(const Files& files) {
  for (const auto& [path, text] : files) {
    for (const char c : path)
      ARBOC_FUZZ_EXPECT(std::isalnum(static_cast<unsigned char>(c)) ||
                        std::string("_./").find(c) != std::string::npos);
    ARBOC_FUZZ_EXPECT(path.find("..") == std::string::npos && path[0] != '/');
    for (const char c : text) ARBOC_FUZZ_EXPECT((c >= 0x20 && c < 0x7F) || c == '\n');
    if (path == "manifest.json" || path == "CMakeLists.txt" || path.starts_with("arboc/")) continue;
    ARBOC_FUZZ_EXPECT(text.find("??") == std::string::npos);
    for (const char c : code_alone(text))
      ARBOC_FUZZ_EXPECT(c != '$' && c != '@' && c != '`' && c != '\\');
  }
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double x : values) most = std::max(most, std::fabs(x));
  return most;
}

/// The program's numbers against the reference engine's.
void expect_true(const Compilation& compilation) {
  StateSource source(1);
  const Values in = source.inputs(compilation.setup);
  for (const CompiledFunction& f : compilation.functions) {
    std::vector<std::vector<double>> inputs;
    for (const Argument& a : f.signature.inputs) inputs.push_back(in.at(a.name));
    const auto got = test::interpret(f.program, inputs);
    const Values expected = evaluate_reference(f.request, compilation.setup, in);
    for (size_t k = 0; k < f.signature.outputs.size(); ++k) {
      const Argument& a = f.signature.outputs[k];
      const std::vector<double>& truth = expected.at(a.name);
      const double bound = a.tolerance * (largest(truth) + 1);
      const auto cols = static_cast<size_t>(a.cols);
      for (size_t e = 0; e < got[k].size(); ++e) {
        const size_t at = !a.sparse ? e
                                    : static_cast<size_t>(f.patterns[k].row[e]) * cols +
                                          static_cast<size_t>(f.patterns[k].col[e]);
        ARBOC_FUZZ_EXPECT(std::fabs(got[k][e] - truth[at]) <= bound);
      }
    }
  }
}

CompileOptions options_of(Bytes& bytes) {
  CompileOptions options;
  if (bytes.chance(60)) options.model.base = Base::kFloating;
  if (bytes.chance(60)) options.model.mimic = MimicPolicy::kIndependent;
  if (bytes.chance(60)) options.model.order = JointOrder::kAlphabetical;
  if (bytes.chance(30)) options.model.continuous = ContinuousAs::kCosSin;
  if (bytes.chance(30)) options.model.expand = true;
  if (bytes.chance(60)) options.model.snap = 0;
  if (bytes.chance(30)) options.function.joint_forces.damping = true;
  constexpr const char* kFunctions[] = {"rnea",       "crba",           "fk",
                                        "nle",        "frame_velocity", "energy",
                                        "centroidal", "com_jacobian",   "regressor"};
  options.requests = {{bytes.pick(kFunctions)}};
  return options;
}

}  // namespace

void compile(const std::uint8_t* data, size_t size) {
  Bytes bytes(data, size);
  const Robot robot = robot_of(bytes);
  const CompileOptions options = options_of(bytes);
  const std::string text = urdf_of(robot, bytes);
  Diagnostics diagnostics;
  try {
    const Model model = parse_urdf(text, "fuzz.urdf", diagnostics);
    expect_read_as_meant(robot, model);
    const Compilation compilation = arboc::compile(model, options, diagnostics);
    expect_true(compilation);
    expect_safe(emit(target(compilation, options)));
  } catch (const InputError& e) {
    // A good robot: only what has no motion or no mass is refused.
    const std::string what = e.what();
    ARBOC_FUZZ_EXPECT(what.find("no joint moves") != std::string::npos ||
                      what.find("mass") != std::string::npos);
  }
}

}  // namespace arboc::fuzz
