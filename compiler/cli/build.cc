#include "cli/build.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "emit/emit.h"

namespace arboc::cli {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> list;
  for (std::string word; in >> word;) list.push_back(word);
  return list;
}

/// Commands in the background, each in a process group of its own with its output in a file.
/// Those that still run at the end are stopped.
class Jobs {
 public:
  /// Files that the commands make for themselves go to `folder`.
  explicit Jobs(const std::string& folder) : folder_(folder) {}
  ~Jobs() {
    for (const Job& job : jobs_) kill(-job.pid, SIGTERM);
    while (!jobs_.empty()) wait_for_oldest();
  }
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  size_t running() const { return jobs_.size(); }
  void start(const std::vector<std::string>& command, const std::string& log);
  /// Waits for the oldest one; throws if it failed, or Interrupted.
  void finish();

 private:
  struct Job {
    pid_t pid = 0;
    std::string log;
  };

  int wait_for_oldest() {
    int status = 0;
    while (waitpid(jobs_.front().pid, &status, 0) < 0 && errno == EINTR) {
    }
    jobs_.pop_front();
    return status;
  }

  std::string folder_;
  std::deque<Job> jobs_;
};

[[noreturn]] void run(const std::vector<std::string>& command, const std::string& log,
                      const std::string& folder) {
  setpgid(0, 0);
  setenv("TMPDIR", folder.c_str(), 1);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  std::fprintf(stderr, "cannot run %s: %s\n", argv[0], std::strerror(errno));
  _exit(127);
}

void Jobs::start(const std::vector<std::string>& command, const std::string& log) {
  check_interrupt();
  const pid_t pid = fork();
  if (pid < 0)
    throw std::runtime_error(fmt::format("cannot start {}: {}", command[0], std::strerror(errno)));
  if (pid == 0) run(command, log, folder_);
  setpgid(pid, pid);  // whichever of the two comes first
  jobs_.push_back({pid, log});
}

void Jobs::finish() {
  // Looks again and again: a signal just before a wait without end would go unnoticed.
  for (siginfo_t ended{};; std::this_thread::sleep_for(std::chrono::milliseconds(3))) {
    check_interrupt();
    const auto pid = static_cast<id_t>(jobs_.front().pid);
    if (waitid(P_PID, pid, &ended, WEXITED | WNOWAIT | WNOHANG) == 0 && ended.si_pid != 0) break;
  }
  check_interrupt();
  const std::string log = jobs_.front().log;
  const int status = wait_for_oldest();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  std::ifstream in(log);
  std::stringstream text;
  text << in.rdbuf();
  throw std::runtime_error("the C++ compiler failed:\n" + text.str().substr(0, 4000));
}

struct ProgressLine {
  ~ProgressLine() { progress_done(); }
};

}  // namespace

std::vector<std::string> compiler_command(const Common& common) {
  const char* variable = std::getenv("CXX");
  std::vector<std::string> command = words(!common.cxx.empty()     ? common.cxx
                                           : variable && *variable ? variable
                                                                   : "c++");
  if (command.empty()) throw UsageError("--cxx: no command");
  for (const std::string& flag : words(common.cxxflags)) command.push_back(flag);
  command.emplace_back("-fPIC");
  return command;
}

void write_sources(const std::string& folder, const Files& files) {
  for (const auto& [path, bytes] : files) {
    const fs::path file = fs::path(folder) / path;
    fs::create_directories(file.parent_path());
    std::ofstream out(file, std::ios::binary);
    if (!(out << bytes).flush())
      throw OutputError(fmt::format("{}: error: cannot write", printable(file.string())));
  }
}

Library::Library(const std::string& path) : handle_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_) throw std::runtime_error(fmt::format("cannot load {}: {}", path, dlerror()));
}

Library::~Library() { dlclose(handle_); }

void* Library::symbol(const std::string& name) const {
  void* address = dlsym(handle_, name.c_str());
  if (!address) throw std::logic_error("generated code lacks " + name);
  return address;
}

