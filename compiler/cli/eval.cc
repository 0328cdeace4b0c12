// arboc eval MODEL --function F --q FILE ...: numbers in, numbers out, by any engine.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

#include "base/words.h"
#include "cli/build.h"
#include "cli/common.h"
#include "cli/csv.h"
#include "passes/dead.h"
#include "truth.h"

namespace arboc::cli {
namespace {

/// The option that gives an input.
std::string option_of(const std::string& input) {
  for (const char* own : {"q", "v", "a", "tau", "q1", "lambda"})
    if (input == own) return fmt::format("--{}", input);
  return input == "f_ext" ? "--f-ext" : fmt::format("--input {}=FILE", input);
}

/// A file for what is no input.  q, v, a and tau are left unread, so that one command line serves
/// every function; any other name is a mistake.
void refuse_or_note(const std::string& name, const std::string& file, const Signature& s) {
  for (const char* common : {"q", "v", "a", "tau"}) {
    if (name != common) continue;
    fmt::print(stderr, "note: {} is no input of {}; {} is not read\n", name, s.name,
               printable(file));
    return;
  }
  if (name == "f_ext")
    throw UsageError(fmt::format(
        "--f-ext: {} has no input f_ext (of rnea, nle, aba and their derivatives it is one where "
        "--external-forces names links)",
        s.name));
  std::vector<std::string_view> known;
  for (const Argument& a : s.inputs) known.emplace_back(a.name);
  const bool own = option_of(name).find(' ') == std::string::npos;
  throw UsageError(
      unknown(own ? option_of(name) : "--input", s.name + " has no input", name, known));
}

/// Which inputs the printed outputs depend on.
std::vector<bool> used_inputs(const CompiledFunction& f, const std::string& output) {
  Graph graph = f.graph;
  for (size_t k = 0; k < f.signature.outputs.size(); ++k)
    if (!output.empty() && f.signature.outputs[k].name != output)
      graph.regions.back().results[k].clear();
  graph = remove_dead(graph);
  const Region& region = graph.regions.back();
  std::vector<bool> used(f.signature.inputs.size(), false);
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

/// What an input is that no file gives: a parameter's own value, else zero if it is not needed.
std::vector<double> missing(const Argument& a, bool used, const Compilation& compilation) {
  for (const Parameter& p : compilation.setup.parameters)
    if (p.name == a.name) return p.nominal;
  if (used)
    throw UsageError(fmt::format("{} (an input of {}) is required", option_of(a.name),
                                 compilation.functions.front().signature.name));
  return std::vector<double>(static_cast<size_t>(a.rows), 0.0);
}

/// The states of the given files; a file of one line serves all states.
std::vector<Values> read_states(const EvalOptions& options, const Compilation& compilation) {
  const CompiledFunction& f = compilation.functions.front();
  const std::vector<bool> used = used_inputs(f, options.output);
  std::map<std::string, std::vector<std::vector<double>>> rows;
  size_t states = 1;
  for (const auto& [name, file] : options.files)
    if (std::none_of(f.signature.inputs.begin(), f.signature.inputs.end(),
                     [&name = name](const Argument& a) { return a.name == name; }))
      refuse_or_note(name, file, f.signature);
  for (size_t k = 0; k < f.signature.inputs.size(); ++k) {
    const Argument& a = f.signature.inputs[k];
    const auto file = options.files.find(a.name);
    if (file == options.files.end()) {
      rows[a.name] = {missing(a, used[k], compilation)};
      continue;
    }
    rows[a.name] = read_csv(file->second, a.rows, a.name);
    const size_t n = rows[a.name].size();
    if (n == 0) throw InputError(fmt::format("{}: error: no states", printable(file->second)));
    if (n != 1 && states != 1 && n != states)
      throw InputError(fmt::format("{}: error: {} states, but {} in the files before it",
                                   printable(file->second), n, states));
    states = std::max(states, n);
  }
  std::vector<Values> result(states);
  for (size_t s = 0; s < states; ++s)
    for (const auto& [name, all] : rows) result[s][name] = all.size() == 1 ? all[0] : all[s];
  return result;
}

void warn_about_quaternions(const Model& model, const std::vector<Values>& states) {
  const Coordinates at = coordinates(model);
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const int quaternion = quaternion_at(model.joints[k].type);
    if (quaternion < 0) continue;
    const auto first = static_cast<size_t>(at.joint[k].q + quaternion);
    for (size_t s = 0; s < states.size(); ++s) {
      double norm2 = 0;
      for (size_t i = first; i < first + 4; ++i) norm2 += std::pow(states[s].at("q")[i], 2);
      if (std::fabs(norm2 - 1) < 1e-9) continue;
      fmt::print(
          stderr,
          "warning: joint '{}': state {}: quaternion of length {} (x y z w of length 1 expected)\n",
          printable(model.joints[k].name), s + 1, std::sqrt(norm2));
      break;
    }
  }
}

using Evaluate = std::function<Values(const Values&)>;

Evaluate make_engine(const std::string& name, const Common& common, const CompileOptions& options,
                     const Compilation& compilation) {
  const CompiledFunction& f = compilation.functions.front();
  const std::string function = f.signature.name;
  const Setup& setup = compilation.setup;
  if (name == "reference")
    return [&](const Values& in) { return evaluate_reference(f.request, setup, in); };
  if (name == "generic")
    return [&](const Values& in) { return evaluate_generic(f.request, setup, f.lowering, in); };
  const auto code = std::make_shared<GeneratedCode>(common, target(compilation, options));
  return [code, function](const Values& in) { return code->call(function, in); };
}

}  // namespace

int run_eval(const Common& common, const EvalOptions& eval) {
  CompileOptions options = common.compile;
  if (!eval.function.empty()) check_function("--function", eval.function);
  if (!eval.function.empty())
    options.requests.insert(options.requests.begin(), Request{eval.function});
  if (options.requests.size() != 1)
    throw UsageError(
        fmt::format("eval evaluates one thing: --function F, or one derivative of an output; {}",
                    options.requests.empty() ? "none is given" : "several are given"));
  const Compilation compilation = compiled(common, options);
  const CompiledFunction& f = compilation.functions.front();
  std::vector<std::string_view> outputs;
  for (const Argument& a : f.signature.outputs) outputs.emplace_back(a.name);
  if (!eval.output.empty() &&
      std::find(outputs.begin(), outputs.end(), eval.output) == outputs.end())
    throw UsageError(
        unknown("--output", f.signature.name + " has no output", eval.output, outputs));
  const std::vector<Values> states = read_states(eval, compilation);
  if (states.front().contains("q")) warn_about_quaternions(compilation.setup.model, states);
  const Evaluate engine = make_engine(eval.engine, common, options, compilation);
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
