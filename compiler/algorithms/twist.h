// Twists: pairs of a linear and an angular vector, and those of joints.
#pragma once
#include "algorithms/joint.h"
#include "algorithms/wrench.h"

namespace arboc {

template <class T>
struct Twist {
  Vector3<T> linear;
  Vector3<T> angular;
};

template <class T>
Twist<T> zero_twist() {
  return {{T(0), T(0), T(0)}, {T(0), T(0), T(0)}};
}
template <class T>
Twist<T>& operator+=(Twist<T>& a, const Twist<T>& b) {
  a.linear += b.linear;
  a.angular += b.angular;
  return a;
}
template <class T, class S>
Twist<T> operator*(const S& s, const Twist<T>& a) {
  return {s * a.linear, s * a.angular};
}
/// How b changes in time if it is fixed to what moves with a, both about one point:
/// a.angular x b.linear + a.linear x b.angular,  a.angular x b.angular.
template <class T>
Twist<T> cross(const Twist<T>& a, const Twist<T>& b) {
  return {cross(a.angular, b.linear) + cross(a.linear, b.angular), cross(a.angular, b.angular)};
}

/// What the joint adds to the velocity (from v) or acceleration (from a) of its body, about the
/// body's origin and along its axes.
template <class B, class T>
Twist<T> joint_twist(const B& body, const T* v) {
  Twist<T> twist = zero_twist<T>();
  for (int d = 0; d < freedoms(body.motion); ++d) {
    const int c = component(body.motion, d);
    Vector3<T>& part = c < 3 ? twist.linear : twist.angular;
    part[c % 3] = rate(body, v, d);
  }
  return twist;
}

/// The twist that a joint's axis `c` of (linear, angular) makes: `axis` is its direction, `arm`
/// leads from the body's origin to the point that the twist is about.
template <class T>
Twist<T> unit_twist(int c, const Vector3<T>& axis, const Vector3<T>& arm) {
  const Vector3<T> zero{T(0), T(0), T(0)};
  return c < 3 ? Twist<T>{axis, zero} : Twist<T>{cross(axis, arm), axis};
}

/// Adds a multiple of six numbers to a column of a row-major matrix with n columns.
template <class T, class S>
void add_column(const S& factor, const Twist<T>& twist, T* column, int n) {
  for (int i = 0; i < 3; ++i) {
    column[i * n] = column[i * n] + factor * twist.linear[i];
    column[(3 + i) * n] = column[(3 + i) * n] + factor * twist.angular[i];
  }
}

template <class T>
void write_twist(const Twist<T>& twist, T* out) {
  for (int i = 0; i < 3; ++i) {
    out[i] = twist.linear[i];
    out[3 + i] = twist.angular[i];
  }
}

template <class T>
void fill_zero(T* values, int n) {
  for (int i = 0; i < n; ++i) values[i] = T(0);
}

}  // namespace arboc
