#include "tree/denavit.h"

#include <cmath>

#include "tree/tallied.h"

namespace arboc {
namespace {

/// Per body the child with the most bodies in its subtree, the first of equals; 0: a leaf.
std::vector<size_t> main_children(const Draft& draft) {
  const size_t n = draft.body.size();
  std::vector<int> size(n, 1);
  std::vector<size_t> main(n, 0);
  for (size_t i = n - 1; i > 0; --i) {
    const auto parent = static_cast<size_t>(draft.body[i].body.parent);
    size[parent] += size[i];
    if (main[parent] == 0 || size[i] >= size[main[parent]]) main[parent] = i;
  }
  return main;
}

/// The rotation about z that puts x along (x, y); none if that only renames axes.
Turn turn_to(double x, double y) {
  const double length = std::hypot(x, y);
  if (length == 0) return {};
  const Turn turn = clean_unit(Turn{x / length, y / length});
  return turn.c == 0 || turn.s == 0 ? Turn{} : turn;
}

struct Choice {
  Turn turn;
  double slide = 0;
};

/// For a child with origin p and axis u, both in the frame that is to be chosen.
Choice along_common_normal(const Vector3<double>& p, const Vector3<double>& u) {
  constexpr double kParallel = 1e-9;
  constexpr double kFar = 10;  // a foot this much further away than the child costs digits
  const Vector3<double> normal{-u.y, u.x, 0};
  const double sine2 = u.x * u.x + u.y * u.y;
  const double sine = std::sqrt(sine2);
  if (sine >= kParallel) {
    const double foot =
        clean((tallied(p).z - Tallied(u.z) * dot(tallied(p), tallied(u))) * Tallied(1 / sine2));
    if (std::fabs(foot) <= kFar * std::sqrt(dot(p, p))) {
      const double side = dot(p, normal) < 0 ? -1 : 1;
      return {turn_to(side * normal.x, side * normal.y), foot};
    }
  }
  return {turn_to(p.x, p.y), p.z};
}

}  // namespace

std::vector<Reframe> denavit_frames(const Draft& draft) {
  const std::vector<size_t> main = main_children(draft);
  std::vector<Reframe> frames(draft.body.size());
  for (size_t i = draft.body.size() - 1; i > 0; --i) {
    const BodyOf<double>& body = draft.body[i].body;
    if (has_quaternion(body.motion)) continue;
    Choice choice;
    if (main[i] != 0) {
      const DraftBody& child = draft.body[main[i]];
      choice =
          along_common_normal(place(child.R, frames[main[i]].t, child.body.c), column(child.R, 2));
    } else if (body.motion == Motion::kRevolute) {
      choice.turn = turn_to(body.inertia.h.x, body.inertia.h.y);
    }
    // A planar joint's velocity is measured along x and y, so those must stay.
    if (body.motion == Motion::kPlanar) choice.turn = {};
    const auto [c, s] = choice.turn;
    frames[i].Q = {{{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}}};
    frames[i].t = {0, 0, choice.slide};
  }
  return frames;
}

}  // namespace arboc
