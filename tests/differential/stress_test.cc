// Generated programs under stress: inputs that are not finite, extreme masses, singular bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "frontend/urdf.h"
#include "support/engines.h"
#include "support/interpreter.h"
#include "support/random_model.h"

namespace arboc::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Numbers = std::vector<std::vector<double>>;

/// Which lanes of a node (bits) depend on something of which its operands' lanes do.
unsigned reached_lanes(const Region& region, const Node& node,
                       const std::vector<unsigned>& reached) {
  const unsigned all = (1u << node.width) - 1;
  const auto lanes = [&](Ref r) {  // a scalar is every lane of itself
    const unsigned bits = reached[r.node()];
    return region[r].width == 1 && bits != 0 ? all : bits;
  };
  unsigned bits = 0;
  int k = 0;
  switch (node.op) {
    case Op::kPack:
      for_each_operand(region, node, [&](Ref r) { bits |= (reached[r.node()] & 1) << k++; });
      return bits;
    case Op::kLane: return reached[node.a.node()] >> node.index & 1;
    case Op::kHsum: return (reached[node.a.node()] & ((1u << node.index) - 1)) != 0 ? 1 : 0;
    default: for_each_operand(region, node, [&](Ref r) { bits |= lanes(r); }); return bits;
  }
}

/// Per entry of the inputs, in their order: which entries of the outputs depend on it.
std::vector<std::vector<char>> dependence(const Region& region) {
  std::vector<std::vector<char>> rows;
  size_t inputs = 0;
  for (const Port& port : region.inputs) inputs += static_cast<size_t>(port.size);
  for (std::uint32_t input = 0; input < inputs; ++input) {
    std::vector<unsigned> reached(region.nodes.size(), 0);
    for (size_t n = 0; n < region.nodes.size(); ++n) {
      const Node& node = region.nodes[n];
      reached[n] =
          node.op == Op::kInput && node.index == input ? 1 : reached_lanes(region, node, reached);
    }
    rows.emplace_back();
    for (const auto& port : region.results)
      for (const Ref ref : port) rows.back().push_back(reached[ref.node()] != 0);
  }
  return rows;
}

std::vector<double> flat(const Numbers& numbers) {
  std::vector<double> all;
  for (const auto& port : numbers) all.insert(all.end(), port.begin(), port.end());
  return all;
}

/// Puts `bad` into each input entry in turn.
void expect_it_spreads_exactly(const Graph& graph, const Program& program, const Numbers& inputs,
                               double bad) {
  const auto depends = dependence(graph.regions.back());
  const std::vector<double> good = flat(interpret(program, inputs));
  size_t row = 0;
  for (size_t p = 0; p < inputs.size(); ++p) {
    for (size_t i = 0; i < inputs[p].size(); ++i, ++row) {
      Numbers spoilt = inputs;
      spoilt[p][i] = bad;
      const std::vector<double> got = flat(interpret(program, spoilt));
      for (size_t e = 0; e < got.size(); ++e) {
        if (depends[row][e])
          EXPECT_FALSE(std::isfinite(got[e])) << program.name << ": " << bad << " in "
                                              << program.inputs[p].name << i << ", output " << e;
        else
          EXPECT_EQ(got[e], good[e]) << program.name;
      }
    }
  }
}

/// Every function but those that solve: they report a pivot and then all is nan.
std::vector<std::string> functions_without_pivots(const Setup& setup) {
  std::vector<std::string> names;
  for (const std::string& name : function_names())
    if (signature({name}, setup).positive.empty()) names.push_back(name);
  return names;
}

void expect_it_spreads(const Model& model) {
  const Setup setup = resolve(model);
  StateSource source(7);
  Values in = source.inputs(setup);
  in["lambda"] = source.vector(setup.nv);
  for (const std::string& function : functions_without_pivots(setup)) {
    const CompiledFunction f = compile_function({function}, setup);
    Numbers inputs;
    for (const Argument& a : f.signature.inputs) inputs.push_back(in.at(a.name));
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
      expect_it_spreads_exactly(f.graph, f.program, inputs, bad);
      if (f.lanes) expect_it_spreads_exactly(f.lanes->graph, f.lanes->program, inputs, bad);
    }
  }
}

TEST(NotFinite, SpreadsToWhatDependsOnItAndNoFurther) {
  for (const char* name : {"double_pendulum", "ur5", "all_joints"}) {
    SCOPED_TRACE(name);
    expect_it_spreads(own_model(name));
  }
  ModelOptions floating;
  floating.base = Base::kFloating;
  SCOPED_TRACE("quadruped");
  expect_it_spreads(own_model("quadruped", floating));
}

TEST(NotFinite, SpreadsInRandomModels) {
  for (const std::uint64_t seed : seeds(5)) {
    RandomModelOptions options;
    options.joints = 5;
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed));
    expect_it_spreads(random_model(seed, options));
  }
}

