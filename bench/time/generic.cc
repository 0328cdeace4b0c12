#include "generic.h"

#include "algorithms/crba.h"
#include "algorithms/rnea.h"

namespace bench {

struct Generic::Work {
  const arboc::DynamicTree& tree;
  arboc::RneaWorkspace<double> rnea{tree};
  arboc::CrbaWorkspace<double> crba{tree};
};

Generic::Generic(const arboc::DynamicTree& tree) : work_(new Work{tree}) {}
Generic::~Generic() = default;

void Generic::rnea(const double* q, const double* v, const double* a, double* tau) {
  arboc::rnea(work_->tree, work_->rnea, q, v, a, tau);
}

void Generic::crba(const double* q, double* M) {
  const int n = work_->tree.nv;
  arboc::crba(work_->tree, work_->crba, q, arboc::UpperTriangle<double>{M, n});
}

}  // namespace bench
