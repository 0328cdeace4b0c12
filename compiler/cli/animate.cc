// arboc animate MOTION -o FILE: a page that plays a motion.
#include <fmt/format.h>

#include <arboc/page/page.hpp>
#include <nlohmann/json.hpp>

#include "cli/common.h"
#include "cli/output.h"
#include "frontend/input_file.h"
#include "model/findings.h"

namespace arboc::cli {
namespace {

/// A member that is text; "" where it is not there or something else.
std::string text(const nlohmann::ordered_json& object, const char* member) {
  const auto found = object.is_object() ? object.find(member) : object.end();
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

int run_animate(const std::string& motion, const std::string& out) {
  Diagnostics diagnostics;
  Findings findings(shown_path(motion));
  const auto bytes = read_input(motion, findings);
  findings.deliver(diagnostics);
  const auto json = nlohmann::ordered_json::parse(bytes.value(), nullptr, false);
  if (json.is_discarded()) throw InputError(printable(motion) + ": error: not JSON");
  if (text(json, "format") != "arboc-motion/1")
    throw InputError(
        fmt::format("{}: error: no motion (\"format\": \"arboc-motion/1\")", printable(motion)));
  const std::string title = text(json, "title");
  write_one_file(out, page::animation(title.empty() ? "motion" : title, dump(json)));
  return kOk;
}

}  // namespace arboc::cli
