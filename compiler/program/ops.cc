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

class Counter {
 public:
  explicit Counter(const Program& program) : by_limb_(program.by_limb) {}

  void add(const Statement& s, int times, OpCount& ops) const {
    switch (s.op) {
      case Op::kSum: add_sum(s, times, ops); break;
      case Op::kAdd: ops.add += times; break;
      case Op::kMul: ops.mul += times; break;
      case Op::kDiv: ops.div += times; break;
      case Op::kSqrt: ops.sqrt += times; break;
      case Op::kSin:
      case Op::kCos: ops.sincos += times; break;
      case Op::kStumpff:
      case Op::kQuaternionLog:
      case Op::kLogCurvature: ops.special += times; break;
      case Op::kPack: ops.pack += by_limb_ ? 0 : 1; break;
      case Op::kHsum: (by_limb_ ? ops.add : ops.hsum) += by_limb_ ? s.index - 1 : 1; break;
      case Op::kLane:
      case Op::kConstant:
      case Op::kInput: break;
    }
    for (const Store& store : s.stores) ops.lane += store.value.lane < 0 || by_limb_ ? 0 : 1;
  }

 private:
  static void add_sum(const Statement& s, int times, OpCount& ops) {
    const auto products = static_cast<int>(std::count_if(
        s.terms.begin(), s.terms.end(), [](const ProgramTerm& t) { return t.product; }));
    const int atoms = static_cast<int>(s.terms.size()) - products;
    ops.add += times * std::max(atoms - 1, 0);
    ops.fma += times * (atoms > 0 ? products : products - 1);
    ops.mul += atoms > 0 ? 0 : times;
  }

  bool by_limb_;
};

/// visit(statement, how often it is computed)
template <class Visit>
void each_statement(const Program& program, const Visit& visit) {
  for (const Statement& s : program.prologue.statements) visit(s, 1);
  for (const Chunk& chunk : program.chunks)
    for (const Statement& s : chunk.statements) visit(s, std::max(chunk.limbs, 1));
}

}  // namespace

OpCount count_ops(const Program& program) {
  OpCount ops;
  ops.sincos = static_cast<int>(program.angles.size());
  const Counter counter(program);
  each_statement(program, [&](const Statement& s, int times) { counter.add(s, times, ops); });
  return ops;
}

OpCount count_listed(const Program& program) {
  OpCount ops;
  const Counter counter(program);
  each_statement(program, [&](const Statement& s, int) { counter.add(s, 1, ops); });
  return ops;
}

std::vector<OpCount> count_ops_by_block(const Program& program) {
  std::vector<OpCount> ops(program.blocks.size());
  const Counter counter(program);
  each_statement(program, [&](const Statement& s, int times) {
    counter.add(s, times, ops[static_cast<size_t>(s.block)]);
  });
  return ops;
}

}  // namespace arboc
