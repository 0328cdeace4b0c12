// The C interface: clean C99 under each compiler at hand, called as CasADi does it, against the
// generic engine; Jacobians against differences of the function itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "embed/external.h"
#include "emit/emit.h"
#include "support/engines.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

using Command = std::vector<std::string>;

struct Case {
  const char* name;
  const char* model;
  Base base;
  std::vector<std::string> functions;
  FunctionOptions options;
  std::vector<Request> requests{};
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

FunctionOptions with_parameters() {
  FunctionOptions options;
  options.parameters = {"gravity", "masses"};
  options.external_forces = {"tip"};
  return options;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"ur5",
       "ur5",
       Base::kFixed,
       {"rnea", "crba", "aba", "fk", "energy", "minv", "rnea_derivatives", "integrate"},
       {},
       {{"rnea", Derivative::kHessian, "tau", false, {"q", "v"}},
        {"fk", Derivative::kVjp, "placements"}}},
      {"quadruped",
       "quadruped",
       Base::kFloating,
       {"rnea", "gravity", "com", "frame_velocity", "integrate", "difference"},
       {},
       {}},
      {"joints",
       "all_joints",
       Base::kFixed,
       {"nle", "crba", "com_jacobian"},
       with_parameters(),
       {}},
  };
  return all;
}

CompileOptions options_of(const Case& c) {
  CompileOptions options;
  options.model.base = c.base;
  options.function = c.options;
  options.requests = requests_of(c.functions);
  options.requests.insert(options.requests.end(), c.requests.begin(), c.requests.end());
  options.targets = {false, true};
  return options;
}

bool installed(const std::string& compiler) {
  return run_program({compiler, "--version"}).status == 0;
}

/// The emitted folder, compiled to one library.
class Emitted {
 public:
  Emitted(const Case& c, const std::string& compiler) {
    const CompileOptions options = options_of(c);
    Diagnostics diagnostics;
    compilation = compile(own_model(c.model), options, diagnostics);
    const TargetModel model = target(compilation, options);
    name = model.name;
    const Files files = emit(model);
    cli::write_sources(folder_.path(), files);
    Command command{compiler};
    for (const char* flag : {"-std=c99", "-O0", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow",
                             "-Wconversion", "-Werror", "-fPIC", "-shared", "-o"})
      command.emplace_back(flag);
    command.push_back(folder_ / "lib.so");
    for (const auto& [path, bytes] : files)
      if (path.ends_with(".c")) command.push_back(folder_ / path);
    command.emplace_back("-lm");
    const Outcome outcome = run_program(command);
    if (outcome.status == 0)
      library = std::make_unique<cli::Library>(folder_ / "lib.so");
    else
      ADD_FAILURE() << outcome.err.substr(0, 4000);
  }

  Compilation compilation;
  std::string name;
  std::unique_ptr<cli::Library> library;

 private:
  TempDir folder_;
};

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double x : values) most = std::max(most, std::fabs(x));
  return most;
}

External::Vectors arguments(const Signature& s, Values inputs, StateSource& source) {
  External::Vectors out;
  for (const Argument& a : s.inputs) {
    if (a.name == "lambda") inputs[a.name] = source.vector(a.rows);
    out.push_back(inputs.at(a.name));
  }
  return out;
}

/// Dense outputs of the generic engine on the same inputs.
Values expected(const CompiledFunction& f, const Setup& setup, const External::Vectors& in) {
  Values inputs;
  for (size_t i = 0; i < in.size(); ++i) inputs[f.signature.inputs[i].name] = in[i];
  return evaluate_generic(f.request, setup, f.lowering, inputs);
}

void expect_shapes(const External& f, const Signature& s) {
  ASSERT_EQ(f.inputs.size(), s.inputs.size());
  ASSERT_EQ(f.outputs.size(), s.outputs.size());
  for (size_t i = 0; i < s.inputs.size(); ++i) {
    EXPECT_EQ(f.input_names[i], s.inputs[i].name);
    EXPECT_EQ(f.inputs[i].rows, s.inputs[i].rows * s.inputs[i].cols);
    EXPECT_EQ(f.inputs[i].entries(), f.inputs[i].rows);
  }
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    EXPECT_EQ(f.output_names[k], s.outputs[k].name);
    EXPECT_EQ(f.outputs[k].rows, s.outputs[k].rows);
    EXPECT_EQ(f.outputs[k].cols, s.outputs[k].cols);
  }
}

void expect_values(const External& f, const CompiledFunction& compiled, const Setup& setup,
                   const External::Vectors& in) {
  const Values wanted = expected(compiled, setup, in);
  const External::Vectors out = f(in);
  for (size_t k = 0; k < out.size(); ++k) {
    const std::vector<double>& values = wanted.at(f.output_names[k]);
    // Rounding of some hundred operations; the condition of M in aba and minv.
    EXPECT_LE(relative_error(f.outputs[k].dense(out[k]), values), 1e-10) << f.output_names[k];
  }
}

/// Not-a-number is what it is: a body without mass has no centre.
bool same_bits(const External::Vectors& a, const External::Vectors& b) {
  bool same = a.size() == b.size();
  for (size_t k = 0; same && k < a.size(); ++k)
    same = a[k].size() == b[k].size() &&
           std::memcmp(a[k].data(), b[k].data(), a[k].size() * sizeof(double)) == 0;
  return same;
}

