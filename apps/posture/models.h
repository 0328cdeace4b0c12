// The models whose generated code the program contains.
#pragma once
#include <arboc/nlp/robot.hpp>

namespace posture {

struct Model {
  arboc::nlp::Robot robot;
  std::vector<bool> passive;                    ///< coordinates that nothing drives
  std::vector<std::vector<std::string>> limbs;  ///< frames that pictures join by lines
  int up = 1;                                   ///< axis of the world that points up
};

/// Throws std::invalid_argument with the names there are.
const Model& model(const std::string& name);

}  // namespace posture
