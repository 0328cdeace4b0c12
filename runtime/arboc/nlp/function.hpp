// A vector function with exact sparse derivatives: what problems are made of.
//
// Generated code becomes one by generated.hpp; anything else by deriving from Function.  A function
// is evaluated at n points in one call, so that an implementation may use lanes and threads: a
// motion has as many points as instants, a posture one.
#ifndef ARBOC_NLP_FUNCTION_HPP
#define ARBOC_NLP_FUNCTION_HPP

#include "nlp.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

/// y (outputs) of x (inputs).  Calls may use memory of the object: one thread at a time.
class Function {
 public:
  virtual ~Function() = default;

  virtual int inputs() const = 0;
  virtual int outputs() const = 0;
  virtual const Pattern& jacobian_pattern() const = 0;  ///< outputs x inputs
  virtual const Pattern& hessian_pattern() const = 0;   ///< inputs x inputs, lower triangle

  /// Of n points, one a row, into n rows of `outputs`, of entries of the Jacobian, and of entries
  /// of the Hessian of weights^T y; a row of weights a point.
  virtual void values(int n, const double* x, double* y) = 0;
  virtual void jacobian(int n, const double* x, double* entries) = 0;
  virtual void hessian(int n, const double* x, const double* weights, double* entries) = 0;

  /// Points of one call may be shared out among so many threads.
  virtual void use_threads(int count) { static_cast<void>(count); }
};

/// A smooth scalar function of few arguments, applied to outputs of functions and to variables.
class Scalar {
 public:
  virtual ~Scalar() = default;

  virtual int arguments() const = 0;
  virtual double value(const double* z) const = 0;
  /// g (arguments); H (arguments x arguments, by rows, both triangles), all entries are written.
  virtual void derivatives(const double* z, double* g, double* H) const = 0;
  /// Can H(i, j) be other than zero?
  virtual bool curved(int i, int j) const {
    static_cast<void>(i), static_cast<void>(j);
    return true;
  }
};

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_FUNCTION_HPP
