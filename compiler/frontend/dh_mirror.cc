// Whether left and right mirror each other.
//
// With S = 1 - 2 n n^T the reflection at the plane of symmetry, a point p has its image at S p, a
// turn by q about an axis u is seen as one by q about -S u, a slide along u as one along S u.
// Where the other side's axis is the image's opposite, its coordinate has the opposite sign, and
// so have its limits and neutral place.
#include <fmt/format.h>

#include <cmath>

#include "base/number.h"
#include "frontend/dh_file.h"

namespace arboc {
namespace {

constexpr double kAngle = 1e-4;   // rad; tables have four digits
constexpr double kLength = 1e-3;  // m
constexpr double kRelative = 0.01;

size_t at(int k) { return static_cast<size_t>(k); }

double distance(const Vector3<double>& a, const Vector3<double>& b) {
  return std::sqrt(dot(a - b, a - b));
}

std::string text(double lower, double upper) {
  return fmt::format("[{}, {}]", shortest(lower), shortest(upper));
}

class MirrorCheck {
 public:
  MirrorCheck(const DhFile& file, const DhReport& report, const DhMirror& mirror)
      : file_(file), report_(report), n_(mirror.normal), places_(zero_posture(file)) {}

  void pair(int left, int right) {
    const DhRow &l = file_.rows[at(left)], &r = file_.rows[at(right)];
    const DhPlace &pl = places_[at(left)], &pr = places_[at(right)];
    const std::string both = fmt::format("rows '{}' and '{}'", l.name, r.name);
    const double off = distance(pl.p, image(pr.p));
    if (off > kLength && std::fabs(off - last_off_) > kLength)
      report_.warning(
          l.where, both,
          fmt::format("do not mirror: at zero their origins are {:.1f} mm from it", 1000 * off));
    last_off_ = off;
    joints(l, r, pl, pr, both);
    segments(left, right);
  }

 private:
  Vector3<double> image(const Vector3<double>& p) const { return p - (2 * dot(n_, p)) * n_; }

  void joints(const DhRow& l, const DhRow& r, const DhPlace& pl, const DhPlace& pr,
              const std::string& both) const {
    const DhCell& cl = l.theta.joint >= 0 ? l.theta : l.d;
    const DhCell& cr = r.theta.joint >= 0 ? r.theta : r.d;
    if (cl.joint < 0 || cr.joint < 0 || cl.joint == cr.joint) return;
    const DhJoint &jl = file_.joints[at(cl.joint)], &jr = file_.joints[at(cr.joint)];
    const Vector3<double> seen =
        (jr.slides ? 1.0 : -1.0) * image((cr.factor < 0 ? -1.0 : 1.0) * pr.axis);
    const double along = (cl.factor < 0 ? -1.0 : 1.0) * dot(pl.axis, seen);
    if (std::fabs(along) < 1 - kAngle) {
      report_.warning(l.where, both, "do not mirror: at zero their joints' axes do not");
      return;
    }
    compare(jl, jr, along > 0);
  }

  void compare(const DhJoint& left, const DhJoint& right, bool same) const {
    const DhDrive &l = left.drives[0], &r = right.drives[0];
    const auto report = [&](const char* what, const std::string& is, const std::string& other,
                            const std::string& expected) {
      report_.warning(left.where, named("joint", left.name),
                      fmt::format("{} {}: no mirror image of {} of {}", what, is, other,
                                  named("joint", right.name)),
                      fmt::format("it turns the {} way in the mirror, so {} would",
                                  same ? "same" : "other", expected));
    };
    const auto interval = [&](const char* what, double ll, double lu, double rl, double ru) {
      const double el = same ? rl : -ru, eu = same ? ru : -rl;
      if (std::isinf(ll) && std::isinf(el) && std::isinf(lu) && std::isinf(eu)) return;
      if (!(std::fabs(ll - el) <= kAngle && std::fabs(lu - eu) <= kAngle))
        report(what, text(ll, lu), text(rl, ru), text(el, eu));
    };
    interval("limits", l.limits.lower, l.limits.upper, r.limits.lower, r.limits.upper);
    interval("torque", l.limits.effort_lower, l.limits.effort, r.limits.effort_lower,
             r.limits.effort);
    const double neutral = same ? r.neutral : -r.neutral;
    if (std::fabs(l.neutral - neutral) > kAngle)
      report("neutral", shortest(l.neutral), shortest(r.neutral), shortest(neutral));
    if (std::fabs(l.stiffness - r.stiffness) > kRelative * std::fabs(r.stiffness))
      report("stiffness", shortest(l.stiffness), shortest(r.stiffness), shortest(r.stiffness));
  }

  const DhSegment* segment_on(int row) const {
    for (const DhSegment& s : file_.segments)
      if (s.row == row) return &s;
    return nullptr;
  }

  /// About the centre of mass, in world axes.
  static Symmetric3<double> in_world(const Symmetric3<double>& I, const Matrix3<double>& R) {
    return symmetric(R * (full(I) * transpose(R)));
  }

  void segments(int left, int right) const {
    const DhSegment *l = segment_on(left), *r = segment_on(right);
    if (l == nullptr || r == nullptr || !l->mass.has_cg || !r->mass.has_cg) return;
    const auto report = [&](const std::string& message) {
      report_.findings.warning({l->mass.where,
                                fmt::format("segments '{}' and '{}'", l->name, r->name),
                                "do not mirror: " + message, "", l->mass.file});
    };
    if (std::fabs(l->mass.mass - r->mass.mass) > kRelative * r->mass.mass)
      report(
          fmt::format("masses are {} and {} kg", shortest(l->mass.mass), shortest(r->mass.mass)));
    const DhPlace &pl = places_[at(left)], &pr = places_[at(right)];
    const Vector3<double> cl = value_of(l->mass.cg, file_), cr = value_of(r->mass.cg, file_);
    const double off = distance(pl.R * cl, image(pr.R * cr));
    if (off > 2 * kLength)
      report(fmt::format("the centres of mass are {:.0f} mm from it", 1000 * off));
    const auto central = [&](const DhMass& m, const Vector3<double>& c, const Matrix3<double>& R) {
      return in_world(m.at_origin ? about_centre(m, c) : m.inertia, R);
    };
    const Symmetric3<double> il = central(l->mass, cl, pl.R), ir = central(r->mass, cr, pr.R);
    const double size = std::fabs(ir.xx) + std::fabs(ir.yy) + std::fabs(ir.zz);
    if (std::fabs(il.xx - ir.xx) + std::fabs(il.yy - ir.yy) + std::fabs(il.zz - ir.zz) >
        3 * kRelative * size)
      report(
          fmt::format("moments of inertia are {:.4g} {:.4g} {:.4g} and {:.4g} {:.4g} {:.4g} "
                      "kg m^2 along the world's axes",
                      il.xx, il.yy, il.zz, ir.xx, ir.yy, ir.zz));
  }

  const DhFile& file_;
  const DhReport& report_;
  Vector3<double> n_;
  std::vector<DhPlace> places_;
  double last_off_ = 0;  // of the pair before: what is off stays off along the limb
};

}  // namespace

void check_mirrors(const DhFile& file, const DhReport& report) {
  for (const DhMirror& mirror : file.mirrors) {
    if (mirror.left.size() != mirror.right.size()) continue;
    MirrorCheck check(file, report, mirror);
    for (size_t k = 0; k < mirror.left.size(); ++k) check.pair(mirror.left[k], mirror.right[k]);
  }
}

}  // namespace arboc
