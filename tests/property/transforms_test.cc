// Transforms and their derivatives: what [Thesis] chapter 2 makes of them, against the functions of
// frames, complex steps, and the structure of chains.
#include <gtest/gtest.h>

#include <array>

#include "functions/trace.h"
#include "reference/differentiate.h"
#include "reference/transforms.h"
#include "support/each_model.h"
#include "support/engines.h"

namespace arboc::test {
namespace {

using Eigen::Matrix4d;
using Eigen::MatrixXd;
using Eigen::Vector4d;
using Eigen::VectorXd;
using Moving = arboc::State;

Setup setup_of(const Model& model, int order) {
  FunctionOptions options;
  options.axes = Axes::kAligned;
  options.transform_order = order;
  return resolve(model, options);
}

Values inputs(const Moving& s) {
  const auto list = [](const VectorXd& x) { return std::vector<double>(x.begin(), x.end()); };
  return {{"q", list(s.q)}, {"v", list(s.v)}, {"a", list(s.a)}};
}

/// Blocks of one frame, whatever the order of their indices.
class Blocks {
 public:
  Blocks(const Setup& setup, const Values& out, int frame) : frame_(frame) {
    const auto rows = static_cast<Eigen::Index>(4 * setup.frames.size());
    for (const char* name : {"T", "dT", "d2T", "d3T"})
      if (out.count(name) != 0) all_.push_back(matrix_of(out.at(name), rows));
  }
  Matrix4d T() const { return block(0, 0); }
  Matrix4d d(int k) const { return block(1, k); }
  Matrix4d d(int j, int k) const {
    if (j > k) std::swap(j, k);
    return block(2, k * (k + 1) / 2 + j);
  }
  Matrix4d d(int j, int k, int l) const {
    std::array at{j, k, l};
    std::sort(at.begin(), at.end());
    return block(3, at[2] * (at[2] + 1) * (at[2] + 2) / 6 + at[1] * (at[1] + 1) / 2 + at[0]);
  }

