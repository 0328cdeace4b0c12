// The proof: every function and derivative, for every type of joint and both bases, against the
// reference engine, identities between functions, and differences; published in docs/coverage.md.
#include <gtest/gtest.h>

#include <algorithm>

#include "differential/proof_measure.h"
#include "differential/proof_table.h"

namespace arboc::test {
namespace {

constexpr Base kBases[] = {Base::kFixed, Base::kFloating};

/// A table on its way; numbers the reasons of gaps.
class Tabulation {
 public:
  explicit Tabulation(const std::string& name) {
    table_.name = name;
    table_.heads = {"function", "order", "identities", "others", "differences"};
    for (const Kind& kind : kinds()) table_.heads.emplace_back(kind.name);
  }

  void add(const Row& row) {
    SCOPED_TRACE(row.label());
    TableRow line;
    std::vector<std::string> identities;
    TableEntry differences{{std::nullopt}, ""};
    for (const Kind& kind : kinds()) {
      TableEntry& entry = line.entries.emplace_back();
      for (const Base base : kBases) {
        const Measured m = measure(row, kind, base);
        for (const std::string& text : m.wrong)
          ADD_FAILURE() << kind.name << (base == Base::kFixed ? ", fixed: " : ", floating: ")
                        << text;
        for (const std::string& text : m.identities)
          if (std::find(identities.begin(), identities.end(), text) == identities.end())
            identities.push_back(text);
        if (m.differences)
          differences.errors[0] = std::max(differences.errors[0].value_or(0), *m.differences);
        entry.errors.push_back(m.exact());
        if (!m.gap.empty()) entry.gap = "gap [" + std::to_string(note(m.gap)) + "]";
      }
    }
    line.entries.insert(line.entries.begin(), differences);
    line.words = {row.label(), std::to_string(row.order()), listed(identities),
                  row.others().empty() ? "-" : row.others()};
    table_.rows.push_back(std::move(line));
  }

  const CoverageTable& table() const { return table_; }

 private:
  size_t note(const std::string& text) {
    auto& notes = table_.notes;
    const auto at = std::find(notes.begin(), notes.end(), text);
    if (at != notes.end()) return static_cast<size_t>(at - notes.begin()) + 1;
    notes.push_back(text);
    return notes.size();
  }

  static std::string listed(const std::vector<std::string>& identities) {
    std::string all;
    for (const std::string& text : identities) all += (all.empty() ? "" : "; ") + text;
    return all.empty() ? "-" : all;
  }

  CoverageTable table_;
};

void prove(const std::string& name, const std::vector<Row>& rows) {
  Tabulation tabulation(name);
  for (const Row& row : rows) tabulation.add(row);
  expect_committed(tabulation.table());
}

TEST(Proof, Functions) { prove("functions", function_rows()); }
TEST(Proof, Jacobians) { prove("jacobians", jacobian_rows()); }
TEST(Proof, Samples) { prove("samples", sample_rows()); }
TEST(Proof, Options) { prove("options", option_rows()); }

}  // namespace
}  // namespace arboc::test
