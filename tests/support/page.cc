#include "support/page.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace arboc::test {
namespace {

/// The length of the number at the start of `text`, 0 if there is none, and what half of its last
/// digit counts.
size_t number_length(const char* text, double& value, double& half) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  const std::string digits(text, static_cast<size_t>(end - text));
  const size_t point = digits.find('.'), exponent = digits.find_first_of("eE");
  half = 1e-9;
  if (point != std::string::npos) {
    const size_t last = exponent == std::string::npos ? digits.size() : exponent;
    const int power = exponent == std::string::npos ? 0 : std::atoi(digits.c_str() + exponent + 1);
    half = 0.5000001 * std::pow(10.0, power - static_cast<int>(last - point - 1));
  }
  return digits.find_first_of("0123456789") == std::string::npos ? 0 : digits.size();
}

}  // namespace

std::string single_spaced(const std::string& text) {
  std::istringstream words(text);
  std::string out;
  for (std::string word; words >> word;) out += (out.empty() ? "" : " ") + word;
  return out;
}

bool prints_as(const std::string& shown, const std::string& printed) {
  size_t i = 0, j = 0;
  while (i < shown.size() && j < printed.size()) {
    double expected = 0, actual = 0, half = 0, ignored = 0;
    const size_t n = number_length(shown.c_str() + i, expected, half);
    const size_t m = number_length(printed.c_str() + j, actual, ignored);
    if (n == 0 || m == 0) {
      if (shown[i++] != printed[j++]) return false;
      continue;
    }
    if (!(std::fabs(actual - expected) <= half)) return false;
    i += n;
    j += m;
  }
  return i == shown.size() && j == printed.size();
}

Page read_page(const std::string& path) {
  Page page;
  std::ifstream file(path);
  bool within = false;  // the output of the last command
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string text = line.starts_with("    ") ? line.substr(4) : "";
    if (text.starts_with("$ ")) {
      CommandExample example{number, text.substr(2), {}};
      for (; line.ends_with("\\") && std::getline(file, line); ++number)
        example.command += "\n" + line;
      page.commands.push_back(example);
      within = true;
    } else if (text.starts_with("> ")) {
      page.words.push_back(single_spaced(text.substr(2)));
      within = false;
    } else if (text.empty()) {
      within = false;
    } else if (within) {
      page.commands.back().output.push_back(text);
    }
  }
  return page;
}

}  // namespace arboc::test
