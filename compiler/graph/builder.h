// Builds a region node by node: hash-consing and the local rewriting rules.
//
// Equal expressions become one node, so equality of references is equality of expressions.  The
// rules look one level deep and never make an expression larger:
//   constants fold;  x + 0 = x;  x - x = 0;  a x + b x = (a + b) x;  (u + x) - x = u;
//   a + (b + x) = (a + b) + x;  0 x = 0;  1 x = x;  a (b x) = (a b) x;  x / a = (1/a) x;
//   hsum(x) + hsum(y) = hsum(x + y), also where hsum(x) is part of a sum;
//   sin(-x) = -sin x;  cos(-x) = cos x;  the same of quaternion_log and log_curvature
// Constants in lanes fold lane by lane; 0 and 1 count only where all lanes agree.
// There is no distribution and no factoring: with fused multiply-adds neither gains (measured).
#pragma once
#include <string>
#include <vector>

#include "graph/graph.h"

namespace arboc {

class Builder {
 public:
  explicit Builder(std::string name);

  /// Adds an input port and returns the references of its entries.
  std::vector<Ref> input(const std::string& name, int size);
  /// Adds an output port.
  void output(const std::string& name, const std::vector<Ref>& entries);
  /// Nodes made from now on belong to a block of this title.
  void begin_block(const std::string& title);
  /// Nodes made from now on belong to a new step, as after begin_block.
  void next_step() { ++step_; }
  /// In which step a node was made.
  std::uint32_t step(std::uint32_t node) const { return steps_[node]; }

  Ref constant(double value);
  Ref constant(const Lanes& value);
  Ref add(Ref a, Ref b);
  Ref mul(Ref a, Ref b);
  Ref div(Ref a, Ref b);
  Ref sqrt(Ref a);
  Ref sin(Ref a);
  Ref cos(Ref a);
  /// k <= kLargestStumpff.
  Ref stumpff(int k, Ref x);
  Ref quaternion_log(Ref w);
  Ref log_curvature(Ref w);
  /// At least two terms; none of them a constant product.
  Ref sum(const std::vector<Term>& terms);

  /// Scalars side by side; several that are all the same remain a scalar.
  Ref pack(const std::vector<Ref>& scalars);
  /// Lane k; a scalar is every lane of itself.
  Ref lane(Ref a, int k);
  /// Sum of the first n lanes; of a scalar n times itself.
  Ref hsum(Ref a, int n);

  const Region& region() const { return region_; }
  Graph finish() &&;

 private:
  Ref intern(const Node& node);
  Ref unary(Op op, Ref a, int index = 0);
  void grow();
  size_t hash(const Node& node) const;
  bool same(const Node& x, const Node& y) const;
  bool same_terms(const Node& x, const Node& y) const;
  /// x = factor * rest, with rest not a constant multiple of anything.
  Lanes split_factor(Ref& x) const;
  /// Interns a sum or a pack.
  Ref listed(Op op, const std::vector<Term>& terms);
  /// A constant that is this number in every lane.
  bool is(Ref ref, double value) const {
    return region_.is_constant(ref) && region_[ref].width == 1 && region_.value(ref) == value;
  }
  Ref fold_nested_add(Ref sum, Ref x, bool& found);
  Ref fold_hsum(Ref a, Ref b, bool& found);

  Region region_;
  std::uint16_t block_ = 0;
  std::uint32_t step_ = 0;
  std::vector<std::uint32_t> steps_;  ///< per node
  std::uint32_t next_input_ = 0;
  std::vector<std::uint32_t> table_;  ///< open addressing; node + 1, 0 is free
  size_t used_ = 0;
};

}  // namespace arboc
