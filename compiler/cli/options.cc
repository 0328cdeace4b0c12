// The options that subcommands share: of the model, of functions, of the C++ compiler.
#include "cli/common.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "base/number.h"
#include "base/words.h"
#include "cli/help.h"
#include "frontend/read_model.h"

namespace arboc::cli {
namespace {

/// "elbow=0.5" or "base=0,0,1,0,0,0,1"; names may contain '='.
Lock parse_lock(const std::string& text) {
  const CLI::ValidationError wrong("--lock",
                                   "expected JOINT=VALUE[,VALUE...], not " + printable(text));
  const size_t end = text.rfind('=');
  if (end == std::string::npos || end == 0) throw wrong;
  constexpr double kLargest = 1e9;  // of which exact_sincos knows the sine
  Lock lock{text.substr(0, end), {}};
  for (const std::string& word : split(text.substr(end + 1))) {
    const auto value = parse_finite(word);
    if (!value || std::fabs(*value) >= kLargest) throw wrong;
    lock.q.push_back(*value);
  }
  if (lock.q.empty()) throw wrong;
  return lock;
}

/// "damping,rotor" on top of what is there.
JointForces parse_joint_forces(JointForces forces, const std::string& list) {
  const std::vector<std::string> given = split(list);
  if (given.empty()) throw CLI::ValidationError("--joint-forces", "the list is empty");
  for (const std::string& word : given) {
    if (word == "damping")
      forces.damping = true;
    else if (word == "friction")
      forces.friction = true;
    else if (word == "stiffness")
      forces.stiffness = true;
    else if (word == "rotor")
      forces.rotor = true;
    else
      throw UsageError(unknown("--joint-forces", "there is no force", word,
                               {"damping", "friction", "stiffness", "rotor"}));
  }
  return forces;
}

void add_subchain_options(CLI::App& app, Common& common) {
  ModelOptions& m = common.compile.model;
  app.add_option_function<std::vector<std::string>>(
         "--lock",
         [&m](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) m.locks.push_back(parse_lock(text));
         },
         "hold a joint at a place (rad or m; all coordinates of joints with several)")
      ->allow_extra_args(false)
      ->type_name("JOINT=VALUE")
      ->group("Model");
  app.add_option("--root", m.root, "keep what hangs on this link, which becomes the root")
      ->type_name("LINK")
      ->group("Model");
  app.add_option("--hang-from", m.hang_from,
                 "hold the body at this link instead: the joints up to the root are reversed")
      ->type_name("LINK")
      ->group("Model");
  const auto add_links = [&](const char* name, std::vector<std::string>& links, const char* text) {
    app.add_option_function<std::string>(
           name,
           [name, &links](const std::string& list) {
             links = split(list);
             if (links.empty()) throw CLI::ValidationError(name, "the list is empty");
           },
           text)
        ->type_name("LINK[,...]")
        ->group("Model");
  };
  add_links("--tip", m.tips, "keep the chains from the root to these links");
}

std::string check_positive(const std::string& text) {
  const auto value = parse_finite(text);
  return value && *value > 0 ? "" : "expected a positive number, not " + text;
}

/// An angle tolerance; CLI::Range lets nan through.
std::string check_snap(const std::string& text) {
  const auto value = parse_finite(text);
  return value && *value >= 0 && *value <= 0.1 ? "" : "expected 0 to 0.1 (rad), not " + text;
}

}  // namespace

void add_model_options(CLI::App& app, Common& common) {
  app.add_option("model", common.path, "the model file (URDF, or a DH table *.dh.toml)")
      ->required()
      ->type_name("MODEL");
  ModelOptions& m = common.compile.model;
  app.add_option("--anthropometry", common.anthropometry,
                 "lengths and masses in place of those of a DH table")
      ->type_name("FILE")
      ->group("Model");
  app.add_option("--base", m.base, "how the root link is attached to the world")
      ->transform(choice({"file", "fixed", "floating"}))
      ->default_str("file")
      ->type_name("file|fixed|floating")
      ->group("Model");
  app.add_option("--mimic", m.mimic, "what mimic joints do")
      ->transform(choice({"follow", "independent"}))
      ->default_str("follow")
      ->type_name("follow|independent")
      ->group("Model");
  app.add_option("--joint-order", m.order, "order among siblings; alphabetical is Pinocchio's")
      ->transform(choice({"file", "alphabetical"}))
      ->default_str("file")
      ->type_name("file|alphabetical")
      ->group("Model");
  app.add_option("--name", m.name, "name of the generated code (default: the model's, sanitised)")
      ->type_name("NAME")
      ->group("Model");
  app.add_option("--snap", m.snap,
                 "written angles this close (rad) to a multiple of 15 degrees become it; 0 is off")
      ->check(CLI::Validator(check_snap, ""))
      ->capture_default_str()
      ->type_name("TOL")
      ->group("Model");
  app.add_option("--continuous", m.continuous, "coordinates of continuous joints")
      ->transform(choice({"angle", "cos-sin"}))
      ->default_str("angle")
      ->type_name("angle|cos-sin")
      ->group("Model");
  app.add_flag("--expand", m.expand,
               "take planar, floating and spherical joints as chains of single axes")
      ->group("Model");
  add_subchain_options(app, common);
  app.add_option("--max-dof", common.compile.max_dof, "refuse to trace larger models")
      ->check(count())
      ->capture_default_str()
      ->type_name("N")
      ->group("Model");
  app.add_flag("--strict", common.strict, "take warnings as errors");
  app.add_option("--diagnostics", common.json_diagnostics,
                 "errors, warnings and notes on stderr as text, or as JSON, an object a line")
      ->transform(choice({"text", "json"}))
      ->default_str("text")
      ->type_name("text|json");
  app.add_flag("-v,--verbose", common.verbose, "print each note, and the compiler's command line");
}

