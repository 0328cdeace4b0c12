// What derivatives of traced inverse dynamics cost: bounds a few percent above what is reached.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "compile.h"
#include "derive/hessian.h"
#include "derive/reverse.h"
#include "frontend/urdf.h"
#include "functions/tangent.h"
#include "functions/trace.h"
#include "graph/expr.h"
#include "passes/passes.h"
#include "support/oracle.h"
#include "tree/lower.h"

namespace arboc::test {
namespace {

struct Problem {
  Builder builder{"f"};
  std::vector<Ref> tau, lambda;
  CoordinateBlock by_q, by_v, by_a;

  explicit Problem(const DynamicTree& tree) {
    const std::vector<Ref> q = builder.input("q", tree.nq), v = builder.input("v", tree.nv),
                           a = builder.input("a", tree.nv);
    lambda = builder.input("lambda", tree.nv);
    std::vector<Expr> forces(static_cast<size_t>(tree.nv));
    RneaWorkspace<Expr> work(tree);
    rnea(tree, work, traced(q).data(), traced(v).data(), traced(a).data(), forces.data());
    for (const Expr& x : forces) tau.push_back(x.ref(builder));
    by_q = tangent(tree, builder, q);
    by_v = coordinates_of(builder, "v", v);
    by_a = coordinates_of(builder, "a", a);
  }
  std::vector<Expr> traced(const std::vector<Ref>& refs) {
    std::vector<Expr> out;
    for (const Ref ref : refs) out.emplace_back(&builder, ref);
    return out;
  }
  /// Operations of these values alone.
  int operations(const std::vector<Ref>& values) const {
    Builder copy = builder;
    copy.output("y", values);
    return schedule(run_passes(std::move(copy).finish())).ops.total();
  }
};

Model model_of(const std::string& path, Base base) {
  ModelOptions options;
  options.base = base;
  Diagnostics diagnostics;
  return configure(read_urdf(path, diagnostics), options, diagnostics);
}

/// Of the sum of squares by all of q, v, a.
double gradient_over_value(const DynamicTree& tree) {
  Problem p(tree);
  const int value = p.operations(p.tau);
  CoordinateBlock all = p.by_q;
  all.insert(all.end(), p.by_v.begin(), p.by_v.end());
  all.insert(all.end(), p.by_a.begin(), p.by_a.end());
  Ref squares = p.builder.constant(0);
  for (const Ref tau : p.tau) squares = p.builder.add(squares, p.builder.mul(tau, tau));
  return p.operations(gradient(p.builder, squares, all)) / static_cast<double>(value);
}

TEST(DerivativeCost, GradientOverValue) {
  const std::pair<const char*, Base> models[] = {{"ur5", Base::kFixed},
                                                 {"arm7", Base::kFixed},
                                                 {"quadruped", Base::kFloating},
                                                 {"humanoid", Base::kFloating},
                                                 {"all_joints", Base::kFloating}};
  for (const auto& [name, base] : models) {
    const Model model = model_of(fmt::format(ARBOC_SOURCE_DIR "/models/{0}/{0}.urdf", name), base);
    for (const LoweringOptions& lowering : lowerings("rnea")) {
      const double ratio = gradient_over_value(lower(model, lowering));
      EXPECT_LE(ratio, 2.6) << name;
      EXPECT_GE(ratio, 1.5) << name;  // every operation has a derivative
      RecordProperty(name, fmt::format("{:.2f}", ratio));
    }
  }
}

TEST(DerivativeCost, HessianOfAQuadruped) {
  const OracleRobot robot{"hyq", Base::kFloating};
  if (!std::filesystem::exists(oracle_urdf(robot))) GTEST_SKIP() << "no file of " << robot.name;
  const DynamicTree tree = lower(model_of(oracle_urdf(robot), robot.base), lowerings("rnea")[1]);
  Problem p(tree);
  const auto parts = hessian(p.builder, {p.tau, p.lambda}, {p.by_q, p.by_v, p.by_a},
                             {{0, 0}, {0, 1}, {1, 1}, {0, 2}});
  std::vector<Ref> all;
  for (const SparseMatrix& part : parts)
    all.insert(all.end(), part.value.begin(), part.value.end());
  EXPECT_EQ(all.size(), 66u + 108u + 72u + 108u);  // a place and a speed of the base change nothing
  EXPECT_LE(p.operations(all), 5700);
}

}  // namespace
}  // namespace arboc::test
