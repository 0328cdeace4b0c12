// Sums of variables and outputs of functions with constant coefficients: 2 * x - y + 1.
#ifndef ARBOC_NLP_AFFINE_HPP
#define ARBOC_NLP_AFFINE_HPP

#include <vector>

namespace arboc {
inline namespace v1 {
namespace nlp {

/// A variable, or an output of a function that the problem evaluates somewhere.
struct Quantity {
  int evaluation = -1;  ///< -1: a variable
  int index = 0;        ///< of the variable, or of the output
};

struct Affine {
  struct Term {
    Quantity of;
    double coefficient;
  };

  double constant = 0;
  std::vector<Term> terms{};

  Affine() = default;
  // NOLINTBEGIN(google-explicit-constructor): a number or a variable is one.
  Affine(double c) : constant(c) {}
  Affine(Quantity q) : terms{{q, 1}} {}
  // NOLINTEND(google-explicit-constructor)

  Affine& operator+=(const Affine& b) {
    constant += b.constant;
    terms.insert(terms.end(), b.terms.begin(), b.terms.end());
    return *this;
  }
  Affine& operator*=(double s) {
    constant *= s;
    for (Term& term : terms) term.coefficient *= s;
    return *this;
  }
};

inline Affine operator+(Affine a, const Affine& b) { return a += b; }
inline Affine operator*(double s, Affine a) { return a *= s; }
inline Affine operator-(const Affine& a) { return -1 * a; }
inline Affine operator-(Affine a, const Affine& b) { return a += -b; }

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_AFFINE_HPP
