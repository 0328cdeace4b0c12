// Choices out of bytes: what a fuzzer mutates steers what is built.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>

namespace arboc::fuzz {

/// Aborts, which a fuzzer takes as a find.
#define ARBOC_FUZZ_EXPECT(condition)                                               \
  do {                                                                             \
    if (!(condition)) {                                                            \
      std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                \
    }                                                                              \
  } while (false)

class Bytes {
 public:
  Bytes(const std::uint8_t* data, size_t size) : data_(data), size_(size) {}

  bool empty() const { return at_ >= size_; }
  /// 0 behind the end.
  unsigned next() { return empty() ? 0 : data_[at_++]; }
  /// 0 .. n-1, n <= 256.
  size_t below(size_t n) { return next() % n; }
  bool chance(unsigned of_256) { return next() < of_256; }
  template <class List>
  const auto& pick(const List& list) {
    return list[below(std::size(list))];
  }
  /// -1 .. 1.
  double unit() { return (static_cast<double>(next()) - 128) / 128 + next() / 65536.0; }

 private:
  const std::uint8_t* data_;
  size_t size_;
  size_t at_ = 0;
};

}  // namespace arboc::fuzz
