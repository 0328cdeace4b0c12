// arboc bench MODEL: generated against generic dynamics, timed in one translation unit.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/number.h"
#include "cli/build.h"
#include "cli/common.h"
#include "emit/emit.h"
#include "emit/names.h"
#include "emit/template.h"
#include "record.h"

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
  constexpr const char* kMotions[] = {"kWorld", "kRevolute", "kPrismatic", "kPlanar", "kFloating"};
  for (const BodyOf<double>& b : tree.body) {
    const Symmetric3<double>& S = b.inertia.Sigma;
    out += fmt::format(
        "  tree.body.push_back({{{{\"\", \"\", {}, Motion::{}, {}, {}, {}, {}, {}, {}, {}}}, {},\n"
        "                       {{{}, {}, {{{}, {}, {}, {}, {}, {}}}}},\n"
        "                       {{{}, {}, {}, {}, {}}}}});\n",
        b.parent, kMotions[static_cast<int>(b.motion)], text(b.gamma), text(b.alpha), text(b.theta),
        b.q, b.v, literal(b.multiplier), literal(b.offset), text(b.c), literal(b.inertia.m),
        text(b.inertia.h), literal(S.xx), literal(S.yy), literal(S.zz), literal(S.xy),
        literal(S.xz), literal(S.yz), literal(b.forces.damping), literal(b.forces.friction),
        literal(b.forces.stiffness), literal(b.forces.neutral), literal(b.forces.rotor));
  }
  for (const FrameOf<double>& f : tree.frame) {
    if (!f.moving) continue;
    const auto& R = f.R;
    out += fmt::format(
        "  tree.frame.push_back({{\"\", {}, {{{{{{{}, {}, {}}}, {{{}, {}, {}}}, {{{}, {}, "
        "{}}}}}}}, {}, true}});\n",
        f.body, literal(R(0, 0)), literal(R(0, 1)), literal(R(0, 2)), literal(R(1, 0)),
        literal(R(1, 1)), literal(R(1, 2)), literal(R(2, 0)), literal(R(2, 1)), literal(R(2, 2)),
        text(f.p));
  }
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

std::string case_text(const std::string& model, size_t index, const TargetFunction& f) {
  const Signature& s = f.signature;
  std::string arguments, compare;
  for (const Argument& a : s.inputs)
    arguments += fmt::format("{} + s * {}, ", a.name, a.name == "q" ? "nq" : "nv");
  int offset = 0;
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    const std::string at = fmt::format("{}::sparsity::{}_{}", model, s.name, a.name);
    arguments += fmt::format("{}y + {}", k ? ", " : "", offset);
    compare += fmt::format(
        "        const double d{0} = difference(out.data() + {1}, expected.data() + {1}, {2}, {3}, "
        "{4}, {5});\n        if (!(d{0} <= result[2])) result[2] = d{0};\n",
        k, offset, f.entries(k), a.sparse ? at + "_row" : "nullptr",
        a.sparse ? at + "_col" : "nullptr", a.cols);
    offset += a.rows * a.cols;
  }
  std::string out = fmt::format("    case {}: {{\n", index);
  out += fmt::format(
      "      const auto generated_call = [&](int s, double* y) {{ {}::raw::{}<double>({}); }};\n",
      model, s.name, arguments);
  out +=
      fmt::format("      const auto generic_call = [&](int s, double* y) {{ generic.{}({}); }};\n",
                  s.name, arguments);
  out +=
      "      for (int s = 0; s < states; ++s) {\n"
      "        generated_call(s, out.data());\n        generic_call(s, expected.data());\n";
  return out + compare +
         "      }\n      measure(states, out.data(), generated_call, generic_call, &result[0], "
         "&result[1]);\n      break;\n    }\n";
}

