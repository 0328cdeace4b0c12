#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/number.h"
#include "tree/lower.h"

namespace arboc {
namespace {

const char* word(Motion motion) {
  switch (motion) {
    case Motion::kWorld: return "world";
    case Motion::kRevolute: return "revolute";
    case Motion::kPrismatic: return "prismatic";
    case Motion::kPlanar: return "planar";
    case Motion::kFloating: return "floating";
    case Motion::kSpherical: return "spherical";
  }
  return "world";
}

std::string text(const Vector3<double>& a) {
  return fmt::format("{} {} {}", shortest(a.x), shortest(a.y), shortest(a.z));
}
bool is_zero(const Vector3<double>& a) { return a.x == 0 && a.y == 0 && a.z == 0; }

/// " gamma(c s)", or nothing for the identity.
std::string text(const char* name, const Turn& turn) {
  if (turn.c == 1 && turn.s == 0) return "";
  return fmt::format(" {}({} {})", name, shortest(turn.c), shortest(turn.s));
}

std::string text(const MassMoments& inertia) {
  const Symmetric3<double>& S = inertia.Sigma;
  std::string out;
  if (inertia.m != 0) out += fmt::format(" m({})", shortest(inertia.m));
  if (!is_zero(inertia.h)) out += fmt::format(" h({})", text(inertia.h));
  if (!is_zero({S.xx, S.yy, S.zz}) || !is_zero({S.xy, S.xz, S.yz}))
    out +=
        fmt::format(" Sigma(xx {} yy {} zz {} xy {} xz {} yz {})", shortest(S.xx), shortest(S.yy),
                    shortest(S.zz), shortest(S.xy), shortest(S.xz), shortest(S.yz));
  return out;
}

std::string text(int index, const BodyOf<double>& body) {
  std::string out =
      fmt::format("body {} '{}': {} '{}' on {}, q {} v {}", index, printable(body.link),
                  word(body.motion), printable(body.joint), body.parent, body.q, body.v);
  if (body.multiplier != 1 || body.offset != 0)
    out += fmt::format(" mimic({} {})", shortest(body.multiplier), shortest(body.offset));
  if (body.circle) out += " cos-sin";
  out += text("gamma", body.gamma) + text("alpha", body.alpha) + text("theta", body.theta);
  if (!is_zero(body.c)) out += fmt::format(" c({})", text(body.c));
  return out + text(body.inertia) + '\n';
}

std::string text(const FrameOf<double>& frame) {
  std::string out = fmt::format("frame '{}': on {}", printable(frame.name), frame.body);
  const Matrix3<double>& R = frame.R;
  if (!is_zero(column(R, 0) - Vector3<double>{1, 0, 0}) ||
      !is_zero(column(R, 1) - Vector3<double>{0, 1, 0}) ||
      !is_zero(column(R, 2) - Vector3<double>{0, 0, 1}))
    out += fmt::format(" x({}) y({}) z({})", text(column(R, 0)), text(column(R, 1)),
                       text(column(R, 2)));
  if (!is_zero(frame.p)) out += fmt::format(" p({})", text(frame.p));
  return out + (frame.moving ? " moving\n" : "\n");
}

}  // namespace

std::string print(const DynamicTree& tree) {
  std::string out =
      fmt::format("tree {}: {} bodies, nq {}, nv {}, gravity({})\n", printable(tree.name),
                  tree.nb(), tree.nq, tree.nv, text(tree.gravity));
  for (int i = 1; i <= tree.nb(); ++i) out += text(i, tree.body[static_cast<size_t>(i)]);
  for (const FrameOf<double>& frame : tree.frame) out += text(frame);
  return out;
}

}  // namespace arboc
