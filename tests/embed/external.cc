#include "embed/external.h"

#include <gtest/gtest.h>

namespace arboc::test {
namespace {

template <class F>
void look_up(const cli::Library& library, const std::string& name, F& function) {
  function = reinterpret_cast<F>(library.symbol(name));
}

CompressedColumns read_pattern(const long long* s) {
  CompressedColumns out;
  out.rows = static_cast<int>(s[0]);
  out.cols = static_cast<int>(s[1]);
  const long long* colptr = s + 2;
  EXPECT_EQ(colptr[0], 0);
  for (int j = 0; j <= out.cols; ++j) out.colptr.push_back(static_cast<int>(colptr[j]));
  const long long* row = colptr + out.cols + 1;
  for (int j = 0; j < out.cols; ++j) {
    for (long long k = colptr[j]; k < colptr[j + 1]; ++k) {
      EXPECT_TRUE(row[k] >= 0 && row[k] < out.rows);
      EXPECT_TRUE(k == colptr[j] || row[k] > row[k - 1]);
      out.row.push_back(static_cast<int>(row[k]));
    }
  }
  return out;
}

/// Values with room behind them that nobody may write to.
class Guarded {
 public:
  explicit Guarded(long long size) : size_(static_cast<size_t>(size)), x_(size_ + 4, kGuard) {}
  ~Guarded() {
    for (size_t k = size_; k < x_.size(); ++k) EXPECT_EQ(x_[k], kGuard);
  }
  Guarded(Guarded&&) = default;
  double* data() { return x_.data(); }
  std::vector<double> values() const { return {x_.begin(), x_.begin() + static_cast<long>(size_)}; }

 private:
  static constexpr double kGuard = 12345.678;
  size_t size_;
  std::vector<double> x_;
};

}  // namespace

std::vector<double> CompressedColumns::dense(const std::vector<double>& values) const {
  std::vector<double> out(static_cast<size_t>(rows) * static_cast<size_t>(cols));
  for (int j = 0; j < cols; ++j)
    for (int k = colptr[static_cast<size_t>(j)]; k < colptr[static_cast<size_t>(j) + 1]; ++k)
      out[static_cast<size_t>(row[static_cast<size_t>(k)] * cols + j)] =
          values[static_cast<size_t>(k)];
  return out;
}

External::External(const cli::Library& library, const std::string& name) {
  const auto named = [&](const char* suffix) { return name + suffix; };
  void (*incref)(), (*decref)();
  long long (*n_in)(), (*n_out)();
  const char* (*name_in)(long long), *(*name_out)(long long);
  const long long* (*sparsity_in)(long long), *(*sparsity_out)(long long);
  double (*default_in)(long long);
  int (*work)(long long*, long long*, long long*, long long*);
  look_up(library, name, call_);
  look_up(library, named("_checkout"), checkout_);
  look_up(library, named("_release"), release_);
  look_up(library, named("_incref"), incref);
  look_up(library, named("_decref"), decref);
  look_up(library, named("_n_in"), n_in);
  look_up(library, named("_n_out"), n_out);
  look_up(library, named("_name_in"), name_in);
  look_up(library, named("_name_out"), name_out);
  look_up(library, named("_sparsity_in"), sparsity_in);
  look_up(library, named("_sparsity_out"), sparsity_out);
  look_up(library, named("_default_in"), default_in);
  look_up(library, named("_work"), work);
  int (*alloc_mem)(), (*init_mem)(int);
  void (*free_mem)(int);
  look_up(library, named("_alloc_mem"), alloc_mem);
  look_up(library, named("_init_mem"), init_mem);
  look_up(library, named("_free_mem"), free_mem);
  incref();
  const int memory = alloc_mem();
  EXPECT_EQ(init_mem(memory), 0);
  free_mem(memory);
  for (long long i = 0; i < n_in(); ++i) {
    input_names.emplace_back(name_in(i));
    inputs.push_back(read_pattern(sparsity_in(i)));
    EXPECT_EQ(default_in(i), 0);
  }
  for (long long i = 0; i < n_out(); ++i) {
    output_names.emplace_back(name_out(i));
    outputs.push_back(read_pattern(sparsity_out(i)));
  }
  for (const long long beyond : {-1LL, n_in(), 1LL << 40}) EXPECT_EQ(name_in(beyond), nullptr);
  for (const long long beyond : {-1LL, n_out()}) EXPECT_EQ(sparsity_out(beyond), nullptr);
  EXPECT_EQ(work(&arg_, &res_, &iw_, &w_), 0);
  EXPECT_EQ(work(nullptr, nullptr, nullptr, nullptr), 0);
  EXPECT_GE(arg_, n_in());
  EXPECT_GE(res_, n_out());
  decref();
}

External::Vectors External::operator()(const Vectors& in, const std::vector<bool>& wanted,
                                       int* status) const {
  std::vector<const double*> arg(static_cast<size_t>(arg_));
  for (size_t i = 0; i < in.size(); ++i) arg[i] = in[i].empty() ? nullptr : in[i].data();
  std::vector<Guarded> results;
  std::vector<double*> res(static_cast<size_t>(res_));
  for (size_t k = 0; k < outputs.size(); ++k) {
    results.emplace_back(outputs[k].entries());
    if (wanted.empty() || wanted[k]) res[k] = results.back().data();
  }
  std::vector<long long> iw(static_cast<size_t>(iw_));
  Guarded w(w_);
  const int memory = checkout_();
  const int returned = call_(arg.data(), res.data(), iw.data(), w.data(), memory);
  release_(memory);
  if (status)
    *status = returned;
  else
    EXPECT_EQ(returned, 0);
  Vectors out;
  for (size_t k = 0; k < outputs.size(); ++k)
    out.push_back(res[k] ? results[k].values() : std::vector<double>());
  return out;
}

}  // namespace arboc::test
