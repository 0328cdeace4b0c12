// schedule(): order, chunks, slots.
#include <algorithm>

#include "program/limb_phases.h"
#include "program/ops.h"

namespace arboc {
namespace {

class Scheduler {
 public:
  Scheduler(const Region& region, const ScheduleOptions& options)
      : in_(region),
        options_(options),
        chunk_of_(region.nodes.size(), kNowhere),
        last_use_(region.nodes.size(), kNowhere),
        angle_(region.nodes.size(), -1),
        slot_(region.nodes.size(), -1),
        read_(region.nodes.size(), 0),
        stored_(region.nodes.size()) {}

  Program run() {
    out_.name = in_.name;
    out_.inputs = in_.inputs;
    out_.outputs = in_.outputs;
    out_.blocks = in_.blocks;
    out_.by_limb = options_.by_limb;
    find_angles();
    find_readers();
    cut();
    find_last_uses();
    place_angles();
    const int angles = angles_;
    out_.angle_stride = angles < 2 ? angles : (angles + 3) / 4 * 4;
    out_.slots = 2 * out_.angle_stride;
    collect_stores();
    for (const std::uint32_t n : prologue_)
      out_.prologue.statements.push_back(statement(n, kPrologue));
    for (const std::uint32_t n : angle_node_) add_angle(n);
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
      early[n] = node.op != Op::kSin && node.op != Op::kCos &&
                 !(options_.by_limb && node.width > 1 && node.op != Op::kPack);
      for_each_operand(in_, node, [&](Ref r) { early[n] = early[n] && early[r.node()]; });
      if ((node.op != Op::kSin && node.op != Op::kCos) || !early[node.a.node()]) continue;
      needed[node.a.node()] = 1;
      if (angle_[node.a.node()] >= 0) continue;
      angle_[node.a.node()] = 0;
      angle_node_.push_back(node.a.node());
    }
    for (const std::uint32_t n : angle_node_) {  // packs are taken apart
      if (in_.nodes[n].op != Op::kPack) continue;
      needed[n] = 0;
      for_each_operand(in_, in_.nodes[n], [&](Ref r) { needed[r.node()] = 1; });
    }
    for (size_t n = in_.nodes.size(); n-- > 0;)
      if (needed[n]) for_each_operand(in_, in_.nodes[n], [&](Ref r) { needed[r.node()] = 1; });
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n) {
      if (!needed[n] || is_leaf(n)) continue;
      prologue_.push_back(n);
      chunk_of_[n] = kPrologue;
    }
  }

  /// Wide ones first, so that their lanes do not straddle two vectors.
  void place_angles() {
    std::stable_sort(angle_node_.begin(), angle_node_.end(),
                     [&](auto a, auto b) { return in_.nodes[a].width > in_.nodes[b].width; });
    for (const std::uint32_t n : angle_node_) {
      angle_[n] = angles_;
      angles_ += in_.nodes[n].width;
    }
  }

  void add_angle(std::uint32_t n) {
    const Node& node = in_.nodes[n];
    if (node.op == Op::kPack) {
      for_each_operand(in_, node, [&](Ref r) { out_.angles.push_back(operand(r, kPrologue)); });
      return;
    }
    Operand angle = operand(Ref(n), kPrologue);
    for (int k = 0; k < node.width; ++k) {
      angle.lane = node.width == 1 ? -1 : k;
      out_.angles.push_back(angle);
    }
  }

  /// What is read in place: constants, inputs, and lanes of others.
  bool is_leaf(std::uint32_t n) const {
    const Op op = in_.nodes[n].op;
    return op == Op::kConstant || op == Op::kInput || op == Op::kLane;
  }
  /// The value that a lane is taken out of, or the value itself.
  std::uint32_t source(Ref ref) const {
    return in_[ref].op == Op::kLane ? in_[ref].a.node() : ref.node();
  }
  bool is_early_trig(std::uint32_t n) const {
    const Node& node = in_.nodes[n];
    return (node.op == Op::kSin || node.op == Op::kCos) && angle_[node.a.node()] >= 0;
  }

