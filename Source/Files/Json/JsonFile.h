// SPDX-License-Identifier: MIT
// How every JSON file is read: within its limit, strictly, whole or not at all. For the .cpp files of Files.
#pragma once
#include "Files/Disk/ReadFile.h"
#include "Files/Result.h"
#include "Files/Json/StrictJson.h"
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>

namespace physvib {

/// What `read` makes of the value that `text` spells, or one line that begins with `name`. `read` takes a Json& and
/// throws JsonError. Any thread.
template <class Read>
Result<std::invoke_result_t<Read, Json&>> readJson(std::string_view text, std::string_view name, std::size_t maxBytes, Read read) {
    try {
        if (text.size() > maxBytes)
            throw JsonError({}, "expected at most " + std::to_string(maxBytes) + " bytes, found more");
        Json root = parseStrictly(text);
        return read(root);
    } catch (const JsonError& error) {
        return Failure{std::string(name) + ": " + error.what()};
    }
}

/// What `read` makes of a file's text and name. M only.
template <class Read>
std::invoke_result_t<Read, std::string_view, std::string_view> loadText(const std::filesystem::path& path, std::size_t maxBytes, Read read) {
    const Result<std::string> text = readFile(path, maxBytes);
    if (!text) return Failure{text.error};
    return read(text.value, path.string());
}

} // namespace physvib
