#pragma once

#include <string>

namespace vellus {

/// The demangled name of a function of this program, static ones too, without its parameters; from
/// the symbol table of /proc/self/exe. Empty where that is stripped.
std::string symbol_name(void (*function)());

}  // namespace vellus
