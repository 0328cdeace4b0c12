// arboc compile MODEL -o DIR: writes DIR/NAME/.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/words.h"
#include "cli/common.h"
#include "cli/output.h"
#include "emit/emit.h"
#include "functions/lane_trace.h"

namespace arboc::cli {
namespace {

/// The groups, and what is done with them.
void print_limbs(const Setup& setup, const CompiledFunction& f) {
  const LoweringOptions& lowering = f.lanes ? f.lanes->lowering : f.lowering;
  fmt::print("# {}\n{}", f.signature.name,
             print(lower(setup, lowering), limbs_in_lanes(setup, lowering)));
  if (f.lanes) fmt::print("{}{}", print(f.lanes->graph), print(f.lanes->program));
}

void print_stage(const Compilation& compilation, const std::string& stage) {
  if (stage == "model") fmt::print("{}", print(compilation.setup.model));
  if (stage == "tree") {
    for (const CompiledFunction& f : compilation.functions)
      fmt::print("# {}\n{}", f.signature.name, print(lower(compilation.setup, f.lowering)));
  }
  for (const CompiledFunction& f : compilation.functions) {
    if (stage == "graph") fmt::print("{}", print(f.graph));
    if (stage == "program") fmt::print("{}", print(f.program));
    if (stage == "limbs") print_limbs(compilation.setup, f);
  }
}

/// "double", "float8": a pack of 8 floats.
Scalar parse_scalar(const std::string& word) {
  for (const char* base : {"double", "float"})
    for (const int lanes : {1, 2, 4, 8, 16})
      if (word == base + (lanes > 1 ? std::to_string(lanes) : "")) return {word, base, lanes};
  throw CLI::ValidationError(
      "--scalars",
      "expected double or float, with 2, 4, 8 or 16 behind it of packs, not " + printable(word));
}

}  // namespace

void add_scalar_option(CLI::App& app, Common& common) {
  app.add_option_function<std::string>(
         "--scalars",
         [&common](const std::string& list) {
           std::vector<Scalar> scalars{Scalar{}};
           for (const std::string& word : split(list))
             if (word != "double") scalars.push_back(parse_scalar(word));
           common.compile.scalars = scalars;
         },
         "translation units of each function besides that for double: float, or packs, double8, "
         "float16")
      ->type_name("LIST")
      ->group("Functions");
}

int run_compile(const Common& common, const std::string& out, const std::string& stage) {
  CompileOptions options = common.compile;
  options.requests = requests(common);
  if (stage == "model" && out.empty()) {  // also of a model that cannot be compiled
    Diagnostics diagnostics;
    const Model model = configured(common, read(common, diagnostics), diagnostics);
    print_diagnostics(diagnostics, common, common.verbose);
    fmt::print("{}", print(model));
    flush_stdout();
    return kOk;
  }
  const Compilation compilation = compiled(common, options);
  print_stage(compilation, stage);
  if (!out.empty()) {
    const TargetModel target = arboc::target(compilation, options);
    check_interrupt();
    write_folder(out, target.name, emit(target));
    if (stage.empty()) {
      fmt::print("{}/{}\n", out, target.name);
      for (const TargetFunction& f : target.functions)
        fmt::print("  {:<30} {:6} operations, {:3} sincos{}\n", f.signature.name,
                   f.program.ops.total(), f.program.ops.sincos,
                   f.lanes ? fmt::format("; in lanes {}", f.lanes->program.ops.total()) : "");
    }
  }
  flush_stdout();
  return kOk;
}

}  // namespace arboc::cli
