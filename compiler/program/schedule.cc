// schedule(): order, chunks, slots.
#include <algorithm>

#include "program/program.h"

namespace arboc {
namespace {

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
    default: return 0;
  }
}

class Scheduler {
 public:
  Scheduler(const Region& region, const ScheduleOptions& options)
      : in_(region),
        options_(options),
        chunk_of_(region.nodes.size(), kNowhere),
        last_use_(region.nodes.size(), kNowhere),
        angle_(region.nodes.size(), -1),
        slot_(region.nodes.size(), -1),
        stored_(region.nodes.size()) {}

  Program run() {
    out_.name = in_.name;
    out_.inputs = in_.inputs;
    out_.outputs = in_.outputs;
    out_.blocks = in_.blocks;
    find_angles();
    cut();
    find_last_uses();
    const int angles = static_cast<int>(angle_node_.size());
    out_.angle_stride = angles < 2 ? angles : (angles + 3) / 4 * 4;
    out_.slots = 2 * out_.angle_stride;
    collect_stores();
    for (const std::uint32_t n : prologue_)
      out_.prologue.statements.push_back(statement(n, kPrologue));
    for (const std::uint32_t n : angle_node_) out_.angles.push_back(operand(Ref(n), kPrologue));
    for (size_t c = 0; c < members_.size(); ++c) emit_chunk(static_cast<int>(c));
    out_.ops = count_ops(out_);
    return std::move(out_);
  }

 private:
  static constexpr int kNowhere = -2;
  static constexpr int kPrologue = -1;

