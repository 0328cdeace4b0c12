// The statements of a Program as text; the C++ emitter uses the very same lines.
#include <fmt/format.h>

#include "base/number.h"
#include "program/limb_text.h"
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

}  // namespace

std::string unsigned_text(const Program& program, const Operand& x, const Spelling& spelling) {
  if (x.lane >= 0 && program.by_limb) {
    if (x.sine) return fmt::format("w[{}]", x.index + x.lane);
    return fmt::format("w{}[{}]", x.width, program.lane_slots[x.width] * x.lane + x.index);
  }
  const std::string whole = whole_text(program, x, spelling);
  return x.lane < 0 ? whole : fmt::format("{}[{}]", whole, x.lane);
}

std::string text(const Program& program, const Operand& operand, const Spelling& spelling) {
  return (operand.negative ? "-" : "") + unsigned_text(program, operand, spelling);
}

namespace {

std::string signed_text(const Operand& x, const Naming& name) {
  return (x.negative ? "-" : "") + name(x);
}

std::string sum_text(const Statement& s, const Naming& name) {
  std::string line;
  for (const ProgramTerm& term : s.terms) {
    line += &term == &s.terms.front() ? (term.a.negative ? "-" : "")
            : term.a.negative         ? " - "
                                      : " + ";
    line += name(term.a);
    if (term.product) line += " * " + signed_text(term.b, name);
  }
  return line;
}

/// Of a program limb by limb: the lanes stand apart.
std::string limb_sum_text(const Program& program, const Statement& s) {
  Operand x = s.terms.front().a;
  const auto lane = [&](int k) {
    x.lane = k;
    return unsigned_text(program, x);
  };
  std::string sum = lane(0);
  for (int k = 1; k < s.index; ++k) sum += " + " + lane(k);
  return x.negative ? fmt::format("-({})", sum) : sum;
}

}  // namespace

std::string text(const Statement& s, const Naming& name, const Spelling& spelling) {
  const ProgramTerm& first = s.terms.front();
  const auto of = [&](const Operand& x) { return signed_text(x, name); };
  switch (s.op) {
    case Op::kSum: return sum_text(s, name);
    case Op::kPack: {
      std::string list;
      for (const ProgramTerm& term : s.terms) list += (&term == &first ? "" : ", ") + of(term.a);
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

std::string text(const Program& program, const Statement& s, const Spelling& spelling) {
  if (s.op == Op::kHsum && program.by_limb) return limb_sum_text(program, s);
  return text(
      s, [&](const Operand& x) { return unsigned_text(program, x, spelling); }, spelling);
}

std::string slot_text(const Statement& s) {
  return s.width == 1 ? fmt::format("w[{}]", s.slot) : fmt::format("w{}[{}]", s.width, s.slot);
}

std::vector<std::string> lanes_apart(const Program& program, const Statement& s) {
  std::vector<std::string> lines;
  if (!program.by_limb || s.width == 1) return lines;
  for (size_t k = 0; k < s.terms.size(); ++k)
    lines.push_back(fmt::format(
        "w{}[{}] = {}", s.width,
        static_cast<size_t>(program.lane_slots[s.width]) * k + static_cast<size_t>(s.slot),
        text(program, s.terms[k].a)));
  return lines;
}

namespace {

/// A statement, where its value is kept and what is stored.
std::vector<std::string> lines(const Program& program, const Statement& s) {
  std::vector<std::string> out = lanes_apart(program, s);
  if (!out.empty()) return out;
  out.push_back(fmt::format("x{} = {}", s.local, text(program, s)));
  if (s.slot >= 0) out.push_back(fmt::format("{} = x{}", slot_text(s), s.local));
  for (const Store& store : s.stores)
    out.push_back(fmt::format("{}[{}] = {}", program.outputs[static_cast<size_t>(store.port)].name,
                              store.index, text(program, store.value)));
  return out;
}

/// The title of a statement that begins another block.
std::string print_block(const Program& program, const Statement& s, int& block) {
  if (s.block == block) return {};
  return fmt::format("# {}\n", program.blocks[static_cast<size_t>(block = s.block)]);
}

std::string print(const Program& program, const Chunk& chunk, int& block) {
  std::string out;
  for (const Statement& s : chunk.statements) {
    out += print_block(program, s, block);
    for (const std::string& line : lines(program, s)) out += line + "\n";
  }
  return out;
}

std::string print_limb(const Program& program, size_t c, int& block) {
  const Chunk& chunk = program.chunks[c];
  LimbText limb(program, chunk);
  std::string body, out;
  for (const Statement& s : chunk.statements) {
    body += print_block(program, s, block);
    body += fmt::format("x{} = {}\n", s.local, limb.value(s));
    for (const std::string& line : limb.stores(s)) body += line + "\n";
  }
  const LimbText::Tables tables = limb.tables(fmt::format("part{}", c));
  for (const auto* list : {&tables.definitions, &tables.rows})
    for (const std::string& line : *list) out += line + "\n";
  return out + body;
}

}  // namespace

std::string print(const Program& program) {
  std::string out = fmt::format("program {}: {} slots, {} operations, {} sincos\n", program.name,
                                program.slots, program.ops.total(), program.ops.sincos);
  int block = 0;
  out += print(program, program.prologue, block);
  for (size_t k = 0; k < program.angles.size(); ++k)
    out +=
        fmt::format("w[{}], w[{}] = sincos({})\n", k, k + static_cast<size_t>(program.angle_stride),
                    text(program, program.angles[k]));
  for (size_t c = 0; c < program.chunks.size(); ++c) {
    const Chunk& chunk = program.chunks[c];
    out += fmt::format("chunk {}", c);
    if (chunk.limbs > 0) out += fmt::format(", for each of {} limbs", chunk.limbs);
    out += "\n" + (chunk.limbs > 0 ? print_limb(program, c, block) : print(program, chunk, block));
  }
  for (const Store& store : program.stores)
    out += fmt::format("{}[{}] = {}\n", program.outputs[static_cast<size_t>(store.port)].name,
                       store.index, text(program, store.value));
  return out;
}

}  // namespace arboc
