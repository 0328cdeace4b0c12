// What the subcommands share: model options, reading, reporting, exit statuses.
#pragma once
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compile.h"
#include "model/model.h"

namespace CLI {
class App;
}

namespace arboc::cli {

enum ExitStatus {
  kOk = 0,
  kUsage = 1,
  kInput = 2,
  kOutput = 3,
  kInternal = 4,
  kNo = 5,
  kInterrupted = 130
};

/// SIGINT or SIGTERM arrived; thrown at the next stage boundary.
struct Interrupted {};

/// From now on SIGINT and SIGTERM end the program with status 130: at once, or, while there is
/// something to clean up, by a flag that check_interrupt() turns into an exception.
void catch_interrupt();
void check_interrupt();

/// There is something to clean up as long as one of these lives.
class CleanUp {
 public:
  CleanUp();
  ~CleanUp();
  CleanUp(const CleanUp&) = delete;
  CleanUp& operator=(const CleanUp&) = delete;
};

/// Options and arguments of every subcommand.
struct Common {
  std::string path;
  std::string anthropometry;  ///< a file with other lengths and masses of a DH table
  CompileOptions compile;
  std::string functions;                         ///< as given; empty: the default
  std::string functions_option = "--functions";  ///< what gave them
  bool json = false;
  bool verbose = false;
  bool strict = false;  ///< warnings are errors
  bool json_diagnostics = false;
  std::string cxx;
  std::string cxxflags = "-std=c++17 -O2 -march=native -fno-tree-vectorize";
};

void add_model_options(CLI::App& app, Common& common);
void add_function_option(CLI::App& app, Common& common);
void add_compiler_options(CLI::App& app, Common& common);
/// --without, --optimise, --max-function-size.
void add_text_options(CLI::App& app, FunctionOptions& options);
/// --scalars: for what emitted functions are compiled.
void add_scalar_option(CLI::App& app, Common& common);

/// --jacobian, --gradient, --vjp and --hessian, which add to the requests, and what requests share.
void add_request_options(CLI::App& app, Common& common);

/// What --functions and the derivative options ask for.  Throws UsageError for an unknown function.
std::vector<Request> requests(const Common& common);

/// Whether the functions are the default ones, of which those that the model cannot have are left
/// out.
bool asks_by_default(const Common& common);

/// Reads the model; prints errors and warnings to stderr.  Throws InputError.
Model read(const Common& common, Diagnostics& diagnostics);

/// Reads and compiles the model; prints what the stages reported, also if one of them fails.
Compilation compiled(const Common& common, const CompileOptions& options);

/// configure() as the options say.
Model configured(const Common& common, const Model& model, Diagnostics& diagnostics);

/// Prints to stderr what the stages reported: each warning; notes one by one if `notes`, otherwise
/// their number.  As JSON everything, one object a line.
void print_diagnostics(const Diagnostics& diagnostics, const Common& common, bool notes);

/// What ends the program, in the same manner.
void print_failure(const std::string& message, const Common& common);

/// JSON in ASCII, on one line or, with `indent`, on several; bytes that are not UTF-8 as U+FFFD.
std::string dump(const nlohmann::ordered_json& json, int indent = -1);

/// "[3/7] rnea ..." on stderr where it is a terminal and the work takes long.
void progress(int step, int steps, const std::string& what);
void progress_done();

// The subcommands; each returns its exit status.
int run_compile(const Common& common, const std::string& out, const std::string& stage);
struct InspectOptions {
  bool ops = false;   ///< trace and count
  bool tree = false;  ///< joints and links with their numbers in the dynamic tree
  std::string svg;    ///< file for a picture of it; empty: none
  std::string html;   ///< file for a page about the model; empty: none
};
int run_inspect(const Common& common, const InspectOptions& options);
/// A motion in JSON -> the page that plays it.
int run_animate(const std::string& motion, const std::string& out);
struct EvalOptions {
  std::string function, output;
  std::map<std::string, std::string> files;  ///< of inputs, by name
  std::string engine = "generated";
};
int run_eval(const Common& common, const EvalOptions& options);
int run_check(const Common& common, int states);
/// Whether a folder that compile wrote is whole and, if common.path is given, made from that file.
int run_check_folder(const Common& common, const std::string& folder);
int run_bench(const Common& common);

}  // namespace arboc::cli
