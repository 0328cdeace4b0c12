// Parts of task files, for the readers of all studies.
#pragma once
#include "common/task_file.h"
#include "task.h"

namespace posture {

/// Of a document, whose base is already under it.
Task task_of(const toml::table& document, const std::string& name);
/// name, frame, point, a place, offset, align.
Target read_target(study::Table& table);
/// Numbers by name; none where there is no key.
std::map<std::string, double> read_numbers(study::Table& table, const char* key);

}  // namespace posture
