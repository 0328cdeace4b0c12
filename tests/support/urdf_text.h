// Small URDF texts for tests: a good robot, and generators of large ones.
#pragma once
#include <exception>
#include <optional>
#include <string>

#include "frontend/urdf.h"

namespace arboc::test {

/// What one reading gave.
struct Reading {
  std::optional<Model> model;
  Diagnostics diagnostics;
  std::string what;  ///< of the InputError, or of another exception with "internal: " before it

  /// All diagnostics as printed, one a line.
  std::string messages() const {
    std::string out;
    for (const Diagnostic& d : diagnostics.all()) out += to_string(d) + "\n";
    return out;
  }
  /// The first one of this severity, if any.
  const Diagnostic* first(Severity severity) const {
    for (const Diagnostic& d : diagnostics.all())
      if (d.severity == severity) return &d;
    return nullptr;
  }
};

template <class Read>
Reading try_reading(Read read) {
  Reading result;
  try {
    result.model = read(result.diagnostics);
  } catch (const InputError& error) {
    result.what = error.what();
  } catch (const std::exception& error) {
    result.what = std::string("internal: ") + error.what();
  }
  return result;
}

inline Reading try_text(const std::string& text) {
  return try_reading([&](Diagnostics& d) { return parse_urdf(text, "robot.urdf", d); });
}

inline std::string link_text(const std::string& name) {
  return "<link name=\"" + name +
         "\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" "
         "iyz=\"0\" izz=\"1\"/></inertial></link>\n";
}

/// A chain of `joints` joints, each child a metre above its parent.
inline std::string chain_text(int joints) {
  std::string text = "<robot name=\"chain\">\n" + link_text("l0");
  for (int k = 1; k <= joints; ++k) {
    const std::string number = std::to_string(k);
    text += link_text("l" + number);
    text += "<joint name=\"j" + number + "\" type=\"continuous\"><parent link=\"l" +
            std::to_string(k - 1) + "\"/><child link=\"l" + number +
            "\"/><origin xyz=\"0 0 1\"/><axis xyz=\"0 1 0\"/></joint>\n";
  }
  return text + "</robot>\n";
}

/// `count` frames fixed to a base.
inline std::string frames_text(int count) {
  std::string text = "<robot name=\"frames\">\n<link name=\"base\"/>\n";
  for (int k = 0; k < count; ++k) {
    const std::string number = std::to_string(k);
    text += "<link name=\"f" + number + "\"/><joint name=\"j" + number +
            "\" type=\"fixed\"><parent link=\"base\"/><child link=\"f" + number + "\"/></joint>\n";
  }
  return text + "</robot>\n";
}

inline std::string repeated(const std::string& text, int count) {
  std::string out;
  for (int k = 0; k < count; ++k) out += text;
  return out;
}

}  // namespace arboc::test
