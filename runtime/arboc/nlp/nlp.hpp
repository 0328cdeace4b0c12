// A nonlinear program as solvers see it: values, sparse Jacobian, sparse Hessian of the Lagrangian.
//
//   minimise f(x)   subject to   lower <= x <= upper,   row_lower <= c(x) <= row_upper
// Equal bounds make an equality; infinite ones none.  A point is set once and everything asked for
// there is computed once, whichever callback asks.
#ifndef ARBOC_NLP_NLP_HPP
#define ARBOC_NLP_NLP_HPP

#include <limits>
#include <string>
#include <vector>

namespace arboc {
inline namespace v1 {
namespace nlp {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Where the entries of a sparse matrix stand; no entry twice.
struct Pattern {
  std::vector<int> row, col;

  std::size_t size() const { return row.size(); }
  void push(int r, int c) {
    row.push_back(r);
    col.push_back(c);
  }
};

/// What a solver and a reader need to know of variables or of rows: one entry each.
struct Scales {
  std::vector<double> lower, upper;
  /// What counts as 1: solvers see x / scale and c / scale.
  std::vector<double> scale;

  std::size_t size() const { return lower.size(); }
  void push(double low, double high, double one) {
    lower.push_back(low);
    upper.push_back(high);
    scale.push_back(one);
  }
};

/// Rows or variables that have one name and one unit.
struct Group {
  std::string name, unit;
  std::vector<int> members;  ///< rows, or variables
};

class Nlp {
 public:
  virtual ~Nlp() = default;

  virtual const Scales& variables() const = 0;
  virtual const Scales& rows() const = 0;
  virtual const std::vector<Group>& row_groups() const = 0;
  virtual const std::vector<Group>& variable_groups() const = 0;
  virtual const Pattern& jacobian_pattern() const = 0;
  virtual const Pattern& hessian_pattern() const = 0;  ///< lower triangle

  /// All below are at this point, until the next one is set.
  virtual void move_to(const double* x) = 0;
  virtual double objective() = 0;
  virtual const std::vector<double>& gradient() = 0;  ///< of the objective, dense
  virtual const std::vector<double>& constraints() = 0;
  virtual const std::vector<double>& jacobian() = 0;
  /// Second derivatives of sigma f + multipliers^T c.
  virtual const std::vector<double>& hessian(double sigma, const double* multipliers) = 0;
};

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_NLP_HPP
