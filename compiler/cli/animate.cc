// arboc animate MOTION -o FILE: a page that plays a motion.
#include <fmt/format.h>

#include <arboc/page/page.hpp>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/common.h"
#include "cli/output.h"

namespace arboc::cli {
namespace {

/// A member that is text; "" where it is not there or something else.
std::string text(const nlohmann::ordered_json& object, const char* member) {
  const auto found = object.is_object() ? object.find(member) : object.end();
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

int run_animate(const std::string& motion, const std::string& out) {
  std::ifstream file(motion, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: error: cannot be opened", printable(motion)));
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto json = nlohmann::ordered_json::parse(bytes, nullptr, false);
  if (json.is_discarded()) throw InputError(printable(motion) + ": error: not JSON");
  if (text(json, "format") != "arboc-motion/1")
    throw InputError(
        fmt::format("{}: error: no motion (\"format\": \"arboc-motion/1\")", printable(motion)));
  const std::string title = text(json, "title");
  write_one_file(out, page::animation(title.empty() ? "motion" : title, dump(json)));
  return kOk;
}

}  // namespace arboc::cli
