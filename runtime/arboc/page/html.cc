// Apart from pages, so that programs that only quote text do not carry the drawing library.
#include "arboc/page/page.hpp"

namespace arboc {
namespace page {

std::string html(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += c;
    }
  }
  return out;
}

}  // namespace page
}  // namespace arboc
