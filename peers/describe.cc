#include "describe.h"

#include <algorithm>

namespace arboc {
namespace {

void copy(const Matrix3<double>& from, double* to) {
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col) *to++ = from(row, col);
}
void copy(const Vector3<double>& from, double* to) {
  to[0] = from.x, to[1] = from.y, to[2] = from.z;
}

bool known(JointType type) {
  return type == JointType::kFixed || type == JointType::kRevolute ||
         type == JointType::kContinuous || type == JointType::kPrismatic ||
         type == JointType::kPlanar || type == JointType::kFloating;
}

peers::Kind kind(JointType type) {
  switch (type) {
    case JointType::kFixed: return peers::Kind::kFixed;
    case JointType::kPrismatic: return peers::Kind::kPrismatic;
    case JointType::kPlanar: return peers::Kind::kPlanar;
    case JointType::kFloating: return peers::Kind::kFloating;
    default: return peers::Kind::kRevolute;
  }
}

peers::Link describe(const Link& link) {
  peers::Link out;
  if (!link.inertial) return out;
  const Inertial& inertial = *link.inertial;
  const Matrix3<double> R = rotation(inertial.origin);
  const Matrix3<double> I = R * full(inertial.inertia) * transpose(R);
  out.massive = 1;
  out.mass = inertial.mass;
  copy(inertial.origin.xyz, out.c);
  const double entries[] = {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)};
  std::copy(std::begin(entries), std::end(entries), out.I);
  return out;
}

}  // namespace

Described describe(const Model& model) {
  Described out;
  for (const Joint& joint : model.joints) {
    if (!known(joint.type)) return {};
    peers::Joint j;
    j.kind = kind(joint.type);
    j.parent = joint.parent;
    j.child = joint.child;
    j.q = out.nq;
    j.v = out.nv;
    out.nq += nq(joint.type);
    out.nv += nv(joint.type);
    copy(rotation(joint.origin), j.R);
    copy(joint.origin.xyz, j.p);
    copy(joint.axis, j.axis);
    if (joint.type == JointType::kPlanar) copy(axis_frame(joint.axis), j.plane);
    out.joints.push_back(j);
  }
  for (const Link& link : model.links) out.links.push_back(describe(link));
  return out;
}

peers::Body Described::body(const Model& model) const {
  peers::Body body;
  body.nq = nq;
  body.nv = nv;
  body.joints = static_cast<int>(joints.size());
  body.links = static_cast<int>(links.size());
  body.root = model.root;
  body.joint = joints.data();
  body.link = links.data();
  copy(model.gravity, body.gravity);
  return body;
}

}  // namespace arboc
