// Derivatives of what the reference engine computes: whole, and along directions of the inputs.
//
// Complex steps where the engine is analytic; differences along numbers of the model, wrenches and
// outputs that are derivatives themselves.  The second derivative is a difference of first ones.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "truth_plain.h"

namespace arboc::truth {

/// What the entries of an output are multiplied with before they are added.
struct Weight {
  std::function<Eigen::VectorXd(const Arguments<Complex>&)> at;
  bool constant = true;
};

/// Derivatives of one output at one state.
class Derivatives {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  Derivatives(const Setup& setup, std::string function, std::string output,
              const Arguments<double>& in);

  /// Of changes of an input.
  int size(const std::string& input) const {
    return input == "q" || input == "q1" ? setup_.nv : static_cast<int>(in_.at(input).size());
  }
  const Arguments<Complex>& inputs() const { return in_; }
  Vector value(const Arguments<Complex>& in) const { return evaluate(in).real(); }

  /// Of the entries of the output, along `direction` of an input.
  Vector along(const std::string& input, const Vector& direction) const {
    return along(in_, input, direction);
  }
  /// Entries of the output x size(input).
  Matrix jacobian(const std::string& input) const;

  /// Of weight^T output, along u of x, then along w of y; `symmetric`: of f(x (+) d) for both.
  double second(const std::string& x, const Vector& u, const std::string& y, const Vector& w,
                const Weight& weight, bool symmetric) const;
  /// Entry (j, k): along j of x, then along k of y.
  Matrix hessian(const std::string& x, const std::string& y, const Weight& weight,
                 bool symmetric) const;

 private:
  VectorOf<Complex> evaluate(const Arguments<Complex>& in) const;
  Vector along(const Arguments<Complex>& in, const std::string& input,
               const Vector& direction) const;
  Vector along_from(const Arguments<Complex>& in, const std::string& input,
                    const VectorOf<Complex>& from, const Vector& direction) const;
  bool analytic(const std::string& input) const;
  bool quadratic(const std::string& input) const;
  bool number(const std::string& input) const;
  double step(const std::string& input, const Vector& direction) const;

  const Setup& setup_;
  std::string function_, output_;
  Arguments<Complex> in_;
  ComplexReference at_;                   ///< for its manifold
  std::optional<Plain<Complex>> engine_;  ///< where no parameter changes it
};

}  // namespace arboc::truth