std::string driver(const TargetModel& target, const DynamicTree& tree) {
  std::string includes, cases;
  int size = 1;
  for (size_t k = 0; k < target.functions.size(); ++k) {
    const TargetFunction& f = target.functions[k];
    includes += fmt::format("#include \"{0}/{0}_{1}_double.cpp\"\n", target.name, f.signature.name);
    cases += case_text(target.name, k, f);
    size = std::max(size, dense_size(f.signature));
  }
  return fill("bench/driver.cpp", {{"name", target.name},
                                   {"includes", includes},
                                   {"tree", tree_text(tree)},
                                   {"size", fmt::format("{}", size)},
                                   {"cases", cases}});
}

struct Row {
  std::string function;
  double generated = 0, generic = 0, difference = 0;
  int ops = 0;
};

std::vector<Row> time(const Common& common, const Model& model, const TargetModel& target) {
  const TemporaryFolder folder;
  Files files;
  for (const auto& [path, bytes] : emit_cpp(target)) files[target.name + "/" + path] = bytes;
  for (const std::string& name : embedded_names("generic/")) files[name.substr(8)] = embedded(name);
  files["arboc/scalar.hpp"] = embedded("runtime/arboc/scalar.hpp");
  files["driver.cpp"] = driver(target, lower(model, {FrameChoice::kAxis, true}));
  const Library library(build_library(common, folder.path(), files, {"driver.cpp"}));

  constexpr int kStates = 32;
  std::vector<double> q, v, a, tau;
  StateSource source(7);
  for (int s = 0; s < kStates; ++s) {
    const State state = source.next(model);
    q.insert(q.end(), state.q.begin(), state.q.end());
    v.insert(v.end(), state.v.begin(), state.v.end());
    a.insert(a.end(), state.a.begin(), state.a.end());
    tau.insert(tau.end(), state.tau.begin(), state.tau.end());
  }
  using Bench =
      void (*)(int, int, const double*, const double*, const double*, const double*, double*);
  const auto bench = reinterpret_cast<Bench>(library.symbol("arboc_bench"));
  std::vector<Row> rows;
  for (size_t k = 0; k < target.functions.size(); ++k) {
    progress(static_cast<int>(k) + 1, static_cast<int>(target.functions.size()),
             "timing " + target.functions[k].signature.name);
    double result[3];
    bench(static_cast<int>(k), kStates, q.data(), v.data(), a.data(), tau.data(), result);
    rows.push_back({target.functions[k].signature.name, result[0], result[1], result[2],
                    target.functions[k].program.ops.total()});
  }
  progress_done();
  return rows;
}

}  // namespace

int run_bench(const Common& common) {
  CompileOptions options = common.compile;
  options.functions = function_list(common.functions);
  const Compilation compilation = compiled(common, options);
  const std::vector<Row> rows = time(common, compilation.model, target(compilation, options));
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  if (!common.json)
    fmt::print("{:<16} {:>10} {:>14} {:>12} {:>7} {:>12}\n", "function", "operations",
               "generated ns", "generic ns", "ratio", "difference");
  bool agree = true;
  for (const Row& row : rows) {
    // Forward dynamics amplifies rounding by the condition of M.
    const bool solves = row.function == "aba" || row.function == "minv";
    agree = agree && row.difference <= (solves ? 1e-6 : 1e-10);
    if (common.json)
      json.push_back({{"function", row.function},
                      {"generated_ns", row.generated},
                      {"generic_ns", row.generic},
                      {"ratio", row.generic / row.generated},
                      {"difference", row.difference},
                      {"operations", row.ops}});
    else
      fmt::print("{:<16} {:>10} {:>14.1f} {:>12.1f} {:>7.2f} {:>12.1e}\n", row.function, row.ops,
                 row.generated, row.generic, row.generic / row.generated, row.difference);
  }
  if (common.json) fmt::print("{}\n", json.dump(1));
  flush_stdout();
  if (!agree) fmt::print(stderr, "error: generated and generic results differ\n");
  return agree ? kOk : kNo;
}

}  // namespace arboc::cli
