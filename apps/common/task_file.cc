#include "task_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace study {
namespace {

/// Bases of tables in a file are beside it, even where the file is a base itself.
void place_bases(toml::node& node, const std::filesystem::path& folder) {
  if (toml::array* list = node.as_array())
    for (toml::node& entry : *list) place_bases(entry, folder);
  toml::table* table = node.as_table();
  if (!table) return;
  if (const auto base = (*table)["base"].value<std::string>())
    table->insert_or_assign("base", (folder / *base).string());
  for (auto&& [key, inner] : *table) place_bases(inner, folder);
}

toml::table parse(const std::string& path) {
  try {
    toml::table file = toml::parse_file(path);
    for (auto&& [key, node] : file) place_bases(node, std::filesystem::path(path).parent_path());
    return file;
  } catch (const toml::parse_error& e) {
    const auto at = e.source().begin;
    throw TaskError(path + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) +
                    ": error: " + std::string(e.description()));
  }
}

void merge(toml::table& under, toml::table&& over);

/// Tables of the same name are one; others are appended.  (Nodes are moved, as copies forget where
/// they stand.)
void merge(toml::array& under, toml::array&& over) {
  for (toml::node& entry : over) {
    toml::table* table = entry.as_table();
    const auto name = table ? (*table)["name"].value<std::string>() : std::nullopt;
    const auto same = std::find_if(under.begin(), under.end(), [&](toml::node& node) {
      const toml::table* mine = node.as_table();
      return name && mine && (*mine)["name"].value<std::string>() == name;
    });
    if (same == under.end())
      under.push_back(std::move(entry));
    else
      merge(*same->as_table(), std::move(*table));
  }
}

/// What `over` says counts; tables are merged, lists of tables by their names, others replaced.
void merge(toml::table& under, toml::table&& over) {
  for (auto&& [key, node] : over) {
    toml::table* table = under[key].as_table();
    toml::array* list = under[key].as_array();
    if (table && node.is_table())
      merge(*table, std::move(*node.as_table()));
    else if (list && list->is_array_of_tables() && node.is_array_of_tables())
      merge(*list, std::move(*node.as_array()));
    else
      under.insert_or_assign(key, std::move(node));
  }
}

/// A table over the file that it names as its `base`, beside `folder`.
toml::table over_base(toml::table own, const std::filesystem::path& folder, int depth) {
  const toml::node* base = own.get("base");
  if (!base) return own;
  if (!base->is_string() || depth > 8) fail(*base, "base is not a file, or goes in circles");
  const std::filesystem::path path = folder / *base->value<std::string>();
  toml::table all = over_base(parse(path.string()), path.parent_path(), depth + 1);
  merge(all, std::move(own));
  return all;
}

}  // namespace

toml::table read_document(const std::string& path) {
  return over_base(parse(path), std::filesystem::path(path).parent_path(), 0);
}

toml::table over_base(toml::table own) { return over_base(std::move(own), {}, 0); }

void fail(const toml::source_region& where, const std::string& message) {
  std::ostringstream text;
  if (where.path) text << *where.path << ':';
  text << where.begin.line << ':' << where.begin.column << ": error: " << message;
  throw TaskError(text.str());
}

void fail(const toml::node& at, const std::string& message) { fail(at.source(), message); }

namespace {

double limit_of(const toml::node& node, const std::string& what) {
  const std::optional<double> x = node.value<double>();
  if (!node.is_number() || !x || std::isnan(*x)) fail(node, what + " is not a number");
  return *x;
}

}  // namespace

double number_of(const toml::node& node, const std::string& what) {
  const double x = limit_of(node, what);
  if (std::isinf(x)) fail(node, what + " is not finite");
  return x;
}

Eigen::Vector3d vector_of(const toml::node& node, const std::string& what) {
  const toml::array* list = node.as_array();
  if (!list || list->size() != 3) fail(node, what + " is not a list of three numbers");
  Eigen::Vector3d v;
  for (std::size_t i = 0; i < 3; ++i)
    v[static_cast<Eigen::Index>(i)] = number_of(*list->get(i), what);
  return v;
}

