// The expression graph: what a traced algorithm computes, as a list of nodes.
//
// A Graph holds regions (function bodies).  A region is an arena of nodes in the order in which
// they were made, so operands always stand before their users.  References carry a sign bit:
// negation costs nothing and never hides that two expressions are the same.
//
//   region twice
//   in  q 2
//   x2 = sin(q0)
//   x3 = x2 * q1
//   out y 1: -x3
//
// Meaning: every node is a real function of the inputs; the rewriting rules of Builder and the
// passes assume finite inputs (0 * x = 0) and may reassociate, so values are preserved up to
// rounding.  Constants are stored non-negative, their sign sits in the reference.
//
// A value has a width: 1, a scalar that all lanes share, or w, one value a lane.  Operands of width
// 1 serve every lane; otherwise all have one width.  Ports are scalars: pack gathers them into
// lanes, lane takes one out, hsum adds the first n lanes up.
//
//   x4 = pack(q0, q1)   x5 = [0.5|-2] * x4   x6 = lane1(x5)   x7 = hsum2(x5)
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace arboc {

/// The operations: name, printed spelling, number of operands (sum: any number of terms).
/// The three before the last cross from scalars to lanes and back: pack lists w scalars in
/// Region::terms, lane takes lane Node::index, hsum adds Node::index lanes.
/// The last three are those of rotations (runtime/arboc/scalar.hpp): the entire function c_k(x), x
/// >= 0, whose k is Node::index, and of the real part w of a unit quaternion the factor L(w) of its
/// logarithm and the curvature b(w).  Derivatives:
///   dc_k/dx = (k c_(k+2) - c_(k+1)) / 2,   dL/dw = -2 b L^2,   db/dw: derive/rules.cc
#define ARBOC_OPS(X)                     \
  X(kConstant, "constant", 0)            \
  X(kInput, "input", 0)                  \
  X(kAdd, "+", 2)                        \
  X(kMul, "*", 2)                        \
  X(kDiv, "/", 2)                        \
  X(kSqrt, "sqrt", 1)                    \
  X(kSin, "sin", 1)                      \
  X(kCos, "cos", 1)                      \
  X(kSum, "sum", 0)                      \
  X(kPack, "pack", 0)                    \
  X(kLane, "lane", 1)                    \
  X(kHsum, "hsum", 1)                    \
  X(kStumpff, "stumpff", 1)              \
  X(kQuaternionLog, "quaternion_log", 1) \
  X(kLogCurvature, "log_curvature", 1)

enum class Op : std::uint8_t {
#define ARBOC_OP(name, text, operands) name,
  ARBOC_OPS(ARBOC_OP)
#undef ARBOC_OP
};

/// How many of Node::a, Node::b are references.
inline int operand_count(Op op) {
  constexpr int kOperands[] = {
#define ARBOC_OP(name, text, operands) operands,
      ARBOC_OPS(ARBOC_OP)
#undef ARBOC_OP
  };
  return kOperands[static_cast<std::size_t>(op)];
}
/// The printed spelling.
const char* spelling(Op op);

/// A node with a sign: -x and x share the node.
class Ref {
 public:
  Ref() = default;
  explicit Ref(std::uint32_t node, bool negative = false)
      : bits_(node << 1 | (negative ? 1u : 0u)) {}

  std::uint32_t node() const { return bits_ >> 1; }
  bool negative() const { return (bits_ & 1) != 0; }
  std::uint32_t bits() const { return bits_; }
  Ref positive() const { return Ref(node()); }
  Ref operator-() const { return Ref(node(), !negative()); }
  Ref with_sign_of(Ref other) const { return Ref(node(), negative() != other.negative()); }
  friend bool operator==(Ref a, Ref b) { return a.bits_ == b.bits_; }

 private:
  std::uint32_t bits_ = 0;
};

/// One operand of a sum: a or a * b, with the sign of a.
struct Term {
  Ref a;
  Ref b;
  bool product = false;
};

struct Node {
  Op op = Op::kConstant;
  std::uint8_t width = 1;   ///< lanes
  std::uint16_t block = 0;  ///< index into Region::blocks: where the trace stood when it made this
  Ref a, b;                 ///< operands
  /// constant: offset into Region::constants.  input: offset into the concatenated input ports.
  /// sum, pack: first of Region::terms.  stumpff: its k.  lane: which.  hsum: how many lanes.
  std::uint32_t index = 0;
  std::uint32_t count = 0;  ///< constant: width.  sum, pack: number of terms.
};

struct Port {
  std::string name;
  int size = 0;  ///< entries
};

/// Lanes that a value has at most.
constexpr int kMostLanes = 4;

/// A constant: one number, or one a lane.
struct Lanes {
  int width = 1;
  double x[kMostLanes] = {};

  double operator[](int lane) const { return x[width == 1 ? 0 : lane]; }
};

struct Region {
  std::string name;
  std::vector<Port> inputs;
  std::vector<Port> outputs;
  std::vector<std::vector<Ref>> results;  ///< per output port, one reference an entry
  std::vector<std::string> blocks{""};
  std::vector<Node> nodes;
  std::vector<Term> terms;
  std::vector<double> constants;

  const Node& operator[](Ref ref) const { return nodes[ref.node()]; }
  bool is_constant(Ref ref) const { return nodes[ref.node()].op == Op::kConstant; }
  /// Value of a constant of width 1, sign included.
  double value(Ref ref) const {
    const double v = constants[nodes[ref.node()].index];
    return ref.negative() ? -v : v;
  }
  /// Of a constant of any width.
  Lanes lanes(Ref ref) const;
};

struct Graph {
  std::vector<Region> regions;  ///< the last one is the function itself
};

/// Calls use(Ref) for each operand of `node`.
template <class Use>
void for_each_operand(const Region& region, const Node& node, Use&& use) {
  const int n = operand_count(node.op);
  if (n > 0) use(node.a);
  if (n > 1) use(node.b);
  if (node.op == Op::kSum || node.op == Op::kPack) {
    for (std::uint32_t t = node.index; t < node.index + node.count; ++t) {
      use(region.terms[t].a);
      if (region.terms[t].product) use(region.terms[t].b);
    }
  }
}

/// Largest k of a stumpff node.
constexpr int kLargestStumpff = 16;
/// The value of a stumpff, quaternion_log or log_curvature node.
double special_value(Op op, int k, double x);

/// The width that the operands give a node, or 0 where they do not fit together.
int width_of(const Region& region, const Node& node);

/// Throws std::logic_error that names the first broken invariant: operands before users, indices
/// in range, constants finite and non-negative (in lanes: the first that is not zero, and not all
/// the same), sums with at least two terms, widths as the operations make them.
void verify(const Graph& graph);

/// The printed form (`--print=graph`), which parse() reads back.
std::string print(const Graph& graph);
/// Throws std::invalid_argument with the line that is wrong.
Graph parse(const std::string& text);

/// Evaluates the last region: one vector an input port, one vector an output port.  Products inside
/// sums are fused (one rounding), as compiled code does it.
std::vector<std::vector<double>> evaluate(const Graph& graph,
                                          const std::vector<std::vector<double>>& inputs);

}  // namespace arboc
