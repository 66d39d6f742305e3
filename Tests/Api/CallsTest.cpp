// SPDX-License-Identifier: MIT
// The library as a program in another language sees it.
#include "Core/ClockLaw.h"
#include "Core/HapticRenderer.h"
#include "Core/PanningLaws.h"
#include "Support/RandomCalls.h"
#include "Support/ReadWav.h"
#include "Support/SizedEvents.h"
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <thread>

namespace physvib::calls_test {

using test::places, test::step, test::touching, test::worldOfABall;

physvib_renderer_settings settings() { return test::begun(physvib_renderer_settings_init); }

physvib_renderer renderer() {
    const auto values = settings();
    physvib_renderer made = nullptr;
    EXPECT_EQ(physvib_renderer_create(&values, &made), PHYSVIB_OK) << physvib_error();
    return made;
}

int land(physvib_world world, double impulse) {
    const physvib_contact contact = touching(impulse);
    return step(world, &contact);
}

std::string temporary(const char* name) {
    return (std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + name)).string();
}

TEST(Calls, AHandleThatIsNoneOfOursIsAnErrorAndTellsOne) {
    const physvib_renderer one = renderer();
    EXPECT_EQ(physvib_renderer_free(one), PHYSVIB_OK);
    for (const physvib_renderer none :
         {one, physvib_renderer{nullptr}, reinterpret_cast<physvib_renderer>(std::uintptr_t{12345})}) {
        EXPECT_EQ(physvib_renderer_free(none), PHYSVIB_ERROR_HANDLE);
        EXPECT_EQ(physvib_renderer_latency_frames(none), PHYSVIB_ERROR_HANDLE);
        EXPECT_STREQ(physvib_error(), "handle: expected one of this kind that has not been freed");
    }
    const physvib_renderer other = renderer(); // in the same place
    EXPECT_NE(other, one);
    EXPECT_EQ(physvib_renderer_latency_frames(one), PHYSVIB_ERROR_HANDLE);
    EXPECT_EQ(physvib_world_end_step(reinterpret_cast<physvib_world>(other)), PHYSVIB_ERROR_HANDLE);
    EXPECT_EQ(physvib_renderer_free(other), PHYSVIB_OK);
}

TEST(Calls, WhatIsPulledIsWhatIsRendered) {
    constexpr int frames = 4800;
    const auto values = settings();
    const std::vector<physvib_event> events{test::hitAt(1'234'567), test::hitAt(20'000'001)};
    std::vector<float> whole(4 * frames), pulled(4 * frames), interleaved(4 * frames);
    ASSERT_EQ(physvib_render(&values, events.data(), 2, frames, whole.data()), PHYSVIB_OK) << physvib_error();
    const physvib_renderer one = renderer(), two = renderer();
    const int latency = physvib_renderer_latency_frames(one);
    for (const auto& event : events) {
        ASSERT_EQ(physvib_renderer_strike(one, &event), PHYSVIB_OK);
        ASSERT_EQ(physvib_renderer_strike(two, &event), PHYSVIB_OK);
    }
    std::array<float*, 4> channels{pulled.data(), pulled.data() + frames, pulled.data() + 2 * frames,
                                   pulled.data() + 3 * frames};
    ASSERT_EQ(physvib_renderer_pull(one, channels.data(), 4, frames), PHYSVIB_OK);
    ASSERT_EQ(physvib_renderer_pull_interleaved(two, interleaved.data(), 4, frames), PHYSVIB_OK);
    double sum = 0.0;
    for (int j = 0; j < 4; ++j)
        for (int n = latency; n < frames; ++n) {
            const auto at = static_cast<std::size_t>(j * frames + n);
            ASSERT_EQ(pulled[at], whole[at - static_cast<std::size_t>(latency)]);
            ASSERT_EQ(pulled[at], interleaved[static_cast<std::size_t>(4 * n + j)]);
            sum += std::abs(static_cast<double>(pulled[at]));
        }
    EXPECT_GT(sum, 1.0);
    auto status = test::begun(physvib_renderer_status_init);
    ASSERT_EQ(physvib_renderer_get_status(one, &status), PHYSVIB_OK);
    EXPECT_EQ(status.played, 2);
    EXPECT_EQ(status.late, 0);
    EXPECT_EQ(status.frames, frames);
    for (const auto each : {one, two}) EXPECT_EQ(physvib_renderer_free(each), PHYSVIB_OK);
}

