// One bad model for each message about joints, trees and masses, and the whole text of what is said
// about it.
#include "errors/message_cases.h"

namespace arboc::test {
namespace {

TEST(Messages, AnglesBeyondATurn) {
  EXPECT_EQ(
      said(with_joint("fixed", "<origin rpy='0 90 6.2831853'/>")),
      "robot.urdf:4:73: warning: joint 'j': <origin>: rpy: 90 rad is more than a turn (angles "
      "are in radians)\n");
}

TEST(Messages, NumbersBeyondDouble) {
  const std::string digits(400, '9');
  for (const char* text : {"1e400", "-1e400", "1e-400", "1.5e+999999999999999999999"})
    EXPECT_NE(said(with_joint("fixed", std::string("<origin xyz='0 0 ") + text + "'/>"))
                  .find("' is beyond the range of double\n"),
              std::string::npos)
        << text;
  EXPECT_NE(
      said(with_joint("fixed", "<origin xyz='0 0 " + digits + "'/>")).find("beyond the range"),
      std::string::npos);
  for (const char* text : {"1e5.5", "1e", "e5", ".e5", "1e+", "--1", "1..0"})
    EXPECT_NE(said(with_joint("fixed", std::string("<origin xyz='0 0 ") + text + "'/>"))
                  .find("' is not a number\n"),
              std::string::npos)
        << text;
}

TEST(Messages, Numbers) {
  const auto origin = [](const std::string& xyz) {
    return said(with_joint("fixed", "<origin xyz=\"" + xyz + "\"/>"));
  };
  const std::string where = "robot.urdf:4:73: error: joint 'j': <origin>: xyz: ";
  EXPECT_EQ(origin("1 2 x"), where + "'x' is not a number\n");
  EXPECT_EQ(origin("1 2"), where + "2 numbers where 3 are needed\n");
  EXPECT_EQ(origin(""), where + "0 numbers where 3 are needed\n");
  EXPECT_EQ(origin("1 2 3 4"), where + "4 numbers where 3 are needed\n");
  EXPECT_EQ(origin("1,2,3"), where +
                                 "'1,2,3' is not a number (separate numbers by blanks and write a "
                                 "decimal point)\n");
  EXPECT_EQ(origin("0 0 nan"), where + "'nan' is not a number (every number must be finite)\n");
  EXPECT_EQ(origin("0 -Inf 0"), where + "'-Inf' is not a number (every number must be finite)\n");
  EXPECT_EQ(origin("0 0x10 0"), where + "'0x10' is not a number (write it in decimal)\n");
  EXPECT_EQ(origin("pi/2 0 0"), where + "'pi/2' is not a number (write the number itself)\n");
  EXPECT_EQ(origin("${x} 0 0"),
            where + "'${x}' is not a number (expand the file with xacro first)\n");
  EXPECT_EQ(origin("1e999 0 0"), where + "'1e999' is beyond the range of double\n");
  EXPECT_EQ(origin("2e 0 0"), where + "'2e' is not a number\n");
  EXPECT_EQ(origin("\xE2\x88\x92"
                   "1 0 0"),
            where +
                "'\xE2\x88\x92"
                "1' is not a number (the minus sign is U+2212; write '-')\n");
  EXPECT_EQ(origin(" 1\t+2.5e-3\n .5 "), "");
  EXPECT_EQ(said(with_joint("fixed", "<origin rpy=\"0 2e9 0\"/>")),
            "robot.urdf:4:73: error: joint 'j': <origin>: rpy: 2e+09 rad is beyond 1e9\n");
}

TEST(Messages, Joints) {
  const std::string limit = "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
  const std::string axis = "<axis xyz=\"0 0 1\"/>";
  EXPECT_EQ(said(with_joint("revolute", axis + limit)), "");
  EXPECT_EQ(said(with_joint("hinge", axis)),
            "robot.urdf:4:17: error: joint 'j': unknown type 'hinge' (URDF has fixed, revolute, "
            "continuous, prismatic, floating, planar)\n");
  EXPECT_EQ(said(with_joint("revolut", axis)),
            "robot.urdf:4:17: error: joint 'j': unknown type 'revolut' (did you mean "
            "'revolute'?)\n");
  EXPECT_EQ(said(with_joint("revolute", axis)),
            "robot.urdf:4:1: error: joint 'j': <limit> is missing (a revolute joint has limits)\n");
  EXPECT_EQ(said(with_joint("prismatic", axis)),
            "robot.urdf:4:1: error: joint 'j': <limit> is missing (a prismatic joint has "
            "limits)\n");
  EXPECT_EQ(said(with_joint("continuous", "<axis xyz=\"0 0 0\"/>")),
            "robot.urdf:4:76: error: joint 'j': <axis>: length is 0 (give a direction, e.g. "
            "xyz=\"0 0 1\")\n");
  EXPECT_EQ(said(with_joint("continuous", "<axis xyz=\"0 3 4\"/>")),
            "robot.urdf:4:76: warning: joint 'j': <axis>: length is 5; normalised (write a vector "
            "of length 1)\n");
  EXPECT_EQ(said(with_joint("continuous", "")),
            "robot.urdf:4:1: warning: joint 'j': no <axis>: the default 1 0 0 is used (write <axis "
            "xyz=\"1 0 0\"/> if that is meant)\n");
  EXPECT_EQ(said(with_joint("continuous", axis + axis)),
            "robot.urdf:4:89: error: joint 'j': a second <axis> (<joint> has one)\n");
  EXPECT_EQ(said(with_joint("fixed", "<axis xyz=\"0 0 0\"/>")),
            "robot.urdf: note: ignored: 1 <axis> of fixed joints\n");
  EXPECT_EQ(said(with_joint("fixed", "<axis xyz=\"0 0 x\"/>")),
            "robot.urdf:4:71: warning: joint 'j': <axis>: xyz: 'x' is not a number\n"
            "robot.urdf: note: ignored: 1 <axis> of fixed joints\n");
}

TEST(Messages, Limits) {
  const auto revolute = [](const std::string& limit) {
    return said(with_joint("revolute", "<axis xyz=\"0 0 1\"/><limit " + limit + "/>"));
  };
  EXPECT_EQ(revolute("lower=\"2\" upper=\"1\" effort=\"1\" velocity=\"1\""),
            "robot.urdf:4:87: error: joint 'j': <limit>: lower (2) is greater than upper (1)\n");
  EXPECT_EQ(revolute("upper=\"-1\" effort=\"1\" velocity=\"1\""),
            "robot.urdf:4:87: error: joint 'j': <limit>: lower (0) is greater than upper (-1)\n");
  EXPECT_EQ(revolute("effort=\"1\" velocity=\"1\""),
            "robot.urdf:4:87: warning: joint 'j': <limit>: neither lower nor upper is given: both "
            "are 0, so the joint cannot move (give both, or use type=\"continuous\")\n");
  EXPECT_EQ(revolute("lower=\"0\" upper=\"1\" effort=\"-1\" velocity=\"-2\""),
            "robot.urdf:4:114: error: joint 'j': <limit>: effort is negative (-1) (limits are "
            "magnitudes)\n"
            "robot.urdf:4:126: error: joint 'j': <limit>: velocity is negative (-2) (limits are "
            "magnitudes)\n");
  EXPECT_EQ(revolute("lower=\"0\" upper=\"1\" effort=\"1\""),
            "robot.urdf:4:87: error: joint 'j': <limit>: velocity is missing (write <limit "
            "velocity=\"...\">)\n");
  EXPECT_EQ(said(with_joint("continuous",
                            "<axis xyz=\"0 0 1\"/><limit lower=\"2\" upper=\"1\" effort=\"1\" "
                            "velocity=\"1\"/><dynamics damping=\"-1\" friction=\"-2\"/>")),
            "robot.urdf:4:151: warning: joint 'j': <dynamics>: damping is negative (-1) (it feeds "
            "energy into the joint)\n"
            "robot.urdf:4:164: warning: joint 'j': <dynamics>: friction is negative (-2) (it feeds "
            "energy into the joint)\n"
            "robot.urdf: note: ignored: 1 lower/upper of continuous joints\n");
}

std::string joint_text(const std::string& name, const std::string& parent, const std::string& child,
                       const std::string& inside = "") {
  return "<joint name=\"" + name + "\" type=\"continuous\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/><axis xyz=\"0 0 1\"/>" + inside + "</joint>\n";
}

TEST(Messages, Tree) {
  EXPECT_EQ(said(with_joints(joint_text("j", "a", "b") + joint_text("k", "b", "c"))), "");
  EXPECT_EQ(said(with_joints(joint_text("j", "a", "b"))),
            "robot.urdf:4:1: error: link 'c': no joint leads to this link (link 'a' has no parent "
            "either, and a robot has one root)\n");
  EXPECT_EQ(said(with_joints(joint_text("j", "a", "b") + joint_text("k", "c", "b"))),
            "robot.urdf:6:1: error: joint 'k': link 'b' is already the child of joint 'j' (closed "
            "loops cannot be read: a link has one parent)\n");
  EXPECT_EQ(said(with_joints(joint_text("j", "b", "c") + joint_text("k", "c", "b"))),
            "robot.urdf:6:1: error: joint 'k': closes a loop of links: 'c' -> 'b' -> 'c' (a robot "
            "is a tree)\n");
  EXPECT_EQ(said(with_joints(joint_text("j", "a", "b") + joint_text("k", "b", "b"))),
            "robot.urdf:6:1: error: joint 'k': parent and child are the same link 'b'\n");
  EXPECT_EQ(said(with_joints(joint_text("j", "a", "b") + joint_text("k", "bb", "c"))),
            "robot.urdf:6:1: error: joint 'k': <parent>: there is no link 'bb'\n");
  EXPECT_EQ(said(with_joints(joint_text("j", "a", "b") + joint_text("j", "b", "c"))),
            "robot.urdf:6:1: error: joint 'j': another joint has this name (the first one is in "
            "line 5)\n");
  EXPECT_EQ(said(with_joints(link_text("arm") + "<link name=\"arm\"/>\n")),
            "robot.urdf:6:1: error: link 'arm': another link has this name (the first one is in "
            "line 5)\n");
  EXPECT_EQ(
      said(with_joints("<joint name=\"j\" type=\"fixed\"/>\n")),
      "robot.urdf:5:1: error: joint 'j': <parent link=\"...\"/> is missing (name the link "
      "that carries it)\n"
      "robot.urdf:5:1: error: joint 'j': <child link=\"...\"/> is missing (name the link that "
      "it moves)\n");
}

TEST(Messages, Mimic) {
  const auto two = [](const std::string& first, const std::string& second) {
    return said(
        with_joints(joint_text("elbow", "a", "b", first) + joint_text("wrist", "b", "c", second)));
  };
  EXPECT_EQ(two("", "<mimic joint=\"elbow\" multiplier=\"2\"/>"), "");
  EXPECT_EQ(
      two("", "<mimic joint=\"elbw\"/>"),
      "robot.urdf:6:93: error: joint 'wrist': <mimic>: there is no joint 'elbw' (did you mean "
      "'elbow'?)\n");
  EXPECT_EQ(two("", "<mimic joint=\"wrist\"/>"),
            "robot.urdf:6:93: error: joint 'wrist': <mimic>: follows itself (one joint of the "
            "group must move on its own)\n");
  EXPECT_EQ(two("<mimic joint=\"wrist\"/>", "<mimic joint=\"elbow\"/>"),
            "robot.urdf:5:93: error: joint 'elbow': <mimic>: follows itself through others (one "
            "joint of the group must move on its own)\n");
  EXPECT_EQ(two("", "<mimic/>"),
            "robot.urdf:6:93: error: joint 'wrist': <mimic>: joint is missing (write <mimic "
            "joint=\"...\">)\n");
  EXPECT_EQ(two("", "<mimic joint=\"elbow\" multiplier=\"0\"/>"),
            "robot.urdf:6:114: warning: joint 'wrist': <mimic>: multiplier is 0: the joint never "
            "moves\n");
  EXPECT_EQ(said(with_joints("<joint name=\"j\" type=\"floating\"><parent link=\"a\"/><child "
                             "link=\"b\"/></joint>\n" +
                             joint_text("k", "b", "c", "<mimic joint=\"j\"/>"))),
            "robot.urdf:6:89: error: joint 'k': <mimic>: joint 'j' is floating and cannot lead "
            "(only joints with one coordinate can)\n");
  EXPECT_EQ(said(with_joints(joint_text("j", "a", "b") +
                             "<joint name=\"k\" type=\"floating\"><parent link=\"b\"/><child "
                             "link=\"c\"/><mimic joint=\"j\"/></joint>\n")),
            "robot.urdf:6:68: error: joint 'k': <mimic>: a floating joint cannot follow another "
            "(only joints with one coordinate can)\n");
  EXPECT_EQ(said(with_joint("fixed", "<mimic joint=\"j\"/>")),
            "robot.urdf:4:65: warning: joint 'j': <mimic>: a fixed joint cannot follow another; "
            "ignored\n");
}

TEST(Messages, Masses) {
  const auto inertial = [](double mass, const std::string& diagonal, const std::string& ixy) {
    return "<mass value=\"" + std::to_string(mass) + "\"/><inertia ixx=\"" + diagonal +
           "\" ixy=\"" + ixy + "\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/>";
  };
  const std::string where = "robot.urdf:3:16: ";
  EXPECT_EQ(said(with_inertial("continuous", inertial(1, "1", "0"))), "");
  EXPECT_EQ(said(with_inertial("continuous", inertial(-1, "1", "0"))),
            where + "error: link 'b': <inertial>: mass is negative (-1)\n");
  EXPECT_EQ(said(with_inertial("continuous", inertial(1, "-1", "0"))),
            where + "error: link 'b': <inertial>: moment of inertia ixx is negative (-1)\n");
  EXPECT_EQ(said(with_inertial("continuous", inertial(1, "1", "3"))),
            where +
                "error: link 'b': <inertial>: inertia tensor is not positive definite (no body has "
                "negative principal moments; check ixy, ixz and iyz)\n");
  EXPECT_EQ(said(with_inertial("fixed", inertial(1, "1", "3"))),
            where +
                "warning: link 'b': <inertial>: inertia tensor is not positive definite (no body "
                "has negative principal moments; check ixy, ixz and iyz)\n");
  EXPECT_EQ(
      said(with_inertial("continuous", inertial(1, "3", "0"))),
      where +
          "warning: link 'b': <inertial>: inertia tensor violates the triangle inequality (of "
          "a real body no principal moment exceeds the sum of the other two)\n");
  EXPECT_EQ(said(with_inertial("fixed", inertial(0, "1", "0"))),
            where + "warning: link 'b': <inertial>: mass is 0 but inertia is not\n");
  EXPECT_EQ(said(with_inertial("continuous", "<mass value=\"1\"/>")),
            where +
                "error: link 'b': <inertial>: <inertia> is missing (write <inertia ixx=\"...\" "
                ".../>, in kg m^2)\n");
  EXPECT_EQ(said(with_inertial("continuous",
                               "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" "
                               "izz=\"1\"/>")),
            where +
                "error: link 'b': <inertial>: <mass> is missing (write <mass value=\"...\"/>, in "
                "kg)\n");
  EXPECT_EQ(said("<robot name=\"r\">\n<link name=\"a\"/><link name=\"b\"/>\n" +
                 joint_text("j", "a", "b") + "</robot>"),
            "robot.urdf:2:17: warning: link 'b': joint 'j' moves it, but neither it nor what hangs "
            "on it has mass or inertia (the mass matrix is singular: no forward dynamics)\n");
}

TEST(Messages, IndefiniteTensorIsHealedByWhatIsFixedToIt) {
  const std::string correction =
      "<link name=\"correction\"><inertial><mass value=\"0.1\"/><inertia ixx=\"0.1\" ixy=\"0.2\" "
      "ixz=\"0\" iyy=\"0.1\" iyz=\"0\" izz=\"0.1\"/></inertial></link>\n"
      "<joint name=\"weld\" type=\"fixed\"><parent link=\"c\"/><child "
      "link=\"correction\"/></joint>\n";
  const Reading reading =
      try_text(with_joints(joint_text("j", "a", "b") + joint_text("k", "b", "c") + correction));
  ASSERT_TRUE(reading.model) << reading.messages();
  EXPECT_EQ(reading.diagnostics.warning_count(), 1);
}

}  // namespace
}  // namespace arboc::test
