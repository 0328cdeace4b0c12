// The examples of docs/conventions.md: commands print what stands below them, words are checked.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "differential/conventions_checks.h"
#include "support/page.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

const std::string kPage = ARBOC_SOURCE_DIR "/docs/conventions.md";

std::vector<WordCheck> word_checks() {
  std::vector<WordCheck> all = joint_checks();
  for (const WordCheck& check : derivative_checks()) all.push_back(check);
  return all;
}

/// Runs a command of the page in bash, from the root of the sources.  `engine` is added to what
/// `eval` is given.
Outcome run_example(const std::string& setup, const std::string& command,
                    const std::string& engine) {
  const std::string program = "\"" + arboc_command({})[0] + "\"";
  const std::string shell = "set -o pipefail\narboc() {\n if [ \"$1\" = eval ]; then " + program +
                            " \"$@\" " + engine + "; else " + program + " \"$@\"; fi\n}\n";
  RunOptions options;
  options.folder = ARBOC_SOURCE_DIR;
  return run_program({"bash", "-c", shell + setup + command}, options);
}

void expect_output(const CommandExample& example, const Outcome& outcome) {
  SCOPED_TRACE("docs/conventions.md:" + std::to_string(example.line) + ": " + example.command);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  size_t k = 0;
  for (std::string line; std::getline(lines, line); ++k) {
    ASSERT_LT(k, example.output.size()) << "also prints " << line;
    EXPECT_TRUE(prints_as(example.output[k], line))
        << "the page has " << example.output[k] << "\nit prints    " << line;
  }
  EXPECT_EQ(k, example.output.size());
}

/// Examples, run in turn after the variables that the page has set before; those of no output set
/// them.
template <class Choose>
int run_examples(const std::string& engine, Choose choose) {
  std::string setup;
  int count = 0;
  for (const CommandExample& example : read_page(kPage).commands) {
    if (example.output.empty()) {
      setup += example.command + "\n";
    } else if (choose(example)) {
      expect_output(example, run_example(setup, example.command, engine));
      ++count;
    }
  }
  return count;
}

TEST(Conventions, CommandsPrintWhatStandsBelowThem) {
  const int count = run_examples("--engine generic", [](const CommandExample&) { return true; });
  EXPECT_GE(count, 40);
}

TEST(Conventions, CommandsPrintTheSameFromGeneratedCode) {
  const int count = run_examples("", [](const CommandExample& example) {
    return example.command.find("--function gravity") != std::string::npos ||
           example.command.find("--hessian iterated") != std::string::npos;
  });
  EXPECT_GE(count, 3);
}

TEST(Conventions, EveryExampleInWordsHasACheckAndEveryCheckItsExample) {
  std::set<std::string> page, checks;
  for (const std::string& words : read_page(kPage).words) page.insert(words);
  for (const WordCheck& check : word_checks()) checks.insert(single_spaced(check.words));
  EXPECT_EQ(page, checks);
  EXPECT_EQ(checks.size(), word_checks().size());
}

TEST(Conventions, NumbersAreComparedAsFarAsTheyAreShown) {
  EXPECT_TRUE(prints_as("1.35,0,x", "1.3499,1e-12,x"));
  EXPECT_FALSE(prints_as("1.35,0,x", "1.3449,0,x"));
  EXPECT_FALSE(prints_as("1.35", "1.35,2"));
  EXPECT_FALSE(prints_as("0", "1e-6"));
  EXPECT_FALSE(prints_as("1.5", "nan"));
  EXPECT_TRUE(prints_as("-0.5", "-0.50000000000000011"));
}

class ConventionInWords : public testing::TestWithParam<WordCheck> {};

TEST_P(ConventionInWords, Holds) { GetParam().check(); }

INSTANTIATE_TEST_SUITE_P(Page, ConventionInWords, testing::ValuesIn(word_checks()),
                         [](const auto& check) { return std::string(check.param.name); });

}  // namespace
}  // namespace arboc::test
