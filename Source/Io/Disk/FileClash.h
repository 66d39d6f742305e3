// SPDX-License-Identifier: MIT
// Checks of paths: whether two are the same file, whether one leaves its folder, and file name extensions.
#pragma once
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace physvib {
/// The parent folder; "." for a name alone. Any thread.
std::filesystem::path parentFolder(const std::filesystem::path& file);

/// A file's name without its folders. Any thread.
inline std::string fileNameOf(const std::filesystem::path& file) { return file.filename().string(); }

/// True if both name one file, existing or not; links and folders may be spelled in any way. Any thread.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

inline constexpr const char* linkLeadsElsewhere =
    "expected a file in its own folder or below, found a link that leads elsewhere";

/// True if `path`, after following all links, is in `folder` or below, existing or not. Not on the render
/// thread.
bool isWithin(const std::filesystem::path& folder, const std::filesystem::path& path);

/// Empty, or one line on the first of `outputs` that equals an input or another output. Empty names are
/// skipped.
std::string fileClashError(std::span<const std::string> outputs, std::span<const std::string> inputs);

/// Empty, or `expected a name that ends in .webp, .gif or .mp4, found "a.avi"`. Any thread (allocates).
inline std::string fileExtensionError(std::string_view path, std::span<const std::string_view> endings) {
    const auto hasEnding = [path](std::string_view ending) { return path.ends_with(ending); };
    if (std::ranges::any_of(endings, hasEnding)) return {};
    return "expected a name that ends in " + nameList(endings, " or ") + ", found " + inQuotes(path);
}
inline std::string fileExtensionError(std::string_view path,
                                      std::initializer_list<std::string_view> endings) {
    return fileExtensionError(path, std::span{endings.begin(), endings.size()});
}

} // namespace physvib
