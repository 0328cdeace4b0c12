// A nonlinear program in parts: variables, functions evaluated at variables, rows, costs.
//
//   Problem p;
//   const auto x = p.add_variables("x", "m", {{-1, 1, 1}, {-1, 1, 1}});
//   const auto y = p.evaluate(function, {x[0], x[1]});
//   const int wall = p.add_group("wall", "m");
//   p.require(wall, y[0] - 2 * x[1], 0, 0);                     // an equality
//   p.minimise("height", 1, square(), {y[1]});
// assembly.hpp makes an Nlp of it, solver.hpp solves that.
#ifndef ARBOC_NLP_PROBLEM_HPP
#define ARBOC_NLP_PROBLEM_HPP

#include <memory>
#include <string>
#include <vector>

#include "affine.hpp"
#include "function.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

/// Bounds of a variable, and what counts as 1.
struct Interval {
  double lower = -kInfinity, upper = kInfinity, scale = 1;
};

/// Consecutive variables, or the outputs of one evaluation.
struct Quantities {
  int evaluation = -1;
  int first = 0;
  int count = 0;

  Quantity operator[](int i) const { return {evaluation, first + i}; }
  int size() const { return count; }
};

class Problem {
 public:
  using FunctionPointer = std::shared_ptr<Function>;
  using ScalarPointer = std::shared_ptr<const Scalar>;

  struct Evaluation {
    FunctionPointer function;
    std::vector<Affine> inputs;  ///< of variables
  };
  /// plus, or of(arguments) + plus.
  struct Expression {
    ScalarPointer of;  ///< may be null
    std::vector<Affine> arguments;
    Affine plus;
  };
  struct Row {
    int group;
    Expression value;
    double lower, upper, scale;
  };
  struct Cost {
    std::string name;
    double weight;
    Expression value;
  };

  /// Variables of one name and unit are one group; so are rows.
  Quantities add_variables(const std::string& name, const std::string& unit,
                           const std::vector<Interval>& intervals);

  /// Outputs of `function` where its inputs are sums of variables.
  Quantities evaluate(FunctionPointer function, std::vector<Affine> inputs);

  int add_group(const std::string& name, const std::string& unit);
  void require(int group, Affine value, double lower, double upper, double scale = 1);
  /// Of of(arguments) + plus.
  void require(int group, ScalarPointer of, std::vector<Affine> arguments, Affine plus,
               double lower, double upper, double scale = 1);
  /// Adds weight * value to the objective; parts of one name are reported together.
  void minimise(const std::string& name, double weight, Affine value);
  void minimise(const std::string& name, double weight, ScalarPointer of,
                std::vector<Affine> arguments);

  const Scales& variables() const { return variables_; }
  const std::vector<Group>& variable_groups() const { return variable_groups_; }
  const std::vector<Group>& groups() const { return groups_; }
  const std::vector<Evaluation>& evaluations() const { return evaluations_; }
  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<Cost>& costs() const { return costs_; }

 private:
  static Group& group_of(std::vector<Group>& groups, const std::string& name,
                         const std::string& unit);
  void check(const Affine& a, bool variables_only) const;
  void check(const Expression& e) const;

  Scales variables_;
  std::vector<Group> variable_groups_, groups_;
  std::vector<Evaluation> evaluations_;
  std::vector<Row> rows_;
  std::vector<Cost> costs_;
};

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_PROBLEM_HPP
