// Task and model -> problem.
#pragma once
#include <arboc/nlp/assembly.hpp>
#include <memory>

#include "models.h"
#include "task.h"

namespace posture {

/// A pair of spheres, by indices into Task::collision.spheres.
using Pair = std::pair<int, int>;

struct BuildOptions {
  arboc::nlp::Aspect aspect = arboc::nlp::Aspect::kAll;
  std::vector<Pair> pairs{};  ///< that must not collide
};

/// A problem, and where its parts are.
struct Built {
  std::unique_ptr<arboc::nlp::Assembly> nlp;
  arboc::nlp::Quantities q, tau;
  std::vector<int> driven;                        ///< coordinate of each torque
  std::vector<arboc::nlp::Quantities> reactions;  ///< one a contact
  int maximum = -1;                               ///< variable of the largest normalised torque
  std::vector<int> targets;                       ///< groups of rows
  std::vector<int> elastic;  ///< groups in the order in which they may give way
};

Built build(const Task& task, const Model& model, const BuildOptions& options);

/// By the names in `posture`, on top of `otherwise`; throws std::invalid_argument.
std::vector<double> posture_of(const std::map<std::string, double>& posture, const Model& model,
                               std::vector<double> otherwise);

/// From where displacement counts.
std::vector<double> relaxed_of(const Task& task, const Model& model);

/// Pairs of spheres that may collide.
std::vector<Pair> pairs(const Task& task);
/// How far they are apart at a posture, m; negative: overlap.
std::vector<double> gaps(const Task& task, const Model& model, const std::vector<Pair>& pairs,
                         const std::vector<double>& q);

}  // namespace posture
