// Text in HTML and SVG.
#pragma once
#include <string>

namespace study {

/// & < > " as entities.
std::string escaped(const std::string& text);

}  // namespace study
