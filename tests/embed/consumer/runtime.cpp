#include <arboc/pack.hpp>
#include <cstdio>

int main() {
  arboc::Pack<double, 4> sine, cosine;
  sincos(arboc::Pack<double, 4>(1.0), sine, cosine);
  std::printf("%.12f\n", sine[3]);
}
