// SPDX-License-Identifier: MIT
// Whether a call would write over what it reads, or over what it writes: by what paths are, not by how they are spelled.
#pragma once
#include <filesystem>
#include <span>
#include <string>

namespace physvib {

/// Whether both name one file, there or to be made; links and folders may be spelled in any way. Any thread.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// Empty, or one line on the first of `outputs` that is one of `inputs` or another output. Empty names are no files. Any thread.
std::string fileClash(std::span<const std::string> outputs, std::span<const std::string> inputs);

} // namespace physvib
