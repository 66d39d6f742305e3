// SPDX-License-Identifier: MIT
// A whole file as text, or one line that says why it cannot be read.
#pragma once
#include "Files/Result.h"
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace physvib {

/// The bytes of the file, at most `maxBytes`. Pipes are read to their end. M only.
inline Result<std::string> readFile(const std::filesystem::path& path, std::size_t maxBytes) {
    const auto unreadable = [&path](int code) {
        return Failure{path.string() + ": cannot be read: " + std::generic_category().message(code)};
    };
    const auto close = [](std::FILE* open) { std::fclose(open); };
    const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.string().c_str(), "rb"), close);
    if (!file) return unreadable(errno);

    std::string text;
    std::array<char, 65536> block;
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
        text.append(block.data(), count);
        if (text.size() > maxBytes)
            return Failure{path.string() + ": expected at most " + std::to_string(maxBytes) +
                           " bytes, found more"};
    }
    if (std::ferror(file.get())) return unreadable(errno);
    return text;
}

} // namespace physvib
