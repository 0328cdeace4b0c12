// Mutations of model files that keep them markup, so that mutants get past the XML parser.
#pragma once
#include <cstdint>
#include <string>

namespace arboc::fuzz {

/// Deletes, doubles, swaps or moves an element; deletes, doubles or renames an attribute; or
/// replaces a value by that of another attribute or by a hostile number or name.
std::string mutate_markup(const std::string& text, std::uint64_t seed);

}  // namespace arboc::fuzz
