// What a motion does at many instants, frames or not: how far it is from what the task asks for.
#pragma once
#include "sample.h"

namespace motion {

/// How far a contact is from where it holds.
struct Misplacement {
  double distance = 0, sine = 0;  ///< m; of the largest angle of its axes
};
Misplacement misplacement(const arboc::nlp::Contact& contact, const arboc::nlp::Placement& at);

/// The worst of many instants, and when it happens.
struct Worst {
  double value = 0, time = 0;
  std::string where{};

  void note(double x, double t, const std::string& what);
};
struct Audit {
  int instants = 0;
  Worst force, moment;    ///< of the passive coordinates: N, N m
  Worst drift, turn;      ///< of contacts: m, 1 (sine of the angle)
  Worst torque_excess;    ///< beyond the limit, as part of it
  Worst joint_excess;     ///< beyond limits of coordinates: rad, m
  Worst friction_excess;  ///< outside of friction cones: N
  Worst overlap;          ///< of spheres: m
  double largest_normalised = 0;

  bool passes(const Tolerance& t) const;
  /// Of a motion that follows, whose time is so much later.
  void add(const Audit& other, double later);
};
Audit audit(const Task& task, const Model& model, const Samples& samples);

}  // namespace motion
