// Committed text that a test compares with, and rewrites where ARBOC_UPDATE=1 is in the
// environment.
#pragma once
#include <string>

namespace arboc::test {

/// Whether this run rewrites what it would compare with.
bool updating();

/// The bytes of a file; empty if there is none.
std::string read_file(const std::string& path);
/// Makes the folders above it.
void write_file(const std::string& path, const std::string& bytes);

/// Compares, naming the first line that differs, or rewrites.
void expect_golden(const std::string& path, const std::string& actual);

}  // namespace arboc::test
