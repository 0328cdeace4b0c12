// TOML text -> a tree of values with places, in file order.
//
// The only file that knows toml++ is dh_document.cc: everything else of the DH front end reads
// this tree.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/findings.h"

namespace arboc {

/// DH files are small: 20 000 rows have some 2 MiB.
constexpr size_t kMaxDhBytes = size_t{8} << 20;

/// A value of a TOML document.
struct DhValue {
  enum class Kind { kText, kNumber, kFlag, kList, kTable, kOther };
  struct Entry;

  Kind kind = Kind::kOther;
  Location where{};
  std::string text{};  ///< of kText; of other plain values as the file spells them
  double number = 0;
  bool flag = false;
  std::vector<DhValue> items{};  ///< of kList
  std::vector<Entry> entries;    ///< of kTable, in file order; without {}: Entry is incomplete here

  /// "a number", "a list", ...
  const char* kind_name() const;
};

struct DhValue::Entry {
  std::string key;
  Location where{};
  DhValue value{};
};

/// The document, a kTable.  Nothing if it is not well-formed TOML, or too large, which is reported.
std::optional<DhValue> read_toml(std::string_view text, Findings& findings);

}  // namespace arboc
