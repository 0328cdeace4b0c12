#include "emit/names.h"

#include <fmt/format.h>

namespace arboc {
namespace {

bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool digit(char c) { return c >= '0' && c <= '9'; }

/// Keywords of C11 and C++20, common macros, names that generated code or its build uses, and
/// functions that the headers of the C library declare.
constexpr std::string_view kReserved = R"(
 BUFSIZ CHAR_BIT DOMAIN EOF Eigen HUGE_VAL INFINITY INT_MAX INT_MIN M_E M_PI NAN NULL OVERFLOW
 RAND_MAX SING UNDERFLOW abort abs accept access acos alarm alignas alignof all and and_eq arboc asctime asin
 asm assert atan atomic_cancel auto basename bind bitand bitor bool break brk calloc
 canonicalize case catch ceil char char16_t char32_t char8_t class clean clock clone close
 co_await co_return co_yield compl concept confstr connect const const_cast consteval constexpr
 constinit continue cos cosh creat crypt ctime daemon daylight decltype default delete div do
 double drem dup dynamic_cast else enum erf errno exit exp exp2 explicit export extern fabs
 false finite float floor fma fmod fopen for fork free frexp friend gamma getenv gets goto help
 hypot i386 if index initstate inline install int j0 j1 jn kill ldexp lgamma link linux listen
 localtime log logb long lround lseek main malloc memcpy mkdir modf mutable namespace nan new
 nice noexcept not not_eq nullptr obstack open operator or or_eq package pause perror pipe poll
 pow printf private protected public puts rand random raw read realloc recv register
 reinterpret_cast remainder remove rename requires restrict return rewind rindex rint round
 scalb select send setenv setstate short shutdown signal signed significand sin sincos sinh
 sizeof sleep socket sparsity sqrt stat static static_assert static_cast std stderr stdin stdout
 strlen struct swab switch sync system tan tanh template test tgamma this thread_local throw
 time timezone tm tmpfile true trunc truncate try typedef typeid typename typeof ungetc union
 unix unsigned using utime virtual void volatile wait wchar_t while write xor xor_eq y0 y1 yn )";

bool reserved(std::string_view name) {
  for (size_t at = kReserved.find(name); at != std::string_view::npos;
       at = kReserved.find(name, at + 1)) {
    const char before = kReserved[at - 1], after = kReserved[at + name.size()];
    if ((before == ' ' || before == '\n') && (after == ' ' || after == '\n')) return true;
  }
  return false;
}

}  // namespace

std::string identifier(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const char next = letter(c) || digit(c) ? c : '_';
    if (next == '_' && (out.empty() || out.back() == '_')) continue;
    out += next;
  }
  if (out.size() > 64) out.resize(64);
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.empty()) return "model";
  if (digit(out.front())) out.insert(0, "m");
  if (reserved(out)) out += "_model";
  return out;
}

std::string upper_case(std::string_view text) {
  std::string out;
  for (const char c : text) out += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return out;
}

std::string comment_text(std::string_view text) {
  constexpr std::string_view kSafe = " _.,:+-'()[]=";
  std::string out;
  for (const char c : text)
    out += letter(c) || digit(c) || kSafe.find(c) != std::string_view::npos ? c : '_';
  return out;
}

std::string string_literal(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (c < 0x20 || c > 0x7E || c == '?')
      out += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace arboc
