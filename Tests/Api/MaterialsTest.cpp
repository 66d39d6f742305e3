// SPDX-License-Identifier: MIT
// Materials by name and single impacts, as a program in another language asks for them.
#include "Core/NameNumbers.h"
#include "Io/Text/NameList.h"
#include "Scene/MaterialTable.h"
#include "Support/SizedEvents.h"
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <physvib/physvib.h>
#include <string>
#include <vector>

namespace physvib::materials_test {

physvib_body body() {
    physvib_body made = test::feltBall(0.25);
    made.frequency_hz = made.decay_per_s = 0.0;
    made.overtone_hz[1] = 500.0;
    return made;
}

TEST(Materials, NamesAreThoseOfTheTablesThatVibrate) {
    int index = 0;
    for (const MaterialTable& table : builtInMaterials())
        for (const Material& material : table.materials)
            if (material.frequencyHz > 0.0) EXPECT_EQ(physvib_material_name(index++), material.name);
    EXPECT_GT(index, 2);
    EXPECT_EQ(physvib_material_name(index), nullptr);
    EXPECT_EQ(physvib_material_name(-1), nullptr);
}

TEST(Materials, SetHowABodyVibratesAndNothingElse) {
    physvib_body made = body();
    ASSERT_EQ(physvib_material("steel plate", &made), PHYSVIB_OK) << physvib_error();
    EXPECT_EQ(made.frequency_hz, 430.0);
    EXPECT_EQ(made.decay_per_s, 11.97);
    EXPECT_EQ(made.overtone_hz[1], 0.0);
    EXPECT_EQ(made.mass_kg, 0.25);
    EXPECT_EQ(made.is_camera, 1);
}

TEST(Materials, AnUnknownNameIsAnsweredByThoseThereAre) {
    physvib_body made = body();
    std::vector<std::string> names;
    for (int i = 0; const char* name = physvib_material_name(i); ++i) names.emplace_back(name);
    for (const char* name : {"wood", "steel", ""}) { // wood is in the table, without a frequency
        EXPECT_EQ(physvib_material(name, &made), PHYSVIB_ERROR_ARGUMENT);
        EXPECT_EQ(std::string{physvib_error()}, "material: expected one that vibrates (" +
                                                    nameList(names, " or ") + "), found \"" + name + "\"");
    }
    EXPECT_EQ(made.frequency_hz, 0.0);
    EXPECT_EQ(physvib_material(nullptr, &made), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_material("steel plate", nullptr), PHYSVIB_ERROR_ARGUMENT);
    physvib_body unready{};
    EXPECT_EQ(physvib_material("steel plate", &unready), PHYSVIB_ERROR_ARGUMENT);
}

TEST(Materials, ComeFromAFile) {
    const std::string path =
        (std::filesystem::temp_directory_path() / "physvib-materials-test.json").string();
    std::ofstream{path} << R"({"physvib_materials": 1, "name": "mine", "materials": [
        {"name": "ice", "density_kg_per_m2": 9, "friction": 0.1, "restitution": 0.2, "frequency_hz": 150,
         "decay_per_s": 20, "grain_m": 0.01, "roughness": 2, "grain_pattern": "regular", "rolling": 0.5}]})";
    physvib_body made = body();
    ASSERT_EQ(physvib_material_load(path.c_str(), "ice", &made), PHYSVIB_OK) << physvib_error();
    EXPECT_EQ(made.frequency_hz, 150.0);
    EXPECT_EQ(made.decay_per_s, 20.0);
    EXPECT_EQ(made.grain_m, 0.01);
    EXPECT_EQ(made.roughness, 2.0);
    EXPECT_EQ(made.rolling, 0.5);
    EXPECT_EQ(made.is_ridged, 1);
    EXPECT_EQ(physvib_material_load(path.c_str(), "snow", &made), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_STREQ(physvib_error(), "material: expected one that vibrates (ice), found \"snow\"");
    EXPECT_EQ(physvib_material_load("/nowhere.json", "ice", &made), PHYSVIB_ERROR_FILE);
    std::filesystem::remove(path);
}

TEST(Materials, ASoundHasTheNumberOfItsName) {
    EXPECT_EQ(physvib_sound("wooden board"), soundOfMaterial("wooden board"));
    EXPECT_EQ(physvib_sound("sound-923368111"), 923368111); // as lists write a number without a name
    EXPECT_EQ(physvib_sound(""), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_sound(nullptr), PHYSVIB_ERROR_ARGUMENT);
}

