// SPDX-License-Identifier: MIT
// Reads material tables; a material's fields are those of scenes.
#include "Scene/MaterialTable.h"
#include "Io/Disk/Embedded.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonText.h"
#include "Scene/SceneJson.h"
#include "Scene/SceneLimits.h"

namespace physvib {

// Source/Scene/Materials/*.json, in the order of their listing
const std::vector<EmbeddedFile>& embeddedMaterials();

void visitFields(auto& v, FieldsOf<MaterialTable>) {
    v.field("name", &MaterialTable::name, anyText);
    v.field("source", &MaterialTable::source, anyText, Need::optional);
    v.field("materials", &MaterialTable::materials, items(0, sceneLimits::maxMaterials));
}

namespace {

constexpr const char* materialsVersionField = "physvib_materials";

MaterialTable readMaterialsRoot(Json& root) {
    checkVersion(JsonField(root, {}), materialsVersionField, materialsFormatVersion);
    root.erase(materialsVersionField);
    auto table = readFields<MaterialTable>(JsonField(root, {}));
    if (const std::string error = validateMaterials(table.materials); !error.empty())
        throw JsonError({}, error);
    return table;
}

} // namespace

Result<MaterialTable> readMaterials(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxMaterialsFileBytes, readMaterialsRoot);
}

Result<MaterialTable> loadMaterials(const std::filesystem::path& path) {
    return loadText(path, limits::maxMaterialsFileBytes, readMaterials);
}

const std::vector<MaterialTable>& builtInMaterials() {
    static const std::vector<MaterialTable> tables = readEmbedded(embeddedMaterials(), readMaterials);
    return tables;
}

} // namespace physvib
