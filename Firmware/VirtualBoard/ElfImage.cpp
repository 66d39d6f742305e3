// SPDX-License-Identifier: MIT
// Parses the 32-bit little-endian ELF files that the firmware's linker writes.
#include "ElfImage.h"
#include <cstring>
#include <elf.h>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace physvib::virtualboard {
namespace {

template <class T>
T at(const std::vector<std::uint8_t>& file, std::size_t offset) {
    if (offset + sizeof(T) > file.size()) throw std::runtime_error("ends too early");
    T value;
    std::memcpy(&value, file.data() + offset, sizeof value);
    return value;
}

void readSegments(const std::vector<std::uint8_t>& file, const Elf32_Ehdr& head, ElfImage& image) {
    for (unsigned i = 0; i < head.e_phnum; ++i) {
        const auto part = at<Elf32_Phdr>(file, head.e_phoff + i * sizeof(Elf32_Phdr));
        if (part.p_type != PT_LOAD || part.p_filesz == 0) continue;
        if (part.p_offset + static_cast<std::size_t>(part.p_filesz) > file.size())
            throw std::runtime_error("ends too early");
        const auto begin = file.begin() + static_cast<std::ptrdiff_t>(part.p_offset);
        image.segments.push_back({part.p_paddr, {begin, begin + static_cast<std::ptrdiff_t>(part.p_filesz)}});
    }
}

void readSymbols(const std::vector<std::uint8_t>& file, const Elf32_Ehdr& head, ElfImage& image) {
    for (unsigned i = 0; i < head.e_shnum; ++i) {
        const auto section = at<Elf32_Shdr>(file, head.e_shoff + i * sizeof(Elf32_Shdr));
        if (section.sh_type != SHT_SYMTAB) continue;
        const auto names = at<Elf32_Shdr>(file, head.e_shoff + section.sh_link * sizeof(Elf32_Shdr));
        for (std::size_t k = 0; k < section.sh_size / sizeof(Elf32_Sym); ++k) {
            const auto symbol = at<Elf32_Sym>(file, section.sh_offset + k * sizeof(Elf32_Sym));
            std::string name;
            for (std::size_t c = names.sh_offset + symbol.st_name; c < file.size() && file[c] != 0; ++c)
                name += static_cast<char>(file[c]);
            image.symbols[name] = {symbol.st_value, symbol.st_size};
        }
    }
}

} // namespace

ElfImage readElf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error(path + ": cannot be read");
    const std::vector<std::uint8_t> file((std::istreambuf_iterator<char>(in)), {});
    ElfImage image;
    try {
        const auto head = at<Elf32_Ehdr>(file, 0);
        if (std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_machine != EM_ARM)
            throw std::runtime_error("expected an Arm ELF file");
        readSegments(file, head, image);
        readSymbols(file, head, image);
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(path + ": " + e.what());
    }
    return image;
}

ElfImage::Symbol ElfImage::symbolLike(const std::string& part) const {
    for (const auto& [name, symbol] : symbols)
        if (name.find(part) != std::string::npos) return symbol;
    throw std::runtime_error("no symbol like " + part + " in the image");
}

} // namespace physvib::virtualboard
