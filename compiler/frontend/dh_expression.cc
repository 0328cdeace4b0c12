#include "frontend/dh_expression.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/number.h"
#include "base/words.h"

namespace arboc {
namespace {

constexpr int kDeepest = 64;

bool is_letter(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return '0' <= c && c <= '9'; }

struct Fault {
  size_t at;
  std::string message, hint{};
};

class Parser {
 public:
  Parser(std::string_view text, const DhFind& find) : text_(text), find_(find) {}

  DhLinear whole() {
    skip();
    if (i_ == text_.size()) throw Fault{0, "is empty", "write 0"};
    DhLinear value = sum();
    if (i_ < text_.size()) unexpected();
    return value;
  }

 private:
  void skip() {
    while (i_ < text_.size() && (text_[i_] == ' ' || text_[i_] == '\t')) ++i_;
  }
  char next() const { return i_ < text_.size() ? text_[i_] : '\0'; }
  bool take(char c) {
    if (next() != c) return false;
    ++i_;
    skip();
    return true;
  }

  [[noreturn]] void unexpected() const {
    if (i_ >= text_.size()) throw Fault{text_.size(), quoted(text_) + " ends too early"};
    std::string hint;
    if (text_.substr(i_).starts_with("\xE2\x88\x92"))
      hint = "the minus sign is U+2212; write '-'";
    else if (next() == ',')
      hint = "write a decimal point, not a comma";
    else if (next() == '^')
      hint = "cells are linear in lengths";
    throw Fault{i_, quoted(text_) + " is not an expression", hint};
  }

  DhLinear sum() {
    if (++depth_ > kDeepest) throw Fault{i_, "is nested too deep"};
    DhLinear value;
    bool minus = take('-');
    if (!minus) take('+');
    value.add(product(), minus ? -1 : 1);
    for (;;) {
      if (take('+'))
        value.add(product(), 1);
      else if (take('-'))
        value.add(product(), -1);
      else
        break;
    }
    --depth_;
    return value;
  }

  DhLinear product() {
    DhLinear value = factor();
    for (;;) {
      const size_t at = i_;
      if (take('*'))
        value = times(value, factor(), at);
      else if (take('/'))
        value = over(value, factor(), at);
      else
        return value;
    }
  }

  DhLinear times(const DhLinear& a, const DhLinear& b, size_t at) const {
    if (!a.is_number() && !b.is_number())
      throw Fault{at, quoted(text_) + " is not linear in its names"};
    DhLinear value;
    if (a.is_number())
      value.add(b, a.constant);
    else
      value.add(a, b.constant);
    value.has_pi = a.has_pi || b.has_pi;
    return value;
  }

  DhLinear over(const DhLinear& a, const DhLinear& b, size_t at) const {
    if (!b.is_number()) throw Fault{at, quoted(text_) + " is not linear in its names"};
    if (b.constant == 0) throw Fault{at, quoted(text_) + " divides by 0"};
    DhLinear value = a;
    value.constant /= b.constant;
    for (auto& term : value.terms) term.second /= b.constant;
    value.has_pi = a.has_pi || b.has_pi;
    return value;
  }

  DhLinear factor() {
    DhLinear value;
    if (take('(')) {
      value = sum();
      if (!take(')')) unexpected();
      return value;
    }
    if (next() == '-' || next() == '+') {
      const bool minus = next() == '-';
      ++i_;
      skip();
      if (++depth_ > kDeepest) throw Fault{i_, "is nested too deep"};
      value.add(factor(), minus ? -1 : 1);
      --depth_;
      return value;
    }
    if (is_digit(next()) || next() == '.') return number();
    if (is_letter(next())) return name();
    unexpected();
  }

  DhLinear number() {
    const size_t begin = i_;
    while (i_ < text_.size()) {
      const char c = text_[i_];
      const bool sign = (c == '+' || c == '-') && i_ > begin &&
                        (text_[i_ - 1] == 'e' || text_[i_ - 1] == 'E') && is_digit(text_[begin]);
      if (!is_digit(c) && !is_letter(c) && c != '.' && !sign) break;
      ++i_;
    }
    const std::string_view word = text_.substr(begin, i_ - begin);
    const auto value = parse_finite(word);
    if (!value) {
      const bool unit = word.find_first_of("mcgdr") != std::string_view::npos;
      throw Fault{begin, quoted(word) + " is not a finite number",
                  unit ? "units are stated once, in [units]" : ""};
    }
    skip();
    DhLinear out;
    out.constant = *value;
    return out;
  }

  DhLinear name() {
    const size_t begin = i_;
    while (i_ < text_.size() && (is_letter(text_[i_]) || is_digit(text_[i_]))) ++i_;
    const std::string_view word = text_.substr(begin, i_ - begin);
    skip();
    DhLinear out;
    if (word == "pi") {
      out.constant = std::numbers::pi;
      out.has_pi = true;
      return out;
    }
    DhSymbol symbol;
    if (word == "nan" || word == "inf" || word == "infinity" || word == "NaN" || word == "Inf")
      throw Fault{begin, quoted(word) + " is not a finite number"};
    if (!find_(word, symbol))
      throw Fault{begin, fmt::format("there is no joint or length {}", quoted(word)), "?"};
    out.terms.emplace_back(symbol, 1.0);
    return out;
  }

  std::string_view text_;
  const DhFind& find_;
  size_t i_ = 0;
  int depth_ = 0;
};

}  // namespace

DhLinear& DhLinear::add(const DhLinear& other, double factor) {
  constant += factor * other.constant;
  has_pi = has_pi || other.has_pi;
  for (const auto& [symbol, x] : other.terms) {
    size_t k = 0;
    while (k < terms.size() && !(terms[k].first == symbol)) ++k;
    if (k == terms.size()) terms.emplace_back(symbol, 0.0);
    terms[k].second += factor * x;
    if (terms[k].second == 0) terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return *this;
}

DhExpression parse_expression(std::string_view text, const DhFind& find) {
  DhExpression result;
  try {
    result.value = Parser(text, find).whole();
    bool finite = std::isfinite(result.value.constant);
    for (const auto& term : result.value.terms) finite = finite && std::isfinite(term.second);
    if (!finite) throw Fault{0, quoted(text) + " is beyond the range of double"};
  } catch (Fault& fault) {
    result.fault = std::move(fault.message);
    result.hint = std::move(fault.hint);
    result.at = fault.at;
  }
  return result;
}

bool is_identifier(std::string_view name) {
  if (name.empty() || !is_letter(name[0]) || name == "pi") return false;
  for (const char c : name)
    if (!is_letter(c) && !is_digit(c)) return false;
  return true;
}

}  // namespace arboc
