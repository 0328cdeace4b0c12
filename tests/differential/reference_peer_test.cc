// The reference engine against independent libraries, on random models of every joint type.
#include <gtest/gtest.h>

#include "differential/peer.h"
#include "reference/reference.h"
#include "support/random_model.h"
#include "support/random_state.h"

namespace arboc::test {
namespace {

class ReferencePeer : public testing::TestWithParam<PeerKind> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ReferencePeer);

void expect_close(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected,
                  const PeerKind& peer) {
  ASSERT_EQ(actual.rows(), expected.rows());
  if (expected.size() == 0) return;
  const double largest = std::max(1.0, expected.cwiseAbs().maxCoeff());
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff() / largest, peer.tolerance) << peer.reason;
}

/// The number of models that the peer supports.
int compare_on_random_models(const PeerKind& peer, const RandomModelOptions& options) {
  int compared = 0;
  for (const std::uint64_t seed : seeds(30)) {
    const Model model = random_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
    const std::unique_ptr<Peer> other = Peer::make(model, peer.make);
    if (!other) continue;
    ++compared;
    const Reference reference(model);
    Random random(seed);
    for (int k = 0; k < 2; ++k) {
      const State x = random_state(model, random);
      expect_close(other->rnea(x.q, x.v, x.a), reference.rnea(x.q, x.v, x.a), peer);
      expect_close(other->crba(x.q), reference.crba(x.q), peer);
      if (!options.massless && other->has_aba()) {
        const Eigen::VectorXd a = other->aba(x.q, x.v, x.tau);
        expect_close(reference.rnea(x.q, x.v, a), x.tau, peer);
      }
    }
    if (testing::Test::HasFailure()) break;
  }
  return compared;
}

TEST_P(ReferencePeer, AgreesOnFixedBase) { EXPECT_GT(compare_on_random_models(GetParam(), {}), 0); }

TEST_P(ReferencePeer, AgreesOnFloatingBase) {
  RandomModelOptions options;
  options.base = Base::kFloating;
  EXPECT_GT(compare_on_random_models(GetParam(), options), 0);
}

TEST_P(ReferencePeer, AgreesOnMassiveLinksWithoutFollowers) {
  RandomModelOptions options;
  options.massless = options.mimic = false;
  EXPECT_GT(compare_on_random_models(GetParam(), options), 0);
  options.base = Base::kFloating;
  EXPECT_GT(compare_on_random_models(GetParam(), options), 0);
}

INSTANTIATE_TEST_SUITE_P(Peers, ReferencePeer, testing::ValuesIn(peer_kinds()),
                         [](const auto& peer) { return std::string(peer.param.name); });

}  // namespace
}  // namespace arboc::test
