// What all programs of studies do alike: files of a result, exit statuses.
#pragma once
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "task_file.h"

namespace study {

struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Files = std::vector<std::pair<std::string, std::string>>;  ///< name in the folder, content

/// Makes the folder where it is not there.  All files are written beside their places first and
/// then renamed, so none is ever half written.  Throws WriteError.
void write_files(const std::string& folder, const Files& files);

/// Runs a program and turns exceptions into a line on stderr and arboc's statuses: 2 input
/// (TaskError, std::invalid_argument), 3 output (WriteError), 5 there is no such posture or motion
/// (std::domain_error), 4 all else.
int exit_status(const std::function<int()>& program);

/// f(), of a task file: what a task asks for that is not there or cannot be (std::invalid_argument)
/// is said of the file, as a TaskError.
template <class F>
decltype(auto) of_task(const std::string& path, const F& f) {
  try {
    return f();
  } catch (const std::invalid_argument& e) {
    throw TaskError(path + ": error: " + e.what());
  }
}

}  // namespace study
