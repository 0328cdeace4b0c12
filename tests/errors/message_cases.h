// Models that are wrong in one place, and what is said of them.
#pragma once
#include <gtest/gtest.h>

#include "support/urdf_text.h"

namespace arboc::test {

struct Case {
  const char* text;
  const char* said;  // every line that is printed
};

inline void expect_all(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    EXPECT_EQ(try_text(c.text).messages(), c.said);
  }
}

/// The text of a robot with links a and b (1 kg) and, in line 4, the joint j with `inside`.
inline std::string with_joint(const std::string& type, const std::string& inside) {
  return "<robot name=\"r\">\n" + link_text("a") + link_text("b") + "<joint name=\"j\" type=\"" +
         type + "\"><parent link=\"a\"/><child link=\"b\"/>" + inside + "</joint>\n</robot>\n";
}

/// The text of a robot whose link b, in line 3, has `inertial` and hangs on a joint of this type.
inline std::string with_inertial(const std::string& type, const std::string& inertial) {
  return "<robot name=\"r\">\n" + link_text("a") + "<link name=\"b\"><inertial>" + inertial +
         "</inertial></link>\n<joint name=\"j\" type=\"" + type +
         "\"><parent link=\"a\"/><child link=\"b\"/>" +
         (type == "fixed" ? "" : "<axis xyz=\"0 0 1\"/>") + "</joint>\n</robot>\n";
}

/// The text of a robot with three links in a row and `joints` from line 5 on.
inline std::string with_joints(const std::string& joints) {
  return "<robot name=\"r\">\n" + link_text("a") + link_text("b") + link_text("c") + joints +
         "</robot>\n";
}

inline std::string said(const std::string& text) { return try_text(text).messages(); }

}  // namespace arboc::test
