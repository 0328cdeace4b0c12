// The text of a cell -> a linear expression of joints and named lengths.
//
//   q12 - pi/2      L4 + L15      -0.5 * L8      2 * (L1 + 3)
//
// Sums, differences, products and quotients of numbers, pi, names and parentheses, as long as the
// whole is linear in the names.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arboc {

/// What a name stands for: a joint or a length, by its index in the file.
struct DhSymbol {
  enum class Kind { kLength, kJoint };
  Kind kind = Kind::kLength;
  int index = 0;
  friend bool operator==(const DhSymbol&, const DhSymbol&) = default;
};

/// constant + sum of factor * symbol; each symbol once, no factor 0.
struct DhLinear {
  double constant = 0;
  std::vector<std::pair<DhSymbol, double>> terms{};
  bool has_pi = false;  ///< pi is written in it

  bool is_zero() const { return constant == 0 && terms.empty(); }
  bool is_number() const { return terms.empty(); }
  DhLinear& add(const DhLinear& other, double factor);
  friend bool operator==(const DhLinear& a, const DhLinear& b) {
    return a.constant == b.constant && a.terms == b.terms;
  }
};

struct DhExpression {
  DhLinear value{};
  std::string fault{};  ///< what is wrong with the text; empty: nothing
  std::string hint{};
  size_t at = 0;  ///< the byte of the text where the fault is
};

/// Names are looked up by `find`, which returns false for those that there are not.
using DhFind = std::function<bool(std::string_view name, DhSymbol& symbol)>;

DhExpression parse_expression(std::string_view text, const DhFind& find);

/// Whether a name may stand in expressions: letters, digits and '_', no digit first, and not `pi`.
bool is_identifier(std::string_view name);

}  // namespace arboc
