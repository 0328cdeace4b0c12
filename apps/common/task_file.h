// Task files: TOML, each over the one that it names as its `base`; values by key, with complaints
// that say where.
#pragma once
#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>
#include <Eigen/Core>
#include <array>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace study {

/// What is wrong with a task file: PATH:LINE:COLUMN: error: ...
struct TaskError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The file over the one that its key `base` names, beside it: tables are merged, lists of tables
/// by the `name` of their entries, others replaced.  Throws TaskError.
toml::table read_document(const std::string& path);
/// The same of a table in such a document, whose `base` is beside the file that says so.
toml::table over_base(toml::table own);

/// Throws TaskError: PATH:LINE:COLUMN: error: ...
[[noreturn]] void fail(const toml::source_region& where, const std::string& message);
[[noreturn]] void fail(const toml::node& at, const std::string& message);

class Table {
 public:
  static constexpr double kMostFrames = 10000;  ///< a second

  Table(const toml::table& table, std::string what) : table_(table), what_(std::move(what)) {}

  bool has(const char* key) const { return table_.contains(key); }
  const toml::node* find(const char* key);
  const toml::table& raw() const { return table_; }

  std::string text(const char* key);  ///< must be there
  std::string text(const char* key, std::string otherwise);
  double number(const char* key, double otherwise);
  int whole(const char* key, int otherwise, int least);
  bool flag(const char* key, bool otherwise);
  double rate(double otherwise);  ///< `rate`: frames a second, at most kMostFrames
  Eigen::Vector3d vector(const char* key);
  Eigen::Vector3d vector(const char* key, const Eigen::Vector3d& otherwise);
  /// Three numbers (fixed) or pairs of limits.
  std::array<std::array<double, 2>, 3> limits(const char* key);
  /// Tables in a list; none where there is no key.
  std::vector<Table> tables(const char* key);
  std::optional<Table> table(const char* key);

  /// Keys that nothing asked for are mistakes.
  void finish() const;
  [[noreturn]] void fail(const std::string& message) const;
  /// At the value of a key, if it is there: tables may be merged from several files.
  [[noreturn]] void fail_at(const char* key, const std::string& message) const;

 private:
  const toml::table& table_;
  std::string what_;
  std::set<std::string> known_;
};

double number_of(const toml::node& node, const std::string& what);
Eigen::Vector3d vector_of(const toml::node& node, const std::string& what);

}  // namespace study
