#include "tree/lower.h"

#include "tree/lowering.h"

namespace arboc {

template DynamicTree lower(const Model&, const LoweringOptions&, const NumbersOf<double>&);

DynamicTree lower(const Model& model, const LoweringOptions& options) {
  Draft draft = merge_fixed(model, numbers(model));
  choose_frames<double>(options, draft, nullptr);
  if (options.regroup) regroup(draft);
  return assemble(std::move(draft));
}

}  // namespace arboc
