#include "program/ops.h"

#include <algorithm>

namespace arboc {

int cost(const Region& region, const Node& node) {
  switch (node.op) {
    case Op::kSum: return static_cast<int>(node.count) - (region.terms[node.index].product ? 0 : 1);
    case Op::kMul:
    case Op::kDiv:
    case Op::kSqrt:
    case Op::kAdd: return 1;
    case Op::kStumpff:
    case Op::kQuaternionLog:
    case Op::kLogCurvature: return 20;
    case Op::kPack: return 2;
    case Op::kHsum: return 3;
    default: return 0;
  }
}

namespace {

void count(const Statement& s, OpCount& ops) {
  switch (s.op) {
    case Op::kSum: {
      const auto products = static_cast<int>(std::count_if(
          s.terms.begin(), s.terms.end(), [](const ProgramTerm& t) { return t.product; }));
      const int atoms = static_cast<int>(s.terms.size()) - products;
      ops.add += std::max(atoms - 1, 0);
      ops.fma += atoms > 0 ? products : products - 1;
      ops.mul += atoms > 0 ? 0 : 1;
      break;
    }
    case Op::kAdd: ++ops.add; break;
    case Op::kMul: ++ops.mul; break;
    case Op::kDiv: ++ops.div; break;
    case Op::kSqrt: ++ops.sqrt; break;
    case Op::kSin:
    case Op::kCos: ++ops.sincos; break;
    case Op::kStumpff:
    case Op::kQuaternionLog:
    case Op::kLogCurvature: ++ops.special; break;
    case Op::kPack: ++ops.pack; break;
    case Op::kHsum: ++ops.hsum; break;
    case Op::kLane:
    case Op::kConstant:
    case Op::kInput: break;
  }
  for (const Store& store : s.stores) ops.lane += store.value.lane < 0 ? 0 : 1;
}

template <class Visit>
void each_statement(const Program& program, const Visit& visit) {
  for (const Statement& s : program.prologue.statements) visit(s);
  for (const Chunk& chunk : program.chunks)
    for (const Statement& s : chunk.statements) visit(s);
}

}  // namespace

OpCount count_ops(const Program& program) {
  OpCount ops;
  ops.sincos = static_cast<int>(program.angles.size());
  each_statement(program, [&](const Statement& s) { count(s, ops); });
  return ops;
}

std::vector<OpCount> count_ops_by_block(const Program& program) {
  std::vector<OpCount> ops(program.blocks.size());
  each_statement(program, [&](const Statement& s) { count(s, ops[static_cast<size_t>(s.block)]); });
  return ops;
}

}  // namespace arboc
