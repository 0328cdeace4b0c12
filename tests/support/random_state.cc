#include "support/random_state.h"

namespace arboc::test {

State random_state(const Model& model, Random& random) {
  const Coordinates where = coordinates(model);
  State state{Eigen::VectorXd(where.nq), random.vector(where.nv, 2), random.vector(where.nv, 5),
              random.vector(where.nv, 10)};
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (joint.mimic) continue;
    const int n = nq(joint);
    if (n == 0) continue;
    auto q = state.q.segment(where.joint[k].q, n);
    q = random.vector(n, 1);
    if (quaternion_at(joint.type) >= 0) q.tail(4) = random.direction(4);
    if (joint.type == JointType::kUnbounded) q = random.direction(2);
    if (has_axis(joint.type) && joint.type != JointType::kPrismatic &&
        joint.type != JointType::kUnbounded)
      q[n - 1] = random.uniform(-3.14, 3.14);
  }
  return state;
}

}  // namespace arboc::test