void add_function_option(CLI::App& app, Common& common) {
  app.add_option_function<std::string>(
         "--functions",
         [&common](const std::string& list) {
           if (split(list).empty()) throw CLI::ValidationError("--functions", "the list is empty");
           common.functions = list;
         },
         fmt::format("comma-separated list, `dynamics` (the default) or `all`; known are {}",
                     fmt::join(function_names(), ", ")))
      ->type_name("LIST");
  add_request_options(app, common);
}

void add_request_options(CLI::App& app, Common& common) {
  const auto derivative = [&](const std::string& option, Derivative kind, const char* text) {
    app.add_option_function<std::vector<std::string>>(
           option,
           [&common, option, kind](const std::vector<std::string>& specs) {
             for (const std::string& spec : specs) {
               if (kind == Derivative::kHessian && (spec == "iterated" || spec == "symmetric"))
                 common.compile.function.iterated = spec == "iterated";
               else
                 common.compile.requests.push_back(parse_request(option, kind, spec));
             }
           },
           text)
        ->allow_extra_args(false)
        ->type_name("F.OUTPUT[:INPUT,...]")
        ->group("Derivatives");
  };
  derivative("--jacobian", Derivative::kJacobian, "of an output, e.g. rnea.tau:q,v (repeatable)");
  derivative("--gradient", Derivative::kGradient,
             "of an output of one entry, e.g. energy.V:q, or of the sum of squares, rnea.tau^2");
  derivative("--vjp", Derivative::kVjp, "lambda^T times the Jacobian, lambda an input");
  derivative("--hessian", Derivative::kHessian,
             "second derivative of lambda^T output; `iterated` alone: all Hessians as derivatives "
             "of derivatives along the body's axes");
  FunctionOptions& f = common.compile.function;
  const auto list = [&](const char* name, std::vector<std::string>& words, const char* type,
                        const char* text) {
    app.add_option_function<std::string>(
           name,
           [name, &words](const std::string& given) {
             words = split(given);
             if (words.empty()) throw CLI::ValidationError(name, "the list is empty");
           },
           text)
        ->type_name(type)
        ->group("Functions");
  };
  list("--frames", f.frames, "LINK[,...]",
       "links that fk and frame functions report (default: each that a joint moves)");
  app.add_option("--axes", f.axes, "where and along which axes frames have velocities and wrenches")
      ->transform(choice({"local", "world", "aligned"}))
      ->default_str("local")
      ->type_name("local|world|aligned")
      ->group("Functions");
  app.add_option("--transform-order", f.transform_order,
                 "highest derivative that transforms has, 0 to 3")
      ->check(CLI::Range(0, 3))
      ->capture_default_str()
      ->type_name("N")
      ->group("Functions");
  list("--external-forces", f.external_forces, "LINK[,...]",
       "links on which wrenches act: an input f_ext of rnea, nle, aba and their derivatives");
  app.add_option_function<std::string>(
         "--joint-forces",
         [&f](const std::string& given) {
           f.joint_forces = parse_joint_forces(f.joint_forces, given);
         },
         "what joints add by themselves: damping, friction, stiffness, rotor")
      ->type_name("LIST")
      ->group("Functions");
  app.add_option("--friction-velocity", f.joint_forces.friction_velocity,
                 "rate (rad/s, m/s) below which friction is smooth")
      ->check(CLI::Validator(check_positive, ""))
      ->capture_default_str()
      ->type_name("V")
      ->group("Functions");
  list("--parameters", f.parameters, "LIST",
       "numbers that stay inputs: gravity, masses, centres, inertias, lengths, or of one link or "
       "joint, masses:NAME");
  add_text_options(app, f);
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

bool asks_by_default(const Common& common) {
  return common.functions.empty() && common.compile.requests.empty();
}

std::vector<Request> requests(const Common& common) {
  static const std::vector<std::string> kDynamics = {
      "fk", "rnea", "gravity", "nle", "crba", "minv", "aba", "rnea_derivatives", "aba_derivatives"};
  std::vector<Request> list;
  const auto add = [&](const Request& request) {
    for (const Request& known : list)
      if (name(known) == name(request)) return;
    list.push_back(request);
  };
  const bool by_default = asks_by_default(common);
  const std::string text = by_default ? "dynamics" : common.functions;
  for (const std::string& word : split(text)) {
    if (word == "all") {
      for (const std::string& f : function_names()) add({f});
    } else if (word == "dynamics") {
      for (const std::string& f : kDynamics) add({f});
    } else {
      check_function(common.functions_option, word);
      add({word});
    }
  }
  for (const Request& request : common.compile.requests) add(request);
  return list;
}

}  // namespace arboc::cli
