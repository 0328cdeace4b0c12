// The printed form of a graph and the reader of it, so that tests are tables of text.
//
//   region NAME        in NAME SIZE        out NAME SIZE: OPERAND ...        # block title
//   x7 = q0 * -x3      x8 = x7 + 2.5       x9 = sin(q1)      x10 = sum(x1, -x3*x4, 2.5*x6)
//   x11 = pack(q0, q1)   x12 = lane1(x11)   x13 = hsum2(x11)   x14 = [0.5|-2] * x11
// stumpff3(x7) is c_3 of x7; [0.5|-2] is a constant in two lanes.  An operand is an input entry
// (q0), a node (x7) or a number, with a sign.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "base/number.h"
#include "graph/builder.h"
#include "graph/graph.h"

namespace arboc {
namespace {

class Printer {
 public:
  explicit Printer(const Region& region) : region_(region) {
    for (const Port& port : region.inputs)
      for (int i = 0; i < port.size; ++i) input_names_.push_back(fmt::format("{}{}", port.name, i));
  }

  std::string run() {
    out_ = fmt::format("region {}\n", region_.name);
    for (const Port& port : region_.inputs) out_ += fmt::format("in {} {}\n", port.name, port.size);
    size_t block = 0;
    for (size_t n = 0; n < region_.nodes.size(); ++n) {
      const Node& node = region_.nodes[n];
      if (node.op == Op::kConstant || node.op == Op::kInput) continue;
      if (node.block != block) out_ += fmt::format("# {}\n", region_.blocks[block = node.block]);
      out_ += fmt::format("x{} = {}\n", n, expression(node));
    }
    for (size_t p = 0; p < region_.outputs.size(); ++p) {
      out_ += fmt::format("out {} {}:", region_.outputs[p].name, region_.outputs[p].size);
      for (const Ref ref : region_.results[p]) out_ += " " + operand(ref);
      out_ += '\n';
    }
    return out_;
  }

 private:
  std::string operand(Ref ref) const {
    const Node& node = region_[ref];
    const std::string sign = ref.negative() ? "-" : "";
    if (node.op == Op::kConstant) return constant(region_.lanes(ref));
    if (node.op == Op::kInput) return sign + input_names_[node.index];
    return fmt::format("{}x{}", sign, ref.node());
  }

  static std::string constant(const Lanes& lanes) {
    std::string text;
    for (int k = 0; k < lanes.width; ++k) text += (k ? "|" : "") + shortest(lanes.x[k]);
    return lanes.width == 1 ? text : "[" + text + "]";
  }

  std::string expression(const Node& node) const {
    if (node.op == Op::kSum || node.op == Op::kPack) {
      std::string text = fmt::format("{}(", spelling(node.op));
      for (std::uint32_t t = node.index; t < node.index + node.count; ++t) {
        const Term& term = region_.terms[t];
        if (t > node.index) text += ", ";
        text += operand(term.a);
        if (term.product) text += "*" + operand(term.b);
      }
      return text + ")";
    }
    if (node.op == Op::kStumpff || node.op == Op::kLane || node.op == Op::kHsum)
      return fmt::format("{}{}({})", spelling(node.op), node.index, operand(node.a));
    if (operand_count(node.op) == 1)
      return fmt::format("{}({})", spelling(node.op), operand(node.a));
    return fmt::format("{} {} {}", operand(node.a), spelling(node.op), operand(node.b));
  }

  const Region& region_;
  std::vector<std::string> input_names_;
  std::string out_;
};

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  Graph run() {
    std::istringstream lines(text_);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      try {
        statement(line);
      } catch (const std::exception& e) {
        throw std::invalid_argument(fmt::format("line {}: {}: {}", number, line, e.what()));
      }
    }
    finish_region();
    return std::move(graph_);
  }

 private:
  void finish_region() {
    if (!builder_) return;
    graph_.regions.push_back(std::move(std::move(*builder_).finish().regions[0]));
    builder_.reset();
    names_.clear();
  }

  void statement(const std::string& line) {
    std::istringstream words(line);
    std::string first, equals;
    if (!(words >> first)) return;
    if (first == "region") {
      finish_region();
      std::string name;
      words >> name;
      builder_.emplace(name);
      return;
    }
    if (!builder_) builder_.emplace("region");
    if (first == "#") {
      builder_->begin_block(line.substr(line.find("# ") + 2));
    } else if (first == "in") {
      input(words);
    } else if (first == "out") {
      output(words);
    } else {
      if (!(words >> equals) || equals != "=") throw std::invalid_argument("NAME = EXPRESSION");
      names_[first] = expression(*builder_, line.substr(line.find('=') + 1));
    }
  }

  void input(std::istringstream& words) {
    std::string name;
    int size = 0;
    if (!(words >> name >> size) || size < 0) throw std::invalid_argument("in NAME SIZE");
    const auto refs = builder_->input(name, size);
    for (int i = 0; i < size; ++i)
      names_[fmt::format("{}{}", name, i)] = refs[static_cast<size_t>(i)];
  }

