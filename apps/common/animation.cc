#include "animation.h"

#include <algorithm>
#include <stdexcept>

namespace study {
namespace {

using Vector3 = Eigen::Vector3d;

void check(const Animation& a) {
  const auto bodies = static_cast<int>(a.bodies.size());
  if (a.placements.rows() != a.frames() || a.placements.cols() != 12 * bodies)
    throw std::invalid_argument("animation: placements are not frames x 12 bodies");
  if (std::adjacent_find(a.times.begin(), a.times.end(),
                         [](double t, double next) { return !(next > t); }) != a.times.end())
    throw std::invalid_argument("animation: times do not rise");
  const auto known = [&](const BodyPoint& p) { return p.body >= 0 && p.body < bodies; };
  for (const Stick& s : a.sticks)
    if (!known(s.from) || !known(s.to)) throw std::invalid_argument("animation: no such body");
  for (const Force& f : a.forces)
    if (!known(f.at) || f.newtons.rows() != a.frames() || f.newtons.cols() != 3)
      throw std::invalid_argument("animation: force '" + f.name + "' is not frames x 3");
}

}  // namespace

int Animation::body(const std::string& of) const {
  const auto at = std::find(bodies.begin(), bodies.end(), of);
  if (at == bodies.end()) throw std::invalid_argument("animation: no body '" + of + "'");
  return static_cast<int>(at - bodies.begin());
}

void Animation::add_limb(const std::vector<std::string>& limb, double radius) {
  for (std::size_t k = 1; k < limb.size(); ++k)
    sticks.push_back(
        {{body(limb[k - 1]), Vector3::Zero()}, {body(limb[k]), Vector3::Zero()}, radius});
}

Vector3 Animation::point(int frame, const BodyPoint& p) const {
  const double* placement = placements.row(frame).data() + 12 * p.body;
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(placement);
  return R * p.at + Eigen::Map<const Vector3>(placement + 9);
}

std::vector<Segment> segments(const Animation& a) {
  check(a);
  std::vector<Segment> out;
  for (const Stick& s : a.sticks) {
    Segment segment{Segment::Kind::kStick,
                    a.bodies[static_cast<std::size_t>(s.from.body)] + "-" +
                        a.bodies[static_cast<std::size_t>(s.to.body)],
                    s.radius, Rows(a.frames(), 6)};
    for (int k = 0; k < a.frames(); ++k)
      segment.ends.row(k) << a.point(k, s.from).transpose(), a.point(k, s.to).transpose();
    out.push_back(std::move(segment));
  }
  for (const Force& f : a.forces) {
    Segment segment{Segment::Kind::kForce, f.name, 0.008, Rows(a.frames(), 6)};
    for (int k = 0; k < a.frames(); ++k) {
      const Vector3 p = a.point(k, f.at);
      segment.ends.row(k) << p.transpose(), p.transpose() + a.metre_per_newton * f.newtons.row(k);
    }
    out.push_back(std::move(segment));
  }
  for (const Fixture& f : a.fixtures) {
    Segment segment{Segment::Kind::kFixture, "fixture", f.radius, Rows(1, 6)};
    segment.ends << f.from.transpose(), f.to.transpose();
    out.push_back(std::move(segment));
  }
  return out;
}

}  // namespace study
