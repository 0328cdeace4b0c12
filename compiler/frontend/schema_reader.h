// XML events -> checked elements: every element and attribute is looked up in the schema.
//
// Unknown words are named with the word that was probably meant; required attributes, single
// elements and numbers are checked here, what they mean in builder.h.  Memory is bounded by the
// depth of the document.
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/builder.h"
#include "frontend/xml.h"

namespace arboc {

class SchemaReader : public XmlHandler {
 public:
  SchemaReader(ModelBuilder& builder, Findings& findings)
      : builder_(builder), findings_(findings) {}

  void start(std::string_view name, const std::vector<XmlAttribute>& attributes,
             Location where) override;
  void end(Location where) override;
  void text(std::string_view piece, Location where) override;
  bool stopped() const override { return stopped_ || builder_.stopped() || findings_.full(); }

 private:
  static constexpr size_t kMostWords = 100;  // unknown ones that are looked into

  /// An open element.
  struct Frame {
    const ElementSpec* spec = nullptr;  // nothing: its inside is skipped
    Severity severity = Severity::kError;
    unsigned seen = 0;  // children that may stand once, by bit
    bool text_reported = false;
  };

  void start_root(std::string_view name, const std::vector<XmlAttribute>& attributes,
                  Location where);
  const ElementSpec* find_child(std::string_view name, Location where);
  void unknown_element(std::string_view name, Location where);
  bool is_repeated(const ElementSpec& spec, Location where);
  void open(const ElementSpec& spec, const std::vector<XmlAttribute>& attributes, Location where);
  void read_attribute(const XmlAttribute& attribute, Severity severity, Element& element);
  void unknown_attribute(const XmlAttribute& attribute, Severity severity, const Element& element);
  void check_required(Severity severity, const Element& element);
  std::string meant_by(std::string_view word, const std::vector<std::string_view>& known);
  bool is_news(std::string word);
  std::string path() const;
  void report(Severity severity, Finding finding) {
    findings_.report(severity, std::move(finding));
  }

  ModelBuilder& builder_;
  Findings& findings_;
  std::vector<Frame> frames_;
  std::string owner_;  // "joint 'elbow'"
  size_t unknown_words_ = 0;
  std::set<std::string> told_;  // unknown words that have been reported
  bool stopped_ = false;
};

}  // namespace arboc
