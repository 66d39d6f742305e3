// SPDX-License-Identifier: MIT
// Material tables as JSON: libraries from which scenes copy materials.
#pragma once
#include "Io/Result.h"
#include "Scene/Scene.h"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The version of the format that is written, and the newest that is read.
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

/// The same for a file. Message thread (M) only.
Result<MaterialTable> loadMaterials(const std::filesystem::path& path);

/// `table` as JSON, a material per line; readMaterials restores it bit for bit. Any thread.
std::string materialsJson(const MaterialTable& table);

/// Table 5.1 of the thesis, then the other tables. Read on first use; any thread.
const std::vector<MaterialTable>& builtInMaterials();

} // namespace physvib
