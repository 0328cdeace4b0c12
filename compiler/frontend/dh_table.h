// One table of a DH file, read key by key: wrong types and unknown keys are reported with the word
// that was probably meant.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/dh_document.h"
#include "frontend/dh_expression.h"
#include "spatial/matrix3.h"

namespace arboc {

/// Where findings about one of the files go.
struct DhReport {
  Findings& findings;
  std::string file{};  ///< shown in place of the model file's path; empty: that one

  void error(Location where, const std::string& element, std::string message,
             std::string hint = {}) const {
    findings.error({where, element, std::move(message), std::move(hint), file});
  }
  void warning(Location where, const std::string& element, std::string message,
               std::string hint = {}) const {
    findings.warning({where, element, std::move(message), std::move(hint), file});
  }
};

/// The units of numbers in one file.  Divisors, as 26.08 / 100 is rounded once.
struct DhUnits {
  double length = 1;  ///< units in a metre
  bool degrees = false;
  double mass = 1;     ///< units in a kilogram
  double inertia = 1;  ///< units in kg m^2

  /// In rad; multiples of 15 degrees exactly rounded.
  double angle(double written) const;
};

class DhTable {
 public:
  /// `element` as in "row 'z12'"; `value` may be anything, what is not a table is reported.
  DhTable(const DhValue& value, std::string element, const DhReport& report);

  bool is_table() const { return value_.kind == DhValue::Kind::kTable; }
  const std::string& element() const { return element_; }
  Location where() const { return value_.where; }
  const DhReport& report() const { return report_; }

  /// The value called `key`, which from now on is a known one; nothing if there is none.
  const DhValue* find(const char* key);
  bool has(const char* key) const;
  Location where(const char* key) const;

  std::optional<std::string> text(const char* key);
  std::optional<bool> flag(const char* key);
  std::optional<double> number(const char* key);
  /// As many numbers as `count`.
  std::optional<std::vector<double>> numbers(const char* key, size_t count);
  /// One of the words; its index.
  std::optional<size_t> word(const char* key, const std::vector<std::string_view>& words);
  std::optional<std::vector<std::string>> texts(const char* key);

  /// Says that a key has no place here, unless it was asked for before.
  void unknown_keys();

  void error(const char* key, std::string message, std::string hint = {}) const;

 private:
  const DhValue& value_;
  std::string element_;
  const DhReport& report_;
  std::vector<std::string_view> known_;
};

/// A finite number; otherwise reported ("about" is "d: " or empty), and nothing.
std::optional<double> finite_number(const DhValue& value, const std::string& element,
                                    const std::string& about, const DhReport& report);

/// xyz, rpy and rotation of a table: the part that says how something is turned.  `rpy` in the
/// file's unit of angles, about the fixed axes; `rotation` three rows of an orthonormal matrix.
struct DhTurn {
  Vector3<double> rpy{};
  Matrix3<double> turn = Matrix3<double>::identity();
};
DhTurn read_turn(DhTable& table, const DhUnits& units);

}  // namespace arboc
