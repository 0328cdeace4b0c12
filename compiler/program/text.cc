// The statements of a Program as text; the C++ emitter uses the very same lines.
#include <fmt/format.h>

#include "base/number.h"
#include "program/program.h"

namespace arboc {
namespace {

std::string constant(const Lanes& value, const Spelling& spelling) {
  const auto number = [&](int k) {
    return fmt::format(fmt::runtime(spelling.constant), literal(value.x[k]));
  };
  if (value.width == 1) return number(0);
  std::string list;
  for (int k = 0; k < value.width; ++k) list += (k ? ", " : "") + number(k);
  return fmt::format("V{}{{{}}}", value.width, list);
}

std::string whole_text(const Program& program, const Operand& x, const Spelling& spelling) {
  switch (x.place) {
    case Operand::Place::kConstant: return constant(x.value, spelling);
    case Operand::Place::kInput:
      return fmt::format("{}[{}]", program.inputs[static_cast<size_t>(x.port)].name, x.index);
    case Operand::Place::kLocal: return fmt::format("x{}", x.index);
    case Operand::Place::kSlot:
      if (x.width == 1) return fmt::format("w[{}]", x.index);
      if (x.sine) return fmt::format("arboc::lanes<{}>(w + {})", x.width, x.index);
      return fmt::format("w{}[{}]", x.width, x.index);
  }
  return {};
}

std::string unsigned_text(const Program& program, const Operand& x, const Spelling& spelling) {
  const std::string whole = whole_text(program, x, spelling);
  return x.lane < 0 ? whole : fmt::format("{}[{}]", whole, x.lane);
}

std::string product(const Program& program, const ProgramTerm& term, const Spelling& spelling) {
  const std::string a = unsigned_text(program, term.a, spelling);
  return term.product ? a + " * " + text(program, term.b, spelling) : a;
}

}  // namespace

std::string text(const Program& program, const Operand& operand, const Spelling& spelling) {
  return (operand.negative ? "-" : "") + unsigned_text(program, operand, spelling);
}

std::string text(const Program& program, const Statement& s, const Spelling& spelling) {
  const ProgramTerm& first = s.terms.front();
  const auto of = [&](const Operand& x) { return text(program, x, spelling); };
  switch (s.op) {
    case Op::kSum: {
      std::string line;
      for (const ProgramTerm& term : s.terms) {
        line += &term == &first ? (term.a.negative ? "-" : "") : term.a.negative ? " - " : " + ";
        line += product(program, term, spelling);
      }
      return line;
    }
    case Op::kPack: {
      std::string list;
      for (const ProgramTerm& term : s.terms)
        list += (&term == &first ? "" : ", ") + of(term.a);
      return fmt::format("V{}{{{}}}", s.width, list);
    }
    case Op::kHsum: return fmt::format("arboc::hsum<{}>({})", s.index, of(first.a));
    case Op::kAdd:
    case Op::kMul:
    case Op::kDiv: return fmt::format("{} {} {}", of(first.a), arboc::spelling(s.op), of(first.b));
    case Op::kStumpff:
      return fmt::format(fmt::runtime(spelling.indexed), arboc::spelling(s.op), s.index,
                         of(first.a));
    case Op::kQuaternionLog:
    case Op::kLogCurvature:
      return fmt::format(fmt::runtime(spelling.special), arboc::spelling(s.op), of(first.a));
    case Op::kSqrt:
      if (s.width > 1) return fmt::format("arboc::lane_sqrt({})", of(first.a));
      [[fallthrough]];
    default: return fmt::format(fmt::runtime(spelling.call), arboc::spelling(s.op), of(first.a));
  }
}

std::string slot_text(const Statement& s) {
  return s.width == 1 ? fmt::format("w[{}]", s.slot) : fmt::format("w{}[{}]", s.width, s.slot);
}

std::string print(const Program& program) {
  std::string out = fmt::format("program {}: {} slots, {} operations, {} sincos\n", program.name,
                                program.slots, program.ops.total(), program.ops.sincos);
  int block = 0;
  const auto print_chunk = [&](const Chunk& chunk) {
    for (const Statement& s : chunk.statements) {
      if (s.block != block)
        out += fmt::format("# {}\n", program.blocks[static_cast<size_t>(block = s.block)]);
      out += fmt::format("x{} = {}\n", s.local, text(program, s));
      if (s.slot >= 0) out += fmt::format("{} = x{}\n", slot_text(s), s.local);
      for (const Store& store : s.stores)
        out += fmt::format("{}[{}] = {}\n", program.outputs[static_cast<size_t>(store.port)].name,
                           store.index, text(program, store.value));
    }
  };
  print_chunk(program.prologue);
  for (size_t k = 0; k < program.angles.size(); ++k)
    out +=
        fmt::format("w[{}], w[{}] = sincos({})\n", k, k + static_cast<size_t>(program.angle_stride),
                    text(program, program.angles[k]));
  for (size_t c = 0; c < program.chunks.size(); ++c) {
    out += fmt::format("chunk {}\n", c);
    print_chunk(program.chunks[c]);
  }
  for (const Store& store : program.stores)
    out += fmt::format("{}[{}] = {}\n", program.outputs[static_cast<size_t>(store.port)].name,
                       store.index, text(program, store.value));
  return out;
}

}  // namespace arboc
