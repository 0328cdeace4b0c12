#include "functions/lane_tree.h"

#include <map>

#include "tree/coupling.h"

namespace arboc {
namespace {

int entries_of_q(const Body& body) {
  switch (body.motion) {
    case Motion::kFloating: return 7;
    case Motion::kSpherical: return 4;
    case Motion::kRevolute: return body.circle ? 2 : 1;
    default: return freedoms(body.motion);
  }
}

/// Numbers of corresponding bodies, one a lane.
class Numbers {
 public:
  Numbers(Builder& builder, std::vector<const BodyOf<double>*> lanes)
      : builder_(builder), lanes_(fill_lanes(std::move(lanes))) {}

  template <class Get>
  Expr number(Get get) const {
    Lanes value;
    value.width = 0;
    for (const BodyOf<double>* body : lanes_) value.x[value.width++] = get(*body);
    return {&builder_, builder_.constant(value)};
  }
  template <class Get>
  PlanarRotation<Expr> turn(Get get) const {
    return {number([&](const auto& b) { return get(b).c; }),
            number([&](const auto& b) { return get(b).s; })};
  }
  template <class Get>
  Vector3<Expr> vector(Get get) const {
    return {number([&](const auto& b) { return get(b).x; }),
            number([&](const auto& b) { return get(b).y; }),
            number([&](const auto& b) { return get(b).z; })};
  }

  void fill(BodyOf<Expr>& to) const {
    to.gamma = turn([](const auto& b) { return b.gamma; });
    to.alpha = turn([](const auto& b) { return b.alpha; });
    to.theta = turn([](const auto& b) { return b.theta; });
    to.c = vector([](const auto& b) { return b.c; });
    to.inertia.m = number([](const auto& b) { return b.inertia.m; });
    to.inertia.h = vector([](const auto& b) { return b.inertia.h; });
    to.inertia.Sigma = {number([](const auto& b) { return b.inertia.Sigma.xx; }),
                        number([](const auto& b) { return b.inertia.Sigma.yy; }),
                        number([](const auto& b) { return b.inertia.Sigma.zz; }),
                        number([](const auto& b) { return b.inertia.Sigma.xy; }),
                        number([](const auto& b) { return b.inertia.Sigma.xz; }),
                        number([](const auto& b) { return b.inertia.Sigma.yz; })};
    to.forces.damping = number([](const auto& b) { return b.forces.damping; });
    to.forces.friction = number([](const auto& b) { return b.forces.friction; });
    to.forces.stiffness = number([](const auto& b) { return b.forces.stiffness; });
    to.forces.neutral = number([](const auto& b) { return b.forces.neutral; });
    to.forces.rotor = number([](const auto& b) { return b.forces.rotor; });
  }

 private:
  Builder& builder_;
  std::vector<const BodyOf<double>*> lanes_;
};

class Folding {
 public:
  Folding(const DynamicTree& tree, const std::vector<LimbGroup>& groups, Builder& builder)
      : whole_(tree), builder_(builder), bodies_(tree.body.size()), index_(tree.body.size(), 0) {
    for (size_t i = 0; i < bodies_.size(); ++i) bodies_[i] = {static_cast<int>(i)};
    for (const LimbGroup& group : groups) {
      for (size_t k = 0; k < group.limb[0].size(); ++k) {
        for (const auto& limb : group.limb) at(limb[k]).clear();
        for (const auto& limb : group.limb) at(group.limb[0][k]).push_back(limb[k]);
      }
    }
  }

  LaneTree run() {
    LaneTree out;
    number_coordinates(out);
    DynamicTreeOf<Expr>& tree = out.tree;
    tree.name = whole_.name;
    tree.nq = static_cast<int>(out.q.size());
    tree.nv = static_cast<int>(out.v.size());
    tree.gravity = cast<Expr>(whole_.gravity);
    tree.joint_forces = whole_.joint_forces;
    tree.friction_velocity = whole_.friction_velocity;
    for (const auto& lanes : out.v) tree.lanes.push_back(static_cast<int>(lanes.size()));
    for (size_t i = 0; i < bodies_.size(); ++i) {
      if (bodies_[i].empty()) continue;
      index_[i] = static_cast<int>(tree.body.size());
      tree.body.push_back(body(bodies_[i]));
    }
    tree.coupled = coupling({tree.body.begin(), tree.body.end()}, tree.nv);
    return out;
  }

 private:
  std::vector<int>& at(int i) { return bodies_[static_cast<size_t>(i)]; }
  const BodyOf<double>& whole(int i) const { return whole_.body[static_cast<size_t>(i)]; }

  /// In the order of the first limbs' entries; mimic joints share one.
  void number_coordinates(LaneTree& out) {
    std::map<int, std::vector<int>> q, v;
    const auto list = [&](std::map<int, std::vector<int>>& all, const std::vector<int>& lanes,
                          int Body::*first, int entry) {
      std::vector<int>& entries = all[whole(lanes[0]).*first + entry];
      entries.clear();
      for (const int i : lanes) entries.push_back(whole(i).*first + entry);
    };
    for (const std::vector<int>& lanes : bodies_) {
      if (lanes.empty() || lanes[0] == 0) continue;
      for (int d = 0; d < entries_of_q(whole(lanes[0])); ++d) list(q, lanes, &Body::q, d);
      for (int d = 0; d < freedoms(whole(lanes[0]).motion); ++d) list(v, lanes, &Body::v, d);
    }
    for (auto& [first, lanes] : q) {
      q_[first] = static_cast<int>(out.q.size());
      out.q.push_back(std::move(lanes));
    }
    for (auto& [first, lanes] : v) {
      v_[first] = static_cast<int>(out.v.size());
      out.v.push_back(std::move(lanes));
    }
  }

  BodyOf<Expr> body(const std::vector<int>& lanes) {
    const BodyOf<double>& first = whole(lanes[0]);
    BodyOf<Expr> out;
    static_cast<Body&>(out) = first;
    std::vector<const BodyOf<double>*> sources;
    out.link.clear();
    for (const int i : lanes) {
      sources.push_back(&whole(i));
      out.link += (out.link.empty() ? "" : ", ") + whole(i).link;
    }
    if (first.motion == Motion::kWorld) return out;
    out.parent = index_[static_cast<size_t>(first.parent)];
    out.q = q_.at(first.q);
    out.v = v_.at(first.v);
    const bool root = at(first.parent).size() != lanes.size();
    out.limbs = root ? static_cast<int>(lanes.size()) : 1;
    Numbers(builder_, std::move(sources)).fill(out);
    return out;
  }

  const DynamicTree& whole_;
  Builder& builder_;
  std::vector<std::vector<int>> bodies_;  ///< per body those it stands for; empty: another does
  std::vector<int> index_;                ///< per body its index in the new tree
  std::map<int, int> q_, v_;              ///< first entries -> entries of the new tree
};

}  // namespace

LaneTree lane_tree(const DynamicTree& tree, const std::vector<LimbGroup>& groups,
                   Builder& builder) {
  return Folding(tree, groups, builder).run();
}

}  // namespace arboc
