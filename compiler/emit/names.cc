#include "emit/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace arboc {
namespace {

bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool digit(char c) { return c >= '0' && c <= '9'; }

/// Keywords of C11 and C++20, common macros, and the names that generated code uses itself.
constexpr std::array kReserved = {"NULL",         "alignas",
                                  "alignof",      "and",
                                  "and_eq",       "arboc",
                                  "asm",          "atomic_cancel",
                                  "auto",         "bitand",
                                  "bitor",        "bool",
                                  "break",        "case",
                                  "catch",        "char",
                                  "char16_t",     "char32_t",
                                  "char8_t",      "class",
                                  "co_await",     "co_return",
                                  "co_yield",     "compl",
                                  "concept",      "const",
                                  "const_cast",   "consteval",
                                  "constexpr",    "constinit",
                                  "continue",     "decltype",
                                  "default",      "delete",
                                  "do",           "double",
                                  "dynamic_cast", "else",
                                  "enum",         "errno",
                                  "explicit",     "export",
                                  "extern",       "false",
                                  "float",        "for",
                                  "friend",       "goto",
                                  "if",           "inline",
                                  "int",          "linux",
                                  "long",         "main",
                                  "mutable",      "namespace",
                                  "new",          "noexcept",
                                  "not",          "not_eq",
                                  "nullptr",      "operator",
                                  "or",           "or_eq",
                                  "private",      "protected",
                                  "public",       "raw",
                                  "register",     "reinterpret_cast",
                                  "requires",     "restrict",
                                  "return",       "short",
                                  "signed",       "sizeof",
                                  "static",       "static_assert",
                                  "static_cast",  "std",
                                  "struct",       "switch",
                                  "template",     "this",
                                  "thread_local", "throw",
                                  "true",         "try",
                                  "typedef",      "typeid",
                                  "typename",     "typeof",
                                  "union",        "unix",
                                  "unsigned",     "using",
                                  "virtual",      "void",
                                  "volatile",     "wchar_t",
                                  "while",        "xor",
                                  "xor_eq",       "Eigen",
                                  "i386",         "assert",
                                  "signal",       "stdin",
                                  "stdout",       "stderr",
                                  "abs",          "exp",
                                  "log",          "sin",
                                  "cos",          "sqrt",
                                  "pow",          "div",
                                  "time",         "exit",
                                  "free",         "printf",
                                  "test",         "all",
                                  "install",      "clean",
                                  "help",         "package",
                                  "accept",       "access",
                                  "alarm",        "bind",
                                  "canonicalize", "ceil",
                                  "clock",        "clone",
                                  "close",        "connect",
                                  "creat",        "daylight",
                                  "drem",         "dup",
                                  "fabs",         "finite",
                                  "floor",        "fork",
                                  "frexp",        "gamma",
                                  "hypot",        "index",
                                  "initstate",    "j0",
                                  "j1",           "jn",
                                  "kill",         "link",
                                  "listen",       "lround",
                                  "modf",         "nan",
                                  "nice",         "obstack",
                                  "open",         "pause",
                                  "pipe",         "poll",
                                  "random",       "rand",
                                  "read",         "remove",
                                  "rename",       "rewind",
                                  "rindex",       "rint",
                                  "round",        "scalb",
                                  "select",       "send",
                                  "setstate",     "shutdown",
                                  "significand",  "sincos",
                                  "sleep",        "socket",
                                  "stat",         "swab",
                                  "sync",         "system",
                                  "tan",          "timezone",
                                  "tm",           "trunc",
                                  "truncate",     "wait",
                                  "write",        "y0",
                                  "y1",           "yn"};

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
  if (std::find(kReserved.begin(), kReserved.end(), out) != kReserved.end()) out += "_model";
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
