// Motions in phases, and velocities at ends.
#include <motion/phases.h>
#include <motion/rates.h>

#include "common/task_file.h"
#include "motion/motion_support.h"

namespace arboc::test {
namespace {

motion::Plan motion_plan(const std::string& name) {
  return motion::read_plan(ARBOC_SOURCE_DIR "/apps/motion/tasks/" + name + ".toml");
}

/// d/dt of all placements along v, by differences of fourth order: rounding of 1e-16 over h.
VectorXd placement_rates(const motion::Model& model, const VectorXd& q, const VectorXd& v) {
  nlp::Function& fk = *model.robot.placements;
  const double h = 1e-4;
  const auto at = [&](double t) {
    VectorXd out(fk.outputs());
    const VectorXd there = q + t * v;
    fk.values(1, there.data(), out.data());
    return out;
  };
  return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

double fastest_contact(const motion::Model& model, const std::vector<nlp::Contact>& contacts,
                       const VectorXd& q, const VectorXd& v) {
  const VectorXd rates = placement_rates(model, q, v);
  double fastest = 0;
  for (const nlp::Contact& c : contacts) {
    const nlp::Placement rate(rates.data() + 12 * model.robot.frame(c.frame));
    fastest = std::max(fastest, rate(c.point).norm());
  }
  return fastest;
}

/// The last sample of one phase and the first of the next.
void expect_continuous(const motion::Samples& a, const motion::Samples& b) {
  const Eigen::Index end = a.t.size() - 1;
  const auto jump = [&](const Eigen::MatrixXd& x, const Eigen::MatrixXd& y) {
    return (x.row(end) - y.row(0)).cwiseAbs().maxCoeff();
  };
  // Rounding of coordinates, which grows by the inverse of the knots' distance with each
  // derivative.
  const double one = std::max(1.0, a.q.cwiseAbs().maxCoeff());
  EXPECT_LT(jump(a.q, b.q), 1e-14 * one);
  EXPECT_LT(jump(a.v, b.v), 1e-12 * one);
  EXPECT_LT(jump(a.a, b.a), 1e-10 * one);
  EXPECT_LT(jump(a.tau, b.tau), 1e-8 * one);  // some 10 kg m^2
}

/// All phases are optimal and audited, and the whole is what its phases are.
motion::Course expect_course(const motion::Plan& plan) {
  const motion::Model& model = posture::model(plan.phases[0].model);
  motion::Course course = motion::predict_phases(plan, model, {});
  EXPECT_EQ(course.status, nlp::Status::kOptimal) << course.reason;
  EXPECT_TRUE(course.audit_passes);
  EXPECT_EQ(course.phases.size(), plan.phases.size());
  EXPECT_FALSE(course.phases[0].stages.empty());
  for (std::size_t k = 0; k < course.phases.size(); ++k) {
    expect_moves(plan.phases[k], course.phases[k]);
    if (k > 0) expect_continuous(course.phases[k - 1].samples, course.phases[k].samples);
  }
  const motion::Result whole = motion::whole(plan, course);
  EXPECT_EQ(whole.status, course.status);
  EXPECT_DOUBLE_EQ(whole.samples.t.tail<1>()[0], motion::whole(plan).duration);
  for (Eigen::Index k = 1; k < whole.samples.t.size(); ++k)
    EXPECT_GT(whole.samples.t[k], whole.samples.t[k - 1]);
  return course;
}

double reaction_jump(const motion::Course& course) {
  const auto &a = course.phases[0].samples.reactions, &b = course.phases[1].samples.reactions;
  return (a.bottomRows<1>() - b.topRows<1>()).cwiseAbs().maxCoeff();
}

TEST(Phases, ThePlaneModelMovesThroughAPlaceWithTheVelocityAsked) {
  const motion::Plan plan = motion_plan("nine_dof_through");
  const motion::Course course = expect_course(plan);
  const motion::Samples& s = course.phases[0].samples;
  const Eigen::Index end = s.t.size() - 1;
  EXPECT_NEAR(s.v(end, 0), 0.3, 1e-12);
  EXPECT_NEAR(s.v(end, 1), 0, 1e-12);
  EXPECT_NEAR(s.q(end, 0), 0, 1e-8);
  EXPECT_NEAR(s.q(end, 1), 0.04, 1e-8);
  // Nothing pulls it to rest there.
  EXPECT_GT(s.a.row(end).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_LT(reaction_jump(course), 1e-9);
  EXPECT_LT(fastest_contact(posture::model("nine_dof"), plan.phases[0].start.posture.contacts,
                            s.q.row(end), s.v.row(end)),
            1e-9);
  // The equations of motion hold at the joint: forces of passive coordinates, N and N m.
  EXPECT_LT(s.tau.row(end).head<3>().cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Phases, TheHumanLeansAndGoesOnIntoASquat) {
  const motion::Plan plan = motion_plan("santos_lean_squat");
  const motion::Course course = expect_course(plan);
  const motion::Samples& s = course.phases[0].samples;
  const Eigen::Index end = s.t.size() - 1;
  EXPECT_NEAR(s.v(end, 1), -0.15, 1e-12);  // ty: hips sink
  EXPECT_LT(reaction_jump(course), 1e-8);
  EXPECT_LT(fastest_contact(posture::model("santos"), plan.phases[0].start.posture.contacts,
                            s.q.row(end), s.v.row(end)),
            1e-9);
  EXPECT_LT(s.tau.row(end).head<6>().cwiseAbs().maxCoeff(), 1e-5);
}

/// Whichever velocity is best is better than one that is asked for.
TEST(Phases, AnyVelocityIsBetter) {
  motion::Plan plan = motion_plan("nine_dof_through");
  const motion::Course asked = motion::predict_phases(plan, posture::model("nine_dof"), {});
  plan.phases[0].end.velocity.clear();
  plan.phases[0].end.any_velocity = true;
  const motion::Course any = expect_course(plan);
  EXPECT_LT(reaction_jump(any), 1e-9);
  const auto objective = [](const motion::Course& c) {
    return c.phases[0].stages.back().objective;
  };
  EXPECT_LT(objective(any), 0.9 * objective(asked));
  const motion::Samples& s = any.phases[0].samples;
  const Eigen::Index end = s.t.size() - 1;
  EXPECT_GT(s.v.row(end).cwiseAbs().maxCoeff(), 0.1);
  // Contacts hold, so velocities are those that they allow to what curves leave between frames.
  EXPECT_LT(fastest_contact(posture::model("nine_dof"), plan.phases[0].start.posture.contacts,
                            s.q.row(end), s.v.row(end)),
            1e-2);
}

/// Control points that follow from those of the phase before, against differences.
TEST(Phases, LinkedPhasesHaveExactDerivatives) {
  motion::Plan plan = motion_plan("nine_dof_through");
  plan.phases[0].end.any_velocity = true;
  plan.phases[1].curves.degree = 4;
  const motion::Model& model = posture::model("nine_dof");
  std::vector<motion::Ends> ends;
  std::vector<motion::Motion> guesses;
  for (motion::Task& t : plan.phases) {
    t.curves.control_points = 9;
    t.objective.maximum = t.objective.displacement = 1;
    motion::Joints joints;
    if (!ends.empty()) joints = {ends[0].at[1], false, true, nullptr};
    posture::Result start, end;
    ends.push_back(motion::predict_ends(t, model, start, end, joints));
    guesses.push_back(motion::first_guess(t, ends.back()));
  }
  motion::Built built = motion::build(
      model, {{&plan.phases[0], &ends[0], &guesses[0]}, {&plan.phases[1], &ends[1], &guesses[1]}});
  const VectorXd x =
      expect_exact_near(*built.nlp, vector_of(motion::variables_of(built, guesses)), 0.05);
  // Whatever the variables, the curves go on smoothly.
  const std::vector<motion::Motion> m = motion::motions_of(built, {x.data(), x.data() + x.size()});
  for (int k = 0; k <= 2; ++k)
    EXPECT_LT((m[0].q(plan.phases[0].duration, k) - m[1].q(0, k)).cwiseAbs().maxCoeff(),
              1e-9 * m[0].q(plan.phases[0].duration, k).cwiseAbs().maxCoeff());
}

/// Contacts change where the body is at rest, and nothing jumps.
TEST(Phases, AFootIsLetGoAndLandsOneRungUp) {
  const motion::Plan plan = motion_plan("santos_climb");
  const motion::Course course = expect_course(plan);
  const motion::Result whole = motion::whole(plan, course);
  const int foot = 6 * 2;  // the third contact
  EXPECT_EQ(motion::whole(plan).start.posture.contacts[2].name, "right foot");
  double carried[3] = {0, 0, 0};
  for (Eigen::Index k = 0; k < whole.samples.t.size(); ++k) {
    const double t = whole.samples.t[k];
    double& most = carried[t < 0.8 ? 0 : t < 2.3 ? 1 : 2];
    most = std::max(most, whole.samples.reactions.row(k).segment<6>(foot).norm());
  }
  EXPECT_GT(carried[0], 10);
  EXPECT_LT(carried[1], 1e-8);
  EXPECT_GT(carried[2], 10);
  for (std::size_t k = 0; k < 3; ++k) {  // at rest at every joint
    const motion::Samples& s = course.phases[k].samples;
    EXPECT_LT(s.v.bottomRows<1>().cwiseAbs().maxCoeff(), 1e-12);
  }
}

/// A hand reaches its hold while the body moves: it does not move there, and its load comes at
/// once.
TEST(Phases, AHandTakesHoldOfAMovingBody) {
  motion::Plan plan = motion_plan("nine_dof_through");
  motion::Task& first = plan.phases[0];
  const nlp::Contact left = first.end.posture.contacts[1];
  EXPECT_EQ(left.name, "left hand");
  for (posture::Task* at : {&first.start.posture, &first.end.posture}) {
    at->contacts.pop_back();
    at->torque_limits = false;
    at->objective.displacement = 1;  // arms without limits do not wind up
  }
  // One hand carries it only below itself, at x = 0.06 m.
  first.start.posture.targets[0].place.at = {0.06, 0.03, 0};
  first.end.posture.targets[0].place.at = {0.03, 0.06, 0};
  first.end.posture.targets.push_back({left.name, left.frame, left.point, left.place});
  first.end.velocity = {{"x", 0.1}};
  EXPECT_EQ(motion::joint_of(first, plan.phases[1]), motion::Joint::kJolt);
  const motion::Model& model = posture::model("nine_dof");
  const motion::Course course = motion::predict_phases(plan, model, {});
  ASSERT_EQ(course.status, nlp::Status::kOptimal) << course.reason;
  for (std::size_t k = 0; k < 2; ++k) expect_moves(plan.phases[k], course.phases[k]);
  const motion::Samples &a = course.phases[0].samples, &b = course.phases[1].samples;
  const Eigen::Index end = a.t.size() - 1;
  EXPECT_LT((a.q.row(end) - b.q.row(0)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((a.v.row(end) - b.v.row(0)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(a.v(end, 0), 0.1, 1e-12);
  EXPECT_LT(fastest_contact(model, {left}, a.q.row(end), a.v.row(end)), 1e-9);
  const motion::Result whole = motion::whole(plan, course);
  EXPECT_EQ(whole.samples.reactions.block(0, 6, end + 1, 6).cwiseAbs().maxCoeff(), 0);
  EXPECT_GT(b.reactions.row(0).tail<6>().norm(), 1);
  // The equations of motion hold on both sides.
  EXPECT_LT(a.tau.row(end).head<3>().cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT(b.tau.row(0).head<3>().cwiseAbs().maxCoeff(), 1e-5);
}

/// One foot lands while the body goes on, the other one is let go while it does: two steps of a
/// robot from a URDF file.
TEST(Phases, TheHumanoidTakesTwoSteps) {
  const motion::Plan plan = motion_plan("humanoid_walk");
  EXPECT_EQ(motion::joint_of(plan.phases[0], plan.phases[1]), motion::Joint::kJolt);
  EXPECT_EQ(motion::joint_of(plan.phases[1], plan.phases[2]), motion::Joint::kSmooth);
  const motion::Model& model = posture::model("humanoid");
  const motion::Course course = motion::predict_phases(plan, model, {});
  ASSERT_EQ(course.status, nlp::Status::kOptimal) << course.reason;
  for (std::size_t k = 0; k < 3; ++k) expect_moves(plan.phases[k], course.phases[k]);
  const motion::Samples &one = course.phases[0].samples, &both = course.phases[1].samples,
                        &two = course.phases[2].samples;
  const Eigen::Index end = one.t.size() - 1, last = both.t.size() - 1;
  // It lands without a shock, and takes its load at once.
  EXPECT_NEAR(one.v(end, model.robot.coordinate("root_joint.x")), 0.1, 1e-12);
  EXPECT_LT((one.q.row(end) - both.q.row(0)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((one.v.row(end) - both.v.row(0)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(
      fastest_contact(model, plan.phases[1].start.posture.contacts, both.q.row(0), both.v.row(0)),
      1e-9);
  // It leaves the ground when it carries nothing any more.
  expect_continuous(both, two);
  EXPECT_GT(both.v.row(last).norm(), 0.01);
  EXPECT_EQ(plan.phases[1].start.posture.contacts[0].name, "left foot");
  EXPECT_EQ(plan.phases[2].start.posture.contacts[0].name, "right foot");
  EXPECT_GT(both.reactions(last / 4, 2), 50);
  EXPECT_LT(both.reactions.row(last).head<6>().cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(
      (both.reactions.row(last).tail<6>() - two.reactions.row(0).head<6>()).cwiseAbs().maxCoeff(),
      1e-9);
  const double steps = two.placements(two.t.size() - 1, 12 * model.robot.frame("left_foot") + 9) -
                       one.placements(0, 12 * model.robot.frame("left_foot") + 9);
  EXPECT_NEAR(steps, 0.4, 1e-6);
}

/// From a velocity to rest, in one phase.
TEST(Phases, AMotionMayBeginMoving) {
  motion::Task t = motion_task("nine_dof_trial3_obj3");
  t.duration = 1;
  t.start.velocity = {{"x", 0.1}, {"q2", 0.2}};
  const motion::Result r = solve_motion(t);
  expect_moves(t, r);
  EXPECT_NEAR(r.samples.v(0, 0), 0.1, 1e-12);
  EXPECT_NEAR(r.samples.v(0, 2), 0.2, 1e-12);
  EXPECT_LT(r.samples.tau.row(0).head<3>().cwiseAbs().maxCoeff(), 1e-5);
}

/// To a posture with whichever velocity is best there.
TEST(Phases, AMotionMayEndMoving) {
  motion::Task t = motion_task("nine_dof_trial3_obj3");
  t.duration = 0.6;
  const double at_rest = solve_motion(t).stages.back().objective;
  t.end.any_velocity = true;
  const motion::Result r = solve_motion(t);
  expect_moves(t, r);
  EXPECT_LT(r.stages.back().objective, 0.9 * at_rest);
  const Eigen::Index end = r.samples.t.size() - 1;
  EXPECT_NEAR(r.samples.q(end, 0), 0.1, 1e-8);
  EXPECT_GT(r.samples.v.row(end).norm(), 0.1);
  EXPECT_LT(r.samples.tau.row(end).head<3>().cwiseAbs().maxCoeff(), 1e-5);
}

struct At {
  const motion::Model& model;
  std::vector<nlp::Contact> contacts;
  VectorXd q;
};
At posture_of(const std::string& name) {
  const motion::Task t = motion_task(name);
  const motion::Model& model = posture::model(t.model);
  const posture::Result r = posture::predict(t.start.posture, model);
  return {model, t.start.posture.contacts,
          Eigen::Map<const VectorXd>(r.q.data(), static_cast<Eigen::Index>(r.q.size()))};
}

double kinetic_energy(const At& at, const VectorXd& v) {
  nlp::Function& rnea = *at.model.robot.dynamics;
  VectorXd x = VectorXd::Zero(rnea.inputs()), with(v.size()), without(v.size());
  x.head(v.size()) = at.q;
  rnea.values(1, x.data(), without.data());
  x.segment(2 * v.size(), v.size()) = v;
  rnea.values(1, x.data(), with.data());
  return v.dot(with - without) / 2;
}

TEST(Velocities, AreThoseOfLeastEnergyThatContactsAllow) {
  for (const char* name : {"nine_dof_trial3_obj3", "santos_lean"}) {
    const At at = posture_of(name);
    const std::string hips = at.model.robot.coordinates[1];
    const auto complete = [&](const std::map<std::string, double>& given) {
      return motion::complete_velocity(at.model, at.q, given, {at.contacts, 0}, "v");
    };
    const VectorXd v = complete({{hips, -0.2}});
    EXPECT_EQ(v[1], -0.2);
    EXPECT_LT(fastest_contact(at.model, at.contacts, at.q, v), 1e-9);
    const double least = kinetic_energy(at, v);
    EXPECT_GT(least, 0);
    for (const double more : {-0.01, 0.01}) {
      const VectorXd other = complete({{hips, -0.2}, {at.model.robot.coordinates[0], v[0] + more}});
      EXPECT_LT(fastest_contact(at.model, at.contacts, at.q, other), 1e-9);
      EXPECT_GT(kinetic_energy(at, other), least);
    }
    EXPECT_TRUE(complete({}).isZero(0));
  }
}

std::string refusal(const At& at, const std::map<std::string, double>& given,
                    const motion::RateLimits& limits) {
  try {
    motion::complete_velocity(at.model, at.q, given, limits, "end_velocity");
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(Velocities, ThatContactsForbidAreRefused) {
  const At at = posture_of("nine_dof_trial3_obj3");
  std::map<std::string, double> all{{"x", 0.3}};
  for (std::size_t i = 1; i < at.model.robot.coordinates.size(); ++i)
    all[at.model.robot.coordinates[i]] = 0;
  EXPECT_EQ(refusal(at, all, {at.contacts, 0}),
            "end_velocity: contacts do not allow it: 'right hand' would move at 0.3 m/s or rad/s, "
            "'left hand' would move at 0.3 m/s or rad/s");
  // Without those contacts it is a velocity like others.
  EXPECT_EQ(refusal(at, all, {{}, 0}), "");
  // In one problem it is refused before anything is solved.
  motion::Task t = motion_task("nine_dof_trial3_obj3");
  t.end.velocity = all;
  EXPECT_THROW(solve_motion(t), std::invalid_argument);
}

TEST(Velocities, StayWithinLimitsOfCoordinates) {
  At at = posture_of("nine_dof_trial3_obj3");
  const std::size_t wrist = 5;
  at.q[static_cast<Eigen::Index>(wrist)] = at.model.robot.q_upper[wrist] - 1e-3;
  const std::string name = at.model.robot.coordinates[wrist];
  EXPECT_EQ(refusal(at, {{name, 0.1}}, {{}, 0.1}),
            "end_velocity: '" + name + "' is about to leave its limits");
  EXPECT_EQ(refusal(at, {{name, 0.1}}, {{}, 0.001}), "");
  // Others stop there.
  const VectorXd v =
      motion::complete_velocity(at.model, at.q, {{"x", 1}}, {at.contacts, 0.1}, "end_velocity");
  EXPECT_EQ(v[static_cast<Eigen::Index>(wrist)], 0);
  EXPECT_LT(fastest_contact(at.model, at.contacts, at.q, v), 1e-9);
}

}  // namespace
}  // namespace arboc::test