 private:
  Matrix4d block(size_t order, int at) const { return all_[order].block<4, 4>(4 * frame_, 4 * at); }
  int frame_;
  std::vector<MatrixXd> all_;
};

/// Six rows of a frame.
template <class M>
MatrixXd rows_of(const M& all, int frame) {
  return all.middleRows(6 * frame, 6);
}

/// (2.15)-(2.26) at the frame's origin, r = (0, 0, 0, 1), by sums over coordinates as printed.
void expect_equations(const Setup& setup, const Moving& s) {
  const LoweringOptions lowering = lowerings("fk")[0];
  const Values in = inputs(s), out = evaluate_generic({"transforms"}, setup, lowering, in);
  const auto get = [&](const char* f) { return evaluate_generic({f}, setup, lowering, in); };
  const Values velocity = get("frame_velocity"), by_v = get("frame_velocity_derivatives");
  const Values acceleration = get("frame_acceleration");
  const Values by_a = get("frame_acceleration_derivatives");
  const auto frames = static_cast<int>(setup.frames.size());
  const auto of = [&](const Values& x, const char* name) {
    return matrix_of(x.at(name), 6 * frames);
  };
  const int n = setup.nv;
  const VectorXd &v = s.v, &a = s.a;
  for (int f = 0; f < frames; ++f) {
    const Blocks T(setup, out, f);
    const Vector4d r(0, 0, 0, 1);
    Vector4d vel = Vector4d::Zero(), acc = Vector4d::Zero();
    for (int j = 0; j < n; ++j) {
      vel += T.d(j) * r * v[j];                                // (2.20)
      acc += T.d(j) * r * a[j] + T.d(j, j) * r * v[j] * v[j];  // (2.23)
      for (int k = j + 1; k < n; ++k) acc += 2 * (T.d(j, k) * r * v[j] * v[k]);
    }
    const auto linear = [&](const MatrixXd& x) { return MatrixXd(rows_of(x, f).topRows(3)); };
    EXPECT_LE(distance(linear(of(velocity, "velocity")), vel.head<3>()), 1e-12);
    EXPECT_LE(distance(linear(of(acceleration, "acceleration")), acc.head<3>()), 1e-12);
    MatrixXd dv_dq(4, n), dv_dv(4, n), da_dq(4, n), da_dv(4, n);
    for (int m = 0; m < n; ++m) {
      dv_dv.col(m) = T.d(m) * r;  // (2.16), (2.22), (2.26)
      dv_dq.col(m).setZero();
      da_dq.col(m).setZero();
      for (int j = 0; j < n; ++j) {
        dv_dq.col(m) += T.d(j, m) * r * v[j];  // (2.21)
        da_dq.col(m) += T.d(j, m) * r * a[j];  // (2.24)
        for (int k = 0; k < n; ++k) da_dq.col(m) += T.d(j, k, m) * r * v[j] * v[k];
      }
      da_dv.col(m) = 2 * dv_dq.col(m);  // (2.25)
    }
    EXPECT_LE(distance(linear(of(by_v, "dvelocity_dv")), dv_dv.topRows(3)), 1e-12);
    EXPECT_LE(distance(linear(of(by_v, "dvelocity_dq")), dv_dq.topRows(3)), 1e-12);
    EXPECT_LE(distance(linear(of(by_a, "dacceleration_da")), dv_dv.topRows(3)), 1e-12);
    EXPECT_LE(distance(linear(of(by_a, "dacceleration_dv")), da_dv.topRows(3)), 1e-12);
    EXPECT_LE(distance(linear(of(by_a, "dacceleration_dq")), da_dq.topRows(3)), 1e-12);
  }
}

ModelOptions expanded() {
  ModelOptions options;
  options.expand = true;
  return options;
}

TEST(Transforms, AreWhatPointsVelocitiesAndAccelerationsAreMadeOf) {
  for (const char* name : {"ur5", "arm7", "all_joints"}) {
    SCOPED_TRACE(name);
    const Model model = own_model(name, expanded());
    Random random(4);
    for (int n = 0; n < 3; ++n) {
      const State s = random_state(model, random);
      expect_equations(setup_of(model, 3), {s.q, s.v, s.a, s.tau});
    }
  }
}

/// Each order by complex steps of the one below, where joints have one coordinate.
TEST(Transforms, AreDerivativesOfOneAnother) {
  for (const char* name : {"arm7", "all_joints"}) {
    const Model model = own_model(name, expanded());
    const auto setup = setup_of(model, 3);
    const ComplexReference complex(model);
    Random random(6);
    const State s = random_state(model, random);
    const Moving at{s.q, s.v, s.a, s.tau};
    const Values out = evaluate_generic({"transforms"}, setup, lowerings("fk")[0], inputs(at));
    for (int f = 0; f < static_cast<int>(setup.frames.size()); ++f) {
      const Blocks T(setup, out, f);
      for (int l = 0; l < setup.nv; ++l) {
        const VectorOf<Complex> q =
            complex.integrate(s.q.cast<Complex>(), VectorOf<Complex>::Unit(setup.nv, l) *
                                                       Complex(0, complex_step::kStep));
        const TransformsOf<Complex> moved(complex, q, setup.frames[static_cast<size_t>(f)]);
        const auto slope = [&](const std::vector<int>& along) {
          return Matrix4d(moved.derivative(along).imag() / complex_step::kStep);
        };
        EXPECT_LE(distance(T.d(l), slope({})), 1e-12);
        for (int k = 0; k < setup.nv; ++k) {
          EXPECT_LE(distance(T.d(k, l), slope({k})), 1e-12);
          for (int j = 0; j <= k; ++j) EXPECT_LE(distance(T.d(j, k, l), slope({j, k})), 1e-12);
        }
      }
    }
  }
}

/// One hand of the human, moved by 27 coordinates: third derivatives along all of them and one.
TEST(Transforms, OfAHandAreDerivativesOfOneAnother) {
  const Model model = own_model("santos");
  FunctionOptions options;
  options.frames = {"z21"};
  options.transform_order = 3;
  const auto setup = resolve(model, options);
  const ComplexReference complex(model);
  Random random(8);
  const State s = random_state(model, random);
  const Values out =
      evaluate_generic({"transforms"}, setup, lowerings("fk")[0], inputs({s.q, s.v, s.a, s.tau}));
  const Blocks T(setup, out, 0);
  const VectorOf<Complex> step = VectorOf<Complex>::Unit(setup.nv, 7) * Complex(0, 1e-30);
  const TransformsOf<Complex> moved(complex, complex.integrate(s.q.cast<Complex>(), step),
                                    setup.frames[0]);
  EXPECT_EQ(moved.coordinates().size(), 27u);
  for (int k = 0; k < setup.nv; ++k)
    for (int j = 0; j <= k; ++j)
      EXPECT_LE(distance(T.d(j, k, 7), Matrix4d(moved.derivative({j, k}).imag() / 1e-30)), 1e-12);
}

/// T(q (+) t d) = T + t dT d + t^2/2 d2T d d + t^3/6 d3T d d d + ..., also where joints turn
/// freely.
TEST(Transforms, AreTheTaylorSeriesAlongTheExponential) {
  int compared = 0;
  for_each_model(20, [&](const Model& model, const Reference& r, const Moving& s) {
    const auto setup = setup_of(model, 3);
    if (setup.nv > 16) return;
    ++compared;
    const Values out = evaluate_generic({"transforms"}, setup, lowerings("fk")[0], inputs(s));
    const VectorXd d = s.v / 2;
    const double h = 2e-2;
    for (int f = 0; f < static_cast<int>(setup.frames.size()); ++f) {
      const Blocks T(setup, out, f);
      Matrix4d one = Matrix4d::Zero(), two = one, three = one;
      for (int j = 0; j < setup.nv; ++j) {
        one += T.d(j) * d[j];
        for (int k = 0; k < setup.nv; ++k) {
          two += T.d(j, k) * d[j] * d[k];
          for (int l = 0; l < setup.nv; ++l) three += T.d(j, k, l) * d[j] * d[k] * d[l];
        }
      }
      const auto at = [&](int m) -> Matrix4d {
        return TransformsOf<double>(r, r.integrate(s.q, m * h * d),
                                    setup.frames[static_cast<size_t>(f)])
            .T();
      };
      const auto odd = [&](int m) -> Matrix4d { return at(m) - at(-m); };
      const auto even = [&](int m) -> Matrix4d { return at(m) + at(-m); };
      // Central stencils of nine points: errors of h^8 and h^6 times further derivatives.
      EXPECT_LE(distance(one, (672 * odd(1) - 168 * odd(2) + 32 * odd(3) - 3 * odd(4)) / (840 * h)),
                1e-9);
      EXPECT_LE(distance(two, (8064 * even(1) - 1008 * even(2) + 128 * even(3) - 9 * even(4) -
                               14350 * at(0)) /
                                  (5040 * h * h)),
                1e-8);
      EXPECT_LE(distance(three, (-488 * odd(1) + 338 * odd(2) - 72 * odd(3) + 7 * odd(4)) /
                                    (240 * h * h * h)),
                1e-6);
    }
  });
  EXPECT_GE(compared, 8);
}

/// Zeros for coordinates off the chain, and rows 0 0 0, are never written.
TEST(Transforms, AreWrittenForTheChainOnly) {
  const Model model = own_model("quadruped");
  FunctionOptions options;
  options.frames = {"left_front_foot"};
  options.transform_order = 3;
  const auto setup = resolve(model, options);
  const Traced traced = trace({"transforms"}, setup, lowerings("fk")[0]);
  const TransformsOf<double> chain(
      Reference(model), VectorXd::Zero(model.joints.size()).head(setup.nq), setup.frames[0]);
  const auto on_chain = [&](int k) {
    const auto& all = chain.coordinates();
    return std::find(all.begin(), all.end(), k) != all.end();
  };
  ASSERT_EQ(chain.coordinates().size(), 3u);
  size_t written = 0;
  for (size_t e = 0; e < traced.patterns[2].row.size(); ++e) {
    EXPECT_LT(traced.patterns[2].row[e], 3);
    EXPECT_TRUE(on_chain(traced.patterns[2].col[e] / 4));
    ++written;
  }
  EXPECT_LE(written, 3u * 12);
  for (int l = 0; l < setup.nv; ++l)
    for (int k = 0; k <= l; ++k) {
      const int block = l * (l + 1) / 2 + k;
      if (on_chain(k) && on_chain(l)) continue;
      for (const int col : traced.patterns[3].col) EXPECT_NE(col / 4, block);
    }
  EXPECT_LE(traced.patterns[4].row.size(), 10u * 12);
  EXPECT_GT(traced.patterns[4].row.size(), 0u);
}

TEST(Transforms, RefuseWhatIsTooLarge) {
  RandomModelOptions options;
  options.types.assign(70, JointType::kRevolute);
  options.mimic = false;
  const Model model = random_model(1, options);
  try {
    signature({"transforms"}, setup_of(model, 3));
    FAIL();
  } catch (const UsageError& e) {
    EXPECT_STREQ(
        e.what(),
        "transforms: d3T of 70 coordinates and 70 frames would have 66796800 entries, more "
        "than 8388608: name fewer --frames, or lower --transform-order");
  }
  EXPECT_EQ(signature({"transforms"}, setup_of(model, 1)).outputs.size(), 3u);
}

}  // namespace
}  // namespace arboc::test
