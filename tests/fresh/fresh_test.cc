// generated/ is what arboc writes today, byte by byte, wherever and in whatever locale it runs.
//
// ARBOC_UPDATE=1 rewrites generated/; read the difference before committing it.
#include <gtest/gtest.h>

#include <clocale>
#include <filesystem>
#include <locale>
#include <set>

#include "compile.h"
#include "emit/emit.h"
#include "frontend/read_model.h"
#include "support/golden.h"
#include "support/temp_dir.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;

struct Product {
  const char* name;
  const char* model;
  std::vector<std::string> functions;
  Targets targets = {};
};

/// As `arboc compile models/MODEL/MODEL.urdf --name NAME --functions ... -o generated` does it.
Files generate(const Product& product) {
  const std::string name = product.model;
  Diagnostics diagnostics;
  const Model model =
      read_model(ARBOC_SOURCE_DIR "/models/" + name + "/" + name + ".urdf", diagnostics);
  CompileOptions options;
  if (name != product.name) options.model.name = product.name;
  options.targets = product.targets;
  for (const std::string& function : product.functions) options.requests.push_back({function});
  return emit(target(compile(model, options, diagnostics), options));
}

std::vector<Product> products() {
  return {{"double_pendulum", "double_pendulum", function_names()},
          {"ur5", "ur5", {"rnea", "crba"}},
          {"double_pendulum_c", "double_pendulum", {"rnea", "crba", "aba"}, {false, true}}};
}

class Generated : public testing::TestWithParam<Product> {};

TEST_P(Generated, EqualsRegeneration) {
  const std::string folder = std::string(ARBOC_SOURCE_DIR "/generated/") + GetParam().name;
  const Files files = generate(GetParam());
  if (updating()) fs::remove_all(folder);
  for (const auto& [path, bytes] : files) expect_golden(folder + "/" + path, bytes);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string path = fs::relative(entry.path(), folder).string();
    EXPECT_TRUE(entry.is_directory() || files.contains(path)) << path << " is left over";
  }
}

/// Numbers as a German reads them: 1.234,5.
struct German : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST_P(Generated, DoesNotDependOnTheSurroundings) {
  const Files here = generate(GetParam());
  const TempDir elsewhere;
  const fs::path before = fs::current_path();
  fs::current_path(elsewhere.path());
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
  const std::locale old = std::locale::global(std::locale(std::locale(), new German));
  const Files there = generate(GetParam());
  std::locale::global(old);
  std::setlocale(LC_ALL, "C");
  fs::current_path(before);
  EXPECT_EQ(here, there);
}

TEST_P(Generated, NamesNoMachine) {
  for (const auto& [path, bytes] : generate(GetParam())) {
    EXPECT_EQ(bytes.find(ARBOC_SOURCE_DIR), std::string::npos) << path;
    EXPECT_EQ(bytes.find("-march"), std::string::npos) << path;
  }
}

INSTANTIATE_TEST_SUITE_P(Products, Generated, testing::ValuesIn(products()),
                         [](const auto& at) { return std::string(at.param.name); });

TEST(GeneratedFolder, HoldsNothingElse) {
  std::set<std::string> known{"README.md"};
  for (const Product& product : products()) known.insert(product.name);
  for (const auto& entry : fs::directory_iterator(ARBOC_SOURCE_DIR "/generated"))
    EXPECT_TRUE(known.contains(entry.path().filename())) << entry.path();
}

}  // namespace
}  // namespace arboc::test