TEST(Impact, IsAnEventOfThatStrengthAndMaterial) {
    auto event = test::sized<physvib_event>();
    ASSERT_EQ(physvib_event_of(nullptr, 0.3, 0.5, 0.8, &event), PHYSVIB_OK) << physvib_error();
    EXPECT_EQ(event.frequency_hz, 200.0);
    EXPECT_EQ(event.decay_per_s, 30.0);
    EXPECT_EQ(event.amplitude, 0.8);
    EXPECT_EQ(event.x_m, 0.3);
    EXPECT_EQ(event.y_m, 0.5);
    EXPECT_EQ(event.sound, 0);
    EXPECT_EQ(event.fixture, -1);
    ASSERT_EQ(physvib_event_of("wooden board", 0.0, 0.0, 1.0, &event), PHYSVIB_OK) << physvib_error();
    EXPECT_EQ(event.frequency_hz, 349.0);
    EXPECT_EQ(event.sound, soundOfMaterial("wooden board"));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double strength : {-0.1, 1.1, nan})
        EXPECT_EQ(physvib_event_of(nullptr, 0.0, 0.0, strength, &event), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_event_of(nullptr, nan, 0.0, 1.0, &event), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(event.frequency_hz, 349.0);
}

TEST(Impact, OfARendererSoundsFromTheNextPullOnAndIsNotLate) {
    for (const int rateHz : {44100, 48000}) { // a frame of the first is no whole number of nanoseconds
        auto settings = test::begun(physvib_renderer_settings_init);
        settings.rate_hz = rateHz;
        settings.limiter = 0;
        physvib_layout_preset("phone1", &settings.layout);
        const physvib_renderer renderer = test::rendererOf(settings);
        std::array<float, 1000> block{};
        float* channel = block.data();
        for (int blocks = 0; blocks < 100; ++blocks) physvib_renderer_pull(renderer, &channel, 1, 777);
        ASSERT_EQ(physvib_renderer_impact_of(renderer, "steel plate", 0.0, 0.0, 0.5), PHYSVIB_OK)
            << physvib_error();
        ASSERT_EQ(physvib_renderer_pull(renderer, &channel, 1, 777), PHYSVIB_OK);
        const int latency = physvib_renderer_latency_frames(renderer);
        ASSERT_LT(latency, 500);
        for (int n = latency; n < 777; ++n) {
            const double t = static_cast<double>(n - latency) / rateHz;
            EXPECT_NEAR(block[static_cast<std::size_t>(n)],
                        0.5 * std::sin(2.0 * M_PI * 430.0 * t) * std::exp(-11.97 * t), 1.0e-5);
        }
        auto status = test::begun(physvib_renderer_status_init);
        physvib_renderer_get_status(renderer, &status);
        EXPECT_EQ(status.played, 1);
        EXPECT_EQ(status.late, 0);
        EXPECT_EQ(physvib_renderer_impact(renderer, 0.0, 0.0, 0.5), PHYSVIB_OK);
        EXPECT_EQ(physvib_renderer_impact(renderer, 0.0, 0.0, 2.0), PHYSVIB_ERROR_ARGUMENT);
        EXPECT_EQ(physvib_renderer_impact_of(renderer, "jam", 0.0, 0.0, 1.0), PHYSVIB_ERROR_ARGUMENT);
        physvib_renderer_free(renderer);
        EXPECT_EQ(physvib_renderer_impact(renderer, 0.0, 0.0, 0.5), PHYSVIB_ERROR_HANDLE);
    }
}

TEST(Gain, AWorldOfTheCLibraryLearnsItsLevel) {
    auto settings = test::begun(physvib_world_settings_init);
    settings.full_scale_impulse_n_s = PHYSVIB_AUTOMATIC;
    settings.settling_s = 0.025;
    physvib_world world = test::worldOfABall(&settings, 0.25);
    for (const double impulse : {40.0, 5.0}) {
        const physvib_contact contact = test::touching(impulse);
        EXPECT_EQ(test::step(world, &contact), PHYSVIB_OK) << physvib_error();
        for (int i = 0; i < 9; ++i) test::step(world);
    }
    auto events = test::places<10>();
    ASSERT_EQ(physvib_world_take(world, events.data(), 10, 1), 1); // the first one settled
    EXPECT_NEAR(events[0].amplitude, 0.5, 1.0e-9);
    physvib_world_free(world);
    settings.full_scale_impulse_n_s = -3.0;
    EXPECT_EQ(physvib_world_create(&settings, &world), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_STREQ(physvib_error(), "full-scale impulse: expected 0 (off), more than 0 N s, or -1 (automatic)");
}

} // namespace physvib::materials_test
