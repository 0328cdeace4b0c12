#include "functions/request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/diagnostic.h"
#include "base/words.h"

namespace arboc {
namespace {

const char* word(Derivative derivative) {
  switch (derivative) {
    case Derivative::kJacobian: return "jacobian";
    case Derivative::kGradient: return "gradient";
    case Derivative::kVjp: return "vjp";
    case Derivative::kHessian: return "hessian";
    case Derivative::kNone: break;
  }
  return "";
}

}  // namespace

Request parse_request(const std::string& option, Derivative derivative, const std::string& text) {
  const auto wrong = [&] {
    return UsageError(
        fmt::format("{}: '{}' is not of the form FUNCTION.OUTPUT[:INPUT,...], such as rnea.tau:q,v",
                    option, printable(text)));
  };
  Request request;
  request.derivative = derivative;
  const size_t colon = text.find(':'), dot = text.find('.');
  if (dot == 0 || dot >= std::min(colon, text.size())) throw wrong();
  request.function = text.substr(0, dot);
  request.output = text.substr(dot + 1, colon == std::string::npos ? colon : colon - dot - 1);
  if (request.output.ends_with("^2")) {
    request.squares = true;
    request.output.resize(request.output.size() - 2);
  }
  if (request.output.empty()) throw wrong();
  if (request.squares && derivative != Derivative::kGradient && derivative != Derivative::kHessian)
    throw UsageError(fmt::format("{}: '{}': a sum of squares has a --gradient and a --hessian",
                                 option, printable(text)));
  if (colon == std::string::npos) return request;
  for (const std::string& item : split(text.substr(colon + 1))) {
    if (item.empty()) throw wrong();
    request.with.push_back(item);
  }
  if (request.with.empty()) throw wrong();
  return request;
}

std::string name(const Request& request) {
  if (request.derivative == Derivative::kNone) return request.function;
  std::string out = fmt::format("{}_{}{}_{}", request.function, request.output,
                                request.squares ? "2" : "", word(request.derivative));
  for (const std::string& input : request.with) out += "_" + input;
  return out;
}

std::string text(const Request& request) {
  if (request.derivative == Derivative::kNone) return request.function;
  std::string out = fmt::format("--{} {}.{}{}", word(request.derivative), request.function,
                                request.output, request.squares ? "^2" : "");
  if (!request.with.empty()) out += fmt::format(":{}", fmt::join(request.with, ","));
  return out;
}

}  // namespace arboc