TEST(NotFinite, IsReportedByForwardDynamics) {
  const Model model = own_model("ur5");
  const cli::GeneratedCode code = generated_code(model, {"aba", "aba_derivatives"});
  StateSource source(8);
  const Values in = source.inputs(resolve(model));
  for (const char* function : {"aba", "aba_derivatives"}) {
    int status = -1;
    const Values good = code.call(function, in, &status);
    EXPECT_EQ(status, 0);
    for (const char* input : {"q", "v", "tau"}) {
      for (const double bad : {kNan, kInfinity, -kInfinity}) {
        SCOPED_TRACE(std::string(function) + ", " + input);
        Values spoilt = in;
        spoilt[input][1] = bad;
        for (const auto& [name, values] : code.call(function, spoilt, &status)) {
          const bool all = std::string(input) == "q" || name == "qdd";
          for (size_t e = 0; all && e < values.size(); ++e)
            EXPECT_EQ(std::isfinite(values[e]), good.at(name)[e] == 0) << name << e;
        }
        // M does not depend on v and tau: there is a solution, which is not finite.
        EXPECT_EQ(status > 0, std::string(input) == "q");
      }
    }
  }
}

/// A chain of revolute joints about alternating axes; link k weighs masses[k].
Model chain(const std::vector<double>& masses, double thickness = 0.1) {
  std::string text = "<robot name='chain'><link name='l0'/>";
  for (size_t k = 1; k <= masses.size(); ++k) {
    const double m = masses[k - 1];
    const auto number = [](double x) {
      char out[32];
      std::snprintf(out, sizeof out, "%.17g", x);
      return std::string(out);
    };
    const std::string I = number(m * 0.04), axial = number(m * thickness * thickness);
    const std::string name = std::to_string(k);
    text += "<link name='l" + name + "'><inertial><origin xyz='0 0 0.2'/><mass value='" +
            number(m) + "'/><inertia ixx='" + I + "' ixy='0' ixz='0' iyy='" + I +
            "' iyz='0' izz='" + axial + "'/></inertial></link><joint name='j" + name +
            "' type='continuous'><parent link='l" + std::to_string(k - 1) + "'/><child link='l" +
            name + "'/><origin xyz='0 0 0.4'/><axis xyz='" + (k % 2 ? "0 1 0" : "1 0 0") +
            "'/></joint>";
  }
  Diagnostics diagnostics;
  return configure(parse_urdf(text + "</robot>", "chain.urdf", diagnostics), {}, diagnostics);
}

/// rnea and M to 1e-12 of the reference; forward dynamics right, or refused at run time.
void expect_no_garbage(const Model& model) {
  const Setup setup = resolve(model);
  const Reference reference(model);
  const Compilation compilation = compilation_of(model, {"rnea", "crba", "aba"});
  StateSource source(11);
  int solved = 0;
  for (int k = 0; k < 50; ++k) {
    const Values in = source.inputs(setup);
    for (const CompiledFunction& f : compilation.functions) {
      Numbers inputs;
      for (const Argument& a : f.signature.inputs) inputs.push_back(in.at(a.name));
      const Numbers got = interpret(f.program, inputs);
      const Values expected = evaluate_reference(f.request, setup, in);
      if (f.signature.name == "rnea") {
        EXPECT_LE(relative_error(got[0], expected.at("tau")), 1e-12);
      } else if (f.signature.name == "crba") {
        const std::vector<double>& M = expected.at("M");
        double largest = 0;
        for (const double x : M) largest = std::max(largest, std::fabs(x));
        for (size_t e = 0; e < got[0].size(); ++e) {
          const auto at =
              static_cast<size_t>(f.patterns[0].row[e] * setup.nv + f.patterns[0].col[e]);
          EXPECT_LE(std::fabs(got[0][e] - M[at]), 1e-12 * largest);
        }
      } else {
        bool positive = true;
        for (const double pivot : got.back()) positive = positive && pivot > 0;
        if (!positive) continue;
        ++solved;
        const double cond = condition(reference.crba(vector_of(in.at("q"))));
        EXPECT_LE(relative_error(got[0], expected.at("qdd")),
                  cond > 0 ? std::min(1e-12 * cond, 0.1) : 0.1);
      }
    }
  }
  testing::Test::RecordProperty("solved", solved);
}

TEST(Extreme, MassRatios) {
  for (const double ratio : {1e-16, 1e-12, 1e-8, 1e8, 1e12, 1e16}) {
    SCOPED_TRACE(ratio);
    expect_no_garbage(chain({1, ratio}));
    expect_no_garbage(chain({ratio, 1}));
    expect_no_garbage(chain({1, 1, ratio, 1}));
    expect_no_garbage(chain({1e-3 * ratio, 1, ratio}));
  }
}

TEST(Extreme, SizesOfEverything) {
  for (const double size : {1e-250, 1e-100, 1e-30, 1e30, 1e100, 1e250}) {
    SCOPED_TRACE(size);
    expect_no_garbage(chain({size, size, size}));
  }
}

TEST(Extreme, ThinRods) {
  for (const double thickness : {1e-2, 1e-6, 1e-9, 1e-12}) {
    SCOPED_TRACE(thickness);
    expect_no_garbage(chain({1, 1, 1}, thickness));
  }
}

/// How many functions are refused.
int refused(const Model& model) {
  const Setup setup = resolve(model);
  int count = 0;
  for (const std::string& function : function_names()) {
    try {
      compile_function({function}, setup);
    } catch (const InputError& e) {
      ++count;
      EXPECT_NE(std::string(e.what()).find("chain.urdf: error: " + function), std::string::npos)
          << e.what();
    }
  }
  return count;
}

TEST(Extreme, NumbersThatOverflowAreInputErrors) {
  EXPECT_GT(refused(chain({1e308, 1e308, 1e308})), 0);
  EXPECT_EQ(refused(chain({1, 1, 1})), 0);
}

}  // namespace
}  // namespace arboc::test
