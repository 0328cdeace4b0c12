#include "differential/proof_measure.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/diagnostic.h"
#include "differential/proof_differences.h"
#include "differential/proof_identities.h"
#include "state_source.h"
#include "truth.h"

namespace arboc::test {
namespace {

/// Solving with M amplifies rounding by its condition, seen up to 2e-16 times it.
double amplification(const Row& row, const Reference& reference, const Values& in) {
  // Twice where it is differentiated twice.
  const double power = row.order() > 1 ? 2 : 1;
  if (!row.request.function.starts_with("aba") && row.request.function != "minv") return 1;
  const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(
                                   reference.crba(as_vector(in.at("q"))), Eigen::EigenvaluesOnly)
                                   .eigenvalues();
  return std::pow(std::max(1.0, eigenvalues.maxCoeff() / eigenvalues.minCoeff() / 1e3), power);
}

/// Rounding of some hundred operations; of derivatives, of larger terms that cancel; or what the
/// reference's own differences are good for.
double allowed(const Row& row) {
  const bool by_differences = row.request.derivative != Derivative::kNone &&
                              (row.variation.loads || !row.variation.parameters.empty());
  const bool of_derivative = row.request.derivative != Derivative::kNone &&
                             row.request.function.ends_with("_derivatives");
  if (row.order() > 1) return by_differences || of_derivative ? 1e-6 : 1e-8;
  // The reference's steps of 1e-3 are long beside the inertia of a light link.
  if (by_differences) return row.request.function == "aba" ? 1e-6 : 1e-8;
  return row.order() == 1 ? 1e-11 : 1e-12;
}
constexpr double kIdentities = 1e-10;
constexpr double kDifferences = 1e-6;

class Cell {
 public:
  explicit Cell(const Row& row) : row_(row) {}

  void add_model(const Model& model, std::uint64_t seed, int states) {
    ProofEngine f(proof_setup(model, row_.variation), seed);
    const Reference reference(model);
    StateSource source(seed);
    const Signature s = signature(row_.request, f.setup());
    for (int k = 0; k < states; ++k) {
      Values in = source.inputs(f.setup());
      in["lambda"] = source.vector(f.setup().nv);
      // Less than half a turn away, where the shortest way jumps.
      const VectorXd way = as_vector(source.vector(f.setup().nv, 1.5));
      in["q1"] = as_list(reference.integrate(as_vector(in.at("q")), way));
      for (const Argument& a : s.inputs)
        if (a.name == "lambda") in["lambda"] = source.vector(a.rows);
      add_state(f, reference, in, source);
    }
  }
  Measured take() && { return std::move(result_); }

 private:
  void add_state(ProofEngine& f, const Reference& reference, const Values& in,
                 StateSource& source) {
    const Values got = f(row_.request, in);
    const double amplified = amplification(row_, reference, in);
    const Values expected = evaluate_reference(row_.request, f.setup(), in);
    for (const auto& [name, entries] : got)
      add(result_.reference, apart(as_vector(entries), as_vector(expected.at(name))),
          allowed(row_) * amplified, name + " against the reference");
    if (const auto error = difference_error(f, row_.request, reference, in, got, source))
      add(result_.differences, *error, kDifferences * amplified, "differences");
    if (row_.request.derivative == Derivative::kNone)
      for (const auto& all : {dynamics_identities(), kinematics_identities()})
        for (const Identity& identity : all) add_identity({f, reference, in}, identity, amplified);
  }

  void add_identity(const Case& c, const Identity& identity, double amplified) {
    if (identity.function != row_.request.function) return;
    const auto error = identity.error(c);
    if (!error) return;
    add(result_.identity, *error, kIdentities * amplified, identity.text);
    auto& texts = result_.identities;
    if (std::find(texts.begin(), texts.end(), identity.text) == texts.end())
      texts.emplace_back(identity.text);
  }

  void add(std::optional<double>& worst, double error, double limit, const std::string& what) {
    worst = std::max(worst.value_or(0), error);
    if (!(error <= limit)) result_.wrong.push_back(fmt::format("{}: {:.1e}", what, error));
  }

  const Row& row_;
  Measured result_;
};

}  // namespace

std::optional<double> Measured::exact() const {
  if (!reference || !identity) return reference ? reference : identity;
  return std::max(*reference, *identity);
}

Measured measure(const Row& row, const Kind& kind, Base base) {
  Cell cell(row);
  try {
    if (row.order() > 1) {
      const std::uint64_t seed = base == Base::kFixed ? 2 : 3;
      cell.add_model(proof_model(kind, base, seed), seed, 1);
    } else {
      for (std::uint64_t seed = 1; seed <= 3; ++seed)
        cell.add_model(proof_model(kind, base, seed), seed, 2);
    }
  } catch (const UsageError& refusal) {
    if (std::string(refusal.what()).find("is a derivative itself") == std::string::npos) throw;
    Measured none;
    none.gap = "refused: the derivative of a function that is a derivative itself";
    return none;
  } catch (const InputError&) {
    Measured none;
    none.gap = "refused: the inertia is singular";
    return none;
  }
  return std::move(cell).take();
}

}  // namespace arboc::test
