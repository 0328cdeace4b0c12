// Generated and generic code in one translation unit, to be timed and compared.
#include <fmt/format.h>

#include <algorithm>

#include "base/number.h"
#include "cli/bench.h"
#include "emit/emit.h"
#include "emit/names.h"
#include "emit/template.h"
#include "state_source.h"

namespace arboc::cli {
namespace {

std::string text(const Vector3<double>& a) {
  return fmt::format("{{{}, {}, {}}}", literal(a.x), literal(a.y), literal(a.z));
}
std::string text(const Turn& a) { return fmt::format("{{{}, {}}}", literal(a.c), literal(a.s)); }

/// C++ statements that fill in `tree`.
std::string tree_text(const DynamicTree& tree) {
  std::string out = fmt::format("  tree.nq = {};\n  tree.nv = {};\n  tree.gravity = {};\n", tree.nq,
                                tree.nv, text(tree.gravity));
  out += "  using arboc::Motion;\n";
  constexpr const char* kMotions[] = {"kWorld",  "kRevolute", "kPrismatic",
                                      "kPlanar", "kFloating", "kSpherical"};
  for (const BodyOf<double>& b : tree.body) {
    const Symmetric3<double>& S = b.inertia.Sigma;
    out += fmt::format(
        "  tree.body.push_back({{{{\"\", \"\", {}, Motion::{}, {}, {}, {}, {}, {}}}, {}, {}, {}, "
        "{},\n"
        "                       {{{}, {}, {{{}, {}, {}, {}, {}, {}}}}},\n"
        "                       {{{}, {}, {}, {}, {}}}}});\n",
        b.parent, kMotions[static_cast<int>(b.motion)], b.q, b.v, literal(b.multiplier),
        literal(b.offset), b.circle, text(b.gamma), text(b.alpha), text(b.theta), text(b.c),
        literal(b.inertia.m), text(b.inertia.h), literal(S.xx), literal(S.yy), literal(S.zz),
        literal(S.xy), literal(S.xz), literal(S.yz), literal(b.forces.damping),
        literal(b.forces.friction), literal(b.forces.stiffness), literal(b.forces.neutral),
        literal(b.forces.rotor));
  }
  for (const FrameOf<double>& f : tree.frame) {
    const auto& R = f.R;
    out += fmt::format(
        "  tree.frame.push_back({{\"\", {}, {{{{{{{}, {}, {}}}, {{{}, {}, {}}}, {{{}, {}, "
        "{}}}}}}}, {}, {}}});\n",
        f.body, literal(R(0, 0)), literal(R(0, 1)), literal(R(0, 2)), literal(R(1, 0)),
        literal(R(1, 1)), literal(R(1, 2)), literal(R(2, 0)), literal(R(2, 1)), literal(R(2, 2)),
        text(f.p), f.moving);
  }
  out += fmt::format("  tree.joint_forces = {};\n  tree.friction_velocity = {};\n",
                     tree.joint_forces, literal(tree.friction_velocity));
  for (const auto& row : tree.coupled)
    out += fmt::format("  tree.coupled.push_back({{{}}});\n", fmt::join(row, ", "));
  return out;
}

/// Entries of all outputs, dense.
int dense_size(const Signature& s) {
  int size = 0;
  for (const Argument& a : s.outputs) size += a.rows * a.cols;
  return size;
}

/// Pointers to the inputs of state s.
std::string input_text(const Argument& a, size_t k) {
  return fmt::format("in[{}] + s * {}", k, a.rows * a.cols);
}

/// Compares entry by entry with the dense results of the other engine.
std::string compare_text(const std::string& model, const TargetFunction& f) {
  const Signature& s = f.signature;
  std::string compare;
  int offset = 0;
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    const std::string at = fmt::format("{}::sparsity::{}_{}", model, s.name, a.name);
    compare += fmt::format(
        "        const double d{0} = difference(out.data() + {1}, expected + {1}, {2}, {3}, "
        "{4}, {5});\n        if (!(d{0} <= worst)) worst = d{0};\n",
        k, offset, f.entries(k), a.sparse ? at + "_row" : "nullptr",
        a.sparse ? at + "_col" : "nullptr", a.cols);
    offset += a.rows * a.cols;
  }
  return compare;
}

/// How the generic engine is called, on the tree that the function needs.
std::string generic_text(const CompiledFunction& compiled, int nv) {
  const Signature& s = compiled.signature;
  std::string out = "      const auto generic_call = [&](int s, double* y) {\n        Inputs x;\n";
  for (size_t k = 0; k < s.inputs.size(); ++k)
    out += fmt::format("        x.{} = {};\n", s.inputs[k].name, input_text(s.inputs[k], k));
  out += "        double* const to[] = {";
  int offset = 0;
  for (const Argument& a : s.outputs) {
    out += fmt::format("y + {}, ", offset);
    offset += a.rows * a.cols;
  }
  if (!s.positive.empty()) out += fmt::format("y + {}, ", offset), offset += nv;
  out.resize(out.size() - 2);
  return out + fmt::format("}};\n        {}.{}(x, to);\n      }};\n",
                           compiled.lowering.regroup ? "regrouped" : "own", s.name);
}

bool has_generic(const CompiledFunction& f, const Setup& setup) {
  return defined_as(f.request).derivative == Derivative::kNone && setup.parameters.empty();
}

std::string case_text(const std::string& model, size_t index, const TargetFunction& f,
                      const CompiledFunction& compiled, const Setup& setup) {
  const Signature& s = f.signature;
  std::string arguments;
  for (size_t k = 0; k < s.inputs.size(); ++k) arguments += input_text(s.inputs[k], k) + ", ";
  int offset = 0;
  for (const Argument& a : s.outputs) {
    arguments += fmt::format("{}y + {}", offset ? ", " : "", offset);
    offset += a.rows * a.cols;
  }
  std::string out = fmt::format("    case {}: {{\n", index);
  out += fmt::format(
      "      const auto generated_call = [&](int s, double* y) {{ {0}::raw::{1}<double>({3}); }};\n"
      "      const auto plain_call = [&](int s, double* y) {{ {0}::raw::{1}{2}<double>({3}); }};\n",
      model, s.name, f.lanes ? "_plain" : "", arguments);
  const bool generic = has_generic(compiled, setup);
  if (generic) out += generic_text(compiled, setup.nv);
  out +=
      "      if (engine == 0) pass(states, out.data(), generated_call);\n"
      "      if (engine == 3) pass(states, out.data(), plain_call);\n";
  if (generic) out += "      if (engine == 1) pass(states, reference.data(), generic_call);\n";
  out +=
      "      for (int s = 0; s < states && engine == 2; ++s) {\n"
      "        generated_call(s, out.data());\n";
  out += generic ? "        generic_call(s, reference.data());\n"
                   "        const double* const expected = reference.data();\n"
                 : fmt::format("        const double* const expected = known + s * {};\n", offset);
  return out + compare_text(model, f) + "      }\n      break;\n    }\n";
}

std::string list_text(const std::vector<int>& indices) {
  return fmt::format("{{{}}}", fmt::join(indices, ", "));
}

std::string driver(const TargetModel& target, const Compilation& compilation) {
  const Setup& setup = compilation.setup;
  std::string includes, cases;
  int size = 1;
  for (size_t k = 0; k < target.functions.size(); ++k) {
    const TargetFunction& f = target.functions[k];
    includes += fmt::format("#include \"{0}/{0}_{1}_double.cpp\"\n", target.name, f.signature.name);
    cases += case_text(target.name, k, f, compilation.functions[k], setup);
    size = std::max(size, dense_size(f.signature) + target.nv);
  }
  constexpr const char* kAxes[] = {"kLocal", "kWorld", "kAligned"};
  return fill("bench/driver.cpp",
              {{"name", target.name},
               {"includes", includes},
               {"regrouped", tree_text(lower(setup, {FrameChoice::kAxis, true}))},
               {"own", tree_text(lower(setup, {FrameChoice::kAxis, false}))},
               {"frames", fmt::format("{{{}, {}, arboc::Axes::{}, {}}}", list_text(setup.frames),
                                      list_text(setup.loads), kAxes[static_cast<int>(setup.axes)],
                                      setup.transform_order)},
               {"size", fmt::format("{}", size)},
               {"cases", cases}});
}

}  // namespace