  void output(std::istringstream& words) {
    std::string name, size, word;
    words >> name >> size;
    std::vector<Ref> entries;
    while (words >> word) entries.push_back(operand(*builder_, word));
    if (size != fmt::format("{}:", entries.size()))
      throw std::invalid_argument("out NAME SIZE: OPERAND ...");
    builder_->output(name, entries);
  }

  Ref operand(Builder& builder, std::string word) {
    const bool negative = word.starts_with('-');
    if (negative) word.erase(0, 1);
    if (word.starts_with('[')) return constant(builder, word, negative);
    const auto number = parse_finite(word);
    const auto name = names_.find(word);
    if (!number && name == names_.end()) throw std::invalid_argument("unknown operand " + word);
    const Ref ref = number ? builder.constant(*number) : name->second;
    return negative ? -ref : ref;
  }

  static Ref constant(Builder& builder, const std::string& word, bool negative) {
    Lanes lanes;
    lanes.width = 0;
    std::istringstream list(word.substr(1, word.find(']') - 1));
    for (std::string item; std::getline(list, item, '|');) {
      const auto number = parse_finite(item);
      if (!number || lanes.width == kMostLanes) throw std::invalid_argument("constant " + word);
      lanes.x[lanes.width++] = *number;
    }
    if (lanes.width == 0) throw std::invalid_argument("constant " + word);
    const Ref ref = builder.constant(lanes);
    return negative ? -ref : ref;
  }

  /// The number behind a name such as stumpff3, or -1.
  static int numbered(const std::string& name, Op op, int most) {
    const std::string stem = spelling(op);
    if (!name.starts_with(stem)) return -1;
    const auto k = parse_finite(name.substr(stem.size()));
    return k && *k >= 0 && *k <= most ? static_cast<int>(*k) : -1;
  }

  Ref expression(Builder& builder, const std::string& text) {
    const size_t open = text.find('(');
    if (open == std::string::npos) {
      std::istringstream words(text);
      std::string a, op, b;
      words >> a;
      if (!(words >> op >> b)) return operand(builder, a);
      const Ref x = operand(builder, a), y = operand(builder, b);
      if (op == "+") return builder.add(x, y);
      if (op == "*") return builder.mul(x, y);
      if (op == "/") return builder.div(x, y);
      throw std::invalid_argument("unknown operation " + op);
    }
    const std::string name =
        text.substr(text.find_first_not_of(' '), open - text.find_first_not_of(' '));
    std::istringstream list(text.substr(open + 1, text.rfind(')') - open - 1));
    if (name == "sum") return builder.sum(terms(builder, list, name));
    if (name == "pack") return pack(builder, list);
    const Ref x = operand(builder, list.str());
    if (name == "sin") return builder.sin(x);
    if (name == "cos") return builder.cos(x);
    if (name == "sqrt") return builder.sqrt(x);
    if (name == "quaternion_log") return builder.quaternion_log(x);
    if (name == "log_curvature") return builder.log_curvature(x);
    if (const int k = numbered(name, Op::kStumpff, kLargestStumpff); k >= 0)
      return builder.stumpff(k, x);
    if (const int k = numbered(name, Op::kLane, kMostLanes - 1); k >= 0) return builder.lane(x, k);
    if (const int k = numbered(name, Op::kHsum, kMostLanes); k >= 2) return builder.hsum(x, k);
    throw std::invalid_argument("unknown operation " + name);
  }

  Ref pack(Builder& builder, std::istringstream& list) {
    std::vector<Ref> scalars;
    for (const Term& term : terms(builder, list, "pack")) {
      if (term.product) throw std::invalid_argument("a pack holds no products");
      scalars.push_back(term.a);
    }
    return builder.pack(scalars);
  }

  std::vector<Term> terms(Builder& builder, std::istringstream& list, const std::string& what) {
    std::vector<Term> terms;
    for (std::string item; std::getline(list, item, ',');) {
      item.erase(0, item.find_first_not_of(' '));
      const size_t star = item.find('*');
      Term term{operand(builder, item.substr(0, star)), Ref(), star != std::string::npos};
      if (term.product) term.b = operand(builder, item.substr(star + 1));
      terms.push_back(term);
    }
    if (terms.size() < 2)
      throw std::invalid_argument(fmt::format("a {} has at least two terms", what));
    return terms;
  }

  const std::string& text_;
  Graph graph_;
  std::optional<Builder> builder_;  ///< of the region being read
  std::map<std::string, Ref> names_;
};

}  // namespace

std::string print(const Graph& graph) {
  std::string text;
  for (const Region& region : graph.regions) text += Printer(region).run();
  return text;
}

Graph parse(const std::string& text) { return Parser(text).run(); }

}  // namespace arboc
