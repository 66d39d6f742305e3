// SPDX-License-Identifier: MIT
// Material tables as JSON, from which scenes copy materials; and checks of materials and of unique names.
#pragma once
#include "Core/NameNumbers.h"
#include "Io/Result.h"
#include "Scene/Scene.h"
#include "Scene/SceneRanges.h"
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The newest version of the format.
constexpr int materialsFormatVersion = 1;

struct MaterialTable {
    std::string name;
    std::string source; ///< source of the figures
    std::vector<Material> materials;
    bool operator==(const MaterialTable&) const = default;
};

/// The table in `text`, checked like a scene's materials; or one line `name: materials[2].friction: expected
/// 0 to 100, found -1`. Any thread.
Result<MaterialTable> readMaterials(std::string_view text, std::string_view name);

/// Reads a file, with the checks and errors of readMaterials(). Message thread only.
Result<MaterialTable> loadMaterials(const std::filesystem::path& path);

/// The tables that come with PhysVib, Table 5.1 of the thesis first. Read on first use; any thread.
const std::vector<MaterialTable>& builtInMaterials();

/// Checks that names are unique: empty, or one line for the first item whose name occurs earlier; `list` is
/// the list's name in files. Any thread.
template <class T>
std::string checkUnique(const std::string& list, const std::vector<T>& all) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!names.insert(all[i].name).second)
            return detail::itemPath(list, i) + ".name: expected a name of its own, found \"" + all[i].name +
                   "\" again";
    return {};
}

/// Checks that names are unique, and also their hash numbers, which events carry: empty, or one line with the
/// field as files spell it and what was expected. Any thread.
inline std::string checkMaterialNames(const std::vector<Material>& all) {
    if (std::string error = checkUnique("materials", all); !error.empty()) return error;
    std::vector<SoundNumber> sounds;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const SoundNumber sound = soundOfMaterial(all[i].name);
        const auto firstIndex = static_cast<std::size_t>(std::ranges::find(sounds, sound) - sounds.begin());
        if (firstIndex < i)
            return detail::itemPath("materials", i) + ".name: expected another name: \"" + all[i].name +
                   "\" and \"" + all[firstIndex].name + "\" have the same number by chance";
        sounds.push_back(sound);
    }
    return {};
}

/// Checks ranges and names of materials, of a scene or a table: empty, or one such line. Any thread.
inline std::string validateMaterials(const std::vector<Material>& materials) {
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (std::string error = checkRanges(materials[i], detail::itemPath("materials", i)); !error.empty())
            return error;
    return checkMaterialNames(materials);
}

} // namespace physvib
