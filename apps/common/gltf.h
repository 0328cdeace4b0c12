// Animation -> glTF 2.0 in one binary file (.glb), for Blender and other viewers.
//
// Each body is an animated node of its name, with a small ball; each stick and force an animated
// cylinder, scaled to its length; fixtures stand still.  A root node turns `up` to glTF's y.
#pragma once
#include <string>

#include "animation.h"

namespace study {

/// Throws std::invalid_argument as `segments` does, and where there are no frames.
std::string glb(const Animation& animation);

}  // namespace study
