// Options of how functions are simplified and written.
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "base/words.h"
#include "cli/common.h"
#include "cli/help.h"

namespace arboc::cli {
namespace {

std::vector<std::string_view> simplifications() {
  std::vector<std::string_view> names;
  for (const auto& [name, member] : kSimplifications) names.emplace_back(name);
  return names;
}

Simplifications parse_without(const std::string& list) {
  Simplifications simplify;
  for (const std::string& word : split(list)) {
    const auto* const found = std::find_if(std::begin(kSimplifications), std::end(kSimplifications),
                                           [&](const auto& known) { return word == known.first; });
    if (found == std::end(kSimplifications))
      throw UsageError(unknown("--without", "there is no simplification", word, simplifications()));
    simplify.*found->second = false;
  }
  return simplify;
}

}  // namespace

void add_text_options(CLI::App& app, FunctionOptions& f) {
  app.add_option_function<std::string>(
         "--without", [&f](const std::string& given) { f.simplify = parse_without(given); },
         fmt::format("simplifications to leave out, to see what they are worth: {}",
                     fmt::join(simplifications(), ", ")))
      ->type_name("LIST")
      ->group("Functions");
  app.add_option("--optimise", f.optimise,
                 "size: limbs that are alike share functions, for which speed has vectors")
      ->transform(choice({"speed", "size"}))
      ->default_str("speed")
      ->type_name("speed|size")
      ->group("Functions");
  app.add_option("--max-function-size", f.max_function_size,
                 "operations after which emitted code begins another function")
      ->check(count())
      ->capture_default_str()
      ->type_name("N")
      ->group("Functions");
}

}  // namespace arboc::cli
