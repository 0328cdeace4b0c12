// Where phases begin and end: postures that are predicted, velocities that contacts allow, and what
// is handed over from one phase to the next.
#pragma once
#include <posture/predict.h>

#include "build.h"

namespace motion {

/// Between two phases.
enum class Joint {
  kRest,    ///< all of the state is known before
  kSmooth,  ///< all of it is continuous
  kJolt  ///< a contact is new while the body moves: its load comes at once, so accelerations jump
};
Joint joint_of(const Task& before, const Task& next);

/// What comes before and after a phase.
struct Joints {
  std::optional<State> after{};  ///< where the phase before ended, or is guessed to
  bool jolts = false;            ///< of that, accelerations and reactions do not count
  bool linked = false;           ///< that phase is in the same problem
  const Task* next = nullptr;    ///< whose contacts do not move at the end either
};

/// Postures, velocities and reactions at both ends.  Throws std::domain_error where there is no
/// posture, std::invalid_argument where contacts do not allow it.
Ends predict_ends(const Task& task, const Model& model, posture::Result& start,
                  posture::Result& end, const Joints& joints = {});

State state_at_end(const Motion& motion);
/// The same for the contacts of the next phase: new ones carry nothing.
State handed_over(State state, const Task& before, const Task& next);

/// Its place among contacts, or -1.
int contact_index(const std::vector<arboc::nlp::Contact>& contacts, const std::string& name);
/// Six columns a contact of `to`, of columns that are six a contact of `from`.
Eigen::MatrixXd arranged(const Eigen::MatrixXd& columns,
                         const std::vector<arboc::nlp::Contact>& from,
                         const std::vector<arboc::nlp::Contact>& to);

}  // namespace motion
