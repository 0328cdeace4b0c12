// A model file of any kind -> Model.
#pragma once
#include <string>

#include "model/model.h"

namespace arboc {

/// Reads the file at `path` ("-": standard input) with the front end that its name asks for; throws
/// InputError after reporting what is wrong.
Model read_model(const std::string& path, Diagnostics& diagnostics);

}  // namespace arboc