// Both calls render in blocks, of at most 8192 and of 64 frames.
TEST(Calls, PullsOfAnyLengthAreWhatIsRendered) {
    constexpr std::array pulls{1, 65, 16'385, 64}; // the third: in two blocks, and a frame
    constexpr int channels = 4, frames = std::accumulate(pulls.begin(), pulls.end(), 0);
    const auto values = settings();
    const physvib_renderer one = renderer(), two = renderer();
    std::vector<physvib_event> events;
    for (physvib_int64 ns = 0; ns < 350'000'000; ns += 35'000'000) { // which ring all the while
        events.push_back(test::hitAt(ns));
        for (const auto each : {one, two})
            ASSERT_EQ(physvib_renderer_strike(each, &events.back()), PHYSVIB_OK) << physvib_error();
    }
    std::vector<float> whole(channels * frames), pulled(channels * frames), interleaved(channels * frames);
    ASSERT_EQ(physvib_render(&values, events.data(), std::ssize(events), frames, whole.data()), PHYSVIB_OK);
    int done = 0;
    for (const int length : pulls) {
        std::array<float*, channels> at{};
        for (int j = 0; j < channels; ++j)
            at[static_cast<std::size_t>(j)] = pulled.data() + j * frames + done;
        ASSERT_EQ(physvib_renderer_pull(one, at.data(), channels, length), PHYSVIB_OK);
        ASSERT_EQ(
            physvib_renderer_pull_interleaved(two, interleaved.data() + channels * done, channels, length),
            PHYSVIB_OK);
        done += length;
    }
    const int latency = physvib_renderer_latency_frames(one);
    int heardFrames = 0;
    for (int j = 0; j < channels; ++j)
        for (int n = latency; n < frames; ++n) {
            const auto expected = whole[static_cast<std::size_t>(j * frames + n - latency)];
            ASSERT_EQ(pulled[static_cast<std::size_t>(j * frames + n)], expected) << j << ' ' << n;
            ASSERT_EQ(interleaved[static_cast<std::size_t>(channels * n + j)], expected) << j << ' ' << n;
            heardFrames += expected != 0.0f ? 1 : 0;
        }
    EXPECT_GT(heardFrames, frames / 2);
    for (const auto each : {one, two}) EXPECT_EQ(physvib_renderer_free(each), PHYSVIB_OK);
}

TEST(Calls, ThePlayOutDelayIsThatOfTheClocksLaw) {
    for (const int rateHz : {5000, 44100, 192000})
        for (const int frames : {1, 480, 8192})
            for (const int steps : {30, 1000})
                for (const double gapSeconds : {0.0, 0.02, 0.3}) {
                    ClockLaw law;
                    law.sampleRateHz = rateHz, law.blockFrames = frames, law.stepsPerSecond = steps;
                    law.longestGapSeconds = gapSeconds;
                    law.limiterFrames = HapticRenderer::latencyFramesAt(rateHz);
                    const double ns = 1.0e9 * static_cast<double>(law.outputLatencyFrames()) / rateHz;
                    EXPECT_NEAR(physvib_play_out_ns(rateHz, frames, steps, gapSeconds), ns, 1.0);
                    EXPECT_GE(ns, 1.0e9 * gapSeconds) << "what the longest gap delays is in time";
                }
}

TEST(Calls, ALandingIsFeltByItsImpulse) {
    const physvib_world world = worldOfABall();
    EXPECT_EQ(land(world, 6.0), PHYSVIB_OK);
    auto events = places<4>();
    EXPECT_EQ(physvib_world_take(world, events.data(), 4, 0), 0); // a step later
    step(world);
    ASSERT_EQ(physvib_world_take(world, events.data(), 4, 0), 1);
    EXPECT_EQ(events[0].impulse_n_s, 6.0);
    EXPECT_EQ(events[0].fixture, 1);
    EXPECT_EQ(events[0].other, 0);
    EXPECT_EQ(events[0].mass_kg, 2.0);
    EXPECT_NEAR(events[0].amplitude, 0.5 * 6.0 / (2.0 + 2.0), 1.0e-12); // Eq. 5.4 with a field of 1 m
    EXPECT_EQ(physvib_world_time_ns(world), 20'000'000);
    EXPECT_EQ(physvib_world_free(world), PHYSVIB_OK);
}

TEST(Calls, ABodyIsOnTheDeviceThatItWasGivenLast) {
    const physvib_world world = worldOfABall();
    auto body = test::begun(physvib_body_init);
    for (const int device : {0, 3, 1, 0, 2}) {
        body.device = device;
        EXPECT_EQ(physvib_world_set_body(world, 1, &body), PHYSVIB_OK);
        EXPECT_EQ(physvib_world_device(world, 1), device);
    }
    EXPECT_EQ(physvib_world_free(world), PHYSVIB_OK);
}

TEST(Calls, WhatRollsOverGrainsIsFelt) {
    const physvib_world world = worldOfABall();
    auto floor = test::begun(physvib_body_init);
    floor.frequency_hz = 250.0;
    floor.decay_per_s = 20.0;
    floor.grain_m = 0.002;
    floor.is_ridged = 1;
    EXPECT_EQ(physvib_world_set_body(world, 0, &floor), PHYSVIB_OK);
    physvib_contact contact = touching(0.2);
    contact.approach_m_per_s = 0.0;
    contact.along_a_m_per_s = contact.along_b_m_per_s = 0.4;
    for (int i = 0; i < 50; ++i) EXPECT_EQ(step(world, &contact), PHYSVIB_OK);
    EXPECT_EQ(physvib_world_take(world, nullptr, 0, 1), 0);
    auto events = places<1000>();
    // 200 a second, from the second step on
    EXPECT_NEAR(static_cast<double>(physvib_world_take(world, events.data(), 1000, 1)), 98.0, 2.0);
    EXPECT_EQ(physvib_world_thinned(world), 0);
    EXPECT_EQ(physvib_world_free(world), PHYSVIB_OK);
}

TEST(Calls, ImpactsThatFindNoRoomInAStepAreCountedAndAreTheWeakest) {
    const physvib_world world = worldOfABall();
    const physvib_body ball = test::feltBall();
    constexpr int balls = 6000;
    EXPECT_EQ(physvib_world_drops(world), 0);
    for (int i = 1; i <= balls; ++i) ASSERT_EQ(physvib_world_set_body(world, i, &ball), PHYSVIB_OK) << i;
    ASSERT_EQ(physvib_world_begin_step(world, 0.01, 9.81), PHYSVIB_OK);
    for (int i = 1; i <= balls; ++i) {
        physvib_contact contact = touching(1.0 + i);
        contact.b = i;
        ASSERT_EQ(physvib_world_touch(world, &contact), PHYSVIB_OK) << physvib_error();
    }
    ASSERT_EQ(physvib_world_end_step(world), PHYSVIB_OK);
    std::vector<physvib_event> events(balls, test::sized<physvib_event>());
    const physvib_int64 felt = physvib_world_take(world, events.data(), balls, 1),
                        drops = physvib_world_drops(world);
    EXPECT_GT(drops, 0);
    EXPECT_EQ(felt + drops, balls);
    auto counts = test::begun(physvib_world_counts_init);
    EXPECT_EQ(physvib_world_get_counts(world, &counts), PHYSVIB_OK);
    EXPECT_EQ(counts.dropped, drops);
    for (physvib_int64 i = 0; i < felt; ++i) EXPECT_GT(events[static_cast<std::size_t>(i)].fixture, drops);
    EXPECT_EQ(physvib_world_free(world), PHYSVIB_OK);
}

TEST(Calls, WhatDoesNotFitWaits) {
    const physvib_world world = worldOfABall();
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(land(world, 6.0), PHYSVIB_OK);
        step(world);
    }
    auto events = places<4>();
    EXPECT_EQ(physvib_world_take(world, events.data(), 2, 1), 2);
    EXPECT_EQ(physvib_world_take(world, events.data(), 4, 1), 1);
    EXPECT_EQ(events[0].time_ns, 40'000'000);
    EXPECT_EQ(physvib_world_free(world), PHYSVIB_OK);
}

