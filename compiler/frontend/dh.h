// DH tables (`*.dh.toml`) -> Model; docs/dh.md says what may stand in them.
//
// A file with errors gives no model: all errors are reported, those of the anthropometry files
// too, before InputError is thrown.
#pragma once
#include <string>
#include <string_view>

#include "model/model.h"

namespace arboc {

/// The model that `text` describes.  Diagnostics show `file_name` as given; a file that the text
/// names is looked for beside it.  `anthropometry`: the path of a file whose lengths and masses
/// replace those of the model and of the file that it names; empty: none.
Model parse_dh(std::string_view text, const std::string& file_name,
               const std::string& anthropometry, Diagnostics& diagnostics);

}  // namespace arboc
