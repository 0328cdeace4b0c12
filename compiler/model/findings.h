// What the checks of one input file find, in any order, and their delivery in file order.
//
// Checks run over a file in several sweeps (elements, names, tree, masses), so a later sweep may
// find the earlier fault.  Findings collects them all and hands them to the Diagnostics sorted by
// place: at most kShownErrors errors and kShownWarnings warnings, the rest as a number.
#pragma once
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/words.h"

namespace arboc {

struct Finding {
  Location where;
  std::string element;  ///< "joint 'elbow'", or empty
  std::string message;
  std::string hint{};
  std::string file{};  ///< that it is in; empty: the one of the Findings
};

class Findings {
 public:
  static constexpr int kShownErrors = 20;
  static constexpr int kShownWarnings = 100;

  /// `file` is shown in front of each finding: the path as the user gave it.
  explicit Findings(std::string file) : file_(std::move(file)) {}

  void report(Severity severity, Finding finding);
  void error(Finding finding) { report(Severity::kError, std::move(finding)); }
  void warning(Finding finding) { report(Severity::kWarning, std::move(finding)); }
  void note(Finding finding) { report(Severity::kNote, std::move(finding)); }

  /// Adds what was found here to what is found in another file.
  void hand_over(Findings& to) const;

  int error_count() const { return errors_; }
  /// So many errors that looking for more is of no use.
  bool full() const { return errors_ >= kKept; }

  /// Reports everything, errors and warnings by place and notes at the end; then throws an
  /// InputError with the first error if there is one.
  void deliver(Diagnostics& diagnostics) const;

 private:
  static constexpr int kKept = 1000;  // of each severity; bounds memory and the time to sort

  std::string file_;
  std::vector<Diagnostic> kept_;
  int errors_ = 0;
  int warnings_ = 0;
  int notes_ = 0;
};

/// "joint 'elbow'": a kind and the name the user gave, cut to a readable length.
std::string named(const char* kind, std::string_view name);

}  // namespace arboc
