// SPDX-License-Identifier: MIT
// Events and layouts of programs that were built with an older header, or with a newer one.
#include "Support/SizedEvents.h"
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace physvib::sizes_test {

using test::eventSizes;
using test::SizedEvents;

/// Events of which each differs from all others, of the length of our header.
std::vector<physvib_event> events(int count = 3) {
    std::vector<physvib_event> all(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        physvib_event& event = all[static_cast<std::size_t>(i)];
        physvib_event_init(&event, sizeof event);
        event.time_ns = 1'000'000 * i;
        event.duration_ns = 50'000'000 + i;
        event.frequency_hz = 200.0 + i;
        event.decay_per_s = 30.0 + i;
        event.amplitude = 0.5 + 0.1 * i;
        event.x_m = 0.01 * i;
        event.y_m = 0.02 * i;
        event.impulse_n_s = 1.0 + i;
        event.mass_kg = 0.5 + i;
        event.fixture = 3 + i;
        event.other = 7 + i;
        event.kind = i % 3;
    }
    return all;
}

std::string temporary(const char* name) {
    return (std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + name)).string();
}

std::vector<float> rendered(const physvib_event* list, physvib_int64 count) {
    auto settings = test::begun(physvib_renderer_settings_init);
    std::vector<float> samples(4 * 4800);
    EXPECT_EQ(physvib_render(&settings, list, count, 4800, samples.data()), PHYSVIB_OK) << physvib_error();
    return samples;
}

TEST(Sizes, ListsAreReadByTheirStep) {
    const auto list = events();
    const std::vector<float> whole = rendered(list.data(), 3);
    for (const std::size_t size : eventSizes) {
        SizedEvents given{size, list};
        EXPECT_EQ(rendered(given.data(), given.count()), whole) << size;
    }
}

TEST(Sizes, ListsComeBackFromFilesAndTexts) {
    const std::string path = temporary("sizes.csv");
    const auto list = events();
    for (const std::size_t size : eventSizes) {
        SizedEvents given{size, list};
        ASSERT_EQ(physvib_events_save(path.c_str(), given.data(), 3), PHYSVIB_OK) << physvib_error();
        SizedEvents loaded{size, 5};
        ASSERT_EQ(physvib_events_load(path.c_str(), loaded.data(), 5), 3) << physvib_error();
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(test::wordsOf(loaded[i]), test::wordsOf(list[i]));
            EXPECT_EQ(loaded[i].size, size);
        }
        EXPECT_TRUE(loaded.isKeptBehind(3)) << size;
        SizedEvents parsed{size, 2};
        ASSERT_EQ(physvib_events_parse("time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n"
                                       "0.1,200,30,0.5,0,0\n0.2,250,30,0.25,0,0\n0.3,250,30,0.25,0,0\n",
                                       parsed.data(), 2),
                  3)
            << physvib_error();
        EXPECT_EQ(parsed[0].frequency_hz, 200.0);
        EXPECT_EQ(parsed[1].time_ns, 200'000'000);
        EXPECT_EQ(parsed[1].fixture, -1);
        EXPECT_TRUE(parsed.isKeptBehind(2)) << size;
    }
    std::filesystem::remove(path);
}

TEST(Sizes, AWorldsEventsAreWrittenByTheirStep) {
    for (const std::size_t size : eventSizes) {
        const physvib_world world = test::worldWithEvents(3);
        SizedEvents taken{size, 2};
        ASSERT_EQ(physvib_world_take(world, taken.data(), 2, 1), 2) << physvib_error();
        EXPECT_EQ(taken[0].impulse_n_s, 1.0);
        EXPECT_EQ(taken[1].impulse_n_s, 3.0);
        EXPECT_EQ(taken[1].fixture, 1);
        EXPECT_TRUE(taken.isKeptBehind(2)) << size;
        ASSERT_EQ(physvib_world_take(world, taken.data(), 2, 1), 1) << physvib_error();
        EXPECT_EQ(taken[0].impulse_n_s, 5.0);
        EXPECT_EQ(physvib_world_free(world), PHYSVIB_OK);
    }
}

