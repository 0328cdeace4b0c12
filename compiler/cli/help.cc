#include "cli/help.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <sstream>

#include "base/diagnostic.h"
#include "cli/output.h"

namespace arboc::cli {
namespace {

/// With line breaks in place of blanks where a line would be longer than `width`.
std::string wrapped(const std::string& text, size_t width) {
  std::istringstream words(text);
  std::string out;
  size_t column = 0;
  for (std::string word; words >> word;) {
    const bool breaks = column > 0 && column + 1 + word.size() > width;
    if (column > 0) out += breaks ? '\n' : ' ';
    column = (breaks || column == 0 ? 0 : column + 1) + word.size();
    out += word;
  }
  return out;
}

class Formatter : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string type = option->get_type_name();
    return type.empty() ? "" : " " + type;
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string value = option->get_default_str();
    return wrapped(option->get_description() + (value.empty() ? "" : fmt::format(" [{}]", value)) +
                       (option->get_required() && !option->get_positional() ? " (required)" : ""),
                   66);
  }
};

}  // namespace

void set_help_style(CLI::App& app) {
  app.formatter(std::make_shared<Formatter>());
  app.get_formatter()->column_width(34);
  app.footer(
      "Exit status: 0 done, 1 usage, 2 input, 3 output, 4 internal, 5 the answer is no,\n"
      "130 interrupted.");
  app.set_help_flag("-h,--help", "print this help");
  app.failure_message([](const CLI::App* failed, const CLI::Error& error) {
    const CLI::App* sub = failed;
    std::string command = failed->get_name();
    while (!sub->get_subcommands().empty()) {
      sub = sub->get_subcommands().front();
      command += " " + sub->get_name();
    }
    return fmt::format("arboc: error: {}\n({} --help explains the usage)\n", error.what(), command);
  });
}

bool parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    app.exit(e);
    flush_stdout();
    return false;
  }
  if (app.get_subcommands().empty()) throw CLI::RequiredError("a subcommand");
  return true;
}

CLI::Validator quiet(CLI::Validator validator) { return validator.description(""); }

CLI::Validator choice(const std::vector<std::string>& words) {
  const auto index = [words](std::string& text) {
    const auto word = std::find(words.begin(), words.end(), text);
    if (word == words.end())
      return fmt::format("expected {}, not '{}'", fmt::join(words, " or "), printable(text));
    text = fmt::format("{}", word - words.begin());
    return std::string();
  };
  return {index, ""};
}

CLI::Validator count() { return quiet(CLI::Range(1, std::numeric_limits<int>::max())); }

}  // namespace arboc::cli
