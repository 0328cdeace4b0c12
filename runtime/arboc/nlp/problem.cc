#include "problem.hpp"

#include <stdexcept>

namespace arboc {
inline namespace v1 {
namespace nlp {

Group& Problem::group_of(std::vector<Group>& groups, const std::string& name,
                         const std::string& unit) {
  for (Group& g : groups)
    if (g.name == name && g.unit == unit) return g;
  groups.push_back({name, unit, {}});
  return groups.back();
}

Quantities Problem::add_variables(const std::string& name, const std::string& unit,
                                  const std::vector<Interval>& intervals) {
  const int first = static_cast<int>(variables_.size());
  Group& group = group_of(variable_groups_, name, unit);
  for (const Interval& i : intervals) {
    if (!(i.lower <= i.upper) || !(i.scale > 0))
      throw std::invalid_argument("variables '" + name + "': bounds cross, or a scale is not > 0");
    group.members.push_back(static_cast<int>(variables_.size()));
    variables_.push(i.lower, i.upper, i.scale);
  }
  return {-1, first, static_cast<int>(intervals.size())};
}

Quantities Problem::evaluate(FunctionPointer function, std::vector<Affine> inputs) {
  if (static_cast<int>(inputs.size()) != function->inputs())
    throw std::invalid_argument("evaluate: not as many inputs as the function has");
  for (const Affine& a : inputs) check(a, true);
  const int count = function->outputs();
  evaluations_.push_back({std::move(function), std::move(inputs)});
  return {static_cast<int>(evaluations_.size()) - 1, 0, count};
}

int Problem::add_group(const std::string& name, const std::string& unit) {
  return static_cast<int>(&group_of(groups_, name, unit) - groups_.data());
}

void Problem::require(int group, Affine value, double lower, double upper, double scale) {
  require(group, nullptr, {}, std::move(value), lower, upper, scale);
}

void Problem::require(int group, ScalarPointer of, std::vector<Affine> arguments, Affine plus,
                      double lower, double upper, double scale) {
  Group& g = groups_.at(static_cast<std::size_t>(group));
  if (!(lower <= upper) || !(scale > 0))
    throw std::invalid_argument("'" + g.name + "': bounds cross, or a scale is not > 0");
  Expression value{std::move(of), std::move(arguments), std::move(plus)};
  check(value);
  g.members.push_back(static_cast<int>(rows_.size()));
  rows_.push_back({group, std::move(value), lower, upper, scale});
}

void Problem::minimise(const std::string& name, double weight, Affine value) {
  Expression sum{nullptr, {}, std::move(value)};
  check(sum);
  costs_.push_back({name, weight, std::move(sum)});
}

void Problem::minimise(const std::string& name, double weight, ScalarPointer of,
                       std::vector<Affine> arguments) {
  Expression value{std::move(of), std::move(arguments), {}};
  check(value);
  costs_.push_back({name, weight, std::move(value)});
}

void Problem::check(const Affine& a, bool variables_only) const {
  for (const Affine::Term& t : a.terms) {
    const bool variable = t.of.evaluation < 0;
    if (variables_only && !variable)
      throw std::invalid_argument("evaluate: an input is not a sum of variables");
    const int count =
        variable ? static_cast<int>(variables_.size())
                 : evaluations_.at(static_cast<std::size_t>(t.of.evaluation)).function->outputs();
    if (t.of.index < 0 || t.of.index >= count)
      throw std::out_of_range("problem: no such variable or output");
  }
}

void Problem::check(const Expression& e) const {
  if (static_cast<int>(e.arguments.size()) != (e.of ? e.of->arguments() : 0))
    throw std::invalid_argument("problem: not as many arguments as the scalar function has");
  for (const Affine& a : e.arguments) check(a, false);
  check(e.plus, false);
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc
