// Whether a Model can be compiled, whatever format it came from.
//
// A front end resolves names to indices (-1 where it could not, which it has then reported) and
// leaves the rest to validate(): unique names, one tree, mimic joints that follow something, and
// masses that a body can have.  Afterwards the invariants of model.h hold, or there are errors.
#pragma once
#include "model/findings.h"
#include "model/model.h"

namespace arboc {

/// Reports what is wrong with `model` and sets model.root.  Linear in links; no recursion.
void validate(Model& model, Findings& findings);

/// The last step of validate(), on a model whose links and joints form a tree.
///
/// Errors: a negative mass, a negative diagonal moment, and an indefinite inertia tensor of a
/// moving body together with what is fixed to it.  Warnings: an indefinite tensor elsewhere,
/// principal moments beyond the triangle inequality, mass 0 with inertia or on a moving body, and
/// bodies with no mass on them or beyond them, which make the mass matrix singular.
void check_masses(const Model& model, Findings& findings);

/// Links from the root outwards, parents before children; joint_of[link] is the joint whose child
/// it is, -1 for the root.  Links that the root does not reach are left out.
std::vector<int> outward(const Model& model, const std::vector<int>& joint_of);

/// joint_of for outward(); of several joints onto one link the first.
std::vector<int> joints_onto(const Model& model);

}  // namespace arboc
