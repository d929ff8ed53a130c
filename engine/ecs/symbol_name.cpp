#include "engine/ecs/symbol_name.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <elf.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/platform/files.h"

namespace vellus {
namespace {

template <class T>
std::span<const T> view(std::span<const std::byte> file, size_t offset, size_t count) {
    if (offset > file.size() || count > (file.size() - offset) / sizeof(T)) return {};
    return {reinterpret_cast<const T*>(file.data() + offset), count};
}

struct Symbols {
    bool relocated = false;  // addresses are relative to where the program is loaded
    std::unordered_map<uintptr_t, std::string> mangled;
};

void add_functions(Symbols& symbols, std::span<const Elf64_Sym> table, std::span<const char> text) {
    for (const Elf64_Sym& symbol : table) {
        if (ELF64_ST_TYPE(symbol.st_info) != STT_FUNC || symbol.st_name >= text.size()) continue;
        const char* const name = &text[symbol.st_name];
        symbols.mangled.try_emplace(symbol.st_value, name,
                                    strnlen(name, text.size() - symbol.st_name));
    }
}

Symbols read_symbols() {
    Symbols symbols;
    const auto file = read_file("/proc/self/exe");
    if (!file) return symbols;
    const auto header = view<Elf64_Ehdr>(*file, 0, 1);
    if (header.empty() || std::memcmp(header[0].e_ident, ELFMAG, SELFMAG) != 0) return symbols;
    symbols.relocated = header[0].e_type == ET_DYN;
    const auto sections = view<Elf64_Shdr>(*file, header[0].e_shoff, header[0].e_shnum);
    for (const Elf64_Shdr& section : sections) {
        if (section.sh_type != SHT_SYMTAB || section.sh_link >= sections.size()) continue;
        const Elf64_Shdr& strings = sections[section.sh_link];
        add_functions(
            symbols, view<Elf64_Sym>(*file, section.sh_offset, section.sh_size / sizeof(Elf64_Sym)),
            view<char>(*file, strings.sh_offset, strings.sh_size));
    }
    return symbols;
}

std::string demangled(const std::string& mangled) {
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> text(
        abi::__cxa_demangle(mangled.c_str(), nullptr, nullptr, &status), std::free);
    return status == 0 ? std::string(text.get()) : mangled;
}

/// "a::(anonymous namespace)::f(int)" -> "a::f"
std::string without_parameters(std::string name) {
    constexpr std::string_view kAnonymous = "(anonymous namespace)::";
    for (size_t at = name.find(kAnonymous); at != std::string::npos; at = name.find(kAnonymous)) {
        name.erase(at, kAnonymous.size());
    }
    return name.substr(0, name.find('('));
}

uintptr_t load_address(void (*function)()) {
    Dl_info object{};
    const bool found = dladdr(reinterpret_cast<void*>(function), &object) != 0;
    return found ? reinterpret_cast<uintptr_t>(object.dli_fbase) : 0;
}

}  // namespace

std::string symbol_name(void (*function)()) {
    static const Symbols kSymbols = read_symbols();
    const uintptr_t base = load_address(function);
    const bool elsewhere = base != load_address(reinterpret_cast<void (*)()>(&read_symbols));
    if (base == 0 || elsewhere) return {};
    const auto address = reinterpret_cast<uintptr_t>(function) - (kSymbols.relocated ? base : 0);
    const auto found = kSymbols.mangled.find(address);
    return found == kSymbols.mangled.end() ? std::string{}
                                           : without_parameters(demangled(found->second));
}

}  // namespace vellus
