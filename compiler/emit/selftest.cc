// NAME_selftest.cpp: the functions of the folder against recorded results.
//
// Recorded by the reference engine: results at a few states, and the configurations a small step
// before and after each on its motion, so that the rate of the kinetic energy can be compared with
// the power of the joint forces without knowing how configurations are integrated.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/number.h"
#include "emit/emit.h"
#include "emit/template.h"

namespace arboc {
namespace {

std::string cpp_name(std::string key) {
  for (char& c : key) c = c == '.' ? '_' : c;
  if (key.ends_with('-')) return key.substr(0, key.size() - 1) + "_before";
  if (key.ends_with('+')) return key.substr(0, key.size() - 1) + "_after";
  return key;
}

std::string recordings(const TargetModel& model, const std::set<std::string>& needed) {
  std::string out;
  for (const auto& [key, first] : model.recordings.front().values) {
    if (!needed.contains(key)) continue;
    out += fmt::format("const double {}[kStates][{}] = {{\n", cpp_name(key), first.size());
    for (const Recording& state : model.recordings) {
      out += "    {";
      size_t column = 5;
      for (const double x : state.values.at(key)) {
        const std::string item = literal(x) + ", ";
        if (column + item.size() > 100) {
          out += "\n     ";
          column = 5;
        }
        out += item;
        column += item.size();
      }
      out.resize(out.size() - 2);
      out += "},\n";
    }
    out += "};\n";
  }
  return out;
}

/// Calls a function; output k goes to out<k>.
std::string call(const TargetFunction& f, const std::string& model) {
  std::string arguments;
  for (const Argument& a : f.signature.inputs) arguments += a.name + "[s], ";
  for (size_t k = 0; k < f.signature.outputs.size(); ++k)
    arguments += fmt::format("{}out{}", k ? ", " : "", k);
  return fmt::format("{}::raw::{}<double>({})", model, f.signature.name, arguments);
}

/// Scatters the non-zeros of an output into `dense`.
std::string scatter(const TargetFunction& f, size_t output) {
  const Argument& a = f.signature.outputs[output];
  std::string out =
      fmt::format("    double dense{}[{}] = {{}};\n    for (int k = 0; k < {}; ++k) {{\n", output,
                  a.rows * a.cols, f.entries(output));
  const std::string at = fmt::format("sparsity::{}_{}", f.signature.name, a.name);
  const auto entry = [&](const char* row, const char* col) {
    return fmt::format("      dense{0}[{1}_{2}[k] * {3} + {1}_{4}[k]] = out{0}[k];\n", output, at,
                       row, a.cols, col);
  };
  out += entry("row", "col");
  if (a.symmetric) out += entry("col", "row");
  return out + "    }\n";
}

std::string check(const TargetModel& model, const TargetFunction& f,
                  std::set<std::string>& needed) {
  const Signature& s = f.signature;
  for (const Argument& input : s.inputs) needed.insert(input.name);
  // Forward dynamics divides by the mass matrix: its condition number enters.
  const bool solves = s.name == "aba" || s.name == "minv";
  std::string errors, states, reports;
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    const std::string key = s.name + "." + a.name;
    needed.insert(key);
    errors += fmt::format("  double {}_error = 0;\n", cpp_name(key));
    states += fmt::format("    double out{}[{}];\n", k, std::max(1, f.entries(k)));
    const std::string shown = s.outputs.size() == 1 ? s.name : key;
    // Recordings have twelve digits.
    reports += fmt::format("  report(\"{}\", {}_error, {});\n", shown, cpp_name(key),
                           literal(solves ? 1e-7 : std::max(1e-11, a.tolerance)));
  }
  states += fmt::format("    {};\n", call(f, model.name));
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    if (a.sparse) states += scatter(f, k);
    const std::string name = cpp_name(s.name + "." + a.name);
    states += fmt::format("    worst({0}_error, relative_error({1}{2}, {0}[s], {3}));\n", name,
                          a.sparse ? "dense" : "out", k, a.rows * a.cols);
  }
  return fmt::format("{}  for (int s = 0; s < kStates; ++s) {{\n{}  }}\n{}", errors, states,
                     reports);
}

/// d/dt (v^T M v / 2) = v^T (tau - g), the rate by central differences.
std::string power_check(const TargetModel& model, std::set<std::string>& needed) {
  const auto find = [&](const char* name) {
    return std::find_if(model.functions.begin(), model.functions.end(),
                        [&](const TargetFunction& f) { return f.signature.name == name; });
  };
  const auto crba = find("crba"), rnea = find("rnea"), gravity = find("gravity");
  const auto end = model.functions.end();
  if (crba == end || rnea == end || gravity == end) return "";
  for (const char* key : {"q", "v", "a", "q-", "q+"}) needed.insert(key);
  std::string out = "  // d/dt (v M v / 2) = v (tau - g), the rate by central differences.\n";
  out += fmt::format(
      "  double power_error = 0;\n  for (int s = 0; s < kStates; ++s) {{\n"
      "    const double step = {};\n    double out[{}], g[{}];\n",
      literal(model.step), std::max(crba->entries(0), model.nv), model.nv);
  out += "    const auto energy = [&](const double* at, double time) {\n";
  out += fmt::format("      {}::raw::crba<double>(at, out);\n      double sum = 0;\n", model.name);
  out += fmt::format("      for (int k = 0; k < {}; ++k) {{\n", crba->entries(0));
  out +=
      "        const int i = sparsity::crba_M_row[k], j = sparsity::crba_M_col[k];\n"
      "        sum += (i == j ? 0.5 : 1.0) * out[k] * (v[s][i] + time * a[s][i]) * (v[s][j] + time "
      "* a[s][j]);\n"
      "      }\n      return sum;\n    };\n";
  out +=
      "    const double rate = (energy(q_after[s], step) - energy(q_before[s], -step)) / (2 * "
      "step);\n";
  out += fmt::format(
      "    {0}::raw::rnea<double>(q[s], v[s], a[s], out);\n    {0}::raw::gravity<double>(q[s], "
      "g);\n",
      model.name);
  out += fmt::format(
      "    double power = 0, scale = 1e-9;\n    for (int i = 0; i < {}; ++i) {{\n"
      "      power += v[s][i] * (out[i] - g[i]);\n"
      "      scale += std::fabs(v[s][i] * (out[i] - g[i]));\n    }}\n",
      model.nv);
  return out +
         "    worst(power_error, std::fabs(rate - power) / scale);\n  }\n"
         "  report(\"power, by differences\", power_error, 1e-6);\n";
}

}  // namespace

std::string selftest(const TargetModel& model) {
  std::set<std::string> needed;
  std::string checks;
  for (const TargetFunction& f : model.functions) checks += check(model, f, needed);
  checks += power_check(model, needed);
  const bool sparse = checks.find("sparsity::") != std::string::npos;
  if (sparse) checks = fmt::format("  namespace sparsity = {}::sparsity;\n", model.name) + checks;
  return fill("cpp/NAME_selftest.cpp", {{"banner", banner(model)},
                                        {"name", model.name},
                                        {"states", fmt::format("{}", model.recordings.size())},
                                        {"recordings", recordings(model, needed)},
                                        {"checks", checks}});
}

}  // namespace arboc
