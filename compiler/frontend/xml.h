// XML text -> elements with places, in file order.
//
// expat does the parsing: it is conforming, so what is not well-formed is refused.  On top of that
// a document may not declare entities or refer to other files, nests at most kMaxDepth deep, and
// has at most kMaxItems elements and attributes, which bounds the time that a hostile file takes.
#pragma once
#include <string_view>
#include <vector>

#include "model/findings.h"

namespace arboc {

constexpr int kMaxDepth = 128;
constexpr size_t kMaxItems = 2000000;
constexpr size_t kMaxAttributes = 100000;  // of one element

struct XmlAttribute {
  std::string_view name;
  std::string_view value;
  Location where;
};

/// Receives the events of a document.  Views are valid during the call only.
class XmlHandler {
 public:
  virtual ~XmlHandler() = default;
  virtual void start(std::string_view name, const std::vector<XmlAttribute>& attributes,
                     Location where) = 0;
  virtual void end(Location where) = 0;
  /// A piece of character data that is not blank; long text comes in several pieces.
  virtual void text(std::string_view piece, Location where) = 0;
  /// Asked after each element's start: whether reading on is of no use.
  virtual bool stopped() const = 0;
};

/// Reads the whole of `text`.  Returns false if the end was not reached: the text is not
/// well-formed or refused, which is reported, or the handler stopped.
bool read_xml(std::string_view text, XmlHandler& handler, Findings& findings);

}  // namespace arboc
