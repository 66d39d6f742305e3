// SPDX-License-Identifier: GPL-3.0-or-later
// The built-in scenes, materials, actuators and pads for the Projucer; for CMake see Source/Io/embed.cmake.
#include "BinaryData.h"
#include "Io/Disk/Embedded.h"

namespace physvib {

namespace {

/// All that hold this field, the version of their format: it tells the kinds from each other.
std::vector<EmbeddedFile> embedded(std::string_view versionField) {
    std::vector<EmbeddedFile> files;
    for (int i = 0; i < BinaryData::namedResourceListSize; ++i) {
        int size = 0;
        const char* const text = BinaryData::getNamedResource(BinaryData::namedResourceList[i], size);
        const std::string_view content{text, static_cast<std::size_t>(size)};
        if (content.find(versionField) != content.npos)
            files.push_back({BinaryData::originalFilenames[i], content});
    }
    return files;
}

} // namespace

const std::vector<EmbeddedFile>& embeddedScenes() {
    static const auto files = embedded("\"physvib_scene\"");
    return files;
}

const std::vector<EmbeddedFile>& embeddedMaterials() {
    static const auto files = embedded("\"physvib_materials\"");
    return files;
}

const std::vector<EmbeddedFile>& embeddedActuators() {
    static const auto files = embedded("\"physvib_actuator\"");
    return files;
}

const std::vector<EmbeddedFile>& embeddedPads() {
    static const auto files = embedded("\"physvib_pad\"");
    return files;
}

} // namespace physvib
