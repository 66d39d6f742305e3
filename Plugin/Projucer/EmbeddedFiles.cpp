// SPDX-License-Identifier: GPL-3.0-or-later
// The built-in scenes and materials where the Projucer embeds them (CMake does by Source/Files/embed.cmake).
#include "BinaryData.h"
#include "Files/Embedded.h"

namespace physvib {

namespace {

constexpr std::string_view sceneVersion = "\"physvib_scene\""; // what tells a scene from a table of materials

std::vector<EmbeddedFile> embedded(bool areScenes) {
    std::vector<EmbeddedFile> files;
    for (int i = 0; i < BinaryData::namedResourceListSize; ++i) {
        int size = 0;
        const char* const text = BinaryData::getNamedResource(BinaryData::namedResourceList[i], size);
        const std::string_view content{text, static_cast<std::size_t>(size)};
        if ((content.find(sceneVersion) != content.npos) == areScenes) files.push_back({BinaryData::originalFilenames[i], content});
    }
    return files;
}

} // namespace

const std::vector<EmbeddedFile>& embeddedScenes() {
    static const auto files = embedded(true);
    return files;
}

const std::vector<EmbeddedFile>& embeddedMaterials() {
    static const auto files = embedded(false);
    return files;
}

} // namespace physvib
