// Motions <-> variables of the problem.
#include <algorithm>

#include "build.h"

namespace motion {
namespace {

using namespace arboc::nlp;
using arboc::BSplineBasis;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Variables and rows of one name belong together one by one: variable = what the row says.
void fill_auxiliary(Assembly& nlp, std::vector<double>& x) {
  std::vector<std::pair<int, int>> pairs;  // variable, row
  for (const Group& variables : nlp.variable_groups()) {
    const std::string name = variables.name == "torque limits" ? "torques" : variables.name;
    for (const Group& rows : nlp.row_groups()) {
      if (rows.name != name || rows.members.size() != variables.members.size()) continue;
      for (std::size_t k = 0; k < rows.members.size(); ++k)
        pairs.emplace_back(variables.members[k], rows.members[k]);
    }
  }
  // Forces in the world's axes, then their moments, then torques.
  for (int round = 0; round < 3; ++round) {
    nlp.move_to(x.data());
    const std::vector<double> c = nlp.constraints();
    for (const auto& [variable, row] : pairs)
      x[static_cast<std::size_t>(variable)] += c[static_cast<std::size_t>(row)];
  }
}

}  // namespace

std::vector<double> variables_of(Built& built, const std::vector<Motion>& motions) {
  const Scales& v = built.nlp->variables();
  std::vector<double> x(v.size(), 0);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const Phase& phase = built.phases[k];
    set_values(phase.q, motions[k].q.points(), x);
    set_values(phase.r, motions[k].reactions.points(), x);
    if (phase.maximum >= 0) x[static_cast<std::size_t>(phase.maximum)] = 1;
  }
  fill_auxiliary(*built.nlp, x);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::clamp(x[i], v.lower[i], v.upper[i]);
  return x;
}

std::vector<Motion> motions_of(const Built& built, const std::vector<double>& x) {
  std::vector<Motion> out;
  for (const Phase& phase : built.phases)
    out.push_back({arboc::BSpline(phase.q_basis, values_of(phase.q, x)),
                   arboc::BSpline(phase.r_basis, values_of(phase.r, x))});
  return out;
}

Motion straight(const Ends& ends, const BSplineBasis& q, const BSplineBasis& reactions) {
  const auto line = [](const BSplineBasis& basis, const VectorXd& from, const VectorXd& to,
                       int fixed) {
    const int n = basis.size();
    MatrixXd P(from.size(), n);
    for (int i = 0; i < n; ++i) {
      const double u = std::clamp((i - fixed + 1.0) / (n - 2 * fixed + 1.0), 0.0, 1.0);
      P.col(i) = (1 - u) * from + u * to;
    }
    return P;
  };
  const auto& [from, to] = ends.at;
  MatrixXd P = line(q, from.q, to.q, 3);
  P.leftCols(3) = end_points(q, from, false);
  P.rightCols(3) = end_points(q, to, true);
  return {arboc::BSpline(q, P),
          arboc::BSpline(reactions, line(reactions, from.reactions, to.reactions, 1))};
}

}  // namespace motion