/// Null inputs are zeros; null outputs change nothing about the others.
void expect_nulls(const External& f, const External::Vectors& in) {
  for (size_t i = 0; i < in.size(); ++i) {
    if (f.input_names[i] == "q" || f.input_names[i] == "q1") continue;  // no quaternion is zero
    External::Vectors zero = in, null = in;
    std::fill(zero[i].begin(), zero[i].end(), 0.0);
    null[i].clear();
    EXPECT_TRUE(same_bits(f(zero), f(null))) << f.input_names[i];
  }
  const External::Vectors all = f(in);
  std::vector<bool> wanted(all.size(), false);
  f(in, wanted);
  for (size_t k = 0; k < all.size(); ++k) {
    wanted[k] = true;
    EXPECT_EQ(f(in, wanted)[k], all[k]);
    wanted[k] = false;
  }
}

/// Every block against central differences of f by each entry.
void expect_jacobian(const External& f, const External& jacobian, const External::Vectors& in) {
  const size_t n_in = f.inputs.size(), n_out = f.outputs.size();
  ASSERT_EQ(jacobian.inputs.size(), n_in + n_out);
  ASSERT_EQ(jacobian.outputs.size(), n_in * n_out);
  External::Vectors with_outputs = in;
  with_outputs.resize(n_in + n_out);
  const External::Vectors blocks = jacobian(with_outputs), value = f(in);
  constexpr double h = 1e-5;
  for (size_t i = 0; i < n_in; ++i) {
    for (size_t e = 0; e < in[i].size(); ++e) {
      External::Vectors ahead = in, behind = in;
      ahead[i][e] += h;
      behind[i][e] -= h;
      const External::Vectors up = f(ahead), down = f(behind);
      for (size_t k = 0; k < n_out; ++k) {
        const CompressedColumns& pattern = jacobian.outputs[i + k * n_in];
        const CompressedColumns& y = f.outputs[k];
        ASSERT_EQ(pattern.rows, y.rows * y.cols);
        ASSERT_EQ(pattern.cols, f.inputs[i].rows);
        const std::vector<double> J = pattern.dense(blocks[i + k * n_in]);
        const std::vector<double> high = y.dense(up[k]), low = y.dense(down[k]);
        // h^2 of the third derivative, rounding over h; of what is of order 1 or of the value.
        const double tolerance = 3e-8 * (1 + largest(J) + largest(value[k]));
        for (int r = 0; r < y.rows; ++r)
          for (int c = 0; c < y.cols; ++c) {
            const size_t at = static_cast<size_t>(r * y.cols + c);
            const size_t entry = static_cast<size_t>(r + y.rows * c) * in[i].size() + e;
            ASSERT_NEAR(J[entry], (high[at] - low[at]) / (2 * h), tolerance)
                << jacobian.output_names[i + k * n_in] << " " << r << " " << c << " by " << e;
          }
      }
    }
  }
}

void expect_all(const Case& c, const std::string& compiler) {
  const Emitted emitted(c, compiler);
  ASSERT_TRUE(emitted.library);
  StateSource source(5);
  for (const CompiledFunction& compiled : emitted.compilation.functions) {
    SCOPED_TRACE(compiled.signature.name);
    const std::string symbol = emitted.name + "_" + compiled.signature.name;
    const External f(*emitted.library, symbol);
    ASSERT_NO_FATAL_FAILURE(expect_shapes(f, compiled.signature));
    for (int s = 0; s < 3; ++s) {
      const External::Vectors in =
          arguments(compiled.signature, source.inputs(emitted.compilation.setup), source);
      expect_values(f, compiled, emitted.compilation.setup, in);
      expect_nulls(f, in);
      if (compiled.request.derivative != Derivative::kNone ||
          compiled.request.function.ends_with("_derivatives"))
        continue;
      const External jacobian(*emitted.library, "jac_" + symbol);
      ASSERT_NO_FATAL_FAILURE(expect_jacobian(f, jacobian, in));
      External::Vectors with_outputs = in;
      with_outputs.resize(jacobian.inputs.size());
      expect_nulls(jacobian, with_outputs);
    }
  }
}

class CInterface : public testing::TestWithParam<Case> {};

TEST_P(CInterface, FollowsTheConventionAndGivesTheNumbers) { expect_all(GetParam(), "gcc"); }

INSTANTIATE_TEST_SUITE_P(Models, CInterface, testing::ValuesIn(cases()),
                         [](const auto& c) { return std::string(c.param.name); });

TEST(CInterfaceBy, AnotherCompiler) {
  if (!installed("clang")) GTEST_SKIP() << "clang is not installed";
  expect_all(cases()[1], "clang");
}

/// A singular arm: not 0, and not-a-number.
TEST(CInterfaceChecks, SayWhatIsNotPositive) {
  Case c = cases()[2];
  c.functions = {"minv"};
  c.options.external_forces.clear();
  const Emitted emitted(c, "gcc");
  ASSERT_TRUE(emitted.library);
  StateSource source(6);
  Values inputs = source.inputs(emitted.compilation.setup);
  std::fill(inputs["masses"].begin(), inputs["masses"].end(), -1e3);
  const CompiledFunction& f = emitted.compilation.functions.front();
  int status = 0;
  const External minv(*emitted.library, emitted.name + "_minv");
  const auto out = minv(arguments(f.signature, inputs, source), {}, &status);
  EXPECT_GT(status, 0);
  for (const double x : out[0]) EXPECT_TRUE(std::isnan(x));
}

}  // namespace
}  // namespace arboc::test
