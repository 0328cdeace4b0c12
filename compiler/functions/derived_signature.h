// Arguments of derivatives: names, shapes, units, meanings.
#pragma once
#include "emit/target.h"
#include "functions/request.h"
#include "functions/setup.h"

namespace arboc {

/// The inputs by which a derivative is taken: those named, or all.
std::vector<std::string> derived_inputs(const Request& request, const Signature& signature);

/// The argument of that name; otherwise throws a UsageError that says which there are.
const Argument& named(const std::vector<Argument>& arguments, const std::string& name,
                      const Request& request, const char* what);

/// The place of an output that there is.
size_t output_index(const Signature& s, const std::string& name);

/// Each input by which a derivative is taken is there, once.
void check_inputs(const Request& request, const Signature& s);

/// Adds the outputs, and lambda where there is one, to the signature `s` of the function whose
/// output `of` is differentiated.
void add_derivatives(const Request& request, const Setup& setup, const Argument& of, Signature& s);

/// One sentence.
std::string meaning_of(const Request& request, const Signature& base, const Argument& of,
                       bool iterated);

}  // namespace arboc
