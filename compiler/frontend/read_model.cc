#include "frontend/read_model.h"

#include "base/diagnostic.h"
#include "frontend/dh.h"
#include "frontend/input_file.h"
#include "frontend/urdf.h"

namespace arboc {
namespace {

/// Not XML, and with the one section that a DH table must have.
bool looks_like_dh(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] != '<' &&
         (text.find("[[frames]]") != std::string_view::npos ||
          text.find("frames =") != std::string_view::npos);
}

}  // namespace

Model read_model(const std::string& path, Diagnostics& diagnostics,
                 const std::string& anthropometry) {
  const std::string shown = shown_path(path);
  Findings findings(shown);
  if (path.ends_with(".xacro"))
    findings.error({{}, "", "this is a xacro file", "run xacro on it first"});
  findings.deliver(diagnostics);
  const auto text = read_input(path, findings);
  findings.deliver(diagnostics);
  const bool is_dh = path.ends_with(".toml") || (path == "-" && looks_like_dh(*text));
  if (!is_dh && looks_like_dh(*text)) {
    findings.error({{1, 1}, "", "the file looks like a DH table, not like URDF",
                    "name it *.dh.toml"});
    findings.deliver(diagnostics);
  }
  if (!is_dh && !anthropometry.empty())
    throw UsageError("--anthropometry: the model is no DH table, and has no named lengths");
  Model model = is_dh ? parse_dh(*text, shown, anthropometry, diagnostics)
                      : parse_urdf(*text, shown, diagnostics);
  model.file = base_name(path);
  return model;
}

}  // namespace arboc
