// SPDX-License-Identifier: MIT
// How every JSON file is read: as its text is. For the .cpp files of Files.
#pragma once
#include "Files/Disk/ReadFile.h"
#include "Files/Json/JsonText.h"
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>

namespace physvib {

/// What `read` makes of a file's text and name. M only.
template <class Read>
std::invoke_result_t<Read, std::string_view, std::string_view> loadText(const std::filesystem::path& path, std::size_t maxBytes, Read read) {
    const Result<std::string> text = readFile(path, maxBytes);
    if (!text) return Failure{text.error};
    return read(text.value, path.string());
}

} // namespace physvib
