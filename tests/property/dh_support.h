// Models of DH tables, and places of their links by Eigen's transformations.
#pragma once
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "frontend/dh.h"
#include "frontend/read_model.h"
#include "functions/setup.h"
#include "reference/frames.h"
#include "reference/reference.h"
#include "support/random.h"

namespace arboc::test {

inline constexpr const char* kSantos = ARBOC_SOURCE_DIR "/models/santos/santos.dh.toml";
using Eigen::Isometry3d, Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

inline Model configured(const Model& model, const ModelOptions& options = {}) {
  Diagnostics diagnostics;
  return configure(model, options, diagnostics);
}
inline Model parsed(const std::string& text) {
  Diagnostics diagnostics;
  return parse_dh(text, "test.dh.toml", "", diagnostics);
}
inline Model santos(const ModelOptions& options = {}, const std::string& anthropometry = "") {
  Diagnostics diagnostics;
  return configured(read_model(kSantos, diagnostics, anthropometry), options);
}

inline ModelOptions with_base(Base base, const std::string& hang_from = "") {
  ModelOptions options;
  options.base = base;
  options.hang_from = hang_from;
  return options;
}
inline ModelOptions unsnapped() {
  ModelOptions options;
  options.snap = 0;
  return options;
}

inline size_t link_of(const Model& model, const std::string& name) {
  for (size_t k = 0; k < model.links.size(); ++k)
    if (model.links[k].name == name) return k;
  throw std::invalid_argument("no link " + name);
}
inline int q_of(const Model& model, const std::string& joint) {
  const Coordinates at = coordinates(model);
  for (size_t k = 0; k < model.joints.size(); ++k)
    if (model.joints[k].name == joint) return at.joint[k].q;
  throw std::invalid_argument("no joint " + joint);
}

inline Isometry3d place(const Model& model, const VectorXd& q, const std::string& link) {
  const auto p = Reference(model).fk(q)[link_of(model, link)];
  Isometry3d T = Isometry3d::Identity();
  T.linear() = p.R;
  T.translation() = p.p;
  return T;
}

inline VectorXd random_vector(int n, Random& random, double size = 1.5) {
  VectorXd x(n);
  for (int k = 0; k < n; ++k) x[k] = random.uniform(-size, size);
  return x;
}

inline double apart(const Isometry3d& a, const Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

inline Isometry3d turn(const Vector3d& axis, double angle) {
  return Isometry3d(Eigen::AngleAxisd(angle, axis));
}
inline Isometry3d slide(const Vector3d& by) { return Isometry3d(Eigen::Translation3d(by)); }

/// The transformation of one row, by either convention.
inline Isometry3d row(bool modified, double theta, double d, double alpha, double a) {
  const Vector3d x = Vector3d::UnitX(), z = Vector3d::UnitZ();
  return modified ? turn(x, alpha) * slide(a * x) * turn(z, theta) * slide(d * z)
                  : turn(z, theta) * slide(d * z) * slide(a * x) * turn(x, alpha);
}

}  // namespace arboc::test