  /// An angle is early if inputs and constants alone determine it without further sines.
  void find_angles() {
    std::vector<char> early(in_.nodes.size(), 0), needed(in_.nodes.size(), 0);
    for (size_t n = 0; n < in_.nodes.size(); ++n) {
      const Node& node = in_.nodes[n];
      early[n] = node.op != Op::kSin && node.op != Op::kCos;
      for_each_operand(in_, node, [&](Ref r) { early[n] = early[n] && early[r.node()]; });
      if ((node.op != Op::kSin && node.op != Op::kCos) || !early[node.a.node()]) continue;
      needed[node.a.node()] = 1;
      if (angle_[node.a.node()] >= 0) continue;
      angle_[node.a.node()] = static_cast<int>(angle_node_.size());
      angle_node_.push_back(node.a.node());
    }
    for (size_t n = in_.nodes.size(); n-- > 0;)
      if (needed[n]) for_each_operand(in_, in_.nodes[n], [&](Ref r) { needed[r.node()] = 1; });
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n) {
      if (!needed[n] || is_leaf(n)) continue;
      prologue_.push_back(n);
      chunk_of_[n] = kPrologue;
    }
  }

  bool is_leaf(std::uint32_t n) const {
    return in_.nodes[n].op == Op::kConstant || in_.nodes[n].op == Op::kInput;
  }
  bool is_early_trig(std::uint32_t n) const {
    const Node& node = in_.nodes[n];
    return (node.op == Op::kSin || node.op == Op::kCos) && angle_[node.a.node()] >= 0;
  }

  void cut() {
    int ops = 0;
    members_.emplace_back();
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n) {
      if (is_leaf(n) || is_early_trig(n) || chunk_of_[n] == kPrologue) continue;
      if (ops >= options_.chunk_ops) {
        members_.emplace_back();
        ops = 0;
      }
      ops += cost(in_, in_.nodes[n]);
      chunk_of_[n] = static_cast<int>(members_.size()) - 1;
      members_.back().push_back(n);
    }
    // A short rest is not worth a function of its own.
    if (members_.size() > 1 && ops < options_.chunk_ops / 5) {
      const auto rest = std::move(members_.back());
      members_.pop_back();
      for (const std::uint32_t n : rest) chunk_of_[n] = static_cast<int>(members_.size()) - 1;
      members_.back().insert(members_.back().end(), rest.begin(), rest.end());
    }
  }

  void find_last_uses() {
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n) {
      if (chunk_of_[n] == kNowhere) continue;
      for_each_operand(in_, in_.nodes[n], [&](Ref r) {
        last_use_[r.node()] = std::max(last_use_[r.node()], chunk_of_[n]);
      });
    }
  }

  void collect_stores() {
    for (size_t p = 0; p < in_.results.size(); ++p) {
      for (size_t e = 0; e < in_.results[p].size(); ++e) {
        const Ref ref = in_.results[p][e];
        const Store store{static_cast<int>(p), static_cast<int>(e), {}};
        const int chunk = chunk_of_[ref.node()];
        if (chunk == kNowhere)
          out_.stores.push_back({store.port, store.index, operand(ref, kNowhere)});
        else
          stored_[ref.node()].push_back({store, ref.negative()});
      }
    }
  }

  Operand operand(Ref ref, int chunk) const {
    const Node& node = in_[ref];
    Operand x;
    x.negative = ref.negative();
    if (node.op == Op::kConstant) {
      x.value = in_.constants[node.index];
    } else if (node.op == Op::kInput) {
      x.place = Operand::Place::kInput;
      x.index = static_cast<int>(node.index);
      while (x.index >= in_.inputs[static_cast<size_t>(x.port)].size)
        x.index -= in_.inputs[static_cast<size_t>(x.port++)].size;
    } else if (is_early_trig(ref.node())) {
      x.place = Operand::Place::kSlot;
      x.index = angle_[node.a.node()] + (node.op == Op::kCos ? out_.angle_stride : 0);
    } else if (chunk_of_[ref.node()] == chunk) {
      x.place = Operand::Place::kLocal;
      x.index = static_cast<int>(ref.node());
    } else {
      x.place = Operand::Place::kSlot;
      x.index = slot_[ref.node()];
    }
    return x;
  }

  Statement statement(std::uint32_t n, int chunk) {
    const Node& node = in_.nodes[n];
    Statement s;
    s.op = node.op;
    if (node.op == Op::kStumpff) s.index = static_cast<int>(node.index);
    s.local = static_cast<int>(n);
    s.block = node.block;
    if (node.op == Op::kSum) {
      for (std::uint32_t t = node.index; t < node.index + node.count; ++t) {
        const Term& term = in_.terms[t];
        s.terms.push_back({operand(term.a, chunk), {}, term.product});
        if (term.product) s.terms.back().b = operand(term.b, chunk);
      }
    } else {
      s.terms.push_back({operand(node.a, chunk), {}, operand_count(node.op) > 1});
      if (s.terms[0].product) s.terms[0].b = operand(node.b, chunk);
    }
    if (last_use_[n] > chunk) s.slot = slot_[n] = take_slot();
    for (auto [store, negative] : stored_[n]) {
      store.value = {Operand::Place::kLocal, negative, 0, 0, s.local};
      s.stores.push_back(store);
    }
    return s;
  }

  int take_slot() {
    if (free_.empty()) return out_.slots++;
    const int slot = free_.back();
    free_.pop_back();
    return slot;
  }

  void emit_chunk(int c) {
    out_.chunks.emplace_back();
    for (const std::uint32_t n : members_[static_cast<size_t>(c)]) {
      out_.chunks.back().statements.push_back(statement(n, c));
      if (slot_[n] >= 0) busy_.push_back(n);
    }
    const auto done = std::stable_partition(busy_.begin(), busy_.end(),
                                            [&](std::uint32_t n) { return last_use_[n] > c; });
    for (auto it = done; it != busy_.end(); ++it) free_.push_back(slot_[*it]);
    busy_.erase(done, busy_.end());
  }

  struct PendingStore {
    Store store;
    bool negative;
  };

  const Region& in_;
  ScheduleOptions options_;
  Program out_;
  std::vector<int> chunk_of_;  ///< per node: chunk, kPrologue or kNowhere
  std::vector<int> last_use_;  ///< per node: last chunk that reads it
  std::vector<int> angle_;     ///< per node: number as an angle, or -1
  std::vector<std::uint32_t> angle_node_;
  std::vector<std::uint32_t> prologue_;
  std::vector<std::vector<std::uint32_t>> members_;  ///< nodes of each chunk
  std::vector<int> slot_;
  std::vector<std::vector<PendingStore>> stored_;
  std::vector<int> free_;
  std::vector<std::uint32_t> busy_;
};

}  // namespace

Program schedule(const Graph& graph, const ScheduleOptions& options) {
  return Scheduler(graph.regions.back(), options).run();
}

OpCount count_ops(const Program& program) {
  OpCount ops;
  ops.sincos = static_cast<int>(program.angles.size());
  const auto count = [&](const Statement& s) {
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
      case Op::kConstant:
      case Op::kInput: break;
    }
  };
  for (const Statement& s : program.prologue.statements) count(s);
  for (const Chunk& chunk : program.chunks)
    for (const Statement& s : chunk.statements) count(s);
  return ops;
}

}  // namespace arboc