void Table::fail(const std::string& message) const { study::fail(table_, what_ + ": " + message); }

void Table::fail_at(const char* key, const std::string& message) const {
  if (const toml::node* at = table_.get(key)) study::fail(*at, what_ + ": " + message);
  fail(message);
}

const toml::node* Table::find(const char* key) {
  known_.insert(key);
  return table_.get(key);
}

std::string Table::text(const char* key) {
  if (!find(key)) fail(std::string(key) + " is missing");
  return text(key, "");
}
std::string Table::text(const char* key, std::string otherwise) {
  const toml::node* node = find(key);
  if (!node) return otherwise;
  if (!node->is_string()) study::fail(*node, what_ + ": " + key + " is not a text");
  return *node->value<std::string>();
}
double Table::number(const char* key, double otherwise) {
  const toml::node* node = find(key);
  return node ? number_of(*node, what_ + ": " + key) : otherwise;
}
int Table::whole(const char* key, int otherwise, int least) {
  const toml::node* node = find(key);
  if (!node) return otherwise;
  const std::optional<int> x = node->value<int>();
  if (!node->is_integer() || !x || *x < least)
    study::fail(*node,
                what_ + ": " + key + " is not a whole number of at least " + std::to_string(least));
  return *x;
}
double Table::rate(double otherwise) {
  const double rate = number("rate", otherwise);
  if (!(rate > 0 && rate <= kMostFrames))
    fail_at("rate", "rate is not between 0 and 10000 frames a second");
  return rate;
}
bool Table::flag(const char* key, bool otherwise) {
  const toml::node* node = find(key);
  if (!node) return otherwise;
  if (!node->is_boolean()) study::fail(*node, what_ + ": " + key + " is neither true nor false");
  return *node->value<bool>();
}
Eigen::Vector3d Table::vector(const char* key) {
  if (!find(key)) fail(std::string(key) + " is missing");
  return vector_of(*find(key), what_ + ": " + key);
}
Eigen::Vector3d Table::vector(const char* key, const Eigen::Vector3d& otherwise) {
  return has(key) ? vector(key) : otherwise;
}

std::array<std::array<double, 2>, 3> Table::limits(const char* key) {
  std::array<std::array<double, 2>, 3> out{};
  const toml::node* node = find(key);
  if (!node) return out;
  const std::string what = what_ + ": " + key;
  const toml::array* list = node->as_array();
  if (!list || list->size() != 3)
    study::fail(*node, what + " is not a list of three numbers or pairs of limits");
  for (std::size_t i = 0; i < 3; ++i) {
    const toml::node& entry = *list->get(i);
    const toml::array* pair = entry.as_array();
    if (!pair) {
      out[i].fill(number_of(entry, what));
      continue;
    }
    if (pair->size() != 2) study::fail(entry, what + ": limits are two numbers");
    for (std::size_t k = 0; k < 2; ++k) out[i][k] = limit_of(*pair->get(k), what);
    if (out[i][0] > out[i][1]) study::fail(entry, what + ": the lower limit is above the upper");
  }
  return out;
}

std::vector<Table> Table::tables(const char* key) {
  std::vector<Table> out;
  const toml::node* node = find(key);
  if (!node) return out;
  const toml::array* list = node->as_array();
  if (!list) study::fail(*node, what_ + ": " + key + " is not a list of tables");
  for (const toml::node& entry : *list) {
    if (!entry.is_table()) study::fail(entry, what_ + ": an entry of " + key + " is not a table");
    const auto name = (*entry.as_table())["name"].value<std::string>();
    out.emplace_back(*entry.as_table(), std::string(key) + (name ? " '" + *name + "'" : ""));
  }
  return out;
}
std::optional<Table> Table::table(const char* key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) study::fail(*node, what_ + ": " + key + " is not a table");
  return Table(*node->as_table(), key);
}

void Table::finish() const {
  for (const auto& [key, node] : table_) {
    if (known_.count(std::string(key.str()))) continue;
    study::fail(key.source(), what_ + ": there is no key '" + std::string(key.str()) + "'");
  }
}

}  // namespace study