Samples samples(const CompiledFunction& f, const Setup& setup) {
  Samples result;
  result.inputs.resize(f.signature.inputs.size());
  StateSource source(7);
  for (int s = 0; s < kStates; ++s) {
    Values in = source.inputs(setup);
    for (size_t k = 0; k < f.signature.inputs.size(); ++k) {
      const Argument& a = f.signature.inputs[k];
      if (a.name == "lambda") in["lambda"] = source.vector(a.rows);
      const std::vector<double>& x = in.at(a.name);
      result.inputs[k].insert(result.inputs[k].end(), x.begin(), x.end());
    }
    if (has_generic(f, setup)) continue;
    const Values out = evaluate_generic(f.request, setup, f.lowering, in);
    for (const Argument& a : f.signature.outputs) {
      const std::vector<double>& y = out.at(a.name);
      result.known.insert(result.known.end(), y.begin(), y.end());
    }
  }
  return result;
}

namespace {

Library build(const Common& common, const Compilation& compilation, const TargetModel& target,
              const std::string& folder) {
  Files files;
  for (const auto& [path, bytes] : emit(target)) files[target.name + "/" + path] = bytes;
  for (const std::string& name : embedded_names("generic/")) files[name.substr(8)] = embedded(name);
  for (const char* header : {"arboc/math.hpp", "arboc/scalar.hpp"})
    files[header] = embedded(fmt::format("runtime/{}", header));
  files["driver.cpp"] = driver(target, compilation);
  return Library(build_library(common, folder, files, {"driver.cpp"}));
}

}  // namespace

Engines::Engines(const Common& common, const Compilation& compilation, const TargetModel& target)
    : library_(build(common, compilation, target, folder_.path())),
      call_(reinterpret_cast<Call>(library_.symbol("arboc_bench"))) {
  for (const CompiledFunction& f : compilation.functions) {
    Samples in = samples(f, compilation.setup);
    Function function{{}, std::move(in.known), {}, {}};
    function.inputs = std::move(in.inputs);
    for (const auto& x : function.inputs) function.pointers.push_back(x.data());
    // Forward dynamics amplifies rounding by the condition of M.
    function.row = {f.signature.name,
                    f.program.ops.total(),
                    f.lanes ? f.lanes->program.ops.total() : 0,
                    has_generic(f, compilation.setup),
                    f.signature.positive.empty() ? 1e-10 : 1e-6,
                    0};
    functions_.push_back(std::move(function));
    functions_.back().row.difference = run(functions_.size() - 1, 2);
  }
}

double Engines::run(size_t function, int engine) const {
  const Function& f = functions_[function];
  return call_(static_cast<int>(function), engine, kStates, f.pointers.data(), f.known.data());
}

}  // namespace arboc::cli
