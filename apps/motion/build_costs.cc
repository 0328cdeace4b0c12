#include "build_costs.h"

#include <posture/build.h>
#include <algorithm>
#include <arboc/nlp/scalars.hpp>
#include <cmath>

namespace motion {
namespace {

using namespace arboc::nlp;
using arboc::BSplineBasis;
using Eigen::MatrixXd;

/// Integrals of products of k-th derivatives, over the duration.
MatrixXd mean_square(const BSplineBasis& basis, int k) {
  return MatrixXd(arboc::gram_matrix(basis, k, k)) / (basis.end() - basis.begin());
}

/// Adds means of squares of k-th derivatives.
struct Squares {
  Problem& problem;
  const BSplineBasis& basis;
  double share;

  void add(const std::string& name, double weight, int k, const std::vector<Affine>& points) const {
    if (weight > 0)
      problem.minimise(name, share * weight, quadratic(2 * mean_square(basis, k)), points);
  }
};

}  // namespace

void add_regularity(Problem& problem, const Task& task, const Model& model, const Phase& phase,
                    const Shares& shares) {
  const Objective& o = task.objective;
  const double T6 = std::pow(task.duration, 6);
  const std::vector<double> relaxed = posture::relaxed_of(task.start.posture, model);
  const Squares q{problem, phase.q_basis, shares.of_time},
      r{problem, phase.r_basis, shares.of_time};
  for (std::size_t j = 0; j < phase.q.points.size() && shares.free == Free::kAll; ++j) {
    std::vector<Affine> row = phase.q.points[j];
    q.add("smoothness", o.smoothness * T6, 3, row);
    q.add("acceleration", o.acceleration, 2, row);
    q.add("jerk", o.jerk, 3, row);
    if (model.passive[j]) continue;
    for (Affine& a : row) a.constant -= relaxed[j];
    q.add("displacement", o.displacement, 0, row);
  }
  const double one = kForceScale * kForceScale;
  for (const std::vector<Affine>& row : phase.r.points) {
    if (std::all_of(row.begin(), row.end(), [](const Affine& a) { return a.terms.empty(); }))
      continue;
    r.add("reactions", o.reactions / one, 0, row);
    r.add("smoothness of reactions", o.reaction_smoothness * T6 / one, 3, row);
  }
}

}  // namespace motion
