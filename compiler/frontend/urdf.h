// URDF text -> Model, strictly: docs/input.md says what is accepted, refused and warned about.
//
// A file with errors gives no model: all errors are reported (20 at most, in file order) before
// InputError is thrown.  What has no bearing on the dynamics (shapes, materials, transmissions,
// other programs' extensions) is read over and listed in one note.
#pragma once
#include <string>
#include <string_view>

#include "model/model.h"

namespace arboc {

/// The model in the file at `path`; "-" is standard input.  Diagnostics show the path as given,
/// Model::file is its last part.
Model read_urdf(const std::string& path, Diagnostics& diagnostics);

/// The model that `text` describes.  Diagnostics show `file_name` as given.
Model parse_urdf(std::string_view text, std::string file_name, Diagnostics& diagnostics);

}  // namespace arboc
