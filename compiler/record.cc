#include "record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "reference/reference.h"
#include "state_source.h"
#include "truth.h"

namespace arboc {
namespace {

constexpr int kStates = 4;

std::vector<double> values(const Eigen::VectorXd& x) { return {x.data(), x.data() + x.size()}; }

Eigen::VectorXd vector(const Values& inputs, const char* name) {
  const auto& x = inputs.at(name);
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// Twelve digits: what differs between machines in the last bits must not reach generated files.
std::vector<double> rounded(std::vector<double> values) {
  for (double& x : values) x = parse_finite(fmt::format("{:.12g}", x)).value_or(x) + 0.0;
  return values;
}

double largest_entry(const std::vector<double>& values) {
  double largest = 0;
  for (const double x : values) largest = std::max(largest, std::fabs(x));
  return largest;
}

/// Results known to `tolerance` of the largest entry to a tenth of that: differences leave noise
/// also where there is nothing.
std::vector<double> rounded(std::vector<double> values, double tolerance, double largest) {
  if (tolerance <= Argument().tolerance) return rounded(std::move(values));
  int decimals = 0;
  for (double unit = 10; unit > tolerance * largest && decimals < 30; unit /= 10) ++decimals;
  for (double& x : values) x = parse_finite(fmt::format("{:.{}f}", x, decimals)).value_or(x) + 0.0;
  return rounded(std::move(values));
}

/// All outputs of all states are too many numbers: projections of them are recorded.
bool large(const Signature& s) {
  constexpr long kMost = 2000;
  long entries = 0;
  for (const Argument& a : s.outputs) entries += long{a.rows} * a.cols;
  return entries * kStates > kMost;
}

/// The results of one function at one state, under its name and theirs.
void record(const CompiledFunction& f, const Setup& setup, const Values& inputs,
            Recording& recording) {
  const bool projected = large(f.signature);
  Values results =
      (projected ? evaluate_projections : evaluate_reference)(f.request, setup, inputs);
  double largest = 0;
  for (const auto& [name, result] : results) largest = std::max(largest, largest_entry(result));
  for (const Argument& output : f.signature.outputs) {
    std::vector<double>& y = results[output.name];
    if (!std::all_of(y.begin(), y.end(), [](double x) { return std::isfinite(x); }))
      throw InputError(fmt::format(
          "{}: error: {}: its values at ordinary states are not finite (check the units: m, kg, "
          "kg m^2)",
          printable(setup.model.file), f.signature.name));
    const bool all = output.tolerance == kDifferencedTwice;
    (projected ? recording.projections : recording.values)[f.signature.name + "." + output.name] =
        rounded(y, output.tolerance, all ? largest : largest_entry(y));
  }
}

}  // namespace

void record(const Setup& setup, const std::vector<CompiledFunction>& functions,
            TargetModel& target) {
  const Reference reference(setup.model);
  StateSource source(1), weights(2);
  for (int s = 0; s < kStates; ++s) {
    Recording recording;
    Values& v = recording.values;
    v = source.inputs(setup);
    const Eigen::VectorXd q = vector(v, "q"), rate = vector(v, "v"), a = vector(v, "a");
    const Eigen::VectorXd curve = 0.5 * target.step * target.step * a;
    v["q-"] = rounded(values(reference.integrate(q, -target.step * rate + curve)));
    v["q+"] = rounded(values(reference.integrate(q, target.step * rate + curve)));
    Values inputs = v;
    for (const CompiledFunction& f : functions) {
      for (const Argument& input : f.signature.inputs)
        if (input.name == "lambda")
          v[f.signature.name + ".lambda"] = inputs["lambda"] = weights.vector(input.rows);
      record(f, setup, inputs, recording);
    }
    target.recordings.push_back(std::move(recording));
  }
}

}  // namespace arboc
