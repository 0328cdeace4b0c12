#include "cli/build.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
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

/// A command that runs in the background, its output in a file.
struct Job {
  pid_t pid = 0;
  std::string log;
};

Job start(const std::vector<std::string>& command, const std::string& log) {
  const pid_t pid = fork();
  if (pid < 0)
    throw std::runtime_error(fmt::format("cannot start {}: {}", command[0], std::strerror(errno)));
  if (pid == 0) {
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
  return {pid, log};
}

void finish(const Job& job) {
  int status = 0;
  while (waitpid(job.pid, &status, 0) < 0 && errno == EINTR) {
  }
  check_interrupt();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  std::ifstream in(job.log);
  std::stringstream text;
  text << in.rdbuf();
  throw std::runtime_error("the C++ compiler failed:\n" + text.str().substr(0, 4000));
}

}  // namespace

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
                          const std::vector<std::string>& sources) {
  for (const auto& [path, bytes] : files) {
    fs::create_directories((fs::path(folder) / path).parent_path());
    std::ofstream(fs::path(folder) / path, std::ios::binary) << bytes;
  }
  const char* variable = std::getenv("CXX");
  std::vector<std::string> compiler = words(!common.cxx.empty()     ? common.cxx
                                            : variable && *variable ? variable
                                                                    : "c++");
  for (const std::string& flag : words(common.cxxflags)) compiler.push_back(flag);
  compiler.emplace_back("-fPIC");

  std::vector<std::string> link = compiler;
  std::vector<Job> jobs;
  const size_t parallel = std::max(1u, std::thread::hardware_concurrency());
  size_t done = 0;
  const auto wait_for = [&](size_t count) {
    for (; done < count; ++done) {
      finish(jobs[done]);
      progress(static_cast<int>(done) + 1, static_cast<int>(sources.size()),
               "compiled " + sources[done]);
    }
  };
  try {
    for (const std::string& source : sources) {
      std::vector<std::string> command = compiler;
      const std::string object = fmt::format("{}/{}.o", folder, jobs.size());
      for (const std::string& word : {std::string("-I"), folder, std::string("-c"),
                                      folder + "/" + source, std::string("-o"), object})
        command.push_back(word);
      link.push_back(object);
      if (common.verbose) fmt::print(stderr, "{}\n", fmt::join(command, " "));
      if (jobs.size() >= parallel) wait_for(jobs.size() - parallel + 1);
      jobs.push_back(start(command, object + ".log"));
    }
    wait_for(jobs.size());
  } catch (...) {
    for (size_t k = done + 1; k < jobs.size(); ++k) waitpid(jobs[k].pid, nullptr, 0);
    progress_done();
    throw;
  }
  progress_done();
  const std::string library = folder + "/lib.so";
  for (const std::string& word : {std::string("-shared"), std::string("-o"), library})
    link.push_back(word);
  if (common.verbose) fmt::print(stderr, "{}\n", fmt::join(link, " "));
  finish(start(link, library + ".log"));
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
  for (const auto& [path, bytes] : emit_cpp(model)) files[model.name + "/" + path] = bytes;
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
    if (pattern.row.empty()) {
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
