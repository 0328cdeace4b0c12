// Task, ends and bases -> problem.
#pragma once
#include <arboc/nlp/assembly.hpp>
#include <memory>

#include <posture/models.h>

#include "curve.h"
#include "task.h"

namespace motion {

using posture::Model;

/// A solution, or a guess: coordinates and, six a contact, reactions along the contact's axes.
struct Motion {
  arboc::BSpline q, reactions;
};

/// The state at both ends.  Accelerations and reactions are `given` too where the body is at rest
/// or where another motion ended; elsewhere they are guesses, and variables.
struct Ends {
  std::array<State, 2> at;
  std::array<bool, 2> given{true, true};

  /// Control points of coordinates that these states fix.
  int fixed(int end) const { return given[static_cast<std::size_t>(end)] ? 3 : 2; }
};

/// Where equations are asked for.
struct Frames {
  struct Frame {
    double t;       ///< s
    bool balances;  ///< the equations of motion hold; otherwise torques are only looked at
    bool holds;     ///< contacts are in place
    double weight;  ///< in means over time, by the trapezoidal rule
  };
  std::vector<Frame> all{};
  bool exact = true;  ///< otherwise within boxes
};
/// At the Greville abscissae of the control points that are free, or at equal distances.
Frames frames_of(const Task& task, const Ends& ends, const arboc::BSplineBasis& q,
                 const arboc::BSplineBasis& reactions);

struct Built {
  std::unique_ptr<arboc::nlp::Assembly> nlp;
  Frames frames;
  arboc::BSplineBasis q_basis, r_basis;
  ControlPoints q, r;
  int maximum = -1;  ///< variable of the largest normalised torque
};

/// What is free: all, or reactions only, of a motion that is given: then the problem is convex.
enum class Free { kAll, kReactions };
/// `guess` has the bases and says which spheres are close.
Built build(const Task& task, const Model& model, const Ends& ends, const Motion& guess,
            Free free = Free::kAll);

/// Variables of a motion; torques and auxiliary forces are what it takes.
std::vector<double> variables_of(Built& built, const Motion& motion);
Motion motion_of(const Built& built, const std::vector<double>& x);

/// Straight lines between the ends, in time, for given bases.
Motion straight(const Ends& ends, const arboc::BSplineBasis& q,
                const arboc::BSplineBasis& reactions);

}  // namespace motion