TEST(Calls, AnOlderProgramsStructureIsTakenAndANewerOneRefused) {
    auto values = settings();
    values.size = offsetof(physvib_renderer_settings, exponent); // without what came later
    values.exponent = -1.0;
    physvib_renderer made = nullptr;
    EXPECT_EQ(physvib_renderer_create(&values, &made), PHYSVIB_OK) << physvib_error();
    EXPECT_EQ(physvib_renderer_free(made), PHYSVIB_OK);
    for (const std::size_t size : {std::size_t{0}, sizeof values + 1}) {
        values.size = size;
        EXPECT_EQ(physvib_renderer_create(&values, &made), PHYSVIB_ERROR_ARGUMENT);
        EXPECT_EQ(made, nullptr);
    }
}

/// Struck by nothing but its program's older structure, which ended at is_soft.
TEST(Calls, AnOlderProgramsContactHasNoPointOfItsOwn) {
    constexpr std::size_t older = offsetof(physvib_contact, point_id);
    const physvib_world world = worldOfABall();
    physvib_contact contact;
    std::memset(&contact, 0, sizeof contact); // what it does not know is anything
    contact.point_id = -77;
    ASSERT_EQ(physvib_contact_init(&contact, older), PHYSVIB_OK);
    contact.a = 0, contact.b = 1, contact.impulse_n_s = 6.0;
    EXPECT_EQ(step(world, &contact), PHYSVIB_OK) << physvib_error();
    auto events = places<4>();
    EXPECT_EQ(physvib_world_take(world, events.data(), 4, 1), 1);
    physvib_world_free(world);
}

