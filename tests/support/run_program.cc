#include "support/run_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace arboc::test {
namespace {

void redirect(const std::string& path, int flags, int to) {
  const int file = ::open(path.c_str(), flags, 0600);
  if (file < 0 || ::dup2(file, to) < 0) _exit(126);
  ::close(file);
}

[[noreturn]] void become(const std::vector<std::string>& command, const RunOptions& options,
                         const TempDir& streams) {
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  redirect(options.input, O_RDONLY, STDIN_FILENO);
  redirect(options.output.empty() ? streams / "out" : options.output, kWrite, STDOUT_FILENO);
  redirect(streams / "err", kWrite, STDERR_FILENO);
  for (const auto& [name, value] : options.environment) ::setenv(name.c_str(), value.c_str(), 1);
  if (!options.folder.empty() && ::chdir(options.folder.c_str()) != 0) _exit(126);
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  _exit(127);
}

}  // namespace

Running::Running(const std::vector<std::string>& command, const RunOptions& options) {
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("cannot start " + command[0]);
  if (pid_ == 0) become(command, options, streams_);
}

Running::~Running() {
  if (pid_ < 0) return;
  signal(SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void Running::signal(int number) const { ::kill(pid_, number); }

Outcome Running::wait() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  const int result = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return {result, read_text(streams_ / "out"), read_text(streams_ / "err")};
}

Outcome run_program(const std::vector<std::string>& command, const RunOptions& options) {
  return Running(command, options).wait();
}

std::vector<std::string> arboc_command(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{ARBOC_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

Outcome run_arboc(const std::vector<std::string>& arguments, const RunOptions& options) {
  return run_program(arboc_command(arguments), options);
}

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::vector<double>> numbers(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
      rows.back().push_back(std::strtod(cell.c_str(), nullptr));
  }
  return rows;
}

std::string csv_text(const std::vector<std::vector<double>>& rows) {
  std::string text;
  for (const auto& row : rows) {
    for (size_t k = 0; k < row.size(); ++k) {
      char cell[32];
      std::snprintf(cell, sizeof cell, "%s%.17g", k ? "," : "", row[k]);
      text += cell;
    }
    text += "\n";
  }
  return text;
}

}  // namespace arboc::test
