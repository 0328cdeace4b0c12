#include "frontend/xml.h"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

namespace arboc {
namespace {

/// Line and column of byte offsets that mostly ascend: each byte is looked at once.
class Locator {
 public:
  explicit Locator(std::string_view text) : text_(text) {}

  Location at(size_t offset) {
    if (offset < line_start_) *this = Locator(text_);
    for (; next_ < offset && next_ < text_.size(); ++next_) {
      const bool lone_return =
          text_[next_] == '\r' && (next_ + 1 == text_.size() || text_[next_ + 1] != '\n');
      if (text_[next_] != '\n' && !lone_return) continue;
      ++line_;
      line_start_ = next_ + 1;
    }
    return {line_, static_cast<int>(offset - line_start_) + 1};
  }

 private:
  std::string_view text_;
  size_t next_ = 0;  // the first byte not looked at
  size_t line_start_ = 0;
  int line_ = 1;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

class Reader {
 public:
  Reader(std::string_view text, XmlHandler& handler, Findings& findings)
      : text_(text),
        handler_(handler),
        findings_(findings),
        locator_(text),
        parser_(XML_ParserCreate(nullptr), &XML_ParserFree) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const char* name, const char** attributes) {
          static_cast<Reader*>(self)->start(name, attributes);
        },
        [](void* self, const char*) { static_cast<Reader*>(self)->end(); });
    XML_SetCharacterDataHandler(parser_.get(), [](void* self, const char* piece, int length) {
      static_cast<Reader*>(self)->text({piece, static_cast<size_t>(length)});
    });
    XML_SetStartDoctypeDeclHandler(
        parser_.get(),
        [](void* self, const char* name, const char* system, const char* pub, int subset) {
          static_cast<Reader*>(self)->doctype(name, system != nullptr || pub != nullptr || subset);
        });
  }

  bool run() {
    if (text_.find_first_not_of(" \t\r\n") == std::string_view::npos)
      return refuse({1, 1}, "the file is empty", "");
    if (is_utf16())
      return refuse({1, 1}, "the encoding is UTF-16 or UTF-32", "save the file as UTF-8");
    if (const size_t tag = overlong_tag(); tag < text_.size())
      return refuse(locator_.at(tag), "an element has too many attributes",
                    fmt::format("the limit is {}", kMaxAttributes));
    const auto status =
        XML_Parse(parser_.get(), text_.data(), static_cast<int>(text_.size()), XML_TRUE);
    if (status == XML_STATUS_ERROR && XML_GetErrorCode(parser_.get()) != XML_ERROR_ABORTED)
      report_malformed();
    return status == XML_STATUS_OK;
  }

 private:
  bool refuse(Location where, std::string message, std::string hint) {
    findings_.error({where, "", std::move(message), std::move(hint)});
    return false;
  }

