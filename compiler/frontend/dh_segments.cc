// Masses, centres and inertias of segments: what no body has, and what no limb has.
#include <fmt/format.h>

#include <cmath>

#include "base/number.h"
#include "frontend/dh_file.h"

namespace arboc {
namespace {

size_t at(int k) { return static_cast<size_t>(k); }

class SegmentCheck {
 public:
  SegmentCheck(const DhFile& file, const DhReport& report, const DhMass& mass, std::string element,
               int row)
      : file_(file), report_(report), mass_(mass), element_(std::move(element)), row_(row) {}

  void run() {
    if (!complete()) return;
    c_ = value_of(mass_.cg, file_);
    central_ = mass_.at_origin ? about_centre(mass_, c_) : mass_.inertia;
    if (mass_.at_origin) check_origin();
    if (!file_.human || row_ < 0 || row_ >= kPrivateFrame || mass_.mass <= 0) return;
    link_ = link();
    if (!(dot(link_, link_) > 0)) return;  // as of hands and heads, which end at their joint
    check_centre();
    if (mass_.has_inertia) check_axis();
  }

 private:
  void error(std::string message, std::string hint = {}) const {
    report_.findings.error(
        {mass_.where, element_, std::move(message), std::move(hint), mass_.file});
  }
  void warning(std::string message, std::string hint = {}) const {
    report_.findings.warning(
        {mass_.where, element_, std::move(message), std::move(hint), mass_.file});
  }

  bool complete() const {
    if (mass_.has_inertia && !mass_.has_mass) error("inertia is given, but no mass");
    if (mass_.has_cg && !mass_.has_mass) error("cg is given, but no mass");
    if (mass_.has_mass && !mass_.has_cg)
      error("mass is given, but no cg", "the centre of mass in the frame: cg = [0, 0, 0]");
    if (!mass_.has_mass && !mass_.has_cg && !mass_.has_inertia)
      error("mass, cg and inertia are missing");
    if (mass_.at_origin &&
        (mass_.axes.rpy.x != 0 || mass_.axes.rpy.y != 0 || mass_.axes.rpy.z != 0 ||
         mass_.axes.turn(0, 0) != 1 || mass_.axes.turn(1, 1) != 1))
      error("inertia about the origin is along the frame's axes, which are not turned",
            "leave rpy and rotation out, or give the inertia about the cg");
    return mass_.has_mass && mass_.has_cg;
  }

  /// Of a tensor about the origin m (c^2 1 - c c^T) belongs to the centre of mass.
  void check_origin() const {
    constexpr double kRounding = 1e-12;
    const double own[] = {central_.xx, central_.yy, central_.zz};
    const double given[] = {mass_.inertia.xx, mass_.inertia.yy, mass_.inertia.zz};
    const double size = mass_.mass * dot(c_, c_);
    for (int i = 0; i < 3; ++i)
      if (own[i] < -kRounding * size)
        error(fmt::format("inertia {0}{0} about the origin ({1}) is less than what the centre of "
                          "mass alone makes ({2:.6g}): {3:.6g} is left about it",
                          "xyz"[i], shortest(given[i]), given[i] - own[i], own[i]),
              "no body has that: check cg, and about which point the inertia is");
    const double products[] = {mass_.mass * c_.x * c_.y, mass_.mass * c_.x * c_.z,
                               mass_.mass * c_.y * c_.z};
    if (!mass_.products &&
        (std::fabs(products[0]) + std::fabs(products[1]) + std::fabs(products[2]) >
         kRounding * size))
      warning(fmt::format("inertia about the origin has no products, but the centre of mass makes "
                          "xy {:.6g}, xz {:.6g}, yz {:.6g}",
                          0 - products[0], 0 - products[1], 0 - products[2]),
              "give all six numbers, or the inertia about the cg");
  }

  /// From the segment's frame to where its link begins, in the frame.
  Vector3<double> link() const {
    const DhRow& row = file_.rows[at(row_)];
    if (row.is_placed || row.joint >= 0 || file_.modified) return {};
    const double a = value_of(row.a, file_), d = value_of(row.d.value, file_);
    const double alpha = row.alpha.constant;
    Vector3<double> s{-a, -d * std::sin(alpha), -d * std::cos(alpha)};
    for (int i = 0; i < 3; ++i)
      if (std::fabs(s[i]) < 1e-9) s[i] = 0;
    return s;
  }

  void check_centre() const {
    constexpr double kFirst = 0.25, kLast = 0.75, kAside = 0.25;
    const double length = std::sqrt(dot(link_, link_));
    const double along = dot(c_, link_) / (length * length);
    const Vector3<double> off = c_ - along * link_;
    const double aside = std::sqrt(dot(off, off)) / length;
    if (kFirst <= along && along <= kLast && aside <= kAside) return;
    warning(fmt::format("the centre of mass is off its link: at {:.0f} % of it, {:.0f} % aside",
                        100 * (1 - along), 100 * aside),
            fmt::format("half way would be cg = [{:.3g}, {:.3g}, {:.3g}] m; check its sign, and "
                        "the lengths of the row",
                        link_.x / 2, link_.y / 2, link_.z / 2));
  }

  /// A limb is round about its link.
  void check_axis() const {
    constexpr double kEqual = 0.05, kDifferent = 0.1, kAlong = 0.9;
    const double I[] = {central_.xx, central_.yy, central_.zz};
    const double length = std::sqrt(dot(link_, link_));
    for (int k = 0; k < 3; ++k) {
      const double one = I[(k + 1) % 3], two = I[(k + 2) % 3];
      const double size = std::max(std::fabs(one), std::fabs(two));
      if (std::fabs(one - two) > kEqual * size || std::fabs(I[k] - one) < kDifferent * size)
        continue;
      for (int j = 0; j < 3; ++j)
        if (j != k && std::fabs(link_[j]) > kAlong * length)
          warning(fmt::format("the inertia is that of a body round about {}, but its link runs "
                              "along {}",
                              "xyz"[k], "xyz"[j]),
                  fmt::format("swap {0}{0} and {1}{1} of the inertia about the centre of mass",
                              "xyz"[k], "xyz"[j]));
    }
  }

  const DhFile& file_;
  const DhReport& report_;
  const DhMass& mass_;
  std::string element_;
  int row_;
  Vector3<double> c_{}, link_{};
  Symmetric3<double> central_{};
};

}  // namespace

void check_segments(const DhFile& file, const DhReport& report) {
  for (const DhSegment& s : file.segments)
    SegmentCheck(file, report, s.mass, named("segment", s.name), s.row).run();
  for (size_t k = 0; k < file.rows.size(); ++k)
    if (file.rows[k].mass)
      SegmentCheck(file, report, *file.rows[k].mass, named("row", file.rows[k].name),
                   static_cast<int>(k))
          .run();
  if (file.root.mass) SegmentCheck(file, report, *file.root.mass, "root", -1).run();
}

}  // namespace arboc
