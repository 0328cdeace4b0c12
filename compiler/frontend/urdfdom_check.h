// A second opinion: urdfdom must read the same numbers from the model that we did.
//
// urdfdom never sees the user's text.  Debian's version executes format strings that it finds in a
// file, accepts nonsense and loses the file's order, so it receives a document written from the
// checked model: links l0, l1, ..., joints j0, j1, ..., and the numbers as shortest text.
#pragma once
#include "model/model.h"

namespace arboc {

constexpr size_t kComparedLinks = 2000;

/// Throws std::logic_error naming the first field in which urdfdom's model differs from `model`.
///
/// Numbers must be equal, except rotations: urdfdom goes through quaternions of half angles and we
/// take angles within 4 eps of a multiple of 15 degrees as that multiple, so entries of R may
/// differ by 1e-14 + 8 eps times the largest angle.
///
/// urdfdom takes 50 us a link, three times as long as everything else, so only the first
/// kComparedLinks links from the root outwards and the joints between them are compared: no real
/// robot has more, and generated ones repeat themselves.
void compare_with_urdfdom(const Model& model);

}  // namespace arboc
