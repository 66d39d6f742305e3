// SPDX-License-Identifier: MIT
// The firmware's ELF file: what goes where in flash, and the addresses of its names.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace physvib::virtualboard {

struct ElfImage {
    struct Segment {
        std::uint32_t address = 0; ///< where it is loaded (flash)
        std::vector<std::uint8_t> bytes;
    };
    struct Symbol {
        std::uint32_t address = 0, size = 0;
    };
    std::vector<Segment> segments;
    std::map<std::string, Symbol> symbols; ///< as the linker writes them (mangled)

    /// The one symbol whose name contains `part`; throws std::runtime_error if none does.
    Symbol symbolLike(const std::string& part) const;
};

/// Throws std::runtime_error: the file's name and what was expected.
ElfImage readElf(const std::string& path);

} // namespace physvib::virtualboard
