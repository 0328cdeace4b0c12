// The corpus of broken and strange files: each gets the answer it deserves, at the right line.
#include <gtest/gtest.h>
#include <regex.h>

#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "frontend/read_model.h"
#include "support/manifest.h"
#include "support/urdf_text.h"

namespace arboc::test {
namespace {

constexpr const char* kCorpus = ARBOC_SOURCE_DIR "/../shared/bad-input/";
constexpr double kMostSeconds = 2;  // of processor time: machines are shared

/// Files that the corpus leaves out because of their size.
const std::map<std::string, std::function<std::string()>> kGenerated = {
    {"A20", [] { return repeated("<a>", 200000); }},
    {"J05", [] { return chain_text(5000); }},
    {"J09", [] { return frames_text(10000); }},
};

std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

bool found(const std::string& pattern, const std::string& text) {
  regex_t regex;
  if (::regcomp(&regex, pattern.c_str(), REG_EXTENDED | REG_ICASE | REG_NOSUB) != 0) return false;
  const bool matches = ::regexec(&regex, text.c_str(), 0, nullptr, 0) == 0;
  ::regfree(&regex);
  return matches;
}

/// Each of the expressions, separated by ";;", matches somewhere.
void expect_named(const std::string& must_name, const std::string& messages) {
  size_t begin = 0;
  while (begin <= must_name.size()) {
    const size_t end = std::min(must_name.find(";;", begin), must_name.size());
    EXPECT_TRUE(found(must_name.substr(begin, end - begin), messages))
        << must_name << " is not in:\n"
        << messages;
    begin = end + 2;
  }
}

void expect_size(const Row& row, const Reading& reading) {
  Diagnostics ignored;
  const Model model = configure(*reading.model, {}, ignored);
  if (!row.at("nv").empty()) {
    EXPECT_EQ(coordinates(model).nv, std::stoi(row.at("nv")));
  }
  if (!row.at("links").empty()) {
    EXPECT_EQ(model.links.size(), std::stoul(row.at("links")));
  }
}

/// Whether the first error, or the first warning if there is none, is at the line of the offence.
void expect_answer(const Row& row, const Reading& reading) {
  const std::string& right = row.at("right");
  EXPECT_NE(reading.what.substr(0, 9), "internal:") << reading.what;
  if (right == "error") {
    EXPECT_FALSE(reading.model.has_value());
  } else if (right == "accept" || right == "warn") {
    EXPECT_TRUE(reading.model.has_value()) << reading.what;
  }
  if (right == "warn") {
    EXPECT_GT(reading.diagnostics.warning_count(), 0);
  }
  if (reading.model) expect_size(row, reading);
  if (!reading.model || right == "warn") expect_named(row.at("must_name"), reading.messages());
}

bool line_is_right(const Row& row, const Reading& reading) {
  const Diagnostic* first = reading.first(Severity::kError);
  if (first == nullptr) first = reading.first(Severity::kWarning);
  return first == nullptr || std::to_string(first->location.line) == row.at("line");
}

TEST(Corpus, EachFileGetsTheAnswerItDeserves) {
  const std::vector<Row> rows = read_table(std::string(kCorpus) + "manifest.csv");
  if (rows.empty()) GTEST_SKIP() << kCorpus << " is not here";
  int files = 0, lines = 0, right_lines = 0;
  std::string wrong_lines;
  for (const Row& row : rows) {
    if (row.at("file").starts_with("@")) continue;  // reading_test.cc
    SCOPED_TRACE(row.at("id") + ": " + row.at("what"));
    ++files;
    const auto generated = kGenerated.find(row.at("id"));
    const std::string text = generated != kGenerated.end()
                                 ? generated->second()
                                 : file_text(kCorpus + ("files/" + row.at("file")));
    ASSERT_TRUE(row.at("id") == "A01" || !text.empty());
    const std::clock_t begin = std::clock();
    const Reading reading = try_text(text);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_LT(seconds, kMostSeconds);
    expect_answer(row, reading);
    if (row.at("line").empty()) continue;
    ++lines;
    if (line_is_right(row, reading))
      ++right_lines;
    else
      wrong_lines += row.at("id") + " (" + row.at("line") + "):\n" + reading.messages();
  }
  EXPECT_GE(right_lines, 0.98 * lines) << wrong_lines;
  RecordProperty("files", files);
  std::printf("%d files, %d of %d lines right\n%s", files, right_lines, lines, wrong_lines.c_str());
}

}  // namespace
}  // namespace arboc::test
