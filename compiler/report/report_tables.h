// What the page of a report shows, as JSON.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "report/report.h"

namespace arboc {

/// Links as they hang together: what the page draws between the frames of fk.
nlohmann::ordered_json skeleton_json(const Model& model);
/// Joints that sliders move, with their places in q.
nlohmann::ordered_json controls_json(const Model& model);
/// A row a link.
nlohmann::ordered_json links_json(const Model& model);
/// {"severity", "file", "line", "column", "element", "message", "hint"}; 0 and "" where there is
/// none.
nlohmann::ordered_json to_json(const Diagnostic& diagnostic);
nlohmann::ordered_json diagnostics_json(const Diagnostics& diagnostics);
/// Operations by link and function; those of no link in a row of their own.
nlohmann::ordered_json operations_json(const ReportInput& input);
/// Where M, dtau_dq and dtau_dv are not zero; none where the model has no masses.
nlohmann::ordered_json matrices_json(const Setup& setup);
/// What the C++ compiler needs, by a rule of thumb.
nlohmann::ordered_json cost_json(const std::vector<CompiledFunction>& functions);

}  // namespace arboc
