// SPDX-License-Identifier: MIT
// Material libraries survive writing and reading, and Table 5.1 is what the thesis printed.
#include "Scene/MaterialTable.h"
#include "Io/Disk/AtomicFile.h"
#include "Support/FileTesting.h"

namespace physvib {
namespace {

std::string errorOf(const std::string& text) {
    const auto read = readMaterials(text, "my.json");
    EXPECT_FALSE(read);
    EXPECT_TRUE(read.value == MaterialTable{});
    return read.error;
}

TEST(MaterialTable, HasTheRowsOfTheThesis) {
    const MaterialTable& table = builtInMaterials().front();
    ASSERT_EQ(table.materials.size(), 6U);
    const Material& steel = table.materials[5];
    EXPECT_EQ(steel.name, "steel plate");
    EXPECT_EQ(steel.densityKgPerSquareMetre, 7820.0);
    EXPECT_EQ(steel.restitution, 0.597);
    EXPECT_EQ(steel.frequencyHz, 430.0);
    EXPECT_EQ(steel.decayPerSecond, 11.97);
    EXPECT_EQ(table.materials[0].densityKgPerSquareMetre, 120.0);
}

TEST(MaterialTable, WrittenAndReadItIsTheSame) {
    const std::string text = materialsJson(builtInMaterials().front());
    const auto again = readMaterials(text, "my.json");
    ASSERT_TRUE(again) << again.error;
    EXPECT_TRUE(again.value == builtInMaterials().front());
    EXPECT_EQ(materialsJson(again.value), text);
}

TEST(MaterialTable, FaultsNameTheirField) {
    const auto with = [](const std::string& materials) {
        return errorOf(R"({"physvib_materials": 1, "name": "n", "materials": [)" + materials + "]}");
    };
    const std::string good = R"({"name": "a", "density_kg_per_m2": 1, "friction": 0, "restitution": 0})";
    EXPECT_EQ(with(R"({"name": "a", "density_kg_per_m2": 1, "friction": -1, "restitution": 0})"),
              "my.json: materials[0].friction: expected 0 to 100, found -1");
    EXPECT_EQ(with(good + "," + good),
              "my.json: materials[1].name: expected a name of its own, found \"a\" again");
    EXPECT_EQ(with("3"), "my.json: materials[0]: expected an object, found a number");
    EXPECT_EQ(errorOf(R"({"physvib_materials": 2})"),
              "my.json: physvib_materials: made for a newer PhysVib: expected a version up to 1, found 2");
    EXPECT_EQ(errorOf(R"({"physvib_materials": 1, "nam": ""})"), "my.json: unknown field \"nam\"");
}

using MaterialTableOnDiskTest = FolderTest;

TEST_F(MaterialTableOnDiskTest, LoadsWhatWasWritten) {
    ASSERT_EQ(writeFile(folder / "m.json", materialsJson(builtInMaterials().front())), "");
    EXPECT_TRUE(loadMaterials(folder / "m.json").value == builtInMaterials().front());
}

} // namespace
} // namespace physvib
