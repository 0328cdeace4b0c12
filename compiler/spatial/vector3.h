// Three-dimensional vectors and matrices on any scalar T: double, or the traced Expr.
//
// C++17, no dependency: these headers are also compiled into the program that times generated
// against generic dynamics.  Nothing here branches on a value of T.
#pragma once

/// gcc at -O2 calls some of these functions; vectors then pass through memory, written as three
/// numbers and read back as a pair and one, and each time the processor waits for the store.
#define ARBOC_INLINE inline __attribute__((always_inline))
/// What most bodies do not have stays out of the way of what all have.
#define ARBOC_COLD __attribute__((noinline, cold))

namespace arboc {

template <class T>
struct Vector3 {
  T x{}, y{}, z{};

  T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  const T& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};

template <class T>
Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Vector3<T> operator-(const Vector3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T, class S>
Vector3<T> operator*(const S& s, const Vector3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
Vector3<T>& operator+=(Vector3<T>& a, const Vector3<T>& b) {
  return a = a + b;
}
template <class T, class S>
auto dot(const Vector3<T>& a, const Vector3<S>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// a x b.
template <class T, class S>
auto cross(const Vector3<T>& a, const Vector3<S>& b) -> Vector3<decltype(a.x * b.x)> {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The same vector on another scalar (constants of the model enter the algorithms this way).
template <class T, class S>
Vector3<T> cast(const Vector3<S>& a) {
  return {T(a.x), T(a.y), T(a.z)};
}

}  // namespace arboc
