// Pages: everything is inside, nothing ends an element early; functions as JavaScript.
#include "arboc/page/page.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/sha256.h"
#include "emit/emit.h"
#include "frontend/read_model.h"
#include "report/report.h"

namespace arboc::test {
namespace {

std::string file(const std::string& path) {
  std::ifstream in(std::string(ARBOC_SOURCE_DIR) + "/" + path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What the page's scripts are given.
nlohmann::json contents(const std::string& page) {
  const std::string open = "id=\"arboc-page\">";
  const size_t begin = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

size_t count(const std::string& text, const std::string& word) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += word.size()) ++n;
  return n;
}

const char* const kHostile = "</script><!--<script>\"'\\\n\t&\x01\xE8\x85\x95";

TEST(Page, HoldsWhatItIsGiven) {
  page::Page page;
  page.title = kHostile;
  page.body = "<p>" + page::html(kHostile) + "</p>";
  page.modules = {{kHostile, kHostile}};
  page.main = kHostile;
  page.data = {{"x", nlohmann::json(kHostile).dump()}};
  const std::string text = page::write(page);
  EXPECT_EQ(count(text, "</script>"), 2u);
  EXPECT_EQ(count(text, "<!--"), 0u);
  const nlohmann::json held = contents(text);
  EXPECT_EQ(held["modules"][kHostile], kHostile);
  EXPECT_EQ(held["data"]["x"], kHostile);
  EXPECT_EQ(held["main"], kHostile);
}

TEST(Page, NothingComesFromElsewhere) {
  const std::string text = page::animation("motion", "{}");
  EXPECT_FALSE(std::regex_search(text.substr(0, text.find("arboc-page")),
                                 std::regex("(src|href)=\"(?!data:)")));
  EXPECT_EQ(text.find("https://cdn"), std::string::npos);
}

TEST(Page, LibraryIsThePinnedOne) {
  const std::string origin = file("third_party/three/ORIGIN.md");
  for (const char* name : {"three.module.min.js", "OrbitControls.js", "LICENSE"})
    EXPECT_NE(origin.find(sha256(file(std::string("third_party/three/") + name))),
              std::string::npos)
        << name;
  const nlohmann::json modules = contents(page::animation("", "{}"))["modules"];
  EXPECT_EQ(modules["three"], file("third_party/three/three.module.min.js"));
  EXPECT_EQ(modules["three/addons/controls/OrbitControls.js"],
            file("third_party/three/OrbitControls.js"));
}

std::string report_of(const std::string& path) {
  Diagnostics diagnostics;
  const Model model = configure(read_model(std::string(ARBOC_SOURCE_DIR) + "/" + path, diagnostics),
                                {}, diagnostics);
  ReportInput input{resolve(model), {}, {}, {}, diagnostics};
  input.functions = {compile_function({"rnea"}, input.setup),
                     compile_function({"crba"}, input.setup)};
  return html_report(input);
}

TEST(Report, SameBytesTwice) {
  const std::string once = report_of("models/double_pendulum/double_pendulum.urdf");
  EXPECT_EQ(once, report_of("models/double_pendulum/double_pendulum.urdf"));
  EXPECT_LT(once.size(), 2000000u);
}

TEST(Report, OperationsOfLinksAddUp) {
  for (const char* path : {"models/quadruped/quadruped.urdf", "models/santos/santos.dh.toml"}) {
    const nlohmann::json operations = contents(report_of(path))["data"]["report"]["operations"];
    for (size_t f = 0; f < operations["functions"].size(); ++f) {
      int sum = 0;
      for (const auto& row : operations["rows"]) sum += row["counts"][f].get<int>();
      EXPECT_EQ(sum, operations["functions"][f]["total"]) << path;
      EXPECT_GT(sum, 0) << path;
    }
  }
}

TEST(Report, FunctionsAreTheProgramAsJavaScript) {
  const std::string fk =
      contents(report_of("models/double_pendulum/double_pendulum.urdf"))["modules"]["arboc/fk"];
  EXPECT_NE(fk.find("export function fk(q, placements) {\n"
                    "  const w = new Float64Array(8);\n  angles(q, w);\n"),
            std::string::npos)
      << fk;
  EXPECT_NE(fk.find("  w[0] = Math.sin(q[0]);\n  w[4] = Math.cos(q[0]);\n"), std::string::npos);
}

}  // namespace
}  // namespace arboc::test
