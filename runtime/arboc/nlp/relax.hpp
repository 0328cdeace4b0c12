// When a problem has no solution: which groups of rows conflict, and by how much.
//
// A relaxed problem allows the rows of some groups to be missed and makes the miss as small as it
// can be; the objective does not count.  l1 finds few groups that give way; the squared miss of one
// group alone is its nearest approach, and the groups whose multipliers are not zero there are what
// holds it off.
#ifndef ARBOC_NLP_RELAX_HPP
#define ARBOC_NLP_RELAX_HPP

#include <memory>

#include "solver.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

enum class Miss { kAbsolute, kSquared };

class Relaxed : public Nlp {
 public:
  /// `groups`: indices into nlp.row_groups(); the miss counts in units of the rows' scales.  The
  /// Nlp is used, and must live.
  Relaxed(Nlp& nlp, const std::vector<int>& groups, Miss miss);

  const Scales& variables() const override { return variables_; }
  const Scales& rows() const override { return nlp_.rows(); }
  const std::vector<Group>& row_groups() const override { return nlp_.row_groups(); }
  const std::vector<Group>& variable_groups() const override { return groups_; }
  const Pattern& jacobian_pattern() const override { return jacobian_pattern_; }
  const Pattern& hessian_pattern() const override { return hessian_pattern_; }

  void move_to(const double* x) override;
  double objective() override;
  const std::vector<double>& gradient() override;
  const std::vector<double>& constraints() override;
  const std::vector<double>& jacobian() override;
  const std::vector<double>& hessian(double sigma, const double* multipliers) override;

  /// A start at x: the misses are those that it has.
  std::vector<double> start(const std::vector<double>& x);
  int own_variables() const { return own_; }

 private:
  Nlp& nlp_;
  Miss miss_;
  int sides_;  ///< variables a relaxed row: what is short and what is over, or the miss with its
               ///< sign
  int own_;    ///< variables of nlp_, which come first
  std::vector<int> relaxed_;
  Scales variables_;
  std::vector<Group> groups_;
  Pattern jacobian_pattern_, hessian_pattern_;
  std::vector<double> x_, gradient_, constraints_, jacobian_, hessian_;
};

/// A group that cannot be met, or that holds others off.
struct Conflict {
  std::string group, unit;
  double miss = 0;     ///< Euclidean, in the group's unit
  double largest = 0;  ///< of one row
};
struct Diagnosis {
  bool feasible = false;            ///< after all: `x` meets every row
  std::vector<double> x;            ///< where the l1 miss is least
  std::vector<Conflict> conflicts;  ///< groups that miss there
  /// Of the first conflict: nearest approach of that group with all others met, if there is any.
  bool has_nearest = false;
  double nearest = 0;
  std::vector<double> nearest_x;
  std::vector<std::string> held_by;  ///< groups whose rows or bounds push back there
};

/// `elastic`: groups that may give way in the first place, in the order in which their nearest
/// approach is of interest; all others hold.
Diagnosis diagnose(Nlp& nlp, const std::vector<double>& x, const std::vector<int>& elastic,
                   const SolverOptions& options = {});

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_RELAX_HPP
