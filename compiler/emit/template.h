// Text templates: `@name@` becomes the value of that name, nothing else happens.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace arboc {

/// Throws std::logic_error for a name of the template that has no value, and for a value that the
/// template does not use.
std::string fill(const std::string& name, const std::map<std::string, std::string>& values);

/// A file embedded in the program: a template ("cpp/NAME_raw.hpp"), a runtime header
/// ("runtime/arboc/scalar.hpp") or a header of the generic engine ("generic/...").
const std::string& embedded(const std::string& name);

/// All embedded names that begin with `prefix`, sorted.
std::vector<std::string> embedded_names(const std::string& prefix);

}  // namespace arboc
