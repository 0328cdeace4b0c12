// Problem -> Nlp: patterns and ways of all derivatives are found once, values then flow along them.
//
// A point is evaluated in stages, each at most once: inputs and outputs of the functions, one call
// a function for all its evaluations; rows and costs; Jacobian entries; Hessian entries.  From
// functions to variables derivatives go by chain.hpp.  Curvature of scalar functions adds products
// of gradients, that of functions arrives contracted with the multipliers.
#ifndef ARBOC_NLP_ASSEMBLY_HPP
#define ARBOC_NLP_ASSEMBLY_HPP

#include <arboc/team.hpp>
#include <map>

#include "chain.hpp"
#include "problem.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

/// Seconds by the clock in functions and in the rest of the evaluation.
struct EvaluationTime {
  double values = 0, jacobian = 0, hessian = 0;  ///< of the functions
  double assembly = 0;                           ///< chain rules and scalar functions
};

class Assembly : public Nlp {
 public:
  /// Throws std::runtime_error, with the group's name, if a row depends on no variable and does not
  /// hold; one that holds is left out.
  explicit Assembly(Problem problem);

  const Scales& variables() const override { return variables_; }
  const Scales& rows() const override { return rows_; }
  const std::vector<Group>& row_groups() const override { return groups_; }
  const std::vector<Group>& variable_groups() const override { return problem_.variable_groups(); }
  const Pattern& jacobian_pattern() const override { return jacobian_pattern_; }
  const Pattern& hessian_pattern() const override { return hessian_pattern_; }

  void move_to(const double* x) override;
  double objective() override;
  const std::vector<double>& gradient() override;
  const std::vector<double>& constraints() override;
  const std::vector<double>& jacobian() override;
  const std::vector<double>& hessian(double sigma, const double* multipliers) override;

  /// Shares out the chain rules; functions have threads of their own.
  void use_threads(int count);

  /// Bounds may be moved between solutions; an equality stays one by equal bounds.
  void set_variable(int variable, double lower, double upper);
  void set_row(int group, int member, double lower, double upper);
  /// Of all costs of a name; false if there are none.
  bool set_weight(const std::string& name, double weight);

  /// Unweighted values of the costs by name, at the current point.
  std::map<std::string, double> costs();
  /// Of a variable, an output or a sum of them, at the current point.
  double value(const Affine& a);
  const EvaluationTime& time() const { return time_; }

 private:
  /// All evaluations of one function; what belongs to them lies together, from these on.
  struct Batch {
    std::shared_ptr<Function> function;
    std::vector<int> evaluations{};
    int inputs = 0, outputs = 0, jacobian = 0, hessian = 0;

    int size() const { return static_cast<int>(evaluations.size()); }
  };
  /// A sum of quantities; its gradient has entries `first`, ... of gradients_ in these columns.
  struct Sum {
    double constant = 0;
    std::vector<std::pair<int, double>> variables{}, outputs{};  ///< index, coefficient
    std::vector<int> columns{};
    int first = 0;
  };
  /// Two entries of gradients_ whose product, times `factor`, is part of a Hessian entry.
  struct Product {
    int target, left, right;
    double factor;
  };
  /// Where a scalar function bends: its H(i, j), i >= j, multiplies these products.
  struct Bend {
    int i, j;
    std::vector<Product> products;
  };
  /// An entry of gradients_, times the slope of an argument, is part of an entry of a row.
  struct Part {
    int target, source, argument;
  };
  /// A row or a cost: a scalar function of sums, plus the last sum.
  struct Expression {
    std::shared_ptr<const Scalar> of{};  ///< null: only the last sum
    std::vector<Sum> sums{};
    std::vector<double> arguments{}, slopes{}, curvature{};  ///< at the point; last slope: 1
    std::vector<Bend> bends{};
    int first_entry = 0;      ///< of a row's Jacobian; where there is only a sum, as its gradient
    std::vector<Part> row{};  ///< otherwise what is added to them
  };

  // Layout, in assembly_layout.cc.
  void lay_out_functions();
  void lay_out_function(Batch& batch);
  Sum lay_out(const Affine& a);
  Expression lay_out(const Problem::Expression& e);
  void lay_out_rows();
  void drop_constant_rows();
  void lay_out_jacobian();
  void lay_out_hessian();
  template <class Visit>
  static void for_each_bend(const Expression& e, const Visit& visit);
  void lay_out_bends(Expression& e, const LowerTriangle& triangle);

  double value(const Sum& sum) const;
  double value(Expression& e) const;
  void need_values();
  void need_gradients();
  void evaluate(Expression& e);
  /// What the multiplier of an expression weighs: outputs of functions, and products of gradients.
  void weigh(const Expression& e, double multiplier);
  void bend(const Expression& e, double multiplier);

  Problem problem_;
  Scales variables_, rows_;
  std::vector<Group> groups_;
  std::vector<Expression> lines_, costs_;
  std::vector<double> weights_;  ///< of costs

  std::vector<Batch> batches_;
  std::vector<int> first_output_;                        ///< of each evaluation, in y_
  std::vector<std::vector<std::vector<int>>> raw_rows_;  ///< evaluation, output -> raw entries
  Inputs input_sums_;
  std::vector<int> raw_input_;  ///< raw Jacobian entry -> entry of inputs_
  GradientChain to_gradients_;
  HessianChain to_hessian_;
  std::vector<double> constant_gradients_;
  std::unique_ptr<Team> team_;
  Pattern jacobian_pattern_, hessian_pattern_;

  bool has_values_ = false, has_gradients_ = false;
  std::vector<double> x_, inputs_, outputs_, constraints_, gradient_;
  std::vector<double> raw_jacobian_, gradients_, jacobian_;
  std::vector<double> raw_hessian_, output_weights_, hessian_;
  EvaluationTime time_;
};

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_ASSEMBLY_HPP
