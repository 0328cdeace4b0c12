// arboc: flags -> options -> a subcommand.  Results go to stdout, everything else to stderr.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <system_error>

#include "base/diagnostic.h"
#include "base/words.h"
#include "cli/bench.h"
#include "cli/bench_compile.h"
#include "cli/common.h"
#include "cli/help.h"
#include "cli/output.h"
#include "emit/emit.h"

namespace arboc::cli {
namespace {

struct Arguments {
  Common common;
  std::string out, stage, folder;
  InspectOptions inspect;
  EvalOptions eval;
  int states = 100;
  bool in_lanes = false;
  bool compiling = false;
  std::string lanes;
  bool with_peers = false;
  PeerOptions peers;
};

Targets parse_targets(const std::string& list) {
  Targets targets{false, false};
  for (const std::string& word : split(list)) {
    if (word != "cpp" && word != "c")
      throw UsageError(unknown("--target", "there is no language", word, {"cpp", "c"}));
    (word == "c" ? targets.c : targets.cpp) = true;
  }
  if (!targets.c && !targets.cpp) throw CLI::ValidationError("--target", "the list is empty");
  return targets;
}

void add_compile(CLI::App& app, Arguments& args) {
  CLI::App* sub = app.add_subcommand("compile", "write specialised C++ for a model to DIR/NAME/");
  add_model_options(*sub, args.common);
  add_function_option(*sub, args.common);
  auto* out = sub->add_option("-o,--out", args.out, "folder that becomes the include path")
                  ->type_name("DIR");
  sub->add_option_function<std::string>(
         "--target",
         [&args](const std::string& list) { args.common.compile.targets = parse_targets(list); },
         "languages: cpp, c (CasADi's convention) or both")
      ->default_str("cpp")
      ->type_name("cpp|c|cpp,c");
  auto* print =
      sub->add_option("--print", args.stage, "print a stage to stdout instead of the summary")
          ->check(quiet(CLI::IsMember({"model", "tree", "limbs", "graph", "program"})))
          ->type_name("model|tree|limbs|graph|program");
  add_scalar_option(*sub, args.common);
  sub->callback([out, print] {
    if (out->count() == 0 && print->count() == 0)
      throw CLI::RequiredError("-o DIR (or --print STAGE)");
  });
}

void add_inspect(CLI::App& app, Arguments& args) {
  CLI::App* sub = app.add_subcommand("inspect", "say what the model is: joints, limits, warnings");
  add_model_options(*sub, args.common);
  sub->add_flag("--json", args.common.json, "as JSON");
  sub->add_option("--ops", args.common.functions,
                  "trace the functions (default: those of compile) and count their operations")
      ->expected(0, 1)
      ->type_name("[LIST]")
      ->default_str("");
  sub->add_flag("--tree", args.inspect.tree,
                "the dynamic tree: joints J0, J1, ... and links L0, L1, ..., dummy links");
  sub->add_option("--svg", args.inspect.svg, "draw it")->type_name("FILE");
  sub->add_option("--html", args.inspect.html,
                  "a page about the model: skeleton with sliders, tables, sparsity, operations")
      ->type_name("FILE");
  add_request_options(*sub, args.common);
  sub->callback([sub, &args] {
    args.inspect.ops = sub->count("--ops") > 0 || !args.common.compile.requests.empty();
    args.common.functions_option = "--ops";
  });
}

void add_animate(CLI::App& app, Arguments& args) {
  CLI::App* sub = app.add_subcommand("animate", "make a page that plays a motion (docs/pages.md)");
  sub->add_option("motion", args.common.path, "the motion, JSON")->required()->type_name("MOTION");
  sub->add_option("-o,--out", args.out, "the page")->required()->type_name("FILE");
}

void add_eval(CLI::App& app, Arguments& args) {
  CLI::App* sub = app.add_subcommand("eval", "evaluate a function on states from CSV files");
  EvalOptions& e = args.eval;
  add_model_options(*sub, args.common);
  add_request_options(*sub, args.common);
  sub->add_option("--function", e.function, "function to evaluate")->type_name("F");
  const auto input = [&](const std::string& option, const std::string& name, const char* meaning) {
    sub->add_option_function<std::string>(
           option, [&e, name](const std::string& file) { e.files[name] = file; }, meaning)
        ->type_name("FILE");
  };
  input("--q", "q", "configurations: one state a line, no header");
  input("--v", "v", "velocities");
  input("--a", "a", "accelerations");
  input("--tau", "tau", "joint forces");
  input("--q1", "q1", "other configurations, of difference");
  input("--lambda", "lambda", "weights of an output's entries");
  input("--f-ext", "f_ext", "external wrenches");
  sub->add_option_function<std::vector<std::string>>(
         "--input",
         [&e](const std::vector<std::string>& pairs) {
           for (const std::string& pair : pairs) {
             const size_t end = pair.find('=');
             if (end == std::string::npos || end == 0)
               throw CLI::ValidationError("--input", "expected NAME=FILE, not " + printable(pair));
             e.files[pair.substr(0, end)] = pair.substr(end + 1);
           }
         },
         "any input by its name, such as masses")
      ->allow_extra_args(false)
      ->type_name("NAME=FILE");
  sub->add_option("--output", e.output, "print only this output")->type_name("NAME");
  sub->add_option("--engine", e.engine,
                  "compiled code, the same algorithms in double, or the truth")
      ->check(quiet(CLI::IsMember({"generated", "generic", "reference"})))
      ->capture_default_str()
      ->type_name("generated|generic|reference");
  add_compiler_options(*sub, args.common);
}

void add_check(CLI::App& app, Arguments& args) {
  CLI::App* sub = app.add_subcommand(
      "check", "compare generated code with the reference engine and with differences");
  add_model_options(*sub, args.common);
  add_function_option(*sub, args.common);
  sub->add_option("--states", args.states, "random states")
      ->check(count())
      ->capture_default_str()
      ->type_name("N");
  sub->add_option("--folder", args.folder,
                  "instead: whether the files of a folder that compile wrote are those that its "
                  "manifest.json lists and, if MODEL is given, whether they were made from it")
      ->type_name("DIR/NAME");
  add_compiler_options(*sub, args.common);
  CLI::Option* model = sub->get_option("model");
  model->required(false);
  sub->callback([sub, model] {
    if (model->count() == 0 && sub->count("--folder") == 0)
      throw CLI::RequiredError("MODEL (or --folder DIR/NAME)");
  });
}

void add_bench(CLI::App& app, Arguments& args) {
  CLI::App* sub = app.add_subcommand("bench", "time generated against generic dynamics");
  add_model_options(*sub, args.common);
  add_function_option(*sub, args.common);
  sub->add_flag("--json", args.common.json, "as JSON");
  sub->add_flag("--compile", args.compiling,
                "what the C++ compiler needs for each function: CPU time, memory, size");
  sub->add_option(
         "--lanes", args.lanes,
         "time one state a call against packs of N states, of floats with f (default: 4,8)")
      ->expected(0, 1)
      ->type_name("[N[f],...]")
      ->default_str("");
  sub->callback([sub, &args] {
    args.in_lanes = sub->count("--lanes") > 0;
    args.with_peers = sub->count("--peers") > 0;
  });
  add_compiler_options(*sub, args.common);
  add_peer_options(*sub, args.peers);
}

int dispatch(const CLI::App& app, const Arguments& args) {
  if (app.got_subcommand("compile")) return run_compile(args.common, args.out, args.stage);
  if (app.got_subcommand("inspect")) return run_inspect(args.common, args.inspect);
  if (app.got_subcommand("animate")) return run_animate(args.common.path, args.out);
  if (app.got_subcommand("eval")) return run_eval(args.common, args.eval);
  if (app.got_subcommand("check") && !args.folder.empty())
    return run_check_folder(args.common, args.folder);
  if (app.got_subcommand("check")) return run_check(args.common, args.states);
  if (args.compiling) return run_bench_compile(args.common);
  if (args.with_peers)
    return run_bench_peers(args.common, args.peers, args.in_lanes ? &args.lanes : nullptr);
  if (args.in_lanes) return run_bench_lanes(args.common, args.lanes);
  return run_bench(args.common);
}

/// Everything that can go wrong, as an exit status.
int run(CLI::App& app, const Arguments& args, int argc, char** argv) {
  const auto failed = [&](ExitStatus status, const std::string& message) {
    print_failure(message, args.common);
    return status;
  };
  try {
    return parse(app, argc, argv) ? dispatch(app, args) : kOk;
  } catch (const CLI::ParseError& e) {
    app.exit(e);
    return kUsage;
  } catch (const UsageError& e) {
    app.exit(CLI::ParseError(e.what(), CLI::ExitCodes::ValidationError));
    return kUsage;
  } catch (const InputError& e) {
    return failed(kInput, e.what());
  } catch (const OutputError& e) {
    return failed(kOutput, e.what());
  } catch (const Interrupted&) {
    std::fputs("interrupted\n", stderr);
    return kInterrupted;
  } catch (const std::system_error& e) {  // of fmt::print and std::filesystem
    return failed(kOutput, fmt::format("arboc: error: {}", e.what()));
  } catch (const std::exception& e) {
    return failed(kInternal, fmt::format("arboc: internal error: {}", e.what()));
  }
}

}  // namespace
}  // namespace arboc::cli

int main(int argc, char** argv) {
  using namespace arboc::cli;
  hold_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  catch_interrupt();
  CLI::App app("arboc compiles the description of an articulated body to specialised C++ dynamics.",
               "arboc");
  app.set_version_flag("--version", arboc::version(), "print the version");
  app.require_subcommand(0, 1);
  set_help_style(app);
  Arguments args;
  add_compile(app, args);
  add_inspect(app, args);
  add_animate(app, args);
  add_eval(app, args);
  add_check(app, args);
  add_bench(app, args);
  return run(app, args, argc, argv);
}
