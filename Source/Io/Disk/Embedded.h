// SPDX-License-Identifier: MIT
// Files that are compiled into the library, so that no path is needed at run time; and the test that tells
// paths of JSON files from names of embedded ones.
#pragma once
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

/// True if `name` is a path, not the name of an embedded file: it ends in .json or has a folder. Any thread.
inline bool isJsonPath(std::string_view name) noexcept {
    return name.ends_with(".json") || name.find('/') != std::string_view::npos;
}

struct EmbeddedFile {
    std::string_view name; ///< "NAME.json"
    std::string_view text;
};

/// The results of `read` (text and name to a Result) for all files. Throws std::logic_error if one cannot be
/// read; a test reads them all. Any thread.
template <class Read>
auto readEmbedded(const std::vector<EmbeddedFile>& files, Read read) {
    std::vector<decltype(read(files.front().text, files.front().name).value)> values;
    for (const EmbeddedFile& file : files) {
        auto result = read(file.text, file.name);
        if (!result) throw std::logic_error(result.error);
        values.push_back(std::move(result.value));
    }
    return values;
}

} // namespace physvib
