// SPDX-License-Identifier: MIT
// Detects the kind of a JSON file by a field that only this kind has.
#include "Scene/FileKind.h"
#include "Io/Disk/ReadFile.h"
#include <array>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace physvib {
namespace {

constexpr std::size_t headBytes = 1 << 16; // long sessions have hundreds of megabytes; the field begins them

constexpr std::array<std::pair<std::string_view, FileKind>, 4> fields{
    // a session's desk has a layout, and a plug-in's state a scene
    {{"\"physvib_plugin_state\"", FileKind::pluginState},
     {"\"physvib_session\"", FileKind::session},
     {"\"physvib_scene\"", FileKind::scene},
     {"\"extent_m\"", FileKind::layout}}};

} // namespace

FileKind fileKind(const std::filesystem::path& path) {
    std::string head(headBytes, '\0');
    if (const auto file = openRegular(path, std::numeric_limits<std::size_t>::max()))
        head.resize(std::fread(head.data(), 1, head.size(), file.value.stream.get()));
    for (const auto& [field, kind] : fields)
        if (head.find(field) != std::string::npos) return kind;
    return FileKind::unknown;
}

} // namespace physvib
