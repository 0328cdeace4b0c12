#include "frontend/dh_placement.h"

#include <map>

namespace arboc {
namespace {

bool is_identity(const Matrix3<double>& R) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (R(i, j) != (i == j ? 1 : 0)) return false;
  return true;
}
bool is_zero(const Vector3<double>& a) { return a.x == 0 && a.y == 0 && a.z == 0; }

}  // namespace

bool DhPlacement::is_identity() const {
  return x.is_zero() && y.is_zero() && z.is_zero() && is_zero(rpy) && arboc::is_identity(turn);
}

Pose pose_of(const DhPlacement& p, const std::vector<NamedLength>& lengths) {
  Pose result;
  result.rpy = p.rpy;
  result.turn = p.turn;
  const DhLinear* const parts[] = {&p.x, &p.y, &p.z};
  std::map<int, Vector3<double>> slopes;
  for (int i = 0; i < 3; ++i) {
    result.rest[i] = parts[i]->constant;
    for (const auto& [symbol, factor] : parts[i]->terms) slopes[symbol.index][i] += factor;
  }
  for (const auto& [length, slope] : slopes) result.terms.push_back({length, slope});
  result.xyz = result.rest;
  for (const LengthTerm& term : result.terms)
    result.xyz = result.xyz + lengths[static_cast<size_t>(term.length)].value * term.slope;
  if (result.terms.empty()) result.rest = {};
  return result;
}

Inertial inertial_of(const DhMass& mass, const std::vector<NamedLength>& lengths) {
  Inertial result;
  result.origin =
      pose_of({mass.cg[0], mass.cg[1], mass.cg[2], mass.axes.rpy, mass.axes.turn}, lengths);
  result.mass = mass.mass;
  result.location = mass.where;
  result.inertia = mass.at_origin ? about_centre(mass, result.origin.xyz) : mass.inertia;
  return result;
}

std::vector<Matrix3<double>> local_frames(std::string_view axes) {
  std::vector<Matrix3<double>> frames;
  Matrix3<double> Q = Matrix3<double>::identity();
  for (const char letter : axes) {
    Vector3<double> axis{};
    axis[letter - 'X'] = 1;
    const Vector3<double> n = cross(column(Q, 2), axis);
    if (!is_zero(n)) {
      Matrix3<double> quarter;
      for (int j = 0; j < 3; ++j) {
        Vector3<double> e{};
        e[j] = 1;
        const Vector3<double> turned = n[j] * n + cross(n, e);
        for (int i = 0; i < 3; ++i) quarter(i, j) = turned[i] + 0.0;
      }
      Q = quarter * Q;
    }
    frames.push_back(Q);
  }
  return frames;
}

Symmetric3<double> about_centre(const DhMass& mass, const Vector3<double>& c) {
  const double m = mass.mass;
  const Symmetric3<double>& I = mass.inertia;
  return {I.xx - m * (c.y * c.y + c.z * c.z),
          I.yy - m * (c.x * c.x + c.z * c.z),
          I.zz - m * (c.x * c.x + c.y * c.y),
          I.xy + m * c.x * c.y,
          I.xz + m * c.x * c.z,
          I.yz + m * c.y * c.z};
}

}  // namespace arboc
