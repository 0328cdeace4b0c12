// Links and joints by the names that options give.
#pragma once
#include <string>

#include "model/model.h"

namespace arboc {

/// The index of the link or joint called `name`; otherwise throws a UsageError that begins with
/// `option` and says which name was probably meant, or which there are.
int link_called(const Model& model, const std::string& name, const char* option);
int joint_called(const Model& model, const std::string& name, const char* option);

}  // namespace arboc
