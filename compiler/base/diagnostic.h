// What the compiler has to say about its input, with a place and a remedy.
//
// A stage reports into a Diagnostics and goes on as long as that makes sense, so that one run
// shows every fault of a file.  A stage that cannot go on throws InputError; main prints it and
// exits with status 2.
//
//   arm.urdf:12:5: error: joint 'elbow': <axis>: length is 0 (give a direction, e.g. xyz="0 0 1")
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace arboc {

/// A place in a text file, counted from 1 in bytes; line 0 means the whole file.
struct Location {
  int line = 0;
  int column = 0;
};

enum class Severity { kNote, kWarning, kError };
const char* name(Severity severity);  ///< "note", ...

struct Diagnostic {
  Severity severity = Severity::kError;
  std::string file;
  Location location;
  std::string element;  ///< "joint 'elbow'", "link 'hand'", or empty
  std::string message;  ///< what is wrong, in one sentence without a full stop
  std::string hint;     ///< what to do about it, or empty
};

/// `file:line:col: severity: element: message (hint)`; parts that are empty are left out.  Bytes of
/// the user's text that would not print are escaped.
std::string to_string(const Diagnostic& diagnostic);

/// Collects what the stages report, in order.
class Diagnostics {
 public:
  void report(Diagnostic diagnostic);

  const std::vector<Diagnostic>& all() const { return all_; }
  int error_count() const { return errors_; }
  int warning_count() const { return warnings_; }

  /// `--strict`: each warning becomes an error.
  void promote_warnings();

 private:
  std::vector<Diagnostic> all_;
  int errors_ = 0;
  int warnings_ = 0;
};

/// The input cannot be compiled; what() is the first error as printed.  Exit status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The command line asks for what there is not.  Exit status 1.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The results cannot be written.  Exit status 3.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// User text made safe for one line of a terminal: control bytes and invalid UTF-8 as \xNN.
std::string printable(std::string_view text);

}  // namespace arboc