std::string build_library(const Common& common, const std::string& folder, const Files& files,
                          const std::vector<std::string>& sources,
                          const std::vector<std::string>& libraries) {
  write_sources(folder, files);
  const std::vector<std::string> compiler = compiler_command(common);
  std::vector<std::string> link = compiler;
  const auto start = [&](Jobs& jobs, const std::vector<std::string>& command,
                         const std::string& product) {
    if (common.verbose) fmt::print(stderr, "{}\n", fmt::join(command, " "));
    jobs.start(command, product + ".log");
  };
  const size_t parallel = std::max(1u, std::thread::hardware_concurrency());
  const ProgressLine line;
  Jobs jobs(folder);
  size_t done = 0;
  const auto finish = [&] {
    jobs.finish();
    progress(static_cast<int>(done) + 1, static_cast<int>(sources.size()),
             "compiled " + sources[done]);
    ++done;
  };
  for (size_t k = 0; k < sources.size(); ++k) {
    std::vector<std::string> command = compiler;
    const std::string object = fmt::format("{}/{}.o", folder, k);
    for (const std::string& word : {std::string("-I"), folder, std::string("-c"),
                                    folder + "/" + sources[k], std::string("-o"), object})
      command.push_back(word);
    link.push_back(object);
    if (jobs.running() >= parallel) finish();
    start(jobs, command, object);
  }
  while (jobs.running() > 0) finish();
  const std::string library = folder + "/lib.so";
  for (const std::string& word : {std::string("-shared"), std::string("-o"), library})
    link.push_back(word);
  link.insert(link.end(), libraries.begin(), libraries.end());
  start(jobs, link, library);
  jobs.finish();
  return library;
}

std::string glue(const TargetModel& model) {
  std::string out = fmt::format("#include \"{0}/{0}_raw.hpp\"\n\nextern \"C\" {{\n", model.name);
  for (const TargetFunction& f : model.functions) {
    std::string arguments;
    for (size_t k = 0; k < f.signature.inputs.size(); ++k) arguments += fmt::format("in[{}], ", k);
    for (size_t k = 0; k < f.signature.outputs.size(); ++k)
      arguments += fmt::format("out[{}], ", k);
    arguments.resize(arguments.size() - 2);
    const std::string call =
        fmt::format("{}::raw::{}<double>({})", model.name, f.signature.name, arguments);
    out += fmt::format("int arboc_call_{}(const double* const* in, double* const* out) {{\n",
                       f.signature.name);
    out += f.signature.positive.empty() ? fmt::format("  {};\n  return 0;\n}}\n", call)
                                        : fmt::format("  return {};\n}}\n", call);
  }
  return out + "}\n";
}

namespace {

std::string build_code(const Common& common, const std::string& folder, const TargetModel& model) {
  Files files;
  std::vector<std::string> sources;
  for (const auto& [path, bytes] : emit(model)) files[model.name + "/" + path] = bytes;
  // The longest ones first.
  std::vector<const TargetFunction*> order;
  for (const TargetFunction& f : model.functions) order.push_back(&f);
  std::stable_sort(order.begin(), order.end(),
                   [](const TargetFunction* x, const TargetFunction* y) {
                     return x->program.ops.total() > y->program.ops.total();
                   });
  for (const TargetFunction* f : order)
    sources.push_back(fmt::format("{0}/{0}_{1}_double.cpp", model.name, f->signature.name));
  files["glue.cpp"] = glue(model);
  sources.emplace_back("glue.cpp");
  return build_library(common, folder, files, sources);
}

}  // namespace

GeneratedCode::GeneratedCode(const Common& common, TargetModel model)
    : model_(std::move(model)),
      library_path_(build_code(common, folder_.path(), model_)),
      library_(library_path_) {}

Values GeneratedCode::call(const std::string& function, const Values& inputs, int* status) const {
  const auto f =
      std::find_if(model_.functions.begin(), model_.functions.end(),
                   [&](const TargetFunction& t) { return t.signature.name == function; });
  std::vector<const double*> in;
  for (const Argument& a : f->signature.inputs) in.push_back(inputs.at(a.name).data());
  std::vector<std::vector<double>> raw;
  std::vector<double*> out;
  for (size_t k = 0; k < f->signature.outputs.size(); ++k) raw.emplace_back(f->entries(k));
  for (auto& values : raw) out.push_back(values.data());
  using Call = int (*)(const double* const*, double* const*);
  const int returned =
      reinterpret_cast<Call>(library_.symbol("arboc_call_" + function))(in.data(), out.data());
  if (status) *status = returned;

  Values results;
  for (size_t k = 0; k < raw.size(); ++k) {
    const Argument& a = f->signature.outputs[k];
    const Pattern& pattern = f->patterns[k];
    if (!a.sparse) {
      results[a.name] = raw[k];
      continue;
    }
    std::vector<double> dense(static_cast<size_t>(a.rows) * static_cast<size_t>(a.cols));
    const auto at = [&](int row, int col) -> double& {
      return dense[static_cast<size_t>(row * a.cols + col)];
    };
    for (size_t e = 0; e < pattern.row.size(); ++e) {
      at(pattern.row[e], pattern.col[e]) = raw[k][e];
      if (a.symmetric) at(pattern.col[e], pattern.row[e]) = raw[k][e];
    }
    results[a.name] = dense;
  }
  return results;
}

}  // namespace arboc::cli
