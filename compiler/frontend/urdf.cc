#include "frontend/urdf.h"

#include "base/sha256.h"
#include "frontend/builder.h"
#include "frontend/input_file.h"
#include "frontend/schema_reader.h"
#include "frontend/urdfdom_check.h"
#include "model/validate.h"

namespace arboc {

Model parse_urdf(std::string_view text, std::string file_name, Diagnostics& diagnostics) {
  Findings findings(file_name);
  ModelBuilder builder(findings);
  SchemaReader reader(builder, findings);
  const bool complete = read_xml(text, reader, findings);
  Model model = builder.finish(complete);
  if (complete) validate(model, findings);
  findings.deliver(diagnostics);
  model.file = base_name(file_name);
  model.source_sha256 = sha256(text);
  compare_with_urdfdom(model);
  return model;
}

Model read_urdf(const std::string& path, Diagnostics& diagnostics) {
  const std::string shown = shown_path(path);
  Findings findings(shown);
  const auto text = read_input(path, findings);
  findings.deliver(diagnostics);
  Model model = parse_urdf(*text, shown, diagnostics);
  model.file = base_name(path);
  return model;
}

}  // namespace arboc
