// Compiles generated code with the user's C++ compiler and loads it.
#pragma once
#include <string>
#include <vector>

#include "cli/common.h"
#include "cli/output.h"
#include "emit/target.h"

namespace arboc::cli {

/// A shared library, closed with the object.
class Library {
 public:
  explicit Library(const std::string& path);
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  void* symbol(const std::string& name) const;

 private:
  void* handle_ = nullptr;
};

/// The C++ compiler of the options and its flags, for position-independent code.
std::vector<std::string> compiler_command(const Common& common);

/// Writes `files` to `folder`.  Throws OutputError.
void write_sources(const std::string& folder, const Files& files);

/// Writes `files` to `folder`, compiles `sources` (relative to it) as many at a time as there are
/// processors, and links them with `libraries` into folder/lib.so.  `-I folder` is given.  Throws
/// std::runtime_error with the compiler's output.
std::string build_library(const Common& common, const std::string& folder, const Files& files,
                          const std::vector<std::string>& sources,
                          const std::vector<std::string>& libraries = {});

/// The functions of a model as compiled code, called with dense arguments.
class GeneratedCode {
 public:
  GeneratedCode(const Common& common, TargetModel model);

  /// Inputs by argument name -> outputs, dense and row-major, by name.  `status`, if given,
  /// receives what the function returned (0 for those that return nothing).
  Values call(const std::string& function, const Values& inputs, int* status = nullptr) const;

 private:
  TemporaryFolder folder_;
  TargetModel model_;
  std::string library_path_;
  Library library_;
};

/// C++ text of a translation unit that exports each function as
/// `extern "C" int arboc_call_NAME(const double* const* in, double* const* out)`.
std::string glue(const TargetModel& model);

}  // namespace arboc::cli
