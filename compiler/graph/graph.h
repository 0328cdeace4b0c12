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
// Ports and constants have a width: 1 for a scalar that all lanes share, w for one value a lane.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace arboc {

/// The operations: name, printed spelling, number of operands (sum: any number of terms).
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
  X(kStumpff, "stumpff", 1)              \
  X(kQuaternionLog, "quaternion_log", 1) \
  X(kLogCurvature, "log_curvature", 1)

enum class Op : std::uint8_t {
#define ARBOC_OP(name, text, operands) name,
  ARBOC_OPS(ARBOC_OP)
#undef ARBOC_OP
};

/// How many of Node::a, Node::b are references.
int operand_count(Op op);
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
  std::uint16_t block = 0;  ///< index into Region::blocks: where the trace stood when it made this
  Ref a, b;                 ///< operands
  /// constant: offset into Region::constants.  input: offset into the concatenated input ports.
  /// sum: first of Region::terms.  stumpff: its k.
  std::uint32_t index = 0;
  std::uint32_t count = 0;  ///< constant: width.  sum: number of terms.
};

struct Port {
  std::string name;
  int size = 0;   ///< entries
  int width = 1;  ///< values an entry: 1, or one a lane
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
  if (node.op == Op::kSum) {
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

/// Throws std::logic_error that names the first broken invariant: operands before users, indices
/// in range, constants finite and non-negative, sums with at least two terms.
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
