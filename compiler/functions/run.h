// Runs an algorithm by name on any scalar; shared by tracing and by the generic engine.
#pragma once
#include <string>
#include <vector>

#include "algorithms/aba.h"
#include "algorithms/fk.h"
#include "algorithms/gravity.h"
#include "algorithms/minv.h"
#include "algorithms/nle.h"
#include "algorithms/rnea.h"
#include "algorithms/rnea_derivatives.h"
#include "emit/target.h"

namespace arboc {

/// The frames that fk reports: links moved by a joint of their own, in the order of the joints.
inline std::vector<int> moving_frames(const DynamicTree& tree) {
  std::vector<int> frames;
  for (size_t k = 0; k < tree.frame.size(); ++k)
    if (tree.frame[k].moving) frames.push_back(static_cast<int>(k));
  return frames;
}

/// What an algorithm wrote, dense and row-major; of symmetric matrices the upper triangle.
template <class T>
struct Results {
  std::vector<std::vector<T>> outputs;  ///< in the order of the signature
  std::vector<T> pivots;                ///< aba, minv
};

/// The functions whose output is a vector of joint forces.
template <class T>
void run_forces(const std::string& function, const DynamicTree& tree,
                const std::vector<std::vector<T>>& in, T* out) {
  const auto input = [&](size_t k) { return in[k].data(); };
  if (function == "gravity") {
    GravityWorkspace<T> work(tree);
    gravity(tree, work, input(0), out);
    return;
  }
  RneaWorkspace<T> work(tree);
  if (function == "rnea")
    rnea(tree, work, input(0), input(1), input(2), out);
  else
    nle(tree, work, input(0), input(1), out);
}

/// `in` holds the inputs in the order of `signature`.
template <class T>
Results<T> run(const Signature& signature, const DynamicTree& tree,
               const std::vector<std::vector<T>>& in) {
  Results<T> out;
  for (const Argument& a : signature.outputs)
    out.outputs.emplace_back(static_cast<size_t>(a.rows) * static_cast<size_t>(a.cols));
  const std::string& function = signature.name;
  const auto n = static_cast<size_t>(tree.nv);
  const auto input = [&](size_t k) { return in[k].data(); };
  const auto output = [&](size_t k) { return out.outputs[k].data(); };
  const auto upper = [&](size_t k) { return UpperTriangle<T>{output(k), tree.nv}; };
  const auto square = [&](size_t k) { return SquareMatrix<T>{output(k), tree.nv}; };
  if (function == "fk") {
    FkWorkspace<T> work(tree);
    fk(tree, work, input(0), moving_frames(tree), output(0));
  } else if (function == "crba") {
    CrbaWorkspace<T> work(tree);
    crba(tree, work, input(0), upper(0));
  } else if (function == "minv") {
    MinvWorkspace<T> work(tree);
    minv(tree, work, input(0), upper(0));
    for (size_t k = 0; k < n; ++k) out.pivots.push_back(work.M[k * n + k]);
  } else if (function == "aba") {
    out.pivots.resize(n);
    AbaWorkspace<T> work(tree);
    aba(tree, work, input(0), input(1), input(2), output(0), out.pivots.data());
  } else if (function == "rnea_derivatives") {
    RneaDerivativesWorkspace<T> work(tree);
    rnea_derivatives(tree, work, input(0), input(1), input(2), square(0), square(1), upper(2));
  } else {
    run_forces(function, tree, in, output(0));
  }
  return out;
}

}  // namespace arboc
