// arboc animate MOTION -o FILE: a page that plays a motion.
#include <fmt/format.h>

#include <arboc/page/page.hpp>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/common.h"
#include "cli/output.h"

namespace arboc::cli {

int run_animate(const std::string& motion, const std::string& out) {
  std::ifstream file(motion, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw InputError(fmt::format("{}: error: cannot be read", printable(motion)));
  nlohmann::ordered_json json;
  try {
    json = nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::json::parse_error& e) {
    throw InputError(fmt::format("{}: error: not JSON: {}", printable(motion), e.what()));
  }
  if (!json.is_object() || json.value("format", "") != "arboc-motion/1")
    throw InputError(
        fmt::format("{}: error: no motion (\"format\": \"arboc-motion/1\")", printable(motion)));
  write_one_file(out, page::animation(json.value("title", "motion"), dump(json)));
  return kOk;
}

}  // namespace arboc::cli
