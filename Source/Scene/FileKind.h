// SPDX-License-Identifier: MIT
// Detects which kind of PhysVib file a JSON file is, without parsing it.
#pragma once
#include <filesystem>

namespace physvib {

enum class FileKind { unknown, session, scene, layout, pluginState };

/// By a field that every file of its kind has; the file may still be invalid. Unknown also if it cannot be
/// read. Message thread (M) only.
FileKind fileKind(const std::filesystem::path& path);

} // namespace physvib
