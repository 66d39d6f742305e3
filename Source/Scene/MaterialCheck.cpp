// SPDX-License-Identifier: MIT
// Ranges and names of materials.
#include "Core/NameNumbers.h"
#include "Scene/MaterialTable.h"
#include "Scene/SceneRanges.h"
#include <algorithm>

namespace physvib {

std::string checkMaterialNames(const std::vector<Material>& all) {
    if (std::string fault = checkUnique("materials", all); !fault.empty()) return fault;
    std::vector<SoundNumber> sounds;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const SoundNumber sound = soundOfMaterial(all[i].name);
        const auto same = static_cast<std::size_t>(std::ranges::find(sounds, sound) - sounds.begin());
        if (same < i)
            return detail::itemPath("materials", i) + ".name: expected another name: \"" + all[i].name +
                   "\" and \"" + all[same].name + "\" have the same number by chance";
        sounds.push_back(sound);
    }
    return {};
}

std::string validateMaterials(const std::vector<Material>& materials) {
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (std::string fault = checkRanges(materials[i], detail::itemPath("materials", i)); !fault.empty())
            return fault;
    return checkMaterialNames(materials);
}

} // namespace physvib
