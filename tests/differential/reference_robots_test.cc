// The reference engine against independent libraries, on the project's own models and on public
// robots, with fixed and with floating base.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "differential/peer.h"
#include "frontend/urdf.h"
#include "reference/reference.h"
#include "support/oracle.h"
#include "support/random_state.h"

namespace arboc::test {
namespace {

std::vector<std::string> robot_files() {
  std::vector<std::string> result;
  const std::filesystem::path models = ARBOC_SOURCE_DIR "/models";
  if (std::filesystem::exists(models))
    for (const auto& entry : std::filesystem::recursive_directory_iterator(models))
      if (entry.path().extension() == ".urdf") result.push_back(entry.path());
  for (const OracleRobot& robot : oracle_robots())
    if (std::filesystem::exists(oracle_urdf(robot))) result.push_back(oracle_urdf(robot));
  std::sort(result.begin(), result.end());
  return result;
}

/// Largest difference relative to the largest entry of `expected`.
double error(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected) {
  if (expected.size() == 0) return 0;
  return (actual - expected).cwiseAbs().maxCoeff() / std::max(1e-3, expected.cwiseAbs().maxCoeff());
}

void compare(const PeerKind& peer, const Model& model) {
  const std::unique_ptr<Peer> other = Peer::make(model, peer.make);
  if (!other) return;
  const Reference reference(model);
  for (const std::uint64_t seed : seeds(3)) {
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed));
    Random random(seed);
    const State x = random_state(model, random);
    EXPECT_LE(error(other->rnea(x.q, x.v, x.a), reference.rnea(x.q, x.v, x.a)), peer.tolerance);
    EXPECT_LE(error(other->crba(x.q), reference.crba(x.q)), peer.tolerance);
  }
}

class ReferenceRobots : public testing::TestWithParam<PeerKind> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ReferenceRobots);

TEST_P(ReferenceRobots, Agree) {
  const std::vector<std::string> files = robot_files();
  if (files.empty()) GTEST_SKIP() << "no robots";
  for (const std::string& file : files) {
    Diagnostics diagnostics;
    const Model as_read = read_urdf(file, diagnostics);
    for (const Base base : {Base::kFixed, Base::kFloating}) {
      SCOPED_TRACE(file + (base == Base::kFixed ? ", fixed" : ", floating") + "; " +
                   GetParam().reason);
      ModelOptions options;
      options.base = base;
      compare(GetParam(), configure(as_read, options, diagnostics));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Peers, ReferenceRobots, testing::ValuesIn(peer_kinds()),
                         [](const auto& peer) { return std::string(peer.param.name); });

}  // namespace
}  // namespace arboc::test