TEST(Sizes, OneEventIsAsLongAsItSays) {
    const auto one = events(2);
    for (const std::size_t size : eventSizes) {
        SizedEvents made{size, 1};
        ASSERT_EQ(physvib_event_of(nullptr, 0.3, 0.5, 0.8, made.data()), PHYSVIB_OK) << physvib_error();
        EXPECT_EQ(made[0].y_m, 0.5);
        EXPECT_EQ(made[0].other, -1);
        EXPECT_EQ(made[0].size, size);
        EXPECT_TRUE(made.isKeptBehind(1)) << size;
        SizedEvents given{size, std::span{one}.last(1)};
        const physvib_renderer renderer = test::rendererOf();
        EXPECT_EQ(physvib_renderer_strike(renderer, given.data()), PHYSVIB_OK) << physvib_error();
        std::vector<float> samples(4 * 480);
        EXPECT_EQ(physvib_renderer_pull_interleaved(renderer, samples.data(), 4, 480), PHYSVIB_OK);
        auto status = test::begun(physvib_renderer_status_init);
        EXPECT_EQ(physvib_renderer_get_status(renderer, &status), PHYSVIB_OK);
        EXPECT_EQ(status.played, 1);
        EXPECT_EQ(physvib_renderer_free(renderer), PHYSVIB_OK);
        physvib_pads pads = nullptr;
        ASSERT_EQ(physvib_pads_create(1, 1.0, 1.0, nullptr, &pads), PHYSVIB_OK);
        EXPECT_EQ(physvib_pads_strike(pads, 0, given.data()), PHYSVIB_OK) << physvib_error();
        physvib_motors motors{};
        EXPECT_EQ(physvib_pads_pull(pads, 40'000'000, &motors, 1), 1);
        EXPECT_GT(motors.high, 0.0);
        EXPECT_EQ(physvib_pads_free(pads), PHYSVIB_OK);
    }
}

TEST(Sizes, AnEventOfAnUnknownSizeIsRefusedAndNothingHappens) {
    const std::string path = temporary("longer.csv");
    const auto list = events();
    for (const std::size_t said :
         {sizeof(physvib_event) + 8, std::size_t{0}, std::size_t{1}, ~std::size_t{0}}) {
        SizedEvents given{sizeof(physvib_event) + 8, list}, room{sizeof(physvib_event) + 8, 3};
        given.say(said), room.say(said);
        auto settings = test::begun(physvib_renderer_settings_init);
        float sample = 0.5F;
        const auto expectRefused = [](physvib_int64 code) {
            EXPECT_EQ(code, PHYSVIB_ERROR_ARGUMENT);
            EXPECT_STREQ(physvib_error(),
                         "size: expected that of the structure, as its _init sets it, and a library that "
                         "is as new as the header");
        };
        expectRefused(physvib_render(&settings, given.data(), 3, 1, &sample));
        EXPECT_EQ(sample, 0.5F);
        expectRefused(physvib_events_save(path.c_str(), given.data(), 3));
        EXPECT_FALSE(std::filesystem::exists(path));
        expectRefused(physvib_event_of(nullptr, 0.0, 0.0, 0.5, room.data()));
        expectRefused(physvib_events_parse(
            "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n0.1,200,30,0.5,0,0\n", room.data(), 3));
        const physvib_world world = test::worldWithEvents(2);
        expectRefused(physvib_world_take(world, room.data(), 3, 1));
        EXPECT_TRUE(room.isKeptBehind(0));
        auto ours = test::places<3>();
        EXPECT_EQ(physvib_world_take(world, ours.data(), 3, 1), 2) << "they were not lost";
        physvib_world_free(world);
        physvib_pads pads = nullptr;
        ASSERT_EQ(physvib_pads_create(1, 1.0, 1.0, nullptr, &pads), PHYSVIB_OK);
        expectRefused(physvib_pads_strike(pads, 0, given.data()));
        physvib_pads_free(pads);
        const physvib_renderer renderer = test::rendererOf(settings);
        expectRefused(physvib_renderer_strike(renderer, given.data()));
        physvib_renderer_free(renderer);
    }
}

