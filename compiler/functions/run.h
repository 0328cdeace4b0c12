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

namespace arboc {

/// The frames that fk reports: links moved by a joint of their own, in the order of the joints.
inline std::vector<int> moving_frames(const DynamicTree& tree) {
  std::vector<int> frames;
  for (size_t k = 0; k < tree.frame.size(); ++k)
    if (tree.frame[k].moving) frames.push_back(static_cast<int>(k));
  return frames;
}

/// What an algorithm wrote: vectors dense, matrices as nv x nv with the upper triangle filled.
template <class T>
struct Results {
  std::vector<T> output;
  std::vector<T> pivots;  ///< aba
};

/// `in` holds the inputs in the order of the signature.
template <class T>
Results<T> run(const std::string& function, const DynamicTree& tree,
               const std::vector<std::vector<T>>& in) {
  Results<T> out;
  const auto input = [&](size_t k) { return in[k].data(); };
  const auto n = static_cast<size_t>(tree.nv);
  if (function == "fk") {
    const std::vector<int> frames = moving_frames(tree);
    out.output.resize(12 * frames.size());
    FkWorkspace<T> work(tree);
    fk(tree, work, input(0), frames, out.output.data());
  } else if (function == "rnea") {
    out.output.resize(n);
    RneaWorkspace<T> work(tree);
    rnea(tree, work, input(0), input(1), input(2), out.output.data());
  } else if (function == "gravity") {
    out.output.resize(n);
    GravityWorkspace<T> work(tree);
    gravity(tree, work, input(0), out.output.data());
  } else if (function == "nle") {
    out.output.resize(n);
    RneaWorkspace<T> work(tree);
    nle(tree, work, input(0), input(1), out.output.data());
  } else if (function == "crba") {
    out.output.resize(n * n);
    CrbaWorkspace<T> work(tree);
    crba(tree, work, input(0), UpperTriangle<T>{out.output.data(), tree.nv});
  } else if (function == "minv") {
    out.output.resize(n * n);
    MinvWorkspace<T> work(tree);
    minv(tree, work, input(0), UpperTriangle<T>{out.output.data(), tree.nv});
    for (size_t k = 0; k < n; ++k) out.pivots.push_back(work.M[k * n + k]);
  } else {
    out.output.resize(n);
    out.pivots.resize(n);
    AbaWorkspace<T> work(tree);
    aba(tree, work, input(0), input(1), input(2), out.output.data(), out.pivots.data());
  }
  return out;
}

}  // namespace arboc
