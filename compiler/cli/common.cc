#include "cli/common.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <sstream>

#include "frontend/read_model.h"

namespace arboc::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

void catch_interrupt() {
  std::signal(SIGINT, [](int) { interrupted = 1; });
  std::signal(SIGTERM, [](int) { interrupted = 1; });
}

void check_interrupt() {
  if (interrupted) throw Interrupted();
}

void add_model_options(CLI::App& app, Common& common) {
  app.add_option("model", common.path, "the model file (URDF)")->required()->type_name("MODEL");
  ModelOptions& m = common.compile.model;
  const std::map<std::string, Base> bases{{"fixed", Base::kFixed}, {"floating", Base::kFloating}};
  const std::map<std::string, MimicPolicy> mimics{{"follow", MimicPolicy::kFollow},
                                                  {"independent", MimicPolicy::kIndependent}};
  const std::map<std::string, JointOrder> orders{{"file", JointOrder::kFile},
                                                 {"alphabetical", JointOrder::kAlphabetical}};
  app.add_option("--base", m.base, "how the root link is attached to the world")
      ->transform(CLI::CheckedTransformer(bases).description("fixed|floating"))
      ->default_str("fixed")
      ->type_name("")
      ->group("Model");
  app.add_option("--mimic", m.mimic, "what mimic joints do")
      ->transform(CLI::CheckedTransformer(mimics).description("follow|independent"))
      ->default_str("follow")
      ->type_name("")
      ->group("Model");
  app.add_option("--joint-order", m.order, "order among siblings; alphabetical is Pinocchio's")
      ->transform(CLI::CheckedTransformer(orders).description("file|alphabetical"))
      ->default_str("file")
      ->type_name("")
      ->group("Model");
  app.add_option("--name", m.name, "name of the generated code (default: the model's, sanitised)")
      ->type_name("NAME")
      ->group("Model");
  app.add_option("--snap", m.snap,
                 "written angles this close (rad) to a multiple of 15 degrees become it; 0 is off")
      ->check(CLI::Range(0.0, 0.1))
      ->capture_default_str()
      ->type_name("TOL")
      ->group("Model");
  app.add_option("--max-dof", common.compile.max_dof, "refuse to trace larger models")
      ->check(CLI::PositiveNumber)
      ->capture_default_str()
      ->type_name("N")
      ->group("Model");
  app.add_flag("--strict", common.strict, "take warnings as errors");
  app.add_flag("-v,--verbose", common.verbose, "print each note, and the compiler's command line");
}

void add_function_option(CLI::App& app, Common& common) {
  std::string names;
  for (const std::string& name : function_names()) names += (names.empty() ? "" : ",") + name;
  app.add_option("--functions", common.functions, "comma-separated list of " + names + ", or all")
      ->capture_default_str()
      ->type_name("LIST");
}

void add_compiler_options(CLI::App& app, Common& common) {
  app.add_option("--cxx", common.cxx, "C++ compiler (default: $CXX, then c++)")
      ->type_name("COMMAND")
      ->group("Compiler");
  app.add_option("--cxxflags", common.cxxflags, "its flags")
      ->capture_default_str()
      ->type_name("FLAGS")
      ->group("Compiler");
}

std::vector<std::string> function_list(const std::string& text) {
  if (text == "all") return function_names();
  std::vector<std::string> names;
  std::istringstream list(text);
  for (std::string name; std::getline(list, name, ',');) {
    if (!is_function(name)) {
      std::string known;
      for (const std::string& n : function_names()) known += " " + n;
      throw CLI::ValidationError(
          "--functions", fmt::format("unknown function '{}'; known are{}", printable(name), known));
    }
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.empty()) throw CLI::ValidationError("--functions", "the list is empty");
  return names;
}

void print_diagnostics(const Diagnostics& diagnostics, bool notes) {
  int hidden = 0;
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity == Severity::kNote && !notes)
      ++hidden;
    else
      fmt::print(stderr, "{}\n", to_string(d));
  }
  if (hidden > 0)
    fmt::print(stderr, "{} note{} (-v prints them)\n", hidden, hidden == 1 ? "" : "s");
}

Model read(const Common& common, Diagnostics& diagnostics) {
  try {
    Model model = read_model(common.path, diagnostics);
    if (common.strict && diagnostics.warning_count() > 0) {
      diagnostics.promote_warnings();
      throw InputError("");
    }
    return model;
  } catch (const InputError& e) {
    print_diagnostics(diagnostics, common.verbose);
    if (diagnostics.error_count() > 0) throw InputError("");  // printed already
    throw;
  }
}

Model configured(const Common& common, const Model& model, Diagnostics& diagnostics) {
  return configure(model, common.compile.model, diagnostics);
}

void progress(int step, int steps, const std::string& what) {
  check_interrupt();
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K[{}/{}] {}", step, steps, what);
}

void progress_done() {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K");
}

}  // namespace arboc::cli
