// SPDX-License-Identifier: MIT
// Looks for the fields that only one kind of file has.
#include "Scene/FileKind.h"
#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

namespace physvib {
namespace {

constexpr std::size_t headBytes = 1 << 16; // long sessions have hundreds of megabytes, and say at their
                                           // beginning what they are

constexpr std::array<std::pair<std::string_view, FileKind>, 4> fields{
    // a session's desk has a layout, and a plug-in's state a scene
    {{"\"physvib_plugin_state\"", FileKind::pluginState},
     {"\"physvib_session\"", FileKind::session},
     {"\"physvib_scene\"", FileKind::scene},
     {"\"extent_m\"", FileKind::layout}}};

} // namespace

FileKind fileKind(const std::filesystem::path& path) {
    std::string head(headBytes, '\0');
    std::ifstream(path, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
    for (const auto& [field, kind] : fields)
        if (head.find(field) != std::string::npos) return kind;
    return FileKind::unknown;
}

} // namespace physvib
