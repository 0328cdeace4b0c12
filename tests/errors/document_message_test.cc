// One bad document for each message: XML, names, unknown words; which messages come, and in which
// order.
#include "errors/message_cases.h"

namespace arboc::test {
namespace {

TEST(Messages, Xml) {
  expect_all({
      {"", "robot.urdf:1:1: error: the file is empty\n"},
      {" \n\t ", "robot.urdf:1:1: error: the file is empty\n"},
      {"<robot name='r'><link name='a'></robot>",
       "robot.urdf:1:34: error: not well-formed XML: mismatched tag (the closing tag is "
       "</robot>)\n"},
      {"<robot name='r'>\n",
       "robot.urdf:2:1: error: not well-formed XML: no element found (the file ends before its "
       "elements are closed)\n"},
      {"<robot name=r/>",
       "robot.urdf:1:13: error: not well-formed XML: invalid token (write attribute values between "
       "quotes)\n"},
      {"<robot name='\xFF'/>",
       "robot.urdf:1:14: error: not well-formed XML: invalid token (bytes that are not UTF-8)\n"},
      {"<robot name='\x01'/>",
       "robot.urdf:1:14: error: not well-formed XML: invalid token (a control character)\n"},
      {"<!-- a -- b --><robot name='r'/>",
       "robot.urdf:1:10: error: not well-formed XML: invalid token ('--' cannot stand inside a "
       "comment)\n"},
      {"<robot name='&nbsp;'/>",
       "robot.urdf:1:1: error: not well-formed XML: undefined entity (only &lt; &gt; &amp; &quot; "
       "&apos; are known)\n"},
      {"<robot name='r'><link name='a'/></robot>x",
       "robot.urdf:1:41: error: not well-formed XML: junk after document element (nothing may "
       "follow </robot>)\n"},
      {"<robot name='r' name='s'/>",
       "robot.urdf:1:17: error: not well-formed XML: duplicate attribute\n"},
      {"<?xml version='1.0' encoding='KOI8-R'?><robot name='r'/>",
       "robot.urdf:1:31: error: not well-formed XML: unknown encoding (save the file as UTF-8)\n"},
      {"\xFF\xFE<",
       "robot.urdf:1:1: error: the encoding is UTF-16 or UTF-32 (save the file as UTF-8)\n"},
      {"<!DOCTYPE html><html/>",
       "robot.urdf:1:15: error: the document type is 'html', not 'robot' (this is not a URDF "
       "file)\n"},
      {"<!DOCTYPE robot [<!ENTITY a 'b'>]><robot name='&a;'/>",
       "robot.urdf:1:17: error: DOCTYPE with declarations or an external file: XML entities are "
       "not read (remove the DOCTYPE)\n"},
      {"<!DOCTYPE robot SYSTEM 'robot.dtd'><robot name='&a;'/>",
       "robot.urdf:1:35: error: DOCTYPE with declarations or an external file: XML entities are "
       "not read (remove the DOCTYPE)\n"},
  });
}

TEST(Messages, Root) {
  expect_all({
      {"<sdf/>",
       "robot.urdf:1:1: error: the document element is <sdf>, not <robot> (this is an SDFormat "
       "file, not URDF)\n"},
      {"<mujoco/>",
       "robot.urdf:1:1: error: the document element is <mujoco>, not <robot> (this is an MJCF "
       "(MuJoCo) file, not URDF)\n"},
      {"<Robot/>",
       "robot.urdf:1:1: error: the document element is <Robot>, not <robot> (element names are "
       "case sensitive)\n"},
      {"<robot name='r'/>", "robot.urdf:1:18: error: robot 'r': it has no <link>\n"},
      {"<robot><link name='a'/></robot>",
       "robot.urdf:1:1: error: robot: name is missing (write <robot name=\"...\">)\n"},
      {"<robot name=''><link name='a'/></robot>", "robot.urdf:1:8: error: robot: name is empty\n"},
      {"<robot name='r'><link name='a'/><robot name='s'/></robot>",
       "robot.urdf:1:33: error: robot: <robot> nested in another element (one file holds one "
       "<robot>)\n"},
      {"<robot name='r'><link name='a&#10;b'/></robot>",
       "robot.urdf:1:23: error: link 'a\\x0ab': name contains a control character (a name is one "
       "line of text)\n"},
      {"<robot name='r'><xacro:property name='p'/><xacro:macro/><link name='a'/></robot>",
       "robot.urdf:1:17: error: robot: <xacro:property> is not expanded (run xacro on the file "
       "first)\n"},
  });
}

TEST(Messages, Names) {
  const std::string longest(1024, 'n');
  EXPECT_EQ(said("<robot name='r'><link name='" + longest + "'/></robot>"), "");
  EXPECT_EQ(said("<robot name='r'><link name='" + longest + "n'/></robot>"),
            "robot.urdf:1:23: error: link '" + std::string(80, 'n') +
                "...': name has 1025 bytes (the limit is 1024)\n");
}

TEST(Messages, NamesThatXacroShouldHaveExpanded) {
  EXPECT_EQ(said("<robot name='${arm}'><link name='$(arg x)'/></robot>"),
            "robot.urdf:1:8: warning: robot: name '${arm}' is not expanded (run xacro on the file "
            "first)\n"
            "robot.urdf:1:28: warning: link '$(arg x)': name '$(arg x)' is not expanded (run xacro "
            "on the file first)\n");
}

TEST(Messages, FilesThatAreNoXml) {
  EXPECT_EQ(
      said("{\"robot\": 1}"),
      "robot.urdf:1:1: error: not well-formed XML: invalid token (the file does not begin with "
      "'<')\n");
  EXPECT_EQ(
      said("robot: r2"),
      "robot.urdf:1:1: error: not well-formed XML: syntax error (the file does not begin with "
      "'<')\n");
}

TEST(Messages, UnknownWords) {
  expect_all({
      {"<robot name='r'><link name='a'><intertial/></link></robot>",
       "robot.urdf:1:32: warning: link 'a': unknown element <intertial> is ignored (did you mean "
       "<inertial>?)\n"},
      {"<robot name='r'><Link name='a'/><link name='b'/></robot>",
       "robot.urdf:1:17: error: robot: unknown element <Link> (names are case sensitive: write "
       "<link>)\n"},
      {"<robot name='r'><axis xyz='0 0 1'/><link name='b'/></robot>",
       "robot.urdf:1:17: warning: robot: <axis> does not belong in <robot> and is ignored (it "
       "belongs in <joint>)\n"},
      {"<robot name='r'><battery/><battery/><link name='b'/></robot>",
       "robot.urdf:1:17: warning: robot: unknown element <battery> is ignored (it is not part of "
       "URDF)\n"
       "robot.urdf: note: ignored: 1 <battery>\n"},
      {"<robot name='r'><link nome='x' name='b' mass='2'/></robot>",
       "robot.urdf:1:23: warning: link 'b': unknown attribute 'nome' is ignored (did you mean "
       "'name'?)\n"
       "robot.urdf:1:41: warning: link 'b': unknown attribute 'mass' is ignored (it is not part of "
       "URDF)\n"},
      {"<robot name='r'><link Name='b'/></robot>",
       "robot.urdf:1:17: error: link: name is missing (write <link name=\"...\">)\n"
       "robot.urdf:1:23: error: link: unknown attribute 'Name' (names are case sensitive: write "
       "'name')\n"},
      {"<robot name='r'>\n hello <link name='b'/></robot>",
       "robot.urdf:2:1: warning: robot: text ' hello ' is ignored (URDF writes values as "
       "attributes)\n"},
  });
  EXPECT_EQ(
      said(with_joint("fixed", "<origin ryp=\"1 2 3\"/>")),
      "robot.urdf:4:73: warning: joint 'j': <origin>: unknown attribute 'ryp' is ignored (did "
      "you mean 'rpy'?)\n");
}

TEST(Messages, WhatIsIgnoredIsSaidOnce) {
  EXPECT_EQ(said("<robot name='r' xmlns:gz='x'>\n<material name='m'><color rgba='1 0 0 "
                 "1'/></material><link name='a'><visual><geometry><sphere "
                 "radius='1'/></geometry></visual><visual/></link><gz:plugin/><transmission "
                 "name='t'><any/></transmission></robot>"),
            "robot.urdf: note: ignored: 1 <gz:plugin>, 1 <material>, 1 <transmission>, 2 "
            "<visual>\n");
  EXPECT_EQ(
      said("<robot name='r'><link name='a'><collision><geometry><box size='1 "
           "x'/></geometry></collision></link></robot>"),
      "robot.urdf:1:58: warning: link 'a': <collision>: <geometry>: <box>: size: 'x' is not a "
      "number\n"
      "robot.urdf: note: ignored: 1 <collision>\n");
}

TEST(Messages, ErrorsComeInFileOrderAndTheFirstIsThrown) {
  const Reading reading = try_text(
      "<robot name='r'>\n<joint name='j' type='fixed'>\n<parent link='a'/><child link='z'/>\n"
      "<origin xyz='x'/></joint>\n<link name='a'/><link/></robot>");
  EXPECT_EQ(reading.what, "robot.urdf:2:1: error: joint 'j': <child>: there is no link 'z'");
  EXPECT_EQ(reading.messages(),
            reading.what +
                "\nrobot.urdf:4:9: error: joint 'j': <origin>: xyz: 'x' is not a number\n"
                "robot.urdf:5:17: error: link: name is missing (write <link name=\"...\">)\n");
}

}  // namespace
}  // namespace arboc::test
