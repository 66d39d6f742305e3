// SPDX-License-Identifier: GPL-3.0-or-later
// The library with devices and sessions as a program in another language sees it, without a device.
#include "Support/RandomLiveCalls.h"
#include "Support/SizedEvents.h"
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace physvib::live_calls_test {

physvib_live opened(const physvib_live_settings* settings = nullptr) {
    physvib_live live = nullptr;
    EXPECT_EQ(physvib_live_open("None:no device", nullptr, settings, &live), PHYSVIB_OK)
        << physvib_live_error();
    return live;
}

physvib_live_status statusOf(physvib_live live) {
    auto status = test::begun(physvib_live_status_init);
    EXPECT_EQ(physvib_live_get_status(live, &status), PHYSVIB_OK);
    return status;
}
int isSilent(physvib_live live) { return statusOf(live).is_silent; }

void awaitEvents(physvib_live live, physvib_int64 count) {
    for (auto now = statusOf(live); now.played + now.rejected + now.dropped < count; now = statusOf(live))
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
}

TEST(LiveCalls, AnOlderProgramsStructureIsBegunAndToldAsFarAsItGoes) {
    test::expectBegunWithin(physvib_live_settings_init);
    test::expectBegunWithin(physvib_live_status_init);
    test::expectBegunWithin(physvib_live_receipt_init);
    physvib_live_settings settings;
    constexpr std::size_t size = offsetof(physvib_live_settings, save),
                          told = offsetof(physvib_live_status, board);
    std::memset(&settings, 0xAB, sizeof settings); // which would be a path
    ASSERT_EQ(physvib_live_settings_init(&settings, size), PHYSVIB_OK);
    const physvib_live live = opened(&settings);
    physvib_live_status status;
    std::memset(&status, 0xAB, sizeof status);
    ASSERT_EQ(physvib_live_status_init(&status, told), PHYSVIB_OK);
    ASSERT_EQ(physvib_live_get_status(live, &status), PHYSVIB_OK);
    EXPECT_EQ(status.size, told);
    EXPECT_EQ(status.is_running, 1);
    EXPECT_EQ(status.board, static_cast<int>(0xABABABABu));
    EXPECT_EQ(physvib_live_close(live), PHYSVIB_OK);
    EXPECT_EQ(physvib_live_close(live), PHYSVIB_ERROR_HANDLE);
}

TEST(LiveCalls, SettingsOutOfRangeAreNamedAndNothingIsOpened) {
    static const double nan = std::numeric_limits<double>::quiet_NaN();
    using Settings = physvib_live_settings;
    int room = 0;
    const auto unchanged = reinterpret_cast<physvib_live>(&room);
    physvib_live live = unchanged;
    struct Row {
        const char* expected;
        void (*change)(Settings&);
    };
    for (const auto& [expected, change] :
         {Row{"rate: expected 0, or 5000 to 192000 Hz", [](Settings& s) { s.rate_hz = 4999; }},
          {"block: expected 0 to 8192 frames", [](Settings& s) { s.block_frames = -1; }},
          {"block: expected 0 to 8192 frames", [](Settings& s) { s.block_frames = 8193; }},
          {"steps: expected 20 to 1000 per second", [](Settings& s) { s.steps_per_s = 19; }},
          {"steps: expected 20 to 1000 per second", [](Settings& s) { s.steps_per_s = 1001; }},
          {"longest gap: expected 0 to 1 s", [](Settings& s) { s.longest_gap_s = 1.1; }},
          {"longest gap: expected 0 to 1 s", [](Settings& s) { s.longest_gap_s = nan; }},
          {"first output: expected 0 to 65535", [](Settings& s) { s.first_output = -1; }},
          {"first output: expected 0 to 65535", [](Settings& s) { s.first_output = 65536; }},
          {"sound output: expected -1, or 0 to 65534", [](Settings& s) { s.sound_output = -2; }},
          {"sound output: expected -1, or 0 to 65534", [](Settings& s) { s.sound_output = 65535; }},
          {"level: expected -90 to 0 dB", [](Settings& s) { s.level_db = 0.1; }},
          {"level: expected -90 to 0 dB", [](Settings& s) { s.sound_db = nan; }},
          {"save: expected a path of at most 1023 bytes",
           [](Settings& s) { std::memset(s.save, 'a', sizeof s.save); }},
          {"structure: expected one that its _init has filled", [](Settings& s) { s.size = 0; }}}) {
        auto settings = test::begun(physvib_live_settings_init);
        change(settings);
        EXPECT_EQ(physvib_live_open("None:no device", nullptr, &settings, &live), PHYSVIB_ERROR_ARGUMENT);
        EXPECT_STREQ(physvib_live_error(), expected);
    }
    for (const auto& [device, place] :
         {std::pair<const char*, physvib_live*>{nullptr, &live}, {"None", nullptr}}) {
        EXPECT_EQ(physvib_live_open(device, nullptr, nullptr, place), PHYSVIB_ERROR_ARGUMENT);
        EXPECT_STREQ(physvib_live_error(), "live: expected a device and a place for it, found NULL");
    }
    EXPECT_EQ(live, unchanged);
}

// It would be known at the end alone, when nothing can be saved another way.
TEST(LiveCalls, WhatAFileCannotHoldIsRefusedWhereOneIsWritten) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("held-" + std::to_string(getpid()));
    fs::create_directory(folder);
    const std::string path = folder / "a.json";
    auto settings = test::begun(physvib_live_settings_init);
    std::copy(path.begin(), path.end(), settings.save);
    using Renderer = physvib_renderer_settings;
    struct Row {
        const char* expected;
        void (*change)(Renderer&);
    };
    const std::array rows{
        Row{"panning.exponent: expected 0.001 to 100, found 101", [](Renderer& r) { r.exponent = 101.0; }},
        Row{"panning.field_m[1]: expected 0.001 to 1e+06, found 1000001",
            [](Renderer& r) { r.field_height_m = 1'000'001.0; }},
        Row{"panning.layout.extent_m[0]: expected 0.001 to 1e+06, found 1e-04",
            [](Renderer& r) { r.layout.extent_width_m = 1e-4; }},
        Row{"panning.layout.enchanters[3].x_m: expected a number from 0 to ",
            [](Renderer& r) { r.layout.x_m[3] = 9.0; }}};
    physvib_live live = nullptr;
    const auto plain = test::begun(physvib_renderer_settings_init);
    const auto open = [&](const Renderer& renderer, bool isSaved) {
        return physvib_live_open("None:no device", &renderer, isSaved ? &settings : nullptr, &live);
    };
    const auto expectRefused = [](int code, const char* expected) {
        EXPECT_EQ(code, PHYSVIB_ERROR_ARGUMENT) << expected;
        EXPECT_EQ(std::string{physvib_live_error()}.rfind(expected, 0), 0U) << physvib_live_error();
    };
    for (const auto& [expected, change] : rows) {
        Renderer changed = plain;
        change(changed);
        ASSERT_EQ(open(changed, false), PHYSVIB_OK) << physvib_live_error();
        EXPECT_EQ(physvib_live_set_layout(live, &changed), PHYSVIB_OK) << physvib_live_error();
        EXPECT_EQ(physvib_live_close(live), PHYSVIB_OK);
        expectRefused(open(changed, true), expected);
    }
    EXPECT_TRUE(fs::is_empty(folder));
    ASSERT_EQ(open(plain, true), PHYSVIB_OK) << physvib_live_error();
    for (const auto& [expected, change] : rows) {
        Renderer changed = plain;
        change(changed);
        expectRefused(physvib_live_set_layout(live, &changed), expected);
    }
    expectRefused(physvib_live_set_gain(live, 0, 1001.0), "value: expected -1000 to 1000, found 1001");
    EXPECT_EQ(physvib_live_set_gain(live, 0, 1000.0), PHYSVIB_OK);
    auto endless = test::hitAt(0, 0.01);
    endless.decay_per_s = 0.0;
    endless.duration_ns = 100'000'000'000'000'000;
    EXPECT_EQ(physvib_live_strike(live, &endless, 1), PHYSVIB_OK) << physvib_live_error();
    awaitEvents(live, 1); // so that the file has it
    EXPECT_EQ(physvib_live_close(live), PHYSVIB_OK) << physvib_live_error();
    physvib_session session = nullptr;
    EXPECT_EQ(physvib_session_load(path.c_str(), &session), PHYSVIB_OK) << physvib_live_error();
    EXPECT_EQ(physvib_session_free(session), PHYSVIB_OK);
    fs::remove_all(folder);
}

