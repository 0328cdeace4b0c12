// The command line's parsing, and how help and usage errors look.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace arboc::cli {

/// One form for all options: `--snap TOL   meaning [1e-09]`; errors begin with "arboc: error:".
void set_help_style(CLI::App& app);

/// Parses the arguments, of which one must be a subcommand.  False if they asked for --help or
/// --version, which have then been given.
bool parse(CLI::App& app, int argc, char** argv);

/// A check whose description stays out of the help text.
CLI::Validator quiet(CLI::Validator validator);

/// One of the words, given to the option as its index.
CLI::Validator choice(const std::vector<std::string>& words);

/// At least 1.
CLI::Validator count();

}  // namespace arboc::cli
