#include "frontend/schema_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/words.h"
#include "frontend/values.h"

namespace arboc {
namespace {

template <class Items>
std::vector<std::string_view> names_of(const Items& items) {
  std::vector<std::string_view> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

/// What a document with another root is, in the user's terms.
std::string other_format(std::string_view root) {
  if (root == "sdf") return "this is an SDFormat file, not URDF";
  if (root == "mujoco") return "this is an MJCF (MuJoCo) file, not URDF";
  if (equal_but_for_case(root, "html")) return "this is an HTML page, not URDF";
  if (equal_but_for_case(root, "robot")) return "element names are case sensitive";
  return "this is not a URDF file";
}

/// "<name>", the user's text cut to a readable length.
std::string bracketed(std::string_view name) {
  const std::string text = quoted(name);
  return fmt::format("<{}>", std::string_view(text).substr(1, text.size() - 2));
}

}  // namespace

void SchemaReader::start(std::string_view name, const std::vector<XmlAttribute>& attributes,
                         Location where) {
  if (frames_.empty()) return start_root(name, attributes, where);
  const ElementSpec* spec = frames_.back().spec ? find_child(name, where) : nullptr;
  if (spec == nullptr) {
    frames_.emplace_back();
    return;
  }
  if (spec->use != Use::kRead && frames_.back().spec->use == Use::kRead)
    builder_.ignore(fmt::format("<{}>", spec->name));
  if (spec->use == Use::kSkipped || is_repeated(*spec, where))
    frames_.emplace_back();
  else
    open(*spec, attributes, where);
}

void SchemaReader::start_root(std::string_view name, const std::vector<XmlAttribute>& attributes,
                              Location where) {
  if (name == robot_schema().name) {
    owner_ = "robot";
    return open(robot_schema(), attributes, where);
  }
  findings_.error({where, "",
                   fmt::format("the document element is {}, not <robot>", bracketed(name)),
                   other_format(name)});
  stopped_ = true;
}

const ElementSpec* SchemaReader::find_child(std::string_view name, Location where) {
  for (const ElementSpec& child : frames_.back().spec->children)
    if (name == child.name) return &child;
  unknown_element(name, where);
  return nullptr;
}

void SchemaReader::unknown_element(std::string_view name, Location where) {
  const Frame& parent = frames_.back();
  const std::string shown = bracketed(name);
  const auto tell = [&](Severity severity, const std::string& message, const std::string& hint) {
    report(severity, {where, owner_, path() + message, hint});
  };
  if (name.starts_with("xacro:")) {
    if (is_news("xacro"))
      tell(Severity::kError, shown + " is not expanded", "run xacro on the file first");
    return;
  }
  if (name.find(':') != std::string_view::npos) return builder_.ignore(shown);
  if (name == robot_schema().name)
    return tell(Severity::kError, "<robot> nested in another element",
                "one file holds one <robot>");

  const std::string meant = meant_by(name, names_of(parent.spec->children));
  const char* home = home_of(name);
  if (equal_but_for_case(name, meant)) {
    tell(parent.severity, fmt::format("unknown element {}", shown),
         fmt::format("names are case sensitive: write <{}>", meant));
  } else if (!meant.empty()) {
    tell(Severity::kWarning, fmt::format("unknown element {} is ignored", shown),
         fmt::format("did you mean <{}>?", meant));
  } else if (home != nullptr) {
    tell(Severity::kWarning,
         fmt::format("{} does not belong in <{}> and is ignored", shown, parent.spec->name),
         fmt::format("it belongs in <{}>", home));
  } else if (is_news(fmt::format("<{}><{}>", parent.spec->name, name))) {
    tell(Severity::kWarning, fmt::format("unknown element {} is ignored", shown),
         "it is not part of URDF");
  } else {
    builder_.ignore(shown);
  }
}

bool SchemaReader::is_repeated(const ElementSpec& spec, Location where) {
  Frame& parent = frames_.back();
  const unsigned bit = 1u << (&spec - parent.spec->children.data());
  if (spec.repeats || (parent.seen & bit) == 0) {
    parent.seen |= bit;
    return false;
  }
  if (spec.tag == Tag::kParent || spec.tag == Tag::kChild) builder_.forget_ends();
  const Severity severity =
      builder_.uses(spec.tag) && spec.use == Use::kRead ? parent.severity : Severity::kWarning;
  report(severity, {where, owner_, path() + fmt::format("a second <{}>", spec.name),
                    fmt::format("<{}> has one", parent.spec->name)});
  return true;
}

void SchemaReader::open(const ElementSpec& spec, const std::vector<XmlAttribute>& attributes,
                        Location where) {
  const bool is_part = frames_.size() > 1;  // of a link or joint
  Element element;
  element.spec = &spec;
  element.where = where;
  element.parent = frames_.empty() ? Tag::kOther : frames_.back().spec->tag;
  Frame frame;
  frame.spec = &spec;
  frame.severity = frames_.empty() ? Severity::kError : frames_.back().severity;
  if (spec.use != Use::kRead) frame.severity = Severity::kWarning;
  if (is_part && element.parent == Tag::kJoint && spec.use == Use::kRead &&
      !builder_.uses(spec.tag)) {
    frame.severity = Severity::kWarning;
    if (spec.tag != Tag::kMimic)  // has a warning of its own
      builder_.ignore(fmt::format("<{}> of {} joints", spec.name, builder_.joint_type()));
  }
  if (!is_part && (spec.tag == Tag::kLink || spec.tag == Tag::kJoint)) {
    const auto name = std::find_if(attributes.begin(), attributes.end(),
                                   [](const XmlAttribute& a) { return a.name == "name"; });
    owner_ = named(spec.name, name == attributes.end() ? "" : name->value);
  } else if (!is_part) {
    owner_ = "robot";
  }
  frames_.push_back(frame);
  element.owner = owner_;
  element.path = path();
  for (const XmlAttribute& attribute : attributes)
    read_attribute(attribute, frame.severity, element);
  check_required(frame.severity, element);
  if (spec.use == Use::kRead) builder_.start(element);
}

void SchemaReader::read_attribute(const XmlAttribute& attribute, Severity severity,
                                  Element& element) {
  if (attribute.name == "xmlns" || attribute.name.find(':') != std::string_view::npos) return;
  const auto& specs = element.spec->attributes;
  size_t i = 0;
  while (i < specs.size() && specs[i].name != attribute.name) ++i;
  if (i == specs.size()) return unknown_attribute(attribute, severity, element);

  AttributeValue& value = element.values[i];
  value.present = value.valid = true;
  value.text = attribute.value;
  value.where = attribute.where;
  if (specs[i].value == Value::kText) return;
  Numbers numbers = parse_numbers(attribute.value, specs[i].value);
  value.number = numbers.value;
  value.valid = numbers.fault.empty();
  if (!value.valid)
    report(severity,
           element.fault(attribute.where, fmt::format("{}: {}", attribute.name, numbers.fault),
                         std::move(numbers.hint)));
}

void SchemaReader::unknown_attribute(const XmlAttribute& attribute, Severity severity,
                                     const Element& element) {
  const std::string message = fmt::format("unknown attribute {}", quoted(attribute.name));
  const std::string meant = meant_by(attribute.name, names_of(element.spec->attributes));
  if (equal_but_for_case(attribute.name, meant)) {
    report(severity, element.fault(attribute.where, message,
                                   fmt::format("names are case sensitive: write '{}'", meant)));
  } else if (!meant.empty()) {
    report(Severity::kWarning, element.fault(attribute.where, message + " is ignored",
                                             fmt::format("did you mean '{}'?", meant)));
  } else if (is_news(fmt::format("<{} {}>", element.spec->name, attribute.name))) {
    report(Severity::kWarning,
           element.fault(attribute.where, message + " is ignored", "it is not part of URDF"));
  } else {
    builder_.ignore(fmt::format("{} of <{}>", quoted(attribute.name), element.spec->name));
  }
}

void SchemaReader::check_required(Severity severity, const Element& element) {
  for (size_t i = 0; i < element.spec->attributes.size(); ++i) {
    const AttributeSpec& spec = element.spec->attributes[i];
    if (spec.required && !element.values[i].present)
      report(severity,
             element.fault(element.where, fmt::format("{} is missing", spec.name),
                           fmt::format("write <{} {}=\"...\">", element.spec->name, spec.name)));
  }
}

/// The known word that `word` stands for: beyond many unknown words only by its letters' case.
std::string SchemaReader::meant_by(std::string_view word,
                                   const std::vector<std::string_view>& known) {
  for (const std::string_view candidate : known)
    if (equal_but_for_case(word, candidate)) return std::string(candidate);
  return ++unknown_words_ <= kMostWords ? nearest(word, known) : "";
}

/// Whether `word` is met for the first time; after many words nothing is.
bool SchemaReader::is_news(std::string word) {
  return told_.size() < kMostWords && told_.insert(std::move(word)).second;
}

/// "<inertial>: <mass>: ": the way from the link or joint to the element at hand.
std::string SchemaReader::path() const {
  std::string out;
  for (size_t i = 1; i < frames_.size(); ++i) {
    const Tag tag = frames_[i].spec->tag;
    if (tag != Tag::kLink && tag != Tag::kJoint)
      out += fmt::format("<{}>: ", frames_[i].spec->name);
  }
  return out;
}

void SchemaReader::end(Location where) {
  if (frames_.empty()) return;
  const ElementSpec* spec = frames_.back().spec;
  frames_.pop_back();
  if (spec != nullptr && spec->use == Use::kRead) builder_.end(spec->tag, where);
  if (frames_.size() == 1) owner_ = "robot";
}

void SchemaReader::text(std::string_view piece, Location where) {
  if (frames_.empty() || frames_.back().spec == nullptr || frames_.back().text_reported) return;
  frames_.back().text_reported = true;
  report(Severity::kWarning,
         {where, owner_, path() + fmt::format("text {} is ignored", quoted(piece)),
          "URDF writes values as attributes"});
}

}  // namespace arboc
