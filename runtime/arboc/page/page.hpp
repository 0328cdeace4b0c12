// Pages that stand alone: one HTML file with its style, its scripts and its data inside.
//
// Scripts are ES modules that import each other by name; the names at hand in every page are
//   three, three/addons/controls/OrbitControls.js   the drawing library (third_party/three)
//   arboc/skeleton                                  a skeleton in 3-D: SkeletonView
//   arboc/animation                                 a motion over time, from JSON
// Modules and data travel as one JSON text, in which nothing can end the element around it: names
// may hold anything, also </script>.  docs/pages.md describes the page, the modules and the format
// of motions.
#ifndef ARBOC_PAGE_PAGE_HPP
#define ARBOC_PAGE_PAGE_HPP

#include <map>
#include <string>

namespace arboc {
namespace page {

struct Page {
  std::string title;  ///< any text
  std::string style;  ///< CSS behind that of all pages
  std::string body;   ///< HTML
  /// ES modules beside those at hand: name -> text.
  std::map<std::string, std::string> modules;
  std::string main;  ///< name of the module that runs
  /// JSON by name: what `window.arboc.data` holds in scripts.
  std::map<std::string, std::string> data;
};

/// The whole file.
std::string write(const Page& page);

/// A page that plays a motion, JSON text as docs/pages.md has it.
std::string animation(const std::string& title, const std::string& motion);

/// Text as HTML, also between quotes.
std::string html(const std::string& text);

}  // namespace page
}  // namespace arboc

#endif
