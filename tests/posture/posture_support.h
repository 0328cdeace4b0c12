// Tasks that are shipped, and what an independent engine says of a result.
#pragma once
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "frontend/read_model.h"
#include "predict.h"
#include "reference/reference.h"

namespace arboc::test {

inline posture::Task task(const std::string& name) {
  return posture::read_task(ARBOC_SOURCE_DIR "/apps/posture/tasks/" + name + ".toml");
}

inline posture::Result solve_task(const posture::Task& t,
                                  const std::optional<nlp::Vector3>& move = {}) {
  return posture::predict(t, posture::model(t.model), move);
}
inline posture::Result solve_task(const std::string& name, int starts) {
  posture::Task t = task(name);
  t.search.starts = starts;
  return solve_task(t);
}

/// Optimal, to the tolerances that docs/posture.md promises.
inline void expect_solved(const posture::Result& r, const std::string& name) {
  EXPECT_EQ(r.status, nlp::Status::kOptimal) << name << ": " << r.reason;
  EXPECT_LE(r.kkt_error, 1e-7) << name;
  EXPECT_LE(r.max_violation, 1e-8) << name;
  EXPECT_LE(r.max_normalised_torque, 1 + 1e-8) << name;
}

/// What the reference engine, which reads the model's file, needs at rest: tau of all coordinates.
inline Eigen::VectorXd reference_torques(const std::string& file, const ModelOptions& options,
                                         const posture::Task& t, const posture::Result& r) {
  Diagnostics diagnostics;
  const Model model =
      configure(read_model(ARBOC_SOURCE_DIR "/models/" + file, diagnostics), options, diagnostics);
  JointForces springs;
  springs.stiffness = true;
  const Reference reference(model, springs);
  const Eigen::Map<const Eigen::VectorXd> q(r.q.data(), static_cast<Eigen::Index>(r.q.size()));
  const auto placements = reference.fk(q);
  Loads loads;
  const auto link = [&](const std::string& name) {
    for (std::size_t k = 0; k < model.links.size(); ++k)
      if (model.links[k].name == name) return static_cast<int>(k);
    throw std::logic_error("no link " + name);
  };
  const auto add = [&](const std::string& frame, const Eigen::Vector3d& point,
                       const Eigen::Vector3d& f, const Eigen::Vector3d& n) {
    const int k = link(frame);
    const Eigen::Vector3d arm = placements[static_cast<std::size_t>(k)].R * point;
    LinkWrench load{k, Axes::kAligned, {}};
    load.wrench << f, n + arm.cross(f);
    loads.push_back(load);
  };
  for (std::size_t c = 0; c < t.contacts.size(); ++c) {
    const double* w = r.reactions[c].data();
    add(t.contacts[c].frame, t.contacts[c].point, Eigen::Vector3d(w), Eigen::Vector3d(w + 3));
  }
  for (const auto& load : t.loads) add(load.frame, load.point, load.force, Eigen::Vector3d::Zero());
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(q.size());
  return reference.rnea(q, rest, rest, loads);
}

/// The reference engine agrees: torques as reported, none where nothing drives.
inline void expect_equilibrium(const std::string& file, const ModelOptions& options,
                               const posture::Task& t, const posture::Result& r) {
  const Eigen::VectorXd tau = reference_torques(file, options, t, r);
  // Rows hold to 1e-8 of 100 N or of a torque's limit.
  for (Eigen::Index i = 0; i < tau.size(); ++i)
    EXPECT_NEAR(tau[i], r.tau[static_cast<std::size_t>(i)], 1e-6) << t.name << " " << i;
}

}  // namespace arboc::test
