// SPDX-License-Identifier: MIT
// Whether two paths are one file, and whether one leaves its folder: by what paths are, not by how they are
// spelled.
#pragma once
#include <filesystem>
#include <span>
#include <string>

namespace physvib {

/// The folder that a file is in, or would be; "." of a name alone. Any thread.
std::filesystem::path folderOf(const std::filesystem::path& file);

/// Whether both name one file, there or to be made; links and folders may be spelled in any way. Any thread.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

inline constexpr const char* leadsElsewhere =
    "expected a file in its own folder or below, found a link that leads elsewhere";

/// Whether what `path` names, once all links are followed, is in `folder` or below; there or to be made. Any
/// thread but R.
bool isWithin(const std::filesystem::path& folder, const std::filesystem::path& path);

/// Empty, or one line on the first of `outputs` that is one of `inputs` or another output. Empty names are no
/// files. Any thread.
std::string fileClash(std::span<const std::string> outputs, std::span<const std::string> inputs);

} // namespace physvib
