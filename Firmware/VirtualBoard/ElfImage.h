// SPDX-License-Identifier: MIT
// The firmware's ELF file: segments with their flash addresses, and symbols.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace physvib::virtualboard {

struct ElfImage {
    struct Segment {
        std::uint32_t address = 0; ///< load address (flash)
        std::vector<std::uint8_t> bytes;
    };
    struct Symbol {
        std::uint32_t address = 0, size = 0;
    };
    std::vector<Segment> segments;
    std::map<std::string, Symbol> symbols; ///< by mangled name

    /// The symbol whose name contains `part`; throws std::runtime_error if there is none.
    Symbol symbolLike(const std::string& part) const;
};

/// Throws std::runtime_error with the file's name and what was expected.
ElfImage readElf(const std::string& path);

} // namespace physvib::virtualboard
