// What must hold between the generated functions themselves, whatever the reference engine says.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "differential/proof_engine.h"

namespace arboc::test {

struct Case {
  ProofEngine& f;
  const Reference& reference;  ///< without joint forces
  const Values& in;

  int nv() const { return f.setup().nv; }
  VectorXd input(const char* name) const { return as_vector(in.at(name)); }
  /// Of a function of the catalogue.
  VectorXd vector(const char* function, const char* output) const {
    return vector(function, output, in);
  }
  VectorXd vector(const char* function, const char* output, const Values& at) const {
    return as_vector(f({function}, at).at(output));
  }
  MatrixXd matrix(const char* function, const char* output, Eigen::Index rows,
                  const Values& at) const {
    return as_matrix(f({function}, at).at(output), rows);
  }
  MatrixXd square(const char* function, const char* output) const {
    return matrix(function, output, nv(), in);
  }
  /// `rnea.tau:q`, all outputs.
  Values derivative(Derivative kind, const char* of) const {
    return f(parse_request("proof", kind, of), in);
  }
  Values with(const char* name, const VectorXd& x) const {
    Values changed = in;
    changed[name] = as_list(x);
    return changed;
  }
};

struct Identity {
  const char* function;
  const char* text;
  /// Nothing where it says nothing about this body or these options.
  std::optional<double> (*error)(const Case&);
};

std::vector<Identity> dynamics_identities();
std::vector<Identity> kinematics_identities();

}  // namespace arboc::test
