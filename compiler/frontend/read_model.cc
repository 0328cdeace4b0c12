#include "frontend/read_model.h"

#include "frontend/input_file.h"
#include "frontend/urdf.h"

namespace arboc {

Model read_model(const std::string& path, Diagnostics& diagnostics) {
  const auto refuse = [&](const char* message, const char* hint) {
    Findings findings(shown_path(path));
    findings.error({{}, "", message, hint});
    findings.deliver(diagnostics);
  };
  if (path.ends_with(".toml")) refuse("this is not a URDF file", "TOML models cannot be read");
  if (path.ends_with(".xacro")) refuse("this is a xacro file", "run xacro on it first");
  return read_urdf(path, diagnostics);
}

}  // namespace arboc