TEST(Sizes, AListIsOfOneSize) {
    auto list = events();
    auto settings = test::begun(physvib_renderer_settings_init);
    float sample = 0.0F;
    for (physvib_event& event : list) event.size = sizeof event;
    EXPECT_EQ(physvib_render(&settings, list.data(), 3, 0, &sample), PHYSVIB_OK) << physvib_error();
    list[2].size = offsetof(physvib_event, part);
    EXPECT_EQ(physvib_render(&settings, list.data(), 3, 0, &sample), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_STREQ(physvib_error(), "events: expected all of one size");
}

TEST(Sizes, ALayoutIsAsLongAsItSays) {
    const std::string path = temporary("sizes.json");
    for (const std::size_t said : {offsetof(physvib_layout, z_m), sizeof(physvib_layout)}) {
        const auto expectWithin = [&](const auto& call) {
            std::vector<unsigned char> memory(sizeof(physvib_layout) + 64, 0xAB);
            std::memcpy(memory.data(), &said, sizeof said);
            ASSERT_EQ(call(reinterpret_cast<physvib_layout*>(memory.data())), PHYSVIB_OK) << physvib_error();
            physvib_layout layout{};
            std::memcpy(&layout, memory.data(), said);
            EXPECT_EQ(layout.size, said);
            EXPECT_EQ(layout.count, 3);
            EXPECT_GT(layout.extent_width_m, 0.0);
            EXPECT_TRUE(std::all_of(memory.begin() + static_cast<std::ptrdiff_t>(said), memory.end(),
                                    [](unsigned char byte) { return byte == 0xAB; }))
                << said;
        };
        expectWithin([&](physvib_layout* layout) {
            const int code = physvib_layout_preset("ring3", layout);
            return code != PHYSVIB_OK ? code : physvib_layout_save(path.c_str(), "mine", layout);
        });
        expectWithin([&](physvib_layout* layout) { return physvib_layout_load(path.c_str(), layout); });
        expectWithin([](physvib_layout* layout) {
            return physvib_layout_parse(
                R"({"name": "three", "extent_m": [0.2, 0.1], "enchanters": [{"label": "A", "x_m": 0, "y_m": 0},
                    {"label": "B", "x_m": 0.2, "y_m": 0}, {"label": "C", "x_m": 0.1, "y_m": 0.1}]})",
                layout);
        });
    }
    physvib_layout longer{};
    longer.size = sizeof longer + 8;
    EXPECT_EQ(physvib_layout_preset("ring3", &longer), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_layout_load(path.c_str(), &longer), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(longer.count, 0);
    EXPECT_EQ(physvib_layout_save(path.c_str(), "mine", &longer), PHYSVIB_ERROR_ARGUMENT);
    std::filesystem::remove(path);
}

TEST(Sizes, TheLayoutOfSettingsSaysWhatFits) {
    physvib_renderer_settings settings;
    for (const std::size_t less : {std::size_t{0}, std::size_t{16}, sizeof settings.layout.part}) {
        ASSERT_EQ(physvib_renderer_settings_init(&settings, sizeof settings - less), PHYSVIB_OK);
        EXPECT_EQ(settings.layout.size, sizeof settings.layout - less);
        EXPECT_EQ(physvib_renderer_free(test::rendererOf(settings)), PHYSVIB_OK);
    }
    physvib_renderer_settings_init(&settings, sizeof settings);
    settings.layout = {}; // which no _init has filled
    EXPECT_EQ(physvib_layout_preset("ring3", &settings.layout), PHYSVIB_ERROR_ARGUMENT);
    physvib_renderer renderer = nullptr;
    EXPECT_EQ(physvib_renderer_create(&settings, &renderer), PHYSVIB_ERROR_ARGUMENT);
}

} // namespace physvib::sizes_test
