// User text on its way into generated code: whatever a model is called, the code compiles.
#include "emit/names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "support/random.h"
#include "support/temp_dir.h"

namespace arboc::test {
namespace {

/// Whether `code` is accepted with every warning an error.
bool compiles(const std::string& code, const char* standard) {
  const TempDir folder;
  std::ofstream(folder / "code.cc") << code;
  const char* compiler = std::getenv("CXX");
  const std::string command = std::string(compiler && *compiler ? compiler : "c++") +
                              " -std=" + standard + " -Wall -Wextra -Werror -fsyntax-only " +
                              (folder / "code.cc") + " > /dev/null 2>&1";
  return std::system(command.c_str()) == 0;
}

struct Name {
  const char* text;
  const char* identifier;
};

TEST(Identifier, Table) {
  const Name names[] = {
      {"ur5", "ur5"},
      {"UR5_e", "UR5_e"},
      {"", "model"},
      {"___", "model"},
      {"!?", "model"},
      {"7dof", "m7dof"},
      {"my robot (v2.0)", "my_robot_v2_0"},
      {"__init__", "init"},
      {"a--b__c", "a_b_c"},
      {"_Upper", "Upper"},
      {"größe", "gr_e"},
      {"ロボット", "model"},
      {"a\nb\tc", "a_b_c"},
      {"../../etc/passwd", "etc_passwd"},
      {"class", "class_model"},
      {"double", "double_model"},
      {"std", "std_model"},
      {"arboc", "arboc_model"},
      {"raw", "raw_model"},
      {"Eigen", "Eigen_model"},
      {"sin", "sin_model"},
      {"sincos", "sincos_model"},
      {"random", "random_model"},
      {"gamma", "gamma_model"},
      {"y1", "y1_model"},
      {"linux", "linux_model"},
      {"main", "main_model"},
      {"test", "test_model"},
      {"NULL", "NULL_model"},
  };
  for (const Name& n : names) EXPECT_EQ(identifier(n.text), n.identifier) << n.text;
  EXPECT_EQ(identifier(std::string("a\0b", 3)), "a_b");
}

TEST(Identifier, IsShortAndHasNoReservedUnderscores) {
  const std::string cut = identifier(std::string(63, 'x') + " y");
  EXPECT_EQ(cut, std::string(63, 'x'));
  EXPECT_LE(identifier(std::string(1000, 'z')).size(), 64u);
}

std::string random_name(Random& random) {
  constexpr const char* kPieces[] = {"_", "-", " ", "1", "0", "ü",  "int", "for", "if", "q",
                                     "x", "X", "E", "/", "'", "\"", "\\",  "@",   "$",  "\x80"};
  std::string name;
  for (int n = random.integer(9); n > 0; --n) name += kPieces[random.integer(20)];
  return name;
}

TEST(Identifier, TenThousandRandomNamesAreValid) {
  Random random(1);
  std::set<std::string> seen;
  for (int k = 0; k < 10000; ++k) {
    const std::string text = random_name(random), name = identifier(text);
    ASSERT_FALSE(name.empty());
    EXPECT_TRUE(std::isalpha(static_cast<unsigned char>(name.front()))) << text;
    EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](char c) {
      return c == '_' || std::isalnum(static_cast<unsigned char>(c));
    })) << text;
    EXPECT_EQ(name.find("__"), std::string::npos) << text;
    EXPECT_NE(name.back(), '_') << text;
    EXPECT_EQ(identifier(name), name) << text;
    seen.insert(name);
  }
  EXPECT_GT(seen.size(), 1000u);
  // As namespaces and constants, next to everything that generated code includes.
  std::string code = "#include <cmath>\n#include <cstdio>\n#include <cstring>\n#include <limits>\n";
  for (const std::string& name : seen) code += "namespace " + name + " { constexpr int x = 1; }\n";
  EXPECT_TRUE(compiles(code, "c++17"));
  EXPECT_TRUE(compiles(code, "c++20"));
}

TEST(CommentText, CannotLeaveTheComment) {
  EXPECT_EQ(comment_text("link 'arm-2' (left) = [a.b]"), "link 'arm-2' (left) = [a.b]");
  EXPECT_EQ(comment_text("a\nb"), "a_b");
  EXPECT_EQ(comment_text("ends in \\"), "ends in _");
  EXPECT_EQ(comment_text("*/ /* // ?\?/"), "__ __ __ ___");
  EXPECT_EQ(comment_text("ü"), "__");
}

TEST(StringLiteral, Escapes) {
  EXPECT_EQ(string_literal("arm"), "\"arm\"");
  EXPECT_EQ(string_literal("a\"b\\c"), "\"a\\\"b\\\\c\"");
  EXPECT_EQ(string_literal("?"), "\"\\077\"");
  EXPECT_EQ(string_literal("\n1"), "\"\\0121\"");
  EXPECT_EQ(string_literal("ü"), "\"\\303\\274\"");
}

TEST(StringLiteral, MeansTheSameBytes) {
  std::string every;
  for (int c = 0; c < 256; ++c) every += static_cast<char>(c);
  std::string code = "// " + comment_text(every) + "\n";
  for (const std::string& text : {every, std::string("?\?/ \"); system(\"ls"), std::string()}) {
    code += "static_assert(sizeof(" + string_literal(text) +
            ") == " + std::to_string(text.size() + 1) + ");\n";
    for (size_t i = 0; i < text.size(); ++i)
      code += "static_assert(" + string_literal(text) + "[" + std::to_string(i) +
              "] == static_cast<char>(" +
              std::to_string(static_cast<int>(static_cast<unsigned char>(text[i]))) + "));\n";
  }
  EXPECT_TRUE(compiles(code, "c++17"));
  EXPECT_FALSE(compiles(code + "static_assert(false, \"\");\n", "c++17"));
}

}  // namespace
}  // namespace arboc::test
