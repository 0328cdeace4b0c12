// fill(): every name of a template has a value and every value a place.
#include "emit/template.h"

#include <gtest/gtest.h>

namespace arboc::test {
namespace {

constexpr const char* kTemplate = "cpp/NAME_FUNCTION_SCALAR.cpp";

std::map<std::string, std::string> values() {
  return {{"banner", "// head"},
          {"name", "arm"},
          {"function", "rnea"},
          {"includes", "// more\n"},
          {"scalar", "double"},
          {"result", "void"},
          {"parameters", "const double* q, double* @tau@"}};
}

/// What fill() complains about.
std::string complaint(const std::string& name, const std::map<std::string, std::string>& given) {
  try {
    fill(name, given);
  } catch (const std::logic_error& e) {
    return e.what();
  }
  return "nothing";
}

TEST(Fill, ReplacesNamesAndNothingElse) {
  EXPECT_EQ(fill(kTemplate, values()),
            "// head\n#include \"arm_rnea.hpp\"\n\n#include \"arm_raw.hpp\"\n// more\n\n"
            "template void arm::raw::rnea<double>(const double* q, double* @tau@) noexcept;\n");
}

TEST(Fill, NamesWhatIsMissing) {
  auto given = values();
  given.erase("result");
  EXPECT_EQ(complaint(kTemplate, given),
            "template cpp/NAME_FUNCTION_SCALAR.cpp: no value for @result@");
}

TEST(Fill, NamesWhatIsNotUsed) {
  auto given = values();
  given["results"] = "int";
  EXPECT_EQ(complaint(kTemplate, given),
            "template cpp/NAME_FUNCTION_SCALAR.cpp: @results@ is not used");
}

TEST(Fill, NamesTheTemplateThatDoesNotExist) {
  EXPECT_EQ(complaint("cpp/NAME.rs", {}), "no embedded file cpp/NAME.rs");
}

TEST(Embedded, ListsByPrefix) {
  const auto names = embedded_names("runtime/");
  EXPECT_EQ(names.size(), 11u);
  EXPECT_EQ(names.front(), "runtime/arboc/angles.hpp");
  EXPECT_EQ(embedded_names("generic/").size(), 39u);
  EXPECT_TRUE(embedded_names("nothing/").empty());
}

}  // namespace
}  // namespace arboc::test