  void stop() {
    stopped_ = true;  // expat may still send the end of the element at hand
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  bool is_utf16() const {
    const std::string_view head = text_.substr(0, 4);
    return head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF") ||
           (head.find('\0') != std::string_view::npos && head.find('<') != std::string_view::npos);
  }

  /// The first tag that may have more than kMaxAttributes attributes, or the end of the text. expat
  /// would store them all, and slowly, before anyone is asked.
  size_t overlong_tag() const {
    constexpr size_t kShortestAttribute = 5;  // a=""
    size_t next = 0;
    for (size_t tag = text_.find('<'); tag < text_.size(); tag = next) {
      next = std::min(text_.find('<', tag + 1), text_.size());
      if (next - tag < kMaxAttributes * kShortestAttribute || text_.substr(tag, 2) == "<!")
        continue;
      const std::string_view piece = text_.substr(tag, next - tag);
      if (std::count(piece.begin(), piece.end(), '=') > static_cast<long>(kMaxAttributes))
        return tag;
    }
    return text_.size();
  }

  size_t offset() const {
    const XML_Index index = XML_GetCurrentByteIndex(parser_.get());
    return index < 0 ? 0 : static_cast<size_t>(index);
  }

  Location here() { return locator_.at(offset()); }

  /// Places of the attributes of the start tag at `tag`, which expat has found well-formed.
  void locate_attributes(size_t tag) {
    size_t i = tag;
    const auto skip_blanks = [&] {
      while (i < text_.size() && is_blank(text_[i])) ++i;
    };
    while (i < text_.size() && !is_blank(text_[i])) ++i;
    for (XmlAttribute& attribute : attributes_) {
      skip_blanks();
      attribute.where = locator_.at(i);
      i = text_.find_first_of("\"'", i);
      if (i != std::string_view::npos) i = text_.find(text_[i], i + 1);
      if (i == std::string_view::npos) return;
      ++i;
    }
  }

  void start(const char* name, const char** attributes) {
    const size_t tag = offset();
    const Location where = locator_.at(tag);
    if (++depth_ > kMaxDepth) {
      refuse(where, fmt::format("elements are nested too deep: the limit is {}", kMaxDepth), "");
      stop();
      return;
    }
    attributes_.clear();
    for (; *attributes != nullptr && items_ + attributes_.size() < kMaxItems; attributes += 2)
      attributes_.push_back({attributes[0], attributes[1], where});
    items_ += 1 + attributes_.size();
    if (items_ > kMaxItems) {
      refuse(where, "the document has too many elements and attributes",
             fmt::format("the limit is {}", kMaxItems));
      stop();
      return;
    }
    if (!attributes_.empty()) locate_attributes(tag);
    handler_.start(name, attributes_, where);
    if (handler_.stopped()) stop();
  }

  void end() {
    if (stopped_) return;
    --depth_;
    handler_.end(here());
  }

  void text(std::string_view piece) {
    if (!stopped_ && piece.find_first_not_of(" \t\r\n") != std::string_view::npos)
      handler_.text(piece, here());
  }

  void doctype(std::string_view name, bool declares) {
    if (name != "robot") {
      refuse(here(), fmt::format("the document type is {}, not 'robot'", quoted(name)),
             "this is not a URDF file");
      stop();
    } else if (declares) {
      refuse(here(), "DOCTYPE with declarations or an external file: XML entities are not read",
             "remove the DOCTYPE");
      stop();
    }
  }

  void report_malformed() {
    const XML_Error code = XML_GetErrorCode(parser_.get());
    Location where = here();
    std::string hint;
    switch (code) {
      case XML_ERROR_NO_ELEMENTS:
        where = locator_.at(text_.size());
        hint = depth_ > 0 ? "the file ends before its elements are closed" : "";
        break;
      case XML_ERROR_INVALID_TOKEN: hint = hint_for_invalid_token(); break;
      case XML_ERROR_TAG_MISMATCH: hint = "the closing tag is " + token_here(); break;
      case XML_ERROR_UNDEFINED_ENTITY: hint = "only &lt; &gt; &amp; &quot; &apos; are known"; break;
      case XML_ERROR_JUNK_AFTER_DOC_ELEMENT: hint = "nothing may follow </robot>"; break;
      case XML_ERROR_UNKNOWN_ENCODING:
      case XML_ERROR_INCORRECT_ENCODING: hint = "save the file as UTF-8"; break;
      default: break;
    }
    const size_t first = text_.find_first_not_of(" \t\r\n");
    if (hint.empty() && depth_ == 0 && text_.substr(first, 1) != "<" &&
        text_.substr(first, 3) != "\xEF\xBB\xBF")
      hint = "the file does not begin with '<'";
    const char* what = code == XML_ERROR_INVALID_TOKEN ? "invalid token" : XML_ErrorString(code);
    refuse(where, fmt::format("not well-formed XML: {}", what), std::move(hint));
  }

  /// "</inertia>" where expat stands at the name, cut to a readable length.
  std::string token_here() const {
    const std::string_view token = text_.substr(offset(), 60);
    return fmt::format("</{}>", token.substr(0, token.find('>')));
  }

  std::string hint_for_invalid_token() const {
    const size_t i = offset();
    const unsigned char c = i < text_.size() ? static_cast<unsigned char>(text_[i]) : ' ';
    if (c == 0) return "a NUL byte";
    if (c >= 0x80) return "bytes that are not UTF-8";
    if (c < 0x20 && !is_blank(text_[i])) return "a control character";
    if (i >= 2 && text_.substr(i - 2, 2) == "--") return "'--' cannot stand inside a comment";
    if (i > 0 && text_[i - 1] == '=') return "write attribute values between quotes";
    return "";
  }

  std::string_view text_;
  XmlHandler& handler_;
  Findings& findings_;
  Locator locator_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::vector<XmlAttribute> attributes_;
  size_t items_ = 0;  // elements and attributes so far
  int depth_ = 0;
  bool stopped_ = false;
};

}  // namespace

bool read_xml(std::string_view text, XmlHandler& handler, Findings& findings) {
  return Reader(text, handler, findings).run();
}

}  // namespace arboc
