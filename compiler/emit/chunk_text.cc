#include "emit/chunk_text.h"

#include <fmt/format.h>

#include "emit/names.h"

namespace arboc {

std::string block_comment(const Program& program, const Statement& s, int& block) {
  if (s.block == block) return {};
  block = s.block;
  return fmt::format("  // {}\n", comment_text(program.blocks[static_cast<size_t>(block)]));
}

std::string store_line(const Program& program, const Store& store, const Spelling& spelling) {
  return fmt::format("  {}[{}] = {};\n", program.outputs[static_cast<size_t>(store.port)].name,
                     store.index, text(program, store.value, spelling));
}

std::string chunk_text(const Program& program, const Chunk& chunk, const Spelling& spelling,
                       const std::string& type, int& block) {
  std::string out;
  for (const Statement& s : chunk.statements) {
    out += block_comment(program, s, block);
    out += fmt::format("  const {}x{} = {};\n", type, s.local, text(program, s, spelling));
    if (s.slot >= 0) out += fmt::format("  {} = x{};\n", slot_text(s), s.local);
    for (const Store& store : s.stores) out += store_line(program, store, spelling);
  }
  return out;
}

}  // namespace arboc
