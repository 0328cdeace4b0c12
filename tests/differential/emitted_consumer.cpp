// A user of an emitted folder, named by MODEL and HEADER: reads states (q v a tau, separated by
// blanks) and prints what each function makes of them, through the Eigen interface, after checking
// that the raw functions say the same.
#include HEADER

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

using MODEL::Config;
using MODEL::nq;
using MODEL::nv;
using MODEL::Tangent;

static_assert(noexcept(MODEL::raw::fk<double>(nullptr, nullptr)), "");
static_assert(noexcept(MODEL::raw::rnea<double>(nullptr, nullptr, nullptr, nullptr)), "");
static_assert(noexcept(MODEL::raw::crba<double>(nullptr, nullptr)), "");
static_assert(noexcept(MODEL::raw::minv<double>(nullptr, nullptr)), "");
static_assert(noexcept(MODEL::raw::aba<double>(nullptr, nullptr, nullptr, nullptr)), "");
static_assert(sizeof(MODEL::q_lower) == sizeof(double) * nq, "");
static_assert(sizeof(MODEL::velocity_names) == sizeof(char*) * nv, "");

bool read(double* values, int n) {
  for (int i = 0; i < n; ++i)
    if (std::scanf("%lf", values + i) != 1) return false;
  return true;
}

template <class Matrix>
void print(const char* function, const Matrix& values) {
  std::printf("%s:", function);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      std::printf("%s%.17g", i + j ? "," : "", values(i, j));
  std::printf("\n");
}

void demand(bool good, const char* what) {
  if (good) return;
  std::fprintf(stderr, "%s: the raw function differs\n", what);
  std::exit(1);
}

/// Entries in the order of the sparsity pattern, which the function filled in completely.
template <class Matrix, int n>
void demand_entries(const Matrix& values, const std::vector<double>& raw, const int (&row)[n],
                    const int (&col)[n], const char* what) {
  for (int k = 0; k < n; ++k)
    demand(values(row[k], col[k]) == raw[static_cast<std::size_t>(k)], what);
}

void vectors(const Config& q, const Tangent& v, const Tangent& a) {
  Tangent raw;
  const auto same = [&](const char* name, const Tangent& values) {
    demand(std::memcmp(raw.data(), values.data(), sizeof(double) * nv) == 0, name);
    print(name, values);
  };
  MODEL::raw::rnea<double>(q.data(), v.data(), a.data(), raw.data());
  same("rnea", MODEL::rnea(q, v, a));
  MODEL::raw::gravity<double>(q.data(), raw.data());
  same("gravity", MODEL::gravity(q));
  MODEL::raw::nle<double>(q.data(), v.data(), raw.data());
  same("nle", MODEL::nle(q, v));
}

void solved(const Config& q, const Tangent& v, const Tangent& tau) {
  Tangent raw;
  int status = -1;
  const Tangent qdd = MODEL::aba(q, v, tau, &status);
  demand(MODEL::raw::aba<double>(q.data(), v.data(), tau.data(), raw.data()) == 0, "aba");
  demand(status == 0 && raw == qdd, "aba");
  print("aba", qdd);
}

void matrices(const Config& q) {
  const auto placements = MODEL::fk(q);
  std::vector<double> raw(static_cast<std::size_t>(placements.size()));
  MODEL::raw::fk<double>(q.data(), raw.data());
  for (Eigen::Index i = 0; i < placements.rows(); ++i)
    for (Eigen::Index j = 0; j < 12; ++j)
      demand(placements(i, j) == raw[static_cast<std::size_t>(12 * i + j)], "fk");
  print("fk", placements);

  namespace pattern = MODEL::sparsity;
  const auto M = MODEL::crba(q);
  raw.resize(pattern::crba_M_nnz);
  MODEL::raw::crba<double>(q.data(), raw.data());
  demand_entries(M, raw, pattern::crba_M_row, pattern::crba_M_col, "crba");
  print("crba", M);

  int status = -1;
  const auto Minv = MODEL::minv(q, &status);
  demand(status == 0, "minv");
  raw.resize(pattern::minv_Minv_nnz);
  demand(MODEL::raw::minv<double>(q.data(), raw.data()) == 0, "minv");
  demand_entries(Minv, raw, pattern::minv_Minv_row, pattern::minv_Minv_col, "minv");
  print("minv", Minv);
}

}  // namespace

int main() {
  Config q;
  Tangent v, a, tau;
  while (read(q.data(), nq) && read(v.data(), nv) && read(a.data(), nv) && read(tau.data(), nv)) {
    vectors(q, v, a);
    solved(q, v, tau);
    matrices(q);
  }
  return 0;
}
