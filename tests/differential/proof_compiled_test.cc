// The proof of compiled code: every function and some derivatives of one body with every type of
// joint, generated, compiled by the C++ compiler and called.
#include <gtest/gtest.h>

#include "differential/proof_engine.h"
#include "differential/proof_rows.h"
#include "differential/proof_table.h"
#include "support/engines.h"

namespace arboc::test {
namespace {

std::vector<Request> compiled_requests() {
  std::vector<Request> requests;
  for (const Row& row : function_rows()) requests.push_back(row.request);
  requests.push_back(parse_request("proof", Derivative::kJacobian, "com.c:q"));
  requests.push_back(parse_request("proof", Derivative::kGradient, "rnea.tau^2:q,a"));
  requests.push_back(parse_request("proof", Derivative::kVjp, "aba.qdd:v,tau"));
  requests.push_back(parse_request("proof", Derivative::kHessian, "energy.V:q"));
  return requests;
}

Compilation compilation_of(Setup setup, const std::vector<Request>& requests) {
  Compilation all{std::move(setup), {}};
  for (const Request& request : requests)
    all.functions.push_back(compile_function(request, all.setup));
  return all;
}

/// Errors of the requests, in their order.
std::vector<double> errors(Base base, const Variation& variation, const char* flags) {
  const std::vector<Request> requests = compiled_requests();
  const Compilation all =
      compilation_of(proof_setup(proof_model(mixed(), base, 1), variation), requests);
  cli::Common common;
  common.cxxflags = flags;
  CompileOptions options;
  options.requests = requests;
  const cli::GeneratedCode code(common, target(all, options));
  StateSource source(7);
  Values in = source.inputs(all.setup);
  in["lambda"] = source.vector(all.setup.nv);
  std::vector<double> errors;
  for (const Request& request : requests) {
    const Values expected = evaluate_reference(request, all.setup, in);
    int status = -1;
    const Values got = code.call(name(request), in, &status);
    EXPECT_EQ(status, 0) << text(request);
    double& error = errors.emplace_back(0);
    for (const auto& [output, entries] : got)
      error = std::max(error, apart(as_vector(entries), as_vector(expected.at(output))));
    EXPECT_LE(error, 1e-9) << text(request);
  }
  return errors;
}

TEST(Proof, Compiled) {
  Variation forces{"all forces"};
  forces.loads = forces.joint_forces = true;
  const std::vector<double> fixed = errors(Base::kFixed, {}, "-std=c++17 -O0");
  const std::vector<double> floating = errors(Base::kFloating, forces, "-std=c++17 -O0");
  CoverageTable table{"compiled", {"function", "fixed base", "floating base, all forces"}, {}, {}};
  const std::vector<Request> requests = compiled_requests();
  for (size_t k = 0; k < requests.size(); ++k)
    table.rows.push_back({{text(requests[k])}, {{{fixed[k]}, ""}, {{floating[k]}, ""}}});
  expect_committed(table);
}

}  // namespace
}  // namespace arboc::test
