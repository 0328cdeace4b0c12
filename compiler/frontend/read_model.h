// A model file of any kind -> Model.
#pragma once
#include <string>

#include "model/model.h"

namespace arboc {

/// Reads the file at `path` ("-": standard input, of which the text tells what it is) with the front
/// end that its name asks for; throws InputError after reporting what is wrong.  `anthropometry`:
/// see dh.h; UsageError if the model is not a DH table.
Model read_model(const std::string& path, Diagnostics& diagnostics,
                 const std::string& anthropometry = {});

}  // namespace arboc
