// The bytes of an input file, whatever kind of file it is, up to a limit.
#pragma once
#include <optional>
#include <string>

#include "model/findings.h"

namespace arboc {

constexpr size_t kMaxFileBytes = size_t{64} << 20;

/// Everything that can be read from `path` ("-": standard input; a pipe or device is read to its
/// end).  Reports an error and returns nothing if the file cannot be read, is a directory, or holds
/// more than kMaxFileBytes; an endless input ends there.
std::optional<std::string> read_input(const std::string& path, Findings& findings);

/// What stands for the file in diagnostics: the path, or "<stdin>".
std::string shown_path(const std::string& path);

/// What stands for the file in output: its name without the folders, or "stdin".
std::string base_name(const std::string& path);

}  // namespace arboc
