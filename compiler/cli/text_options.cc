// Options of how functions are simplified and written.
#include <algorithm>
#include <sstream>

#include "base/words.h"
#include "cli/common.h"
#include "cli/help.h"

namespace arboc::cli {
namespace {

Simplifications parse_without(const std::string& list) {
  Simplifications simplify;
  const std::pair<const char*, bool*> known[] = {{"frames", &simplify.frames},
                                                 {"regroup", &simplify.regroup},
                                                 {"fuse", &simplify.fuse},
                                                 {"dead", &simplify.dead},
                                                 {"limbs", &simplify.limbs}};
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    const auto* const found = std::find_if(std::begin(known), std::end(known),
                                           [&](const auto& k) { return word == k.first; });
    if (found == std::end(known))
      throw UsageError(unknown("--without", "there is no simplification", word,
                               {"frames", "regroup", "fuse", "dead", "limbs"}));
    *found->second = false;
  }
  return simplify;
}

}  // namespace

void add_text_options(CLI::App& app, FunctionOptions& f) {
  app.add_option_function<std::string>(
         "--without", [&f](const std::string& given) { f.simplify = parse_without(given); },
         "simplifications to leave out, to see what they are worth: frames, regroup, fuse, dead, "
         "limbs")
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
