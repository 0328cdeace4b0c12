// arboc bench MODEL: generated against generic dynamics, timed in one translation unit.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/number.h"
#include "cli/bench.h"
#include "cli/build.h"
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
        "{4}, {5});\n        if (!(d{0} <= result[2])) result[2] = d{0};\n",
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
      "      for (int s = 0; s < states; ++s) {\n"
      "        generated_call(s, out.data());\n";
  out += generic ? "        generic_call(s, reference.data());\n"
                   "        const double* const expected = reference.data();\n"
                 : fmt::format("        const double* const expected = known + s * {};\n", offset);
  return out + compare_text(model, f) +
         fmt::format(
             "      }}\n      measure(states, out.data(), generated_call, {}, plain_call,\n"
             "              &result[0], &result[1], &result[3]);\n      break;\n    }}\n",
             generic ? "generic_call" : "generated_call");
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

Samples samples(const CompiledFunction& f, const Setup& setup, int states) {
  Samples result;
  result.inputs.resize(f.signature.inputs.size());
  StateSource source(7);
  for (int s = 0; s < states; ++s) {
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

std::vector<BenchRow> time_generic(const Common& common, const Compilation& compilation,
                                   const TargetModel& target) {
  const TemporaryFolder folder;
  Files files;
  for (const auto& [path, bytes] : emit(target)) files[target.name + "/" + path] = bytes;
  for (const std::string& name : embedded_names("generic/")) files[name.substr(8)] = embedded(name);
  for (const char* header : {"arboc/math.hpp", "arboc/scalar.hpp"})
    files[header] = embedded(fmt::format("runtime/{}", header));
  files["driver.cpp"] = driver(target, compilation);
  const Library library(build_library(common, folder.path(), files, {"driver.cpp"}));

  constexpr int kStates = 32;
  using Bench = void (*)(int, int, const double* const*, const double*, double*);
  const auto bench = reinterpret_cast<Bench>(library.symbol("arboc_bench"));
  std::vector<BenchRow> rows;
  for (size_t k = 0; k < target.functions.size(); ++k) {
    const CompiledFunction& f = compilation.functions[k];
    progress(static_cast<int>(k) + 1, static_cast<int>(target.functions.size()),
             "timing " + f.signature.name);
    const Samples in = samples(f, compilation.setup, kStates);
    std::vector<const double*> pointers;
    for (const auto& x : in.inputs) pointers.push_back(x.data());
    double result[4];
    bench(static_cast<int>(k), kStates, pointers.data(), in.known.data(), result);
    // Forward dynamics amplifies rounding by the condition of M.
    rows.push_back({f.signature.name, result[0], has_generic(f, compilation.setup) ? result[1] : 0,
                    f.lanes ? result[3] : 0, result[2], f.program.ops.total(),
                    f.lanes ? f.lanes->program.ops.total() : 0,
                    f.signature.positive.empty() ? 1e-10 : 1e-6});
  }
  progress_done();
  return rows;
}

int run_bench(const Common& common) {
  CompileOptions options = common.compile;
  options.requests = requests(common);
  const Compilation compilation = compiled(common, options);
  const std::vector<BenchRow> rows =
      time_generic(common, compilation, target(compilation, options));
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  if (!common.json)
    fmt::print("{:<30} {:>10} {:>8} {:>14} {:>12} {:>12} {:>7} {:>12}\n", "function", "operations",
               "in lanes", "generated ns", "plain ns", "generic ns", "ratio", "difference");
  bool agree = true;
  for (const BenchRow& row : rows) {
    agree = agree && row.difference <= row.allowed;
    const bool compared = row.generic > 0;
    if (common.json) {
      json.push_back({{"function", row.function},
                      {"generated_ns", row.generated},
                      {"difference", row.difference},
                      {"operations", row.ops}});
      if (row.plain > 0) json.back()["plain_ns"] = row.plain;
      if (row.plain > 0) json.back()["operations_in_lanes"] = row.lane_ops;
      if (compared) json.back()["generic_ns"] = row.generic;
      if (compared) json.back()["ratio"] = row.generic / row.generated;
    } else {
      fmt::print("{:<30} {:>10} {:>8} {:>14.1f} {:>12} {:>12} {:>7} {:>12.1e}\n", row.function,
                 row.ops, row.plain > 0 ? fmt::format("{}", row.lane_ops) : "-", row.generated,
                 row.plain > 0 ? fmt::format("{:.1f}", row.plain) : "-",
                 compared ? fmt::format("{:.1f}", row.generic) : "-",
                 compared ? fmt::format("{:.2f}", row.generic / row.generated) : "-",
                 row.difference);
    }
  }
  if (common.json) fmt::print("{}\n", dump(json, 1));
  flush_stdout();
  if (!agree) fmt::print(stderr, "error: generated and generic results differ\n");
  return agree ? kOk : kNo;
}

}  // namespace arboc::cli
