// One-line expressions of the inputs a, b, c ... for tables of tests.
//
//   "-(a + 2) * sin(b); a / b" -> a graph with two outputs, node by node through Builder
// and back: products inside n-ary sums stand bare, nodes of their own in parentheses, so that
// sum(c, a * b) is one fused operation and sum(c, (a * b)) are two.
#pragma once
#include <string>

#include "graph/graph.h"

namespace arboc::test {

/// Expressions separated by ';', one output entry each.  Operators + - * / and parentheses,
/// functions sin, cos, sqrt.  Throws std::invalid_argument.
Graph graph_of(const std::string& expressions);

/// The output entries of the last region, separated by "; ".
std::string expressions_of(const Graph& graph);

}  // namespace arboc::test
