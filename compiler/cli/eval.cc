// arboc eval MODEL --function F --q FILE ...: numbers in, numbers out, by any engine.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

#include "cli/build.h"
#include "cli/common.h"
#include "cli/csv.h"
#include "record.h"

namespace arboc::cli {
namespace {

/// Which inputs the traced function depends on.
std::vector<bool> used_inputs(const CompiledFunction& f) {
  std::vector<bool> used(f.signature.inputs.size(), false);
  const Region& region = f.graph.regions.back();
  const auto use = [&](Ref ref) {
    const Node& node = region[ref];
    if (node.op != Op::kInput) return;
    size_t port = 0;
    int index = static_cast<int>(node.index);
    while (index >= region.inputs[port].size) index -= region.inputs[port++].size;
    used[port] = true;
  };
  for (const Node& node : region.nodes) for_each_operand(region, node, use);
  for (const auto& results : region.results)
    for (const Ref ref : results) use(ref);
  return used;
}

/// The states of the given files; an input that is not given and not needed is zero.
std::vector<Values> read_states(const EvalOptions& options, const CompiledFunction& f) {
  const std::map<std::string, std::string> files{
      {"q", options.q}, {"v", options.v}, {"a", options.a}, {"tau", options.tau}};
  const std::vector<bool> used = used_inputs(f);
  std::vector<Values> states;
  for (size_t k = 0; k < f.signature.inputs.size(); ++k) {
    const Argument& a = f.signature.inputs[k];
    const std::string& file = files.at(a.name);
    if (file.empty() && used[k])
      throw UsageError(fmt::format("--{} (an input of {}) is required", a.name, f.signature.name));
    if (file.empty()) continue;
    const auto rows = read_csv(file, a.rows);
    if (states.empty()) states.resize(rows.size());
    if (rows.size() != states.size())
      throw InputError(fmt::format("{}: error: {} states, but {} in the files before it",
                                   printable(file), rows.size(), states.size()));
    for (size_t s = 0; s < rows.size(); ++s) states[s][a.name] = rows[s];
  }
  if (states.empty()) states.resize(1);
  for (Values& state : states)
    for (const Argument& a : f.signature.inputs)
      state.try_emplace(a.name, static_cast<size_t>(a.rows), 0.0);
  return states;
}

void warn_about_quaternions(const Model& model, const std::vector<Values>& states) {
  const Coordinates at = coordinates(model);
  for (size_t k = 0; k < model.joints.size(); ++k) {
    if (model.joints[k].type != JointType::kFloating) continue;
    for (size_t s = 0; s < states.size(); ++s) {
      double norm2 = 0;
      for (size_t i = 3; i < 7; ++i)
        norm2 += std::pow(states[s].at("q")[static_cast<size_t>(at.joint[k].q) + i], 2);
      if (std::fabs(norm2 - 1) < 1e-9) continue;
      fmt::print(
          stderr,
          "warning: joint '{}': state {}: quaternion of length {} (x y z w of length 1 expected)\n",
          printable(model.joints[k].name), s + 1, std::sqrt(norm2));
      break;
    }
  }
}

using Engine = std::function<Values(const Values&)>;

Engine make_engine(const std::string& name, const Common& common, const CompileOptions& options,
                   const Compilation& compilation) {
  const CompiledFunction& f = compilation.functions.front();
  const std::string function = f.signature.name;
  if (name == "reference") {
    const auto reference = std::make_shared<Reference>(compilation.model);
    return [&model = compilation.model, reference, function](const Values& in) {
      return evaluate_reference(function, model, *reference, in);
    };
  }
  if (name == "generic")
    return [&f, function](const Values& in) { return evaluate_generic(function, f.tree, in); };
  const auto code = std::make_shared<GeneratedCode>(common, target(compilation, options));
  return [code, function](const Values& in) { return code->call(function, in); };
}

}  // namespace

int run_eval(const Common& common, const EvalOptions& eval) {
  CompileOptions options = common.compile;
  if (!is_function(eval.function)) unknown_function("--function", eval.function);
  options.functions = {eval.function};
  const Compilation compilation = compiled(common, options);
  const CompiledFunction& f = compilation.functions.front();
  std::vector<std::string> outputs;
  for (const Argument& a : f.signature.outputs) outputs.push_back(a.name);
  if (!eval.output.empty() &&
      std::find(outputs.begin(), outputs.end(), eval.output) == outputs.end())
    throw UsageError(fmt::format("--output: {} has no output '{}', but {}", eval.function,
                                 printable(eval.output), fmt::join(outputs, ", ")));
  const std::vector<Values> states = read_states(eval, f);
  if (states.front().contains("q")) warn_about_quaternions(compilation.model, states);
  const Engine engine = make_engine(eval.engine, common, options, compilation);
  for (const Values& state : states) {
    check_interrupt();
    const Values results = engine(state);
    std::vector<double> line;
    for (const Argument& a : f.signature.outputs) {
      if (!eval.output.empty() && a.name != eval.output) continue;
      const auto& values = results.at(a.name);
      line.insert(line.end(), values.begin(), values.end());
    }
    const std::string text = csv_line(line);
    std::fwrite(text.data(), 1, text.size(), stdout);
  }
  flush_stdout();
  return kOk;
}

}  // namespace arboc::cli