/// The ball strikes a wall that leans in space, beside its centre.
TEST(Calls, AnImpactInSpaceFollowsFromTheMotionAndTheInverseInertia) {
    const physvib_world world = worldOfABall();
    const double centre[3] = {0.0, 0.0, 0.0}, velocity[3] = {0.0, -1.8, -2.4}, still[3] = {0.0, 0.0, 0.0},
                 turning[6] = {4.0, 0.0, 0.0, 0.0, 0.0, 0.0}; // 0.25 kg m^2 about x alone
    physvib_contact contact = touching();
    contact.x_m = 0.0, contact.y_m = -0.8, contact.z_m = 0.6;
    contact.normal_y = 0.6, contact.normal_z = 0.8;
    for (const bool turns : {true, false}) {
        ASSERT_EQ(physvib_world_begin_step(world, 0.01, 0.0), PHYSVIB_OK);
        EXPECT_EQ(physvib_world_move_in_space(world, 1, centre, velocity, still, turns ? turning : nullptr),
                  PHYSVIB_OK)
            << physvib_error();
        EXPECT_EQ(physvib_world_touch(world, &contact), PHYSVIB_OK) << physvib_error();
        EXPECT_EQ(physvib_world_end_step(world), PHYSVIB_OK);
        auto events = places<4>();
        ASSERT_EQ(physvib_world_take(world, events.data(), 4, 1), 1);
        // an arm of 1 m across the normal; without a matrix, inertia_kg_m2 of 0 means through the centre
        EXPECT_NEAR(events[0].impulse_n_s, 3.0 / (0.5 + (turns ? 4.0 : 0.0)), 1.0e-5);
        EXPECT_NEAR(events[0].y_m, -0.8, 1.0e-6);
        ASSERT_EQ(physvib_world_begin_step(world, 0.01, 0.0), PHYSVIB_OK); // it parts
        ASSERT_EQ(physvib_world_end_step(world), PHYSVIB_OK);
    }
    EXPECT_EQ(physvib_world_move_in_space(world, 1, centre, nullptr, still, nullptr), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_STREQ(physvib_error(), "motion: expected centre, velocity and spin, found NULL");
    EXPECT_EQ(physvib_world_moved_in_space(world, 1, velocity, nullptr), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_world_moved_in_space(world, 1, velocity, still), PHYSVIB_ERROR_ORDER);
    const double wrong[6] = {-1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    EXPECT_EQ(physvib_world_move_in_space(world, 1, centre, velocity, still, wrong), PHYSVIB_ERROR_ARGUMENT);
    physvib_world_free(world);
}

physvib_world_counts countsOf(physvib_world world) {
    auto counts = test::begun(physvib_world_counts_init);
    EXPECT_EQ(physvib_world_get_counts(world, &counts), PHYSVIB_OK) << physvib_error();
    return counts;
}

TEST(Calls, EveryReasonWhyNothingIsFeltIsCounted) {
    const physvib_world world = worldOfABall();
    step(world);
    EXPECT_EQ(land(world, 0.01), PHYSVIB_OK); // 5 mm/s
    EXPECT_EQ(countsOf(world).contacts, 1);
    EXPECT_EQ(countsOf(world).below_threshold, 1);
    EXPECT_NEAR(countsOf(world).threshold_m_per_s, 0.15, 1e-9);

    auto muted = test::begun(physvib_world_settings_init);
    muted.is_muted = 1;
    ASSERT_EQ(physvib_world_configure(world, &muted), PHYSVIB_OK);
    for (int i = 0; i < 2; ++i) {
        step(world); // apart
        EXPECT_EQ(land(world, 6.0), PHYSVIB_OK);
    }
    EXPECT_EQ(countsOf(world).muted, 2);

    physvib_body silent = test::feltBall();
    silent.frequency_hz = silent.decay_per_s = 0.0;
    ASSERT_EQ(physvib_world_set_body(world, 1, &silent), PHYSVIB_OK);
    ASSERT_EQ(physvib_world_configure(world, nullptr), PHYSVIB_OK);
    for (int i = 0; i < 3; ++i) {
        step(world);
        EXPECT_EQ(land(world, 6.0), PHYSVIB_OK);
    }
    EXPECT_EQ(countsOf(world).unplayable, 3);
    silent.is_camera = 0;
    ASSERT_EQ(physvib_world_set_body(world, 1, &silent), PHYSVIB_OK);
    step(world);
    EXPECT_EQ(land(world, 6.0), PHYSVIB_OK);
    EXPECT_EQ(countsOf(world).no_source, 1);
    EXPECT_EQ(countsOf(world).events, 0);
    physvib_world_free(world);
}

TEST(Calls, ValuesThatCanNeverBeFeltAreRefusedWithTheWordThatIsMissing) {
    const physvib_world world = worldOfABall();
    auto body = test::begun(physvib_body_init);
    body.is_camera = 1;
    body.mass_kg = 1.0;
    body.frequency_hz = 200.0;
    EXPECT_EQ(physvib_world_set_body(world, 3, &body), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(std::string(physvib_error()).rfind("decay:", 0), 0U) << physvib_error();
    body.decay_per_s = 0.5;
    EXPECT_EQ(physvib_world_set_body(world, 3, &body), PHYSVIB_OK);
    body.overtone_hz[1] = 400.0;
    EXPECT_EQ(physvib_world_set_body(world, 3, &body), PHYSVIB_ERROR_ARGUMENT);
    body.overtone_hz[1] = 0.0;
    body.frequency_hz = 3.0; // a coil would be held at nearly direct current
    EXPECT_EQ(physvib_world_set_body(world, 3, &body), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_world_set_body(world, -2, &body), PHYSVIB_ERROR_ARGUMENT);
    auto settings = test::begun(physvib_world_settings_init);
    settings.threshold_m_per_s = -1.0;
    EXPECT_EQ(physvib_world_configure(world, &settings), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_STREQ(physvib_error(), "threshold: expected 0 m/s or more");
    physvib_world none = nullptr;
    EXPECT_EQ(physvib_world_create(&settings, &none), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(none, nullptr);
    physvib_world_free(world);
}

TEST(Calls, LayoutsAndListsAreReadFromTextAsFromFiles) {
    auto layout = test::sized<physvib_layout>(), again = test::sized<physvib_layout>();
    ASSERT_EQ(physvib_layout_preset("phone4", &layout), PHYSVIB_OK);
    ASSERT_EQ(
        physvib_layout_parse(
            R"({"name": "two", "extent_m": [0.2, 0.1], "enchanters": [{"label": "A", "x_m": 0, "y_m": 0}, {"label": "B", "x_m": 0.2, "y_m": 0}]})",
            &again),
        PHYSVIB_OK)
        << physvib_error();
    EXPECT_EQ(again.count, 2);
    EXPECT_EQ(again.x_m[1], 0.2);
    EXPECT_EQ(physvib_layout_parse("{", &again), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_layout_parse(nullptr, &again), PHYSVIB_ERROR_ARGUMENT);
    const char* const list =
        "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n0.1,200,30,0.5,0,0\n0.2,200,30,0.25,0,0\n";
    auto events = places<4>();
    ASSERT_EQ(physvib_events_parse(list, events.data(), 4), 2) << physvib_error();
    EXPECT_EQ(events[1].time_ns, 200'000'000);
    EXPECT_EQ(physvib_events_parse(list, nullptr, 0), 2);
    EXPECT_EQ(physvib_events_parse("time_s\n1", events.data(), 4), PHYSVIB_ERROR_ARGUMENT);
}

TEST(Calls, AnOlderProgramsStructureIsBegunAndToldAsFarAsItGoes) {
    test::expectBegunWithin(physvib_event_init);
    test::expectBegunWithin(physvib_layout_init);
    test::expectBegunWithin(physvib_renderer_settings_init, offsetof(physvib_renderer_settings, layout));
    test::expectBegunWithin(physvib_renderer_status_init);
    test::expectBegunWithin(physvib_world_settings_init);
    test::expectBegunWithin(physvib_body_init);
    test::expectBegunWithin(physvib_contact_init);
    test::expectBegunWithin(physvib_world_counts_init);
    test::expectBegunWithin(physvib_output_facts_init);
    const physvib_renderer one = renderer();
    physvib_renderer_status status;
    std::memset(&status, 0xAB, sizeof status);
    constexpr std::size_t size = offsetof(physvib_renderer_status, played); // which it does not know
    ASSERT_EQ(physvib_renderer_status_init(&status, size), PHYSVIB_OK);
    ASSERT_EQ(physvib_renderer_get_status(one, &status), PHYSVIB_OK);
    EXPECT_EQ(status.size, size);
    EXPECT_EQ(status.frames, 0);
    unsigned char beyond[sizeof status - size];
    std::memcpy(beyond, reinterpret_cast<const unsigned char*>(&status) + size, sizeof beyond);
    for (const unsigned char byte : beyond) EXPECT_EQ(byte, 0xAB);
    EXPECT_EQ(physvib_renderer_free(one), PHYSVIB_OK);
}

TEST(Calls, WrongOrderIsOneAndNothingHappens) {
    const physvib_world world = worldOfABall();
    physvib_contact contact = touching();
    EXPECT_EQ(physvib_world_touch(world, &contact), PHYSVIB_ERROR_ORDER);
    EXPECT_STREQ(physvib_error(), "step: expected to be within one");
    EXPECT_EQ(physvib_world_end_step(world), PHYSVIB_ERROR_ORDER);
    EXPECT_EQ(physvib_world_begin_step(world, 0.01, 9.81), PHYSVIB_OK);
    EXPECT_EQ(physvib_world_begin_step(world, 0.01, 9.81), PHYSVIB_ERROR_ORDER);
    EXPECT_EQ(physvib_world_remove_body(world, 1), PHYSVIB_ERROR_ORDER);
    EXPECT_EQ(physvib_world_begin_step(world, std::nan(""), 9.81), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_world_free(world), PHYSVIB_OK);
}

TEST(Calls, LawsAreThoseOfTheTable) {
    for (const auto& [law, name] : {std::pair{PHYSVIB_LAW_LINEAR, "linear"},
                                    {PHYSVIB_LAW_LOG, "log"},
                                    {PHYSVIB_LAW_LOG_OUTER, "log-outer"},
                                    {PHYSVIB_LAW_ENERGY, "energy"},
                                    {PHYSVIB_LAW_NEIGHBOURS, "neighbours"},
                                    {PHYSVIB_LAW_AUTO, "auto"},
                                    {PHYSVIB_LAW_DISTANCE, "distance"},
                                    {PHYSVIB_LAW_TRIANGLES, "triangles"}})
        EXPECT_STREQ(physvib_law_name(law), name);
    int count = 0;
    while (physvib_law_name(count) != nullptr) ++count;
    EXPECT_EQ(count, static_cast<int>(panningLaws.size()));
    EXPECT_EQ(physvib_law_name(-1), nullptr);
}

TEST(Calls, AListSaysItsField) {
    const std::string list = temporary("field.csv");
    const physvib_event event = test::hitAt(1);
    double width = 7.0, height = 7.0;
    const auto expect = [&](double wantedWidth, double wantedHeight) {
        EXPECT_EQ(width, wantedWidth);
        EXPECT_EQ(height, wantedHeight);
    };
    ASSERT_EQ(physvib_events_save_field(list.c_str(), &event, 1, 6.4, 0.1 + 0.2), PHYSVIB_OK)
        << physvib_error();
    ASSERT_EQ(physvib_events_load_field(list.c_str(), &width, &height), PHYSVIB_OK) << physvib_error();
    expect(6.4, 0.1 + 0.2);
    EXPECT_EQ(physvib_events_load(list.c_str(), nullptr, 0), 1);
    ASSERT_EQ(physvib_events_save(list.c_str(), &event, 1), PHYSVIB_OK);
    ASSERT_EQ(physvib_events_load_field(list.c_str(), &width, &height), PHYSVIB_OK);
    expect(0.0, 0.0);
    const std::string row = "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n1,200,30,0.5,0,0\n";
    EXPECT_EQ(physvib_events_parse_field(("# field_m=8,4.5\n" + row).c_str(), &width, &height), PHYSVIB_OK);
    expect(8.0, 4.5);
    EXPECT_EQ(physvib_events_parse_field("# field_m=8\n", &width, &height), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_STREQ(physvib_error(), "events:1: field_m: expected W,H in metres (0.001 to 1e6), found \"8\"");
    expect(8.0, 4.5);
    EXPECT_EQ(physvib_events_load_field("/nowhere.csv", &width, &height), PHYSVIB_ERROR_FILE);
    EXPECT_EQ(physvib_events_load_field(nullptr, &width, &height), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_events_parse_field(row.c_str(), nullptr, &height), PHYSVIB_ERROR_ARGUMENT);
    for (const double wrong : {-1.0, 1e-4, 1e7, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(physvib_events_save_field(list.c_str(), &event, 1, wrong, 1.0), PHYSVIB_ERROR_ARGUMENT)
            << wrong;
}

TEST(Calls, ListsLayoutsAndSoundsComeBack) {
    const std::string list = temporary("list.csv"), layoutPath = temporary("layout.json"),
                      sound = temporary("sound.wav");
    const std::vector<physvib_event> events{test::hitAt(1), test::hitAt(1'000'000'007)};
    ASSERT_EQ(physvib_events_save(list.c_str(), events.data(), 2), PHYSVIB_OK) << physvib_error();
    auto read = places<2>();
    EXPECT_EQ(physvib_events_load(list.c_str(), nullptr, 0), 2);
    EXPECT_EQ(physvib_events_load(list.c_str(), read.data(), 2), 2);
    EXPECT_EQ(std::memcmp(read.data(), events.data(), sizeof read), 0);
    const std::vector<physvib_event> swapped{events[1], events[0]};
    EXPECT_EQ(physvib_events_save(list.c_str(), swapped.data(), 2), PHYSVIB_ERROR_ARGUMENT);

    auto layout = test::sized<physvib_layout>(), again = test::sized<physvib_layout>();
    ASSERT_EQ(physvib_layout_preset("vest16", &layout), PHYSVIB_OK); // with depths and parts
    layout.part[3] = physvib_part("left elbow");
    EXPECT_EQ(physvib_layout_preset("ring5", &again), PHYSVIB_ERROR_ARGUMENT);
    ASSERT_EQ(physvib_layout_save(layoutPath.c_str(), "mine", &layout), PHYSVIB_OK) << physvib_error();
    ASSERT_EQ(physvib_layout_load(layoutPath.c_str(), &again), PHYSVIB_OK) << physvib_error();
    EXPECT_EQ(std::memcmp(&layout, &again, sizeof layout), 0);
    EXPECT_EQ(physvib_layout_load(list.c_str(), &again), PHYSVIB_ERROR_FILE);
    EXPECT_NE(std::string{physvib_error()}.find(list), std::string::npos);

    for (const int channels : {1, 2, 3, 64}) {
        std::vector<float> samples(static_cast<std::size_t>(channels) * 100);
        for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<float>(i) / 10000.0F;
        ASSERT_EQ(physvib_wav_save(sound.c_str(), samples.data(), channels, 100, 48000), PHYSVIB_OK)
            << physvib_error();
        std::FILE* const file = std::fopen(sound.c_str(), "rb");
        const auto wav = readWav(*file);
        std::fclose(file);
        ASSERT_TRUE(wav) << wav.error;
        ASSERT_EQ(wav.value.channels.size(), static_cast<std::size_t>(channels));
        for (std::size_t j = 0; j < wav.value.channels.size(); ++j)
            EXPECT_TRUE(std::equal(wav.value.channels[j].begin(), wav.value.channels[j].end(),
                                   samples.begin() + static_cast<std::ptrdiff_t>(100 * j)));
    }
    for (const std::string& path : {list, layoutPath, sound}) std::filesystem::remove(path);
}

TEST(Calls, SilenceFadesAndIsForgottenLater) {
    const physvib_renderer one = renderer();
    for (const physvib_event& event : {test::hitAt(0), test::hitAt(50'000'000)})
        EXPECT_EQ(physvib_renderer_strike(one, &event), PHYSVIB_OK);
    EXPECT_EQ(physvib_renderer_silence(one, 10'000'000, 60'000'000), PHYSVIB_OK);
    std::vector<float> samples(4 * 4800);
    EXPECT_EQ(physvib_renderer_pull_interleaved(one, samples.data(), 4, 4800), PHYSVIB_OK);
    const auto peakFrom = [&](std::size_t frame) {
        float peak = 0.0F;
        for (std::size_t i = 4 * frame; i < samples.size(); ++i) peak = std::max(peak, std::abs(samples[i]));
        return peak;
    };
    EXPECT_GT(peakFrom(0), 0.1F);
    EXPECT_EQ(peakFrom(480 + 480 + 48), 0.0F); // 10 ms after, and the limiter's millisecond
    EXPECT_EQ(physvib_renderer_free(one), PHYSVIB_OK);
}

TEST(Calls, OneThreadStrikesAnotherPullsAThirdFrees) {
    const physvib_renderer one = renderer();
    const physvib_world world = worldOfABall();
    std::atomic<bool> isOver{false};
    std::atomic<int> pulls{0};
    std::thread game([&] {
        for (int i = 0; i < 200; ++i) {
            land(world, i % 2 == 0 ? 6.0 : 0.1);
            physvib_world_send(world, one, 10'000'000, 0);
            physvib_renderer_set_gain(one, 0, i % 4, 0.5);
        }
        while (pulls < 20) std::this_thread::yield();
        EXPECT_EQ(physvib_renderer_free(one), PHYSVIB_OK); // while it is pulled
        isOver = true;
    });
    std::thread audio([&] {
        std::vector<float> samples(4 * 64);
        int result = PHYSVIB_OK;
        while (!isOver) {
            result = physvib_renderer_pull_interleaved(one, samples.data(), 4, 64);
            EXPECT_TRUE(result == PHYSVIB_OK || result == PHYSVIB_ERROR_HANDLE);
            ++pulls;
        }
        EXPECT_EQ(physvib_renderer_pull_interleaved(one, samples.data(), 4, 64), PHYSVIB_ERROR_HANDLE);
    });
    while (!isOver) {
        auto status = test::begun(physvib_renderer_status_init);
        physvib_renderer_get_status(one, &status);
        std::this_thread::yield();
    }
    game.join();
    audio.join();
    EXPECT_EQ(physvib_world_free(world), PHYSVIB_OK);
}

TEST(Calls, AnyOrderOfCallsWithAnythingIsAnsweredByACode) {
    std::mt19937 random{1};
    std::vector<std::uint8_t> bytes(1000);
    test::RandomCalls calls;
    for (int i = 0; i < 40; ++i) {
        for (std::uint8_t& each : bytes) each = static_cast<std::uint8_t>(random());
        calls.run(bytes.data(), bytes.size());
    }
}

} // namespace physvib::calls_test
