// SPDX-License-Identifier: MIT
// Files that stand in the library itself, so that no path is needed at run time.
#pragma once
#include <string_view>
#include <vector>

namespace physvib {

struct EmbeddedFile {
    std::string_view name; ///< "shake-the-box.json"
    std::string_view text;
};

/// Source/Files/Scenes/*.json, in the order of their listing. Any thread.
const std::vector<EmbeddedFile>& embeddedScenes();

/// Source/Files/Materials/*.json. Any thread.
const std::vector<EmbeddedFile>& embeddedMaterials();

/// Source/Files/Protocols/*.json.
const std::vector<EmbeddedFile>& embeddedProtocols();

/// Source/Files/Actuators/*.json.
const std::vector<EmbeddedFile>& embeddedActuators();

} // namespace physvib
