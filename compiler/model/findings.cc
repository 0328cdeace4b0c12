#include "model/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace arboc {

void Findings::report(Severity severity, Finding finding) {
  int& count = severity == Severity::kError     ? errors_
               : severity == Severity::kWarning ? warnings_
                                                : notes_;
  if (++count > kKept) return;
  kept_.push_back({severity, finding.file.empty() ? file_ : std::move(finding.file), finding.where,
                   std::move(finding.element), std::move(finding.message),
                   std::move(finding.hint)});
}

void Findings::hand_over(Findings& to) const {
  for (const Diagnostic& d : kept_)
    to.report(d.severity, {d.location, d.element, d.message, d.hint, d.file});
}

void Findings::deliver(Diagnostics& diagnostics) const {
  std::vector<Diagnostic> sorted = kept_;
  const auto place = [this](const Diagnostic& d) {
    return std::tuple(d.severity == Severity::kNote, d.file != file_, d.location.line,
                      d.location.column);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return place(a) < place(b); });
  int errors = 0, warnings = 0;
  std::string first_error;
  for (Diagnostic& d : sorted) {
    if (d.severity == Severity::kError) {
      if (++errors > kShownErrors) continue;
      if (errors == 1) first_error = to_string(d);
    } else if (d.severity == Severity::kWarning && ++warnings > kShownWarnings) {
      continue;
    }
    diagnostics.report(std::move(d));
  }
  const auto more = [&](int count, int shown, const char* what) {
    if (count > shown)
      diagnostics.report({Severity::kNote,
                          file_,
                          {},
                          "",
                          fmt::format("{} more {} not shown", count - shown, what),
                          ""});
  };
  more(errors_, kShownErrors, "errors");
  more(warnings_, kShownWarnings, "warnings");
  if (errors > 0) throw InputError(first_error);
}

std::string named(const char* kind, std::string_view name) {
  return name.empty() ? kind : fmt::format("{} {}", kind, quoted(name));
}

}  // namespace arboc
