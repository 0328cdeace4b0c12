// Tasks of phases, ends and bases -> one problem.
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

/// What of a state is known before; the rest is a guess, and variables.
enum class Known {
  kPosture,   ///< q
  kVelocity,  ///< q and v
  kAll        ///< at rest, or where a motion ended that was found before
};
/// The states at both ends.
struct Ends {
  std::array<State, 2> at;
  std::array<Known, 2> known{Known::kAll, Known::kAll};
  bool linked = false;  ///< the start is where the phase before ends, in the same problem

  bool all(int end) const { return known[static_cast<std::size_t>(end)] == Known::kAll; }
  /// Control points of coordinates that are no variables.
  int fixed(int end) const {
    const Known k = known[static_cast<std::size_t>(end)];
    return k == Known::kAll ? 3 : k == Known::kVelocity ? 2 : 1;
  }
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

struct Phase {
  Frames frames;
  arboc::BSplineBasis q_basis, r_basis;
  ControlPoints q{}, r{};
  int maximum = -1;  ///< variable of the largest normalised torque
};
struct Built {
  std::unique_ptr<arboc::nlp::Assembly> nlp;
  std::vector<Phase> phases;
};

/// What a phase is made from; `guess` has the bases and says which spheres are close.
struct Part {
  const Task* task;
  const Ends* ends;
  const Motion* guess;
};
/// What is free: all, or reactions only, of motions that are given: then the problem is convex.
enum class Free { kAll, kReactions };
/// The objective is the mean over the time of all phases.
Built build(const Model& model, const std::vector<Part>& parts, Free free = Free::kAll);

/// Variables of motions, one a phase; torques and auxiliary forces are what they take.
std::vector<double> variables_of(Built& built, const std::vector<Motion>& motions);
std::vector<Motion> motions_of(const Built& built, const std::vector<double>& x);

/// Straight lines between the ends, in time, for given bases.
Motion straight(const Ends& ends, const arboc::BSplineBasis& q,
                const arboc::BSplineBasis& reactions);

}  // namespace motion
