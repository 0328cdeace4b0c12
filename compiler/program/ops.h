// What a node costs, for cutting a program into chunks.
#pragma once
#include "program/program.h"

namespace arboc {

/// Floating-point instructions of one node, about.
int cost(const Region& region, const Node& node);

}  // namespace arboc
