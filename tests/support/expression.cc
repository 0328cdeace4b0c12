#include "support/expression.h"

#include <cctype>
#include <stdexcept>

#include "base/number.h"
#include "graph/builder.h"

namespace arboc::test {
namespace {

constexpr int kLetters = 8;

/// Recursive descent; each rule consumes what it reads and the space behind it.
class Reader {
 public:
  explicit Reader(const std::string& text) : text_(text), builder_("f") {
    inputs_ = builder_.input("a", kLetters);
  }

  Graph run() {
    std::vector<Ref> entries{sum()};
    while (accept(';')) entries.push_back(sum());
    if (at_ != text_.size()) throw std::invalid_argument("unexpected: " + text_.substr(at_));
    builder_.output("y", entries);
    return std::move(builder_).finish();
  }

 private:
  bool accept(char c) {
    space();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void space() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  Ref sum() {
    Ref left = product();
    for (;;) {
      if (accept('+'))
        left = builder_.add(left, product());
      else if (accept('-'))
        left = builder_.add(left, -product());
      else
        return left;
    }
  }

  Ref product() {
    Ref left = factor();
    for (;;) {
      if (accept('*'))
        left = builder_.mul(left, factor());
      else if (accept('/'))
        left = builder_.div(left, factor());
      else
        return left;
    }
  }

  Ref factor() {
    if (accept('-')) return -factor();
    if (accept('(')) {
      const Ref inside = sum();
      if (!accept(')')) throw std::invalid_argument("missing )");
      return inside;
    }
    space();
    const size_t begin = at_;
    const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    while (at_ < text_.size() && (in_word(text_[at_]) || text_[at_] == '.')) ++at_;
    return word(text_.substr(begin, at_ - begin));
  }

  Ref word(const std::string& name) {
    if (const auto number = parse_finite(name)) return builder_.constant(*number);
    if (name.size() == 1 && name[0] >= 'a' && name[0] < 'a' + kLetters)
      return inputs_[static_cast<size_t>(name[0] - 'a')];
    if (!accept('(')) throw std::invalid_argument("unknown name " + name);
    const Ref x = sum();
    if (!accept(')')) throw std::invalid_argument("missing )");
    if (name == "sin") return builder_.sin(x);
    if (name == "cos") return builder_.cos(x);
    if (name == "sqrt") return builder_.sqrt(x);
    throw std::invalid_argument("unknown function " + name);
  }

  const std::string& text_;
  size_t at_ = 0;
  Builder builder_;
  std::vector<Ref> inputs_;
};

class Writer {
 public:
  explicit Writer(const Region& region) : region_(region) {}

  /// Binary nodes in parentheses unless they are the whole expression.
  std::string operand(Ref ref) const {
    const bool binary = operand_count(region_[ref].op) == 2;
    const std::string text = node(ref);
    return (ref.negative() ? "-" : "") + (binary ? "(" + text + ")" : text);
  }
  std::string whole(Ref ref) const { return ref.negative() ? operand(ref) : node(ref); }

 private:
  std::string node(Ref ref) const {
    const Node& n = region_[ref];
    if (n.op == Op::kConstant) return shortest(region_.constants[n.index]);
    if (n.op == Op::kInput) return std::string(1, static_cast<char>('a' + n.index));
    if (n.op == Op::kSum) return terms(n);
    if (operand_count(n.op) == 1) return std::string(spelling(n.op)) + "(" + whole(n.a) + ")";
    if (n.op == Op::kAdd && n.b.negative()) return operand(n.a) + " - " + operand(n.b.positive());
    return operand(n.a) + " " + spelling(n.op) + " " + operand(n.b);
  }

  std::string terms(const Node& n) const {
    std::string text = "sum(";
    for (std::uint32_t t = n.index; t < n.index + n.count; ++t) {
      const Term& term = region_.terms[t];
      text += (t > n.index ? ", " : "") + operand(term.a);
      if (term.product) text += " * " + operand(term.b);
    }
    return text + ")";
  }

  const Region& region_;
};

}  // namespace

Graph graph_of(const std::string& expressions) { return Reader(expressions).run(); }

std::string expressions_of(const Graph& graph) {
  const Region& region = graph.regions.back();
  std::string text;
  for (const auto& port : region.results)
    for (const Ref ref : port) text += (text.empty() ? "" : "; ") + Writer(region).whole(ref);
  return text;
}

}  // namespace arboc::test
