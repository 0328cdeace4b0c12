// Examples of a page of docs/, which are indented by four spaces:
//
//   $ a command          run in bash; it goes on where a line ends with a backslash
//   what it prints       up to an empty line or the next example
//   > words              an example that a test checks by itself
#pragma once
#include <string>
#include <vector>

namespace arboc::test {

struct CommandExample {
  int line = 0;  ///< where it begins
  std::string command;
  std::vector<std::string> output;
};

struct Page {
  std::vector<CommandExample> commands;
  std::vector<std::string> words;  ///< runs of blanks are one
};

Page read_page(const std::string& path);

/// With every run of blanks as one.
std::string single_spaced(const std::string& text);

/// Whether two lines are the same but for numbers: those with a point as far as `shown` has digits,
/// integers to 1e-9.
bool prints_as(const std::string& shown, const std::string& printed);

}  // namespace arboc::test
