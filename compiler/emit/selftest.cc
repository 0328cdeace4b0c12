// NAME_selftest.cpp: the functions of the folder against recorded results.
//
// Recorded by the reference engine: results at a few states, and the configurations a small step
// before and after each on its motion, so that the rate of the kinetic energy can be compared with
// the power of the joint forces without knowing how configurations are integrated.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/// `const double NAME[kStates][n] = {...};`, a row a state.
std::string table(const std::string& name, const std::vector<std::vector<double>>& states) {
  std::string out = fmt::format("const double {}[kStates][{}] = {{\n", name, states.front().size());
  for (const std::vector<double>& state : states) {
    out += "    {";
    size_t column = 5;
    for (const double x : state) {
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
  return out + "};\n";
}

/// What is recorded under a key in a state.
const std::vector<double>& recorded(const Recording& state, const std::string& key) {
  const auto projections = state.projections.find(key);
  return projections != state.projections.end() ? projections->second : state.values.at(key);
}

std::string recordings(const TargetModel& model, const std::set<std::string>& needed) {
  std::string out;
  for (const std::string& key : needed) {
    std::vector<std::vector<double>> states;
    for (const Recording& state : model.recordings) states.push_back(recorded(state, key));
    out += table(cpp_name(key), states);
  }
  return out;
}

/// Under what an input is recorded.
std::string key_of(const TargetFunction& f, const Argument& input) {
  return input.name == "lambda" ? f.signature.name + ".lambda" : input.name;
}

/// Calls a function; output k goes to out<k>.
std::string call(const TargetFunction& f, const std::string& model) {
  std::string arguments;
  for (const Argument& a : f.signature.inputs) arguments += cpp_name(key_of(f, a)) + "[s], ";
  for (size_t k = 0; k < f.signature.outputs.size(); ++k)
    arguments += fmt::format("{}out{}.data()", k ? ", " : "", k);
  return fmt::format("{}::raw::{}<double>({})", model, f.signature.name, arguments);
}

/// Compares output k of a state with what was recorded.
std::string compare(const TargetModel& model, const TargetFunction& f, size_t k) {
  const Argument& a = f.signature.outputs[k];
  const std::string name = cpp_name(f.signature.name + "." + a.name);
  std::string out, dense = fmt::format("out{}", k);
  if (a.sparse) {
    dense = fmt::format("dense{}", k);
    out += fmt::format(
        "    std::vector<double> {}({});\n    {}::raw::scatter_{}_{}(out{}.data(), {}.data());\n",
        dense, a.rows * a.cols, model.name, f.signature.name, a.name, k, dense);
  }
  if (!model.recordings.front().projections.contains(f.signature.name + "." + a.name))
    return out + fmt::format("    worst({0}_error, relative_error({1}, {0}[s]));\n", name, dense);
  const int side = a.symmetric ? 0 : 1;
  return out + fmt::format("    worst({0}_error, error_of_projections({1}, {2}, {3}, {0}[s]));\n",
                           name, dense, a.cols, side);
}

double largest(const Recording& state, const std::string& key) {
  double result = 0;
  for (const double x : recorded(state, key)) result = std::max(result, std::fabs(x));
  return result;
}

/// Of output k relative to its largest number: recordings have twelve digits, and where they are
/// known to a part of the largest number of all outputs only, that much.
std::string tolerance(const TargetModel& model, const TargetFunction& f, size_t k) {
  const Signature& s = f.signature;
  // Forward dynamics divides by the mass matrix: its condition number enters.
  if (!s.positive.empty()) return literal(std::max(1e-7, s.outputs[k].tolerance));
  if (s.outputs[k].tolerance < kDifferencedTwice)
    return literal(std::max(1e-11, s.outputs[k].tolerance));
  double ratio = 1;
  for (const Recording& state : model.recordings) {
    double all = 0;
    for (const Argument& a : s.outputs) all = std::max(all, largest(state, s.name + "." + a.name));
    ratio = std::max(ratio, all / std::max(1e-9, largest(state, s.name + "." + s.outputs[k].name)));
  }
  return fmt::format("{:.0e}", kDifferencedTwice * ratio);
}

std::string check(const TargetModel& model, const TargetFunction& f,
                  std::set<std::string>& needed) {
  const Signature& s = f.signature;
  for (const Argument& input : s.inputs) needed.insert(key_of(f, input));
  const bool solves = !s.positive.empty();
  std::string errors, states, reports;
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    const std::string key = s.name + "." + a.name;
    needed.insert(key);
    errors += fmt::format("  double {}_error = 0;\n", cpp_name(key));
    states += fmt::format("    std::vector<double> out{}({});\n", k, std::max(1, f.entries(k)));
    const std::string shown = s.outputs.size() == 1 ? s.name : key;
    reports += fmt::format("  report(\"{}\", {}_error, {});\n", shown, cpp_name(key),
                           tolerance(model, f, k));
  }
  const std::string run = call(f, model.name);
  states +=
      solves ? fmt::format("    if ({} != 0) ++failures;\n", run) : fmt::format("    {};\n", run);
  for (size_t k = 0; k < s.outputs.size(); ++k) states += compare(model, f, k);
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
  // Wrenches and what joints add by themselves have a power of their own.
  if (!model.load_names.empty() || !model.joint_forces.empty()) return "";
  std::string numbers;
  for (const ParameterTable& p : model.parameters) numbers += p.name + "[s], ";
  for (const char* key : {"q", "v", "a", "q-", "q+"}) needed.insert(key);
  std::string out = "  // d/dt (v M v / 2) = v (tau - g), the rate by central differences.\n";
  out += fmt::format(
      "  double power_error = 0;\n  for (int s = 0; s < kStates; ++s) {{\n"
      "    const double step = {};\n    double out[{}], g[{}];\n",
      literal(model.step), std::max(crba->entries(0), model.nv), model.nv);
  out += "    const auto energy = [&](const double* at, double time) {\n";
  out += fmt::format("      {}::raw::crba<double>(at, {}out);\n      double sum = 0;\n", model.name,
                     numbers);
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
      "    {0}::raw::rnea<double>(q[s], v[s], a[s], {1}out);\n    {0}::raw::gravity<double>(q[s], "
      "{1}g);\n",
      model.name, numbers);
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