TEST(LiveCalls, AnythingButZeroSilencesAlsoByAWrongName) {
    const physvib_live live = opened();
    for (const int odd : {1, -1, 2, 256, 65'536, std::numeric_limits<int>::min()}) {
        EXPECT_EQ(physvib_live_silence(live, odd), PHYSVIB_OK);
        EXPECT_EQ(isSilent(live), 1) << odd;
        EXPECT_EQ(physvib_live_silence(live, 0), PHYSVIB_OK);
        EXPECT_EQ(isSilent(live), 0);
        EXPECT_EQ(physvib_live_silence(nullptr, odd), PHYSVIB_ERROR_HANDLE);
        EXPECT_EQ(isSilent(live), 1) << odd;
        EXPECT_EQ(physvib_live_silence(nullptr, 0), PHYSVIB_ERROR_HANDLE);
        EXPECT_EQ(isSilent(live), 1) << "nobody lifts it by a wrong name";
        EXPECT_EQ(physvib_live_silence(live, 0), PHYSVIB_OK);
    }
    EXPECT_EQ(physvib_live_close(live), PHYSVIB_OK);
    EXPECT_EQ(physvib_live_silence(live, 1), PHYSVIB_ERROR_HANDLE);
}

TEST(LiveCalls, SeveralDevicesAreEachTheirOwn) {
    const std::array lives{opened(), opened(), opened()};
    EXPECT_EQ(physvib_live_silence(lives[1], 1), PHYSVIB_OK);
    EXPECT_EQ(isSilent(lives[0]) + isSilent(lives[2]), 0);
    EXPECT_EQ(isSilent(lives[1]), 1);
    EXPECT_EQ(physvib_live_silence(nullptr, 1), PHYSVIB_ERROR_HANDLE);
    for (const auto live : lives) EXPECT_EQ(isSilent(live), 1) << "whichever was meant";
    EXPECT_EQ(physvib_live_close(lives[1]), PHYSVIB_OK);
    EXPECT_EQ(physvib_live_silence(lives[0], 0), PHYSVIB_OK);
    EXPECT_EQ(isSilent(lives[0]), 0);
    EXPECT_EQ(isSilent(lives[2]), 1);
    EXPECT_EQ(physvib_live_close(lives[2]), PHYSVIB_OK);
    EXPECT_EQ(physvib_live_close(lives[0]), PHYSVIB_OK);
}

TEST(LiveCalls, EventsGoToTheDeviceOfTheirBody) {
    const std::array lives{opened(), opened()};
    physvib_world world = nullptr;
    ASSERT_EQ(physvib_world_create(nullptr, &world), PHYSVIB_OK);
    auto body = test::begun(physvib_body_init);
    physvib_world_set_body(world, 0, &body);
    body.mass_kg = 0.2;
    body.is_camera = 1;
    body.frequency_hz = 200.0;
    body.decay_per_s = 30.0;
    constexpr int bodies = 5;
    for (int k = 1; k <= bodies; ++k) { // of the first device, two of the second, two of ones not there
        body.device = std::array{0, 1, 1, 7, 2}[static_cast<std::size_t>(k - 1)];
        ASSERT_EQ(physvib_world_set_body(world, k, &body), PHYSVIB_OK);
    }
    body.device = -1;
    EXPECT_EQ(physvib_world_set_body(world, 4, &body), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_world_device(world, 4), 7);
    EXPECT_EQ(physvib_world_device(world, 9), 0);
    std::array<physvib_int64, 2> starts{};
    physvib_int64 sent = 0;
    for (int step = 0; step < 5; ++step) {
        physvib_world_begin_step(world, 0.01, 9.81);
        for (int k = 1; k <= bodies && step == 1; ++k) {
            auto contact = test::begun(physvib_contact_init);
            contact.a = 0;
            contact.b = k;
            contact.approach_m_per_s = 2.0;
            EXPECT_EQ(physvib_world_touch(world, &contact), PHYSVIB_OK) << physvib_error();
        }
        physvib_world_end_step(world);
        if (step == 2) {
            EXPECT_EQ(physvib_world_remove_body(world, 2), PHYSVIB_OK);
        }
        const auto count = physvib_live_send_each(lives.data(), 2, world, starts.data());
        ASSERT_GE(count, 0) << physvib_live_error();
        sent += count;
    }
    EXPECT_EQ(sent, bodies);
    const auto played = [](physvib_live live) { return statusOf(live).played; };
    for (int i = 0; i < 500 && played(lives[0]) + played(lives[1]) < bodies; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    EXPECT_EQ(played(lives[0]), 3) << "with those of devices that are not there";
    EXPECT_EQ(played(lives[1]), 2);
    EXPECT_EQ(physvib_live_send_each(nullptr, 0, world, starts.data()), PHYSVIB_ERROR_ARGUMENT);
    physvib_world_free(world);
    for (const auto live : lives) EXPECT_EQ(physvib_live_close(live), PHYSVIB_OK);
}

// As a program does that starts others without exec(): a child has none of the threads.
TEST(LiveCalls, AChildOfForkLetsGoAndItsParentPlaysOn) {
    const physvib_live live = opened();
    const auto endsWith = [](auto act) {
        const pid_t child = fork();
        if (child == 0) {
            alarm(20);
            act();
            std::exit(7); // with what is registered for the end of a program
        }
        int status = 0;
        waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    };
    EXPECT_EQ(endsWith([] {}), 7);
    EXPECT_EQ(endsWith([live] { _exit(physvib_live_close(live) == PHYSVIB_OK ? 3 : 4); }), 3);
    EXPECT_EQ(endsWith([live] { physvib_live_close(live); }), 7);
    EXPECT_EQ(endsWith([live] {
                  const int code = physvib_live_silence(live, 1);
                  _exit(code == PHYSVIB_ERROR_DEVICE ? 3 : 4);
              }),
              3)
        << "nothing is silenced there, and nobody told so";
    EXPECT_EQ(statusOf(live).is_running, 1);
    EXPECT_EQ(physvib_live_close(live), PHYSVIB_OK);
}

TEST(LiveCalls, WhatLeftIsKnownALatencyLater) {
    auto settings = test::begun(physvib_live_settings_init);
    settings.level_db = 0.0;
    const physvib_live live = opened(&settings);
    auto event = test::sized<physvib_event>();
    ASSERT_EQ(physvib_event_of(nullptr, 0.0, 0.0, 0.5, &event), PHYSVIB_OK) << physvib_error();
    auto receipt = test::begun(physvib_live_receipt_init);
    // a busy machine may hold up the device for longer than the event waits: then once more
    for (int tries = 0; tries < 50; ++tries) {
        event.time_ns = physvib_live_now_ns(live) + 100'000'000;
        ASSERT_EQ(physvib_live_strike(live, &event, 1), PHYSVIB_OK);
        const physvib_int64 end = event.time_ns + 200'000'000;
        ASSERT_EQ(physvib_live_left(live, event.time_ns, end + 10'000'000'000, 2, &receipt), PHYSVIB_OK);
        EXPECT_EQ(receipt.over, 0);
        for (receipt.over = 0; receipt.over == 0; std::this_thread::sleep_for(std::chrono::milliseconds{5}))
            ASSERT_EQ(physvib_live_left(live, event.time_ns, end, 2, &receipt), PHYSVIB_OK);
        if (receipt.peak > 0.0) break;
    }
    EXPECT_GT(receipt.peak, 0.1) << "the third actuator of phone4 is at 0, 0";
    EXPECT_LT(receipt.peak, 0.51);
    EXPECT_GT(receipt.mean_square, 0.0);
    EXPECT_EQ(receipt.running, 1);
    EXPECT_EQ(receipt.kept, 1);
    EXPECT_EQ(receipt.opening, 1);
    EXPECT_NEAR(static_cast<double>(receipt.frames), 0.2 * 48000.0, 2.0 * 240.0) << "rounded outwards";
    EXPECT_EQ(physvib_live_left(live, 0, 1, 4, &receipt), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_live_left(live, 0, 1, 0, nullptr), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_live_close(live), PHYSVIB_OK);
    EXPECT_EQ(physvib_live_left(live, 0, 1, 0, &receipt), PHYSVIB_ERROR_HANDLE);
}

// Of programs that were built with an older header: see Tests/Api/SizesTest.cpp.
TEST(LiveCalls, EventsOfAnySizeAreStruckAndRendered) {
    std::array<physvib_event, 3> list{};
    list.fill(test::sized<physvib_event>());
    for (int i = 0; i < 3; ++i) {
        physvib_event& event = list[static_cast<std::size_t>(i)];
        ASSERT_EQ(physvib_event_of(nullptr, 0.01 * i, 0.02 * i, 0.2 + 0.1 * i, &event), PHYSVIB_OK);
        event.time_ns = 1'000'000 * i;
        event.fixture = 5 + i;
    }
    std::vector<float> whole;
    physvib_int64 played = 0;
    const physvib_live live = opened();
    for (const std::size_t size : test::eventSizes) {
        test::SizedEvents given{size, list};
        physvib_session session = nullptr;
        ASSERT_EQ(physvib_session_create(nullptr, given.data(), 3, 100'000'000, &session), PHYSVIB_OK)
            << physvib_live_error();
        test::SizedEvents told{size, 2};
        ASSERT_EQ(physvib_session_events(session, 100'000'000, told.data(), 2), 3) << physvib_live_error();
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_EQ(told[i].time_ns, list[i].time_ns);
            EXPECT_EQ(told[i].y_m, list[i].y_m);
            EXPECT_EQ(told[i].fixture, list[i].fixture);
        }
        EXPECT_TRUE(told.isKeptBehind(2)) << size;
        std::vector<float> samples(4 * 4800);
        ASSERT_EQ(physvib_session_render(session, 48000, 4800, samples.data()), PHYSVIB_OK);
        if (whole.empty()) whole = samples;
        EXPECT_EQ(samples, whole) << size;
        EXPECT_EQ(physvib_session_free(session), PHYSVIB_OK);
        ASSERT_EQ(physvib_live_strike(live, given.data(), 3), PHYSVIB_OK) << physvib_live_error();
        played += 3;
    }
    awaitEvents(live, played);
    EXPECT_EQ(statusOf(live).rejected, 0);
    test::SizedEvents refused{sizeof(physvib_event) + 8, list};
    physvib_session none = nullptr;
    EXPECT_EQ(physvib_live_strike(live, refused.data(), 3), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_session_create(nullptr, refused.data(), 3, 0, &none), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_live_close(live), PHYSVIB_OK);
}

/// Each stage between a hit and what is rendered is kept in the file, and is in the list.
TEST(LiveCalls, EventsOfASessionAreThoseThatWereFelt) {
    const auto path = std::filesystem::temp_directory_path() / ("felt-" + std::to_string(getpid()) + ".json");
    auto hit = test::hitAt(1'000'000, 0.4);
    hit.frequency_hz = 1000.0;
    hit.decay_per_s = 40.0;
    struct Felt {
        const char* shaping;
        double frequencyHz, decayPerSecond, amplitude, durationNs;
    };
    for (const Felt& felt : {Felt{R"("method": "AF-FF-DRF", "fixed_amplitude": 0.25)", 250.0, 0.0, 0.25, 2e7},
                             {R"("remap_hz": [100, 200])", 200.0, 40.0, 0.4, 0.0}, // of 20 to 1000 Hz
                             {R"("gain": 0.5)", 1000.0, 40.0, 0.2, 0.0},
                             {R"("perceived_level": true)", 1000.0, 40.0, 0.8, 0.0}, // twice, from 500 Hz on
                             {R"("gamma": 0.1)", 1000.0, 40.0, 0.4, 1e9 * std::log(10.0) / 40.0}}) {
        physvib_session session = nullptr;
        ASSERT_EQ(physvib_session_create(nullptr, &hit, 1, 100'000'000, &session), PHYSVIB_OK);
        ASSERT_EQ(physvib_session_save(session, path.c_str()), PHYSVIB_OK) << physvib_live_error();
        EXPECT_EQ(physvib_session_free(session), PHYSVIB_OK);
        std::ostringstream text;
        text << std::ifstream{path}.rdbuf();
        std::string edited = text.str();
        edited.insert(edited.find("\"takes\""), "\"shaping\": { " + std::string{felt.shaping} + " }, ");
        std::ofstream{path} << edited;
        ASSERT_EQ(physvib_session_load(path.c_str(), &session), PHYSVIB_OK) << physvib_live_error();
        auto told = test::places<2>();
        EXPECT_EQ(physvib_session_events(session, 100'000'000, told.data(), 2), 1) << felt.shaping;
        EXPECT_NEAR(told[0].frequency_hz, felt.frequencyHz, 1e-9) << felt.shaping;
        EXPECT_EQ(told[0].decay_per_s, felt.decayPerSecond) << felt.shaping;
        EXPECT_NEAR(told[0].amplitude, felt.amplitude, 1e-12) << felt.shaping;
        EXPECT_NEAR(static_cast<double>(told[0].duration_ns), felt.durationNs, 2.0) << felt.shaping;
        EXPECT_EQ(physvib_session_free(session), PHYSVIB_OK);
    }
    std::filesystem::remove(path);
}

TEST(LiveCalls, ASessionHasTheSettingsItWasMadeWith) {
    for (const int limiter : {0, 1}) {
        auto given = test::begun(physvib_renderer_settings_init), told = given;
        given.limiter = limiter;
        given.channels = 6 + limiter;
        given.law = PHYSVIB_LAW_LINEAR;
        given.exponent = 1.5;
        given.field_width_m = 3.0;
        given.field_height_m = 2.0;
        physvib_session session = nullptr;
        ASSERT_EQ(physvib_session_create(&given, nullptr, 0, 0, &session), PHYSVIB_OK)
            << physvib_live_error();
        ASSERT_EQ(physvib_session_get_renderer(session, &told), PHYSVIB_OK) << physvib_live_error();
        EXPECT_EQ(told.limiter, limiter);
        EXPECT_EQ(told.channels, given.channels);
        EXPECT_EQ(told.law, PHYSVIB_LAW_LINEAR);
        EXPECT_EQ(told.exponent, 1.5);
        EXPECT_EQ(told.field_width_m, 3.0);
        EXPECT_EQ(told.field_height_m, 2.0);
        EXPECT_EQ(physvib_session_free(session), PHYSVIB_OK);
    }
}

TEST(LiveCalls, ASessionsLayoutIsToldAsFarAsItGoes) {
    physvib_session session = nullptr;
    physvib_renderer_settings settings;
    ASSERT_EQ(physvib_session_create(nullptr, nullptr, 0, 0, &session), PHYSVIB_OK) << physvib_live_error();
    const std::size_t size = sizeof settings - sizeof settings.layout.part; // of one without parts
    std::memset(&settings, 0xAB, sizeof settings);
    ASSERT_EQ(physvib_renderer_settings_init(&settings, size), PHYSVIB_OK);
    ASSERT_EQ(physvib_session_get_renderer(session, &settings), PHYSVIB_OK) << physvib_live_error();
    EXPECT_EQ(settings.layout.size, offsetof(physvib_layout, part)) << "what it may hand on";
    EXPECT_EQ(settings.layout.count, 4);
    EXPECT_EQ(settings.layout.part[0], static_cast<int>(0xABABABABu));
    EXPECT_EQ(physvib_session_free(session), PHYSVIB_OK);
}

TEST(LiveCalls, DevicesAreListedInTheCallersStructures) {
    const int count = physvib_live_devices(nullptr, 0, 0);
    ASSERT_GE(count, 0);
    struct Longer { // of a later version
        physvib_device device;
        double more;
    };
    std::vector<Longer> longer(static_cast<std::size_t>(count) + 1);
    for (auto& one : longer) one.more = 5.0;
    EXPECT_GE(physvib_live_devices(&longer.front().device, count + 1, sizeof(Longer)), 0);
    for (int k = 0; k < count; ++k) {
        EXPECT_EQ(longer[static_cast<std::size_t>(k)].device.size, sizeof(Longer));
        EXPECT_NE(std::string{longer[static_cast<std::size_t>(k)].device.name}.find(':'), std::string::npos);
        EXPECT_EQ(longer[static_cast<std::size_t>(k)].more, 5.0);
    }
    physvib_device one;
    EXPECT_EQ(physvib_live_devices(&one, 1, 8), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_live_devices(&one, 1, std::numeric_limits<std::size_t>::max()), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_live_devices(nullptr, 1, sizeof one), PHYSVIB_ERROR_ARGUMENT);
}

TEST(LiveCalls, AnyOrderOfCallsWithAnythingIsAnsweredByACode) {
    std::mt19937 random{7};
    test::RandomLiveCalls calls;
    int made = 0;
    while (made < 20'000) {
        std::vector<std::uint8_t> bytes(4096);
        for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
        made += calls.run(bytes.data(), bytes.size());
    }
}

} // namespace physvib::live_calls_test
