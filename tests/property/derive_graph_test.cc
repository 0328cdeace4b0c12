// Derivatives of random graphs: against evaluation at x + i h e, whose imaginary part over h is the
// derivative without cancellation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <complex>

#include "derive/hessian.h"
#include "derive/jacobian.h"
#include "derive/reverse.h"
#include "support/random.h"
#include "support/random_graph.h"
#include "support/replay.h"

namespace arboc::test {
namespace {

constexpr int kSeeds = 100;
// Relative to the largest derivative of a graph: random graphs cancel, and amplify rounding.
constexpr double kRounding = 1e-10;
constexpr double kStep = 1e-100;

using Complex = std::complex<double>;


/// sum_i (-x)^i / (k + 2 i)!
Complex stumpff(int k, Complex x) {
  Complex term = 1.0 / std::tgamma(k + 1.0), sum = term;
  for (int i = 1; i < 30; ++i) {
    term *= -x / static_cast<double>((k + 2 * i - 1) * (k + 2 * i));
    sum += term;
  }
  return sum;
}
/// Of w > 0.
Complex log_curvature(Complex w) {
  const Complex half = std::acos(w);
  return (1.0 - w * half / std::sqrt(1.0 - w * w)) / (4.0 * half * half);
}
Complex quaternion_log(Complex w) { return 2.0 * std::acos(w) / std::sqrt(1.0 - w * w); }

std::vector<Complex> evaluate_at(const Region& region, const std::vector<Complex>& inputs) {
  std::vector<Complex> value;
  for (const Node& node : region.nodes) {
    const auto at = [&](Ref r) { return r.negative() ? -value[r.node()] : value[r.node()]; };
    switch (node.op) {
      case Op::kConstant: value.push_back(region.constants[node.index]); break;
      case Op::kInput: value.push_back(inputs[node.index]); break;
      case Op::kAdd: value.push_back(at(node.a) + at(node.b)); break;
      case Op::kMul: value.push_back(at(node.a) * at(node.b)); break;
      case Op::kDiv: value.push_back(at(node.a) / at(node.b)); break;
      case Op::kSqrt: value.push_back(std::sqrt(at(node.a))); break;
      case Op::kSin: value.push_back(std::sin(at(node.a))); break;
      case Op::kCos: value.push_back(std::cos(at(node.a))); break;
      case Op::kStumpff: value.push_back(stumpff(static_cast<int>(node.index), at(node.a))); break;
      case Op::kQuaternionLog: value.push_back(quaternion_log(at(node.a))); break;
      case Op::kLogCurvature: value.push_back(log_curvature(at(node.a))); break;
      case Op::kPack:
      case Op::kLane:
      case Op::kHsum: ADD_FAILURE() << "lanes"; break;
      case Op::kSum: ADD_FAILURE() << "fused already"; break;
    }
  }
  return value;
}

struct Problem {
  Replay graph;
  std::vector<Complex> at;
  std::vector<Coordinate> by;

