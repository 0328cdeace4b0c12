// arboc bench MODEL --compile: what the C++ compiler needs for each function.
//
// One process a function, with the flags that eval uses; CPU seconds and the largest memory of the
// compiler and of what it starts, as the kernel accounts them.
#include <elf.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/bench_compile.h"
#include "cli/build.h"
#include "emit/emit.h"

namespace arboc::cli {
namespace {

struct Cost {
  double seconds = 0;    ///< CPU, of the compiler and its children
  double megabytes = 0;  ///< largest resident set
};

[[noreturn]] void become(const std::vector<std::string>& command, const std::string& log) {
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  _exit(127);
}

/// Bytes of machine code and constants in an object file (ELF, 64 bits), what `size` calls text; of
/// other formats the whole file.
double text_bytes(const std::string& object) {
  std::ifstream in(object, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  Elf64_Ehdr head{};
  if (bytes.size() < sizeof head) return static_cast<double>(bytes.size());
  std::memcpy(&head, bytes.data(), sizeof head);
  if (std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_ident[EI_CLASS] != ELFCLASS64)
    return static_cast<double>(bytes.size());
  double sum = 0;
  for (size_t k = 0; k < head.e_shnum; ++k) {
    Elf64_Shdr section{};
    const size_t at = head.e_shoff + k * head.e_shentsize;
    if (at + sizeof section > bytes.size()) break;
    std::memcpy(&section, bytes.data() + at, sizeof section);
    if ((section.sh_flags & SHF_ALLOC) && !(section.sh_flags & SHF_WRITE)) sum += static_cast<double>(section.sh_size);
  }
  return sum;
}

/// Runs the command to its end; throws if it fails.
Cost run(const std::vector<std::string>& command, const std::string& log) {
  check_interrupt();
  const pid_t pid = fork();
  if (pid < 0)
    throw std::runtime_error(fmt::format("cannot start {}: {}", command[0], std::strerror(errno)));
  if (pid == 0) become(command, log);
  int status = 0;
  rusage use{};
  while (wait4(pid, &status, WNOHANG, &use) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    try {
      check_interrupt();
    } catch (...) {
      kill(pid, SIGTERM);
      waitpid(pid, &status, 0);
      throw;
    }
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(fmt::format("the C++ compiler failed: {}", command[0]));
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {seconds(use.ru_utime) + seconds(use.ru_stime), static_cast<double>(use.ru_maxrss) / 1024};
}

}  // namespace

int run_bench_compile(const Common& common) {
  CompileOptions options = common.compile;
  options.requests = requests(common);
  const Compilation compilation = compiled(common, options);
  const TargetModel target = arboc::target(compilation, options);
  const TemporaryFolder folder;
  Files files;
  for (const auto& [path, bytes] : emit(target)) files[target.name + "/" + path] = bytes;
  write_sources(folder.path(), files);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  if (!common.json)
    fmt::print("{:<30} {:>10} {:>8} {:>13} {:>7} {:>10}\n", "function", "operations", "CPU s",
               "ms/operation", "MB", "text kB");
  for (const TargetFunction& f : target.functions) {
    const std::string name = f.signature.name;
    const std::string source =
        fmt::format("{0}/{1}/{1}_{2}_double.cpp", folder.path(), target.name, name);
    const std::string object = folder.path() + "/" + name + ".o";
    std::vector<std::string> command = compiler_command(common);
    command.insert(command.end(), {"-I", folder.path(), "-c", source, "-o", object});
    const Cost cost = run(command, object + ".log");
    const int operations = f.program.ops.total();
    const auto size = text_bytes(object) / 1024;
    const double each = 1e3 * cost.seconds / std::max(operations, 1);
    if (common.json)
      json.push_back({{"function", name},
                      {"operations", operations},
                      {"cpu_s", cost.seconds},
                      {"mb", cost.megabytes},
                      {"text_kb", size}});
    else
      fmt::print("{:<30} {:>10} {:>8.2f} {:>13.3f} {:>7.0f} {:>10.1f}\n", name, operations,
                 cost.seconds, each, cost.megabytes, size);
  }
  if (common.json) fmt::print("{}\n", dump(json, 1));
  flush_stdout();
  return kOk;
}

}  // namespace arboc::cli
