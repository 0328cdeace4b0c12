// Chunks of a program -> statements, for languages without vectors.
#pragma once
#include <string>

#include "program/program.h"

namespace arboc {

/// The comment that a statement begins with if its block is not `block`, which becomes its own.
std::string block_comment(const Program& program, const Statement& statement, int& block);

/// `  tau[0] = -x4;`, a line.
std::string store_line(const Program& program, const Store& store, const Spelling& spelling);

/// Lines that define values, keep them and store them.  `type`: what stands before a new name, with
/// a space behind it.
std::string chunk_text(const Program& program, const Chunk& chunk, const Spelling& spelling,
                       const std::string& type, int& block);

}  // namespace arboc
