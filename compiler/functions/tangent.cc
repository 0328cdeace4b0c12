#include "functions/tangent.h"

#include "graph/expr.h"

namespace arboc {
namespace {

class Tangent {
 public:
  Tangent(const DynamicTree& tree, Builder& builder, const std::vector<Ref>& q)
      : builder_(builder), out_(static_cast<size_t>(tree.nv)) {
    for (const Ref ref : q) q_.emplace_back(&builder, ref);
    for (size_t k = 0; k < out_.size(); ++k) out_[k].name = "q" + std::to_string(k);
    for (size_t i = 1; i < tree.body.size(); ++i) add(tree.body[i], static_cast<int>(i));
  }
  std::vector<Coordinate> take() && { return std::move(out_); }

 private:
  void add(const Body& body, int i) {
    if (!out_[static_cast<size_t>(body.v)].seeds.empty()) return;  // a follower
    switch (body.motion) {
      case Motion::kWorld: break;
      case Motion::kRevolute:
      case Motion::kPrismatic: add_single(body); break;
      case Motion::kPlanar: add_planar(body, i); break;
      case Motion::kFloating: add_floating(body, i); break;
      case Motion::kSpherical: add_turn(body, 0, body.v, i); break;
    }
  }

  void add_single(const Body& body) {
    if (body.circle) {
      seed(body.v, q(body, 0), -q(body, 1));
      seed(body.v, q(body, 1), q(body, 0));
    } else {
      seed(body.v, q(body, 0), 1.0);
    }
  }

  void add_planar(const Body& body, int group) {
    Expr s, c;
    sincos(q(body, 2), s, c);
    seed(body.v, q(body, 0), c);
    seed(body.v, q(body, 1), s);
    seed(body.v + 1, q(body, 0), -s);
    seed(body.v + 1, q(body, 1), c);
    seed(body.v + 2, q(body, 2), 1.0);
    for (int d = 0; d < 3; ++d) out_[static_cast<size_t>(body.v + d)].group = group;
  }

  void add_floating(const Body& body, int group) {
    const Matrix3<Expr> R = add_turn(body, 3, body.v + 3, group);
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) seed(body.v + k, q(body, i), R(i, k));
      out_[static_cast<size_t>(body.v + k)].group = group;
    }
  }

  /// R' = R [e], quaternion' = quaternion (e, 0) / 2; returns R.
  Matrix3<Expr> add_turn(const Body& body, int first, int v, int group) {
    const Expr quaternion[] = {q(body, first), q(body, first + 1), q(body, first + 2),
                               q(body, first + 3)};
    const Vector3<Expr> u{quaternion[0], quaternion[1], quaternion[2]};
    const Matrix3<Expr> R = rotation_of_quaternion(quaternion);
    for (int k = 0; k < 3; ++k) {
      const int about = v + k, next = (k + 1) % 3, last = (k + 2) % 3;
      for (int i = 0; i < 3; ++i) {
        seed(about, R(i, next), R(i, last));
        seed(about, R(i, last), -R(i, next));
      }
      seed(about, quaternion[k], 0.5 * quaternion[3]);
      seed(about, quaternion[next], 0.5 * u[last]);
      seed(about, quaternion[last], -0.5 * u[next]);
      seed(about, quaternion[3], -0.5 * u[k]);
      out_[static_cast<size_t>(about)].group = group;
    }
    return R;
  }

  const Expr& q(const Body& body, int k) const { return q_[static_cast<size_t>(body.q + k)]; }

  void seed(int coordinate, const Expr& node, const Expr& derivative) {
    out_[static_cast<size_t>(coordinate)].seeds.push_back(
        {node.ref(builder_), derivative.ref(builder_)});
  }

  Builder& builder_;
  std::vector<Expr> q_;
  std::vector<Coordinate> out_;
};

}  // namespace

std::vector<Coordinate> tangent(const DynamicTree& tree, Builder& builder,
                                const std::vector<Ref>& q) {
  return Tangent(tree, builder, q).take();
}

}  // namespace arboc
