// What is said about DH tables: one file a message or a group of them, the whole text.
//
// dh/messages.txt holds cases: a title that says what the answer is (accept, warn, error), the
// file, `--- said` and the messages.  `@head` stands for name, convention and units.  The tables of
// the documents, as printed, are cases of their own.  ARBOC_UPDATE=1 rewrites what is said.
#include <gtest/gtest.h>

#include <sstream>

#include "frontend/dh.h"
#include "frontend/read_model.h"
#include "support/golden.h"

namespace arboc::test {
namespace {

constexpr const char* kFolder = ARBOC_SOURCE_DIR "/tests/golden/dh/";
constexpr std::string_view kSaid = "--- said\n";

struct Answer {
  std::string kind = "accept", messages;
};

template <class Read>
Answer answer(const Read& read) {
  Answer result;
  Diagnostics diagnostics;
  bool refused = false;
  try {
    read(diagnostics);
  } catch (const InputError&) {
    refused = true;
  }
  for (const Diagnostic& d : diagnostics.all()) result.messages += to_string(d) + "\n";
  if (refused)
    result.kind = "error";
  else if (diagnostics.warning_count() > 0)
    result.kind = "warn";
  return result;
}

Answer answer_to(std::string text) {
  const std::string head =
      "name = \"arm\"\nconvention = \"standard\"\nunits = { length = \"m\", angle = \"rad\" }\n";
  if (text.starts_with("@head\n")) text.replace(0, 6, head);
  return answer([&](Diagnostics& d) { parse_dh(text, "arm.dh.toml", "", d); });
}

TEST(DhMessages, EachFileGetsItsAnswer) {
  const std::string path = std::string(kFolder) + "messages.txt";
  const std::string text = read_file(path);
  std::string now;
  int cases = 0;
  for (size_t at = text.find("=== "); at != std::string::npos;) {
    const size_t line = text.find('\n', at) + 1, said = text.find(kSaid, line);
    ASSERT_NE(said, std::string::npos);
    const size_t next = text.find("\n=== ", said);
    const std::string title = text.substr(at, line - at);
    const Answer a = answer_to(text.substr(line, said - line));
    EXPECT_TRUE(title.starts_with("=== " + a.kind + ":")) << title << "is: " << a.kind << "\n"
                                                          << a.messages;
    now += text.substr(at, said - at) + std::string(kSaid) + a.messages;
    at = next == std::string::npos ? next : next + 1;
    ++cases;
  }
  EXPECT_GT(cases, 40);
  expect_golden(path, now);
}

class Document : public testing::TestWithParam<const char*> {};

// The tables of the thesis: [Thesis] A.1 to A.11 contradict themselves, and arboc says where.
TEST_P(Document, AsPrinted) {
  const std::string path = std::string(kFolder) + GetParam();
  const std::string text = read_file(path + ".dh.toml");
  const Answer a =
      answer([&](Diagnostics& d) { parse_dh(text, std::string(GetParam()) + ".dh.toml", "", d); });
  EXPECT_EQ(a.kind, "error");
  expect_golden(path + ".txt", a.messages);
}

INSTANTIATE_TEST_SUITE_P(Tables, Document, testing::Values("thesis_printed", "thesis_renumbered"));

TEST(DhMessages, ATableByTheNameOfUrdfIsRecognised) {
  const Answer a =
      answer([](Diagnostics& d) { read_model(ARBOC_SOURCE_DIR "/tests/golden/dh/table.urdf", d); });
  EXPECT_EQ(a.kind, "error");
  EXPECT_NE(a.messages.find("looks like a DH table"), std::string::npos) << a.messages;
}

TEST(DhMessages, LineEndsAndByteOrderMarksDoNotMatter) {
  const std::string text = read_file(ARBOC_SOURCE_DIR "/models/santos/santos.dh.toml");
  std::string crlf = "\xEF\xBB\xBF";
  for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  crlf.resize(crlf.size() - 2);
  Diagnostics diagnostics;
  const std::string file = ARBOC_SOURCE_DIR "/models/santos/santos.dh.toml";
  EXPECT_EQ(print(parse_dh(crlf, file, "", diagnostics)),
            print(parse_dh(text, file, "", diagnostics)));
}

// Time and memory grow linearly; what is beyond the limit is refused, not tried.
TEST(DhMessages, LongTables) {
  const auto table = [](int rows) {
    std::string text =
        "name = \"n\"\nconvention = \"modified\"\nunits = { length = \"m\", angle = \"rad\" }\n"
        "[joints]\n";
    for (int k = 0; k < rows; ++k) text += "q" + std::to_string(k) + " = {}\n";
    for (int k = 0; k < rows; ++k)
      text += "[[frames]]\nname = \"f" + std::to_string(k) + "\"\ntheta = \"q" + std::to_string(k) +
              "\"\nd = 0\nalpha = 0\na = 1\n";
    return text;
  };
  Diagnostics diagnostics;
  for (const int rows : {1, 1000}) {
    const Model model = parse_dh(table(rows), "n.dh.toml", "", diagnostics);
    EXPECT_EQ(model.joints.size(), static_cast<size_t>(rows));
  }
  EXPECT_THROW(parse_dh(table(20001), "n.dh.toml", "", diagnostics), InputError);
}

}  // namespace
}  // namespace arboc::test