  explicit Problem(std::uint64_t seed) : graph(replay(random_graph(seed))) {
    for (const auto& port : random_inputs(random_graph(seed), seed))
      for (const double x : port) at.emplace_back(x);
    by = coordinates_of(graph.builder, "x", graph.inputs);
  }
  std::vector<double> values(const std::vector<Ref>& refs) const {
    const std::vector<Complex> all = evaluate_at(graph.builder.region(), at);
    std::vector<double> out;
    for (const Ref r : refs) out.push_back((r.negative() ? -1 : 1) * all[r.node()].real());
    return out;
  }
  /// Derivatives of `refs` by input j.
  std::vector<double> steps(const std::vector<Ref>& refs, size_t j) const {
    std::vector<Complex> moved = at;
    moved[j] += Complex(0, kStep);
    const std::vector<Complex> all = evaluate_at(graph.builder.region(), moved);
    std::vector<double> out;
    for (const Ref r : refs) out.push_back((r.negative() ? -1 : 1) * all[r.node()].imag() / kStep);
    return out;
  }
  Eigen::MatrixXd steps(const std::vector<Ref>& refs) const {
    Eigen::MatrixXd out(refs.size(), by.size());
    for (size_t j = 0; j < by.size(); ++j) {
      const std::vector<double> column = steps(refs, j);
      for (size_t i = 0; i < refs.size(); ++i) out(i, j) = column[i];
    }
    return out;
  }
  Eigen::MatrixXd dense(const SparseMatrix& matrix) const {
    const std::vector<double> entries = values(matrix.value);
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(matrix.rows, matrix.cols);
    for (size_t e = 0; e < entries.size(); ++e) out(matrix.row[e], matrix.col[e]) = entries[e];
    return out;
  }
};

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

TEST(RandomGraphDerivatives, JacobianByBothDirections) {
  double worst = 0;
  for (const std::uint64_t seed : seeds(kSeeds)) {
    for (const Direction direction :
         {Direction::kForward, Direction::kReverse, Direction::kCheapest}) {
      Problem p(seed);
      const SparseMatrix J = jacobian(p.graph.builder, p.graph.outputs, p.by, direction);
      const double error = distance(p.dense(J), p.steps(p.graph.outputs));
      ASSERT_LE(error, kRounding) << "ARBOC_SEED=" << seed;
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst", fmt::format("{:.1e}", worst));
}

TEST(RandomGraphDerivatives, GradientOfAWeightedSum) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    Problem p(seed);
    WeightedSum sum{p.graph.outputs, {}};
    Eigen::RowVectorXd weights(sum.terms.size());
    for (size_t k = 0; k < sum.terms.size(); ++k) {
      weights[k] = 0.3 * static_cast<double>(k) - 1;
      sum.weights.push_back(p.graph.builder.constant(weights[k]));
    }
    const std::vector<double> g = p.values(gradient(p.graph.builder, sum, p.by));
    const Eigen::RowVectorXd expected = weights * p.steps(sum.terms);
    ASSERT_LE(distance(Eigen::Map<const Eigen::RowVectorXd>(g.data(), expected.size()), expected),
              kRounding)
        << "ARBOC_SEED=" << seed;
  }
}

TEST(RandomGraphDerivatives, HessianIsThatOfTheGradientAndSymmetric) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    Problem p(seed);
    Builder& builder = p.graph.builder;
    const WeightedSum sum{{p.graph.outputs[0], p.graph.outputs[1]},
                          {builder.constant(1), builder.constant(-2)}};
    const std::vector<Ref> g = gradient(builder, sum, p.by);
    const Eigen::MatrixXd H = p.dense(iterated_hessian(builder, sum, p.by));
    const double scale = 1 + H.cwiseAbs().maxCoeff();
    ASSERT_LE(distance(H, p.steps(g)), kRounding) << "ARBOC_SEED=" << seed;
    ASSERT_LE((H - H.transpose()).cwiseAbs().maxCoeff(), kRounding * scale);
    const std::vector<CoordinateBlock> blocks{{p.by.begin(), p.by.begin() + 2},
                                              {p.by.begin() + 2, p.by.end()}};
    const auto parts = hessian(builder, sum, blocks, {{0, 0}, {0, 1}, {1, 1}});
    const Eigen::MatrixXd upper = H.triangularView<Eigen::Upper>();
    const Eigen::Index n = H.cols();
    ASSERT_LE(distance(p.dense(parts[0]), upper.topLeftCorner(2, 2)), kRounding * scale);
    ASSERT_LE(distance(p.dense(parts[1]), upper.topRightCorner(2, n - 2)), kRounding * scale);
    ASSERT_LE(distance(p.dense(parts[2]), upper.bottomRightCorner(n - 2, n - 2)),
              kRounding * scale);
  }
}

}  // namespace
}  // namespace arboc::test
