// Where and along which axes the velocity of a frame, a Jacobian or a wrench is taken.
#pragma once

namespace arboc {

enum class Axes {
  kLocal,    ///< at the frame's origin, along the frame's axes
  kWorld,    ///< of the point that passes the world's origin, along the world's axes
  kAligned,  ///< at the frame's origin, along the world's axes
};

}  // namespace arboc
