// The human and its anthropometry, against the numbers of the document.
#include "property/dh_support.h"

namespace arboc::test {
namespace {

// [Thesis] Tables A.4 to A.8 with Table A.1, at zero, in the frame of the hips.
TEST(Santos, StandsAsItsTablesSay) {
  const Model model = santos();
  const VectorXd zero = VectorXd::Zero(55);
  const Isometry3d to_base = place(model, zero, "base").inverse();
  const auto at = [&](const char* link) -> Vector3d {
    return (to_base * place(model, zero, link)).translation();
  };
  const double kPrinted = 1e-4;  // four digits
  EXPECT_LT((at("z19") - Vector3d(0.0558, -0.6565, 0.3310)).norm(), kPrinted);
  EXPECT_LT((at("z29") - Vector3d(0.0558, 0.6565, 0.3310)).norm(), kPrinted);
  EXPECT_LT((at("z35") - Vector3d(0, 0, 0.4587)).norm(), kPrinted);
  EXPECT_LT((at("z42") - Vector3d(0, -0.0803, -0.8658)).norm(), kPrinted);
  EXPECT_LT((at("r_ball") - Vector3d(0.1306, -0.0803, -0.8658)).norm(), kPrinted);
  // World: x left, y up, z forward.
  EXPECT_LT((place(model, zero, "l_ball").translation() - Vector3d(0.0803, -0.8658, 0.1306)).norm(),
            kPrinted);
  EXPECT_EQ(coordinates(model).nv, 55);
  int rows = 0;
  for (const Link& link : model.links) rows += link.reported ? 1 : 0;
  EXPECT_EQ(rows, 54);
}

TEST(Santos, WeighsWhatItsTableSays) {
  const Model model = santos();
  double mass = 0;
  for (const Link& link : model.links) mass += link.inertial ? link.inertial->mass : 0;
  EXPECT_NEAR(mass, 98.3, 1e-12);
  Random random(1);
  const Reference reference(model);
  for (int k = 0; k < 20; ++k) {
    const VectorXd g = reference.gravity(random_vector(55, random));
    EXPECT_NEAR(g[1], 98.3 * 9.81, 1e-9);  // 964.32 N upwards, in any posture
    EXPECT_NEAR(g[0], 0, 1e-9);
    EXPECT_NEAR(g[2], 0, 1e-9);
  }
}

// The first rows by which the document turns the body: theta = q + pi/2, alpha = pi/2, three times.
TEST(Santos, TurnsLikeTheRowsOfTheDocument) {
  const Model model = santos();
  Random random(1);
  const VectorXd q = random_vector(55, random);
  Isometry3d T = slide(q.head<3>());
  for (int k = 3; k < 6; ++k) T = T * row(false, q[k] + M_PI / 2, 0, M_PI / 2, 0);
  EXPECT_LT(apart(place(model, q, "z0"), T), 1e-14);
  const Isometry3d R =
      turn(Vector3d::UnitZ(), q[3]) * turn(Vector3d::UnitX(), q[4]) * turn(Vector3d::UnitY(), q[5]);
  EXPECT_LT(apart(place(model, q, "z0"), slide(q.head<3>()) * R), 1e-14);
}

TEST(Santos, OneJointTurnsBothArmsAndTheHead) {
  const Model model = santos();
  const int q12 = q_of(model, "q12");
  VectorXd q = VectorXd::Zero(55);
  q[q12] = 0.2;
  for (const char* link : {"r_hand", "l_hand", "head"})
    EXPECT_GT(apart(place(model, q, link), place(model, VectorXd::Zero(55), link)), 0.01) << link;
}

// A person s times as large: lengths s, first moments s, inertias s^2 at the same masses.
TEST(Santos, ScalesWithItsLengths) {
  const double s = 1.1;
  const Model model = santos();
  FunctionOptions options;
  options.parameters = {"lengths", "cgs", "inertias"};
  const auto setup = resolve(model, options);
  std::vector<std::vector<double>> values;
  for (const Parameter& p : setup.parameters) {
    values.push_back(p.nominal);
    for (double& x : values.back()) x *= p.kind == Parameter::Kind::kInertia ? s * s : s;
  }
  EXPECT_EQ(setup.parameters.back().name, "lengths");
  EXPECT_EQ(values.back().size(), 26u);
  const Model scaled = model_with(model, setup.parameters, values);
  Random random(1);
  VectorXd q = random_vector(55, random);
  q.head<3>().setZero();
  for (const char* link :
       {"z21", "z31", "z37", "z45", "z53"})  // points at fixed places do not scale
    EXPECT_LT(
        (place(scaled, q, link).translation() - s * place(model, q, link).translation()).norm(),
        1e-14);
  const MatrixXd M = Reference(model).crba(q), N = Reference(scaled).crba(q);
  for (int i = 3; i < 55; ++i)
    for (int j = 3; j < 55; ++j) EXPECT_NEAR(N(i, j), s * s * M(i, j), 1e-12 * M(3, 3));
}

// Reading other lengths and putting them in as parameters are the same.
TEST(Santos, AnthropometryOfAFileEqualsParameters) {
  const std::string path = testing::TempDir() + "/tall.toml";
  FILE* file = std::fopen(path.c_str(), "w");
  std::fputs(
      "units = { length = \"cm\", angle = \"rad\", mass = \"g\" }\n[lengths]\nL19 = 45\nL24 = "
      "45\n[segments]\n\"Head\" = { mass = 7000 }\n",
      file);
  std::fclose(file);
  const Model tall = santos({}, path);
  const Model model = santos();
  FunctionOptions options;
  options.parameters = {"lengths:L19", "lengths:L24", "masses:Head"};
  const auto setup = resolve(model, options);
  const Model same = model_with(model, setup.parameters, {{7}, {0.45, 0.45}});
  Random random(1);
  const VectorXd q = random_vector(55, random);
  EXPECT_EQ(place(tall, q, "r_ball").matrix(), place(same, q, "r_ball").matrix());
  EXPECT_EQ(Reference(tall).crba(q), Reference(same).crba(q));
  EXPECT_NE(tall.source_sha256, model.source_sha256);
}

}  // namespace
}  // namespace arboc::test
