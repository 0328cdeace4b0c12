#include "fuzz/markup_mutator.h"

#include <random>
#include <vector>

namespace arboc::fuzz {
namespace {

struct Span {
  size_t begin = 0, end = 0;
  size_t size() const { return end - begin; }
};

struct Attribute {
  Span all, name, value;  ///< value without its quotes
};

constexpr const char* kValues[] = {
    "",      "0",        "-0",         "1",         "-1",         "1e308",    "1e309",    "5e-324",
    "1e400", "nan",      "inf",        "0x1p3",     "1,5",        "+1",       " 1 ",      "1 2",
    "1 0 0", "0 0 0",    "0 0 1",      "1 1 1",     "1e-200 0 0", "\xD9\xA1", "1d0",      "pi",
    "${x}",  "%s%n",     "world",      "a",         "\xC3\xA9",   "&#10;",    "&#65;",    "&amp;",
    "fixed", "revolute", "continuous", "prismatic", "planar",     "floating", "spherical"};
constexpr const char* kNames[] = {"name",     "type",       "link",   "xyz", "rpy", "value",
                                  "joint",    "lower",      "upper",  "ixx", "izz", "effort",
                                  "velocity", "multiplier", "offset", "nmae"};
constexpr const char* kElements[] = {
    "<link name=\"z\"/>",
    "<axis xyz=\"0 0 1\"/>",
    "<mimic joint=\"a\"/>",
    "<mass value=\"1\"/>",
    "<limit effort=\"1\" velocity=\"1\" lower=\"0\" upper=\"1\"/>",
    "<origin rpy=\"0 0 1.57\"/>",
    "<inertial/>",
    "<gazebo/>",
    "<jiont/>",
    "<![CDATA[x]]>",
    "<!-- -->",
    "<dynamics damping=\"1\"/>",
    "<joint name=\"y\" type=\"fixed\"><parent link=\"a\"/><child link=\"z\"/></joint>"};

class Mutator {
 public:
  Mutator(const std::string& text, std::uint64_t seed) : text_(text), random_(seed) { scan(); }

  std::string run() {
    switch (random_() % 8) {
      case 0: return without(some(elements_));
      case 1: return inserted(place(), text_of(some(elements_)));
      case 2: return swapped();
      case 3: return inserted(place(), pick(kElements));
      case 4: return attributes_.empty() ? text_ : without(some(attributes_).all);
      case 5: {
        if (attributes_.empty()) return text_;
        const Attribute& a = some(attributes_);
        return replaced(a.name, pick(kNames));
      }
      default: {
        if (attributes_.empty()) return text_;
        const Span to = some(attributes_).value, from = some(attributes_).value;
        return replaced(to, random_() % 2 ? text_of(from) : std::string(pick(kValues)));
      }
    }
  }

 private:
  /// Elements from their start tag to their end tag, and the attributes of all.
  void scan() {
    std::vector<size_t> open;
    for (size_t at = text_.find('<'); at != std::string::npos; at = text_.find('<', at + 1)) {
      const size_t end = text_.find('>', at);
      if (end == std::string::npos) break;
      if (text_[at + 1] == '/') {
        if (open.empty()) continue;
        elements_.push_back({open.back(), end + 1});
        open.pop_back();
      } else if (text_[at + 1] != '!' && text_[at + 1] != '?') {
        attributes({at, end});
        if (text_[end - 1] == '/')
          elements_.push_back({at, end + 1});
        else
          open.push_back(at);
      }
    }
  }

  void attributes(Span tag) {
    for (size_t equals = text_.find('=', tag.begin); equals < tag.end;
         equals = text_.find('=', equals + 1)) {
      const char quote = equals + 1 < tag.end ? text_[equals + 1] : ' ';
      if (quote != '"' && quote != '\'') continue;
      const size_t close = text_.find(quote, equals + 2);
      const size_t begin = text_.find_last_of(" \t\n", equals);
      if (close == std::string::npos || close > tag.end || begin == std::string::npos ||
          begin < tag.begin)
        continue;
      attributes_.push_back({{begin, close + 1}, {begin + 1, equals}, {equals + 2, close}});
      equals = close;
    }
  }

  template <class T>
  T some(const std::vector<T>& list) {
    return list.empty() ? T() : list[random_() % list.size()];
  }
  template <size_t n>
  const char* pick(const char* const (&list)[n]) {
    return list[random_() % n];
  }
  std::string text_of(Span span) const { return text_.substr(span.begin, span.size()); }
  /// Before some element or end tag.
  size_t place() {
    const Span element = some(elements_);
    return random_() % 2 ? element.begin : element.end;
  }
  std::string without(Span span) const { return replaced(span, ""); }
  std::string inserted(size_t at, const std::string& piece) const {
    return text_.substr(0, at) + piece + text_.substr(at);
  }
  std::string replaced(Span span, const std::string& by) const {
    return text_.substr(0, span.begin) + by + text_.substr(span.end);
  }
  std::string swapped() {
    Span a = some(elements_), b = some(elements_);
    if (a.begin > b.begin) std::swap(a, b);
    if (a.end > b.begin) return text_;
    return text_.substr(0, a.begin) + text_of(b) + text_.substr(a.end, b.begin - a.end) +
           text_of(a) + text_.substr(b.end);
  }

  const std::string& text_;
  std::mt19937_64 random_;
  std::vector<Span> elements_;
  std::vector<Attribute> attributes_;
};

}  // namespace

std::string mutate_markup(const std::string& text, std::uint64_t seed) {
  return Mutator(text, seed).run();
}

}  // namespace arboc::fuzz
