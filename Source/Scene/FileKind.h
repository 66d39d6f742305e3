// SPDX-License-Identifier: MIT
// What a JSON file of ours describes, before it is read.
#pragma once
#include <filesystem>

namespace physvib {

enum class FileKind { unknown, session, scene, layout, pluginState };

/// By the field that every file of its kind has; a file that says what it is may be broken all the same.
/// Unknown as well if it cannot be read. M only.
FileKind fileKind(const std::filesystem::path& path);

} // namespace physvib