  /// A pack that only sines need is taken apart and not a value itself.
  void find_readers() {
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n)
      if (!is_early_trig(n))
        for_each_operand(in_, in_.nodes[n], [&](Ref r) { read_[source(r)] = 1; });
    for (const auto& port : in_.results)
      for (const Ref ref : port) read_[source(ref)] = 1;
  }
  bool is_angle_only(std::uint32_t n) const {
    return in_.nodes[n].op == Op::kPack && angle_[n] >= 0 && !read_[n];
  }

  void cut() {
    std::vector<char> placed(in_.nodes.size());
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n)
      placed[n] = is_leaf(n) || is_early_trig(n) || chunk_of_[n] == kPrologue || is_angle_only(n);
    if (options_.by_limb) {
      for (const Phase& phase : limb_phases(in_, placed)) cut(phase);
      return;
    }
    Phase all;
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n)
      if (!placed[n]) all.nodes.push_back(n);
    cut(all);
  }

  void cut(const Phase& phase) {
    const size_t first = members_.size();
    int ops = 0;
    members_.emplace_back();
    for (const std::uint32_t n : phase.nodes) {
      if (ops >= options_.chunk_ops) {
        members_.emplace_back();
        ops = 0;
      }
      ops += cost(in_, in_.nodes[n]);
      members_.back().push_back(n);
    }
    // A short rest is not worth a function of its own.
    if (members_.size() > first + 1 && ops < options_.chunk_ops / 5) {
      const auto rest = std::move(members_.back());
      members_.pop_back();
      members_.back().insert(members_.back().end(), rest.begin(), rest.end());
    }
    limbs_.resize(members_.size(), phase.limbs);
    for (size_t c = first; c < members_.size(); ++c)
      for (const std::uint32_t n : members_[c]) chunk_of_[n] = static_cast<int>(c);
  }

  void find_last_uses() {
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n) {
      if (chunk_of_[n] == kNowhere) continue;
      for_each_operand(in_, in_.nodes[n], [&](Ref r) {
        last_use_[source(r)] = std::max(last_use_[source(r)], chunk_of_[n]);
      });
    }
  }

  void collect_stores() {
    for (size_t p = 0; p < in_.results.size(); ++p) {
      for (size_t e = 0; e < in_.results[p].size(); ++e) {
        const Ref ref = in_.results[p][e];
        const Store store{static_cast<int>(p), static_cast<int>(e), {}};
        if (chunk_of_[source(ref)] == kNowhere)
          out_.stores.push_back({store.port, store.index, operand(ref, kNowhere)});
        else
          stored_[source(ref)].push_back({store, ref});
      }
    }
  }

  Operand operand(Ref ref, int chunk) const {
    const Node& node = in_[ref];
    if (node.op == Op::kLane) {
      Operand whole = operand(node.a.with_sign_of(ref), chunk);
      whole.lane = static_cast<int>(node.index);
      return whole;
    }
    Operand x;
    x.negative = ref.negative();
    x.width = node.width;
    if (node.op == Op::kConstant) {
      x.value = in_.lanes(ref.positive());
    } else if (node.op == Op::kInput) {
      x.place = Operand::Place::kInput;
      x.index = static_cast<int>(node.index);
      while (x.index >= in_.inputs[static_cast<size_t>(x.port)].size)
        x.index -= in_.inputs[static_cast<size_t>(x.port++)].size;
    } else if (is_early_trig(ref.node())) {
      x.place = Operand::Place::kSlot;
      x.sine = true;
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
    if (node.op == Op::kStumpff || node.op == Op::kHsum) s.index = static_cast<int>(node.index);
    s.width = node.width;
    s.local = static_cast<int>(n);
    s.block = node.block;
    if (node.op == Op::kSum || node.op == Op::kPack) {
      for (std::uint32_t t = node.index; t < node.index + node.count; ++t) {
        const Term& term = in_.terms[t];
        s.terms.push_back({operand(term.a, chunk), {}, term.product});
        if (term.product) s.terms.back().b = operand(term.b, chunk);
      }
    } else {
      s.terms.push_back({operand(node.a, chunk), {}, operand_count(node.op) > 1});
      if (s.terms[0].product) s.terms[0].b = operand(node.b, chunk);
    }
    if (last_use_[n] > chunk) s.slot = slot_[n] = take_slot(node.width);
    for (auto [store, ref] : stored_[n]) {
      store.value = operand(ref, chunk);
      s.stores.push_back(store);
    }
    return s;
  }

  int take_slot(int width) {
    std::vector<int>& free = free_[width];
    if (free.empty()) return width == 1 ? out_.slots++ : out_.lane_slots[width]++;
    const int slot = free.back();
    free.pop_back();
    return slot;
  }

  void emit_chunk(int c) {
    out_.chunks.emplace_back();
    out_.chunks.back().limbs = limbs_[static_cast<size_t>(c)];
    for (const std::uint32_t n : members_[static_cast<size_t>(c)]) {
      out_.chunks.back().statements.push_back(statement(n, c));
      if (slot_[n] >= 0) busy_.push_back(n);
    }
    const auto done = std::stable_partition(busy_.begin(), busy_.end(),
                                            [&](std::uint32_t n) { return last_use_[n] > c; });
    for (auto it = done; it != busy_.end(); ++it) free_[in_.nodes[*it].width].push_back(slot_[*it]);
    busy_.erase(done, busy_.end());
  }

  struct PendingStore {
    Store store;
    Ref value;
  };

  const Region& in_;
  ScheduleOptions options_;
  Program out_;
  std::vector<int> chunk_of_;  ///< per node: chunk, kPrologue or kNowhere
  std::vector<int> last_use_;  ///< per node: last chunk that reads it
  std::vector<int> angle_;     ///< per node: where its lanes begin among the angles, or -1
  int angles_ = 0;             ///< scalars
  std::vector<std::uint32_t> angle_node_;
  std::vector<std::uint32_t> prologue_;
  std::vector<std::vector<std::uint32_t>> members_;  ///< nodes of each chunk
  std::vector<int> limbs_;                           ///< of each chunk
  std::vector<int> slot_;
  std::vector<char> read_;  ///< per node: something else than an early sine reads it
  std::vector<std::vector<PendingStore>> stored_;
  std::vector<int> free_[kMostLanes + 1];  ///< by width
  std::vector<std::uint32_t> busy_;
};

}  // namespace

Program schedule(const Graph& graph, const ScheduleOptions& options) {
  return Scheduler(graph.regions.back(), options).run();
}

}  // namespace arboc
