// Runs a program to its end, or until a signal, and keeps what it said.
#pragma once
#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

#include "support/temp_dir.h"

namespace arboc::test {

struct Outcome {
  int status = -1;  ///< exit status, or minus the signal that ended it
  std::string out;
  std::string err;
};

struct RunOptions {
  std::string folder;                              ///< to run in; empty: this one
  std::string input = "/dev/null";                 ///< file for standard input
  std::string output;                              ///< file for standard output; empty: a new one
  std::map<std::string, std::string> environment;  ///< added to this one
};

/// A program in the background; its destructor ends it.
class Running {
 public:
  explicit Running(const std::vector<std::string>& command, const RunOptions& options = {});
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void signal(int number) const;
  Outcome wait();

 private:
  TempDir streams_;
  pid_t pid_ = -1;
};

Outcome run_program(const std::vector<std::string>& command, const RunOptions& options = {});

/// The same for bin/arboc.
std::vector<std::string> arboc_command(const std::vector<std::string>& arguments);
Outcome run_arboc(const std::vector<std::string>& arguments, const RunOptions& options = {});

std::string read_text(const std::string& path);
void write_text(const std::string& path, const std::string& text);
/// The numbers of comma-separated lines.
std::vector<std::vector<double>> numbers(const std::string& csv);
/// The other way round, with 17 digits.
std::string csv_text(const std::vector<std::vector<double>>& rows);

}  // namespace arboc::test
