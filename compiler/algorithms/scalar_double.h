// What the algorithms ask of a scalar beyond + - * /: for numbers the runtime's sincos, the very
// one that generated code calls, so that comparing the engines shows the specialisation only.
#pragma once
#include "arboc/scalar.hpp"
