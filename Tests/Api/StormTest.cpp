// SPDX-License-Identifier: MIT
// Two thousand contacts in one step: what is kept, by which rule, at what cost (Docs/how-it-works.md).
#include "Support/SizedEvents.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <gtest/gtest.h>
#include <physvib/physvib.h>
#include <thread>
#include <vector>

namespace physvib::storm_test {

constexpr int bodies = 2000;
constexpr std::size_t room = 1024; // of a step

template <class Work>
double millisecondsOf(Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// A floor and 2,000 balls of so many materials above it, which all land in one step, harder and harder.
struct Storm {
    explicit Storm(int materials, int hitsPerStep = -1) {
        auto settings = test::begun(physvib_world_settings_init);
        settings.hits_per_step = hitsPerStep;
        EXPECT_EQ(physvib_world_create(&settings, &world), PHYSVIB_OK) << physvib_error();
        auto body = test::begun(physvib_body_init);
        physvib_world_set_body(world, 0, &body);
        body.is_camera = 1, body.mass_kg = 0.1;
        for (int i = 1; i <= bodies; ++i) {
            body.frequency_hz = 60.0 + 0.2 * (i % materials);
            body.decay_per_s = 20.0;
            EXPECT_EQ(physvib_world_set_body(world, i, &body), PHYSVIB_OK) << physvib_error();
        }
    }
    ~Storm() { physvib_world_free(world); }
    Storm(const Storm&) = delete;
    Storm& operator=(const Storm&) = delete;

    std::vector<physvib_event> land() {
        test::step(world);
        auto contact = test::begun(physvib_contact_init);
        contact.b = 0, contact.normal_y = -1.0;
        milliseconds = millisecondsOf([&] {
            physvib_world_begin_step(world, 0.01, 9.81);
            for (contact.a = 1; contact.a <= bodies; ++contact.a) {
                contact.x_m = contact.y_m = static_cast<double>(contact.a) / bodies;
                contact.approach_m_per_s = 0.1 + 0.001 * contact.a;
                EXPECT_EQ(physvib_world_touch(world, &contact), PHYSVIB_OK) << physvib_error();
            }
            physvib_world_end_step(world);
        });
        std::vector<physvib_event> events(2 * bodies, test::sized<physvib_event>());
        const auto count = physvib_world_take(world, events.data(), 2 * bodies, 1);
        events.resize(static_cast<std::size_t>(std::max<physvib_int64>(0, count)));
        return events;
    }
    physvib_world_counts counts() const {
        auto counts = test::begun(physvib_world_counts_init);
        EXPECT_EQ(physvib_world_get_counts(world, &counts), PHYSVIB_OK);
        return counts;
    }
    physvib_world world = nullptr;
    double milliseconds = 0.0;
};

TEST(Storm, TheStrongestThousandOfOneStepBecomeEventsAndAllOfThemArePlayed) {
    for (const int materials : {3, 2000}) {
        Storm storm{materials};
        const auto events = storm.land();
        EXPECT_EQ(events.size(), room);
        EXPECT_EQ(storm.counts().dropped, bodies - static_cast<int>(room));
        for (const physvib_event& event : events)
            EXPECT_GT(event.fixture, bodies - static_cast<int>(room))
                << "harder and harder: the last are the strongest";
        auto output = test::begun(physvib_renderer_settings_init);
        output.field_width_m = output.field_height_m = 1.0;
        const physvib_renderer renderer = test::rendererOf(output);
        const int channels = output.channels > 0 ? output.channels : output.layout.count;
        std::vector<float> samples(static_cast<std::size_t>(480 * channels));
        const auto pull = [&] {
            EXPECT_EQ(physvib_renderer_pull_interleaved(renderer, samples.data(), channels, 480), PHYSVIB_OK);
        };
        pull();
        for (const physvib_event& event : events)
            EXPECT_EQ(physvib_renderer_strike(renderer, &event), PHYSVIB_OK) << physvib_error();
        double first = millisecondsOf(pull), rest = 0.0;
        float peak = 0.0f;
        for (int i = 0; i < 10; ++i) {
            rest = std::max(rest, millisecondsOf(pull));
            peak = std::max(peak, *std::ranges::max_element(samples));
        }
        EXPECT_GT(peak, 0.5f);
        EXPECT_LE(peak, 1.0f) << "the limiter holds";
        std::printf(
            "%d materials: %.1f ms in the step, %.1f ms for the first 10 ms of sound, then up to %.1f\n",
            materials, storm.milliseconds, first, rest);
        physvib_renderer_free(renderer);
    }
}

TEST(Storm, OfFewerHitsPerStepTheStrongestAreKept) {
    Storm storm{3, 100};
    const auto events = storm.land();
    ASSERT_EQ(events.size(), 100u);
    EXPECT_EQ(storm.counts().dropped, bodies - 100);
    for (const physvib_event& event : events) EXPECT_GT(event.fixture, bodies - 101);
}

TEST(Storm, AControllerKeepsTheStrongestOfWhatWaits) {
    Storm storm{3};
    auto events = storm.land();
    physvib_pads pads = nullptr;
    ASSERT_EQ(physvib_pads_create(1, 1.0, 1.0, nullptr, &pads), PHYSVIB_OK);
    for (std::size_t i = 0; i < events.size(); ++i) { // harder and harder: each finds room
        events[i].time_ns = 1'000'000'000;
        EXPECT_EQ(physvib_pads_strike(pads, 0, &events[i]), PHYSVIB_OK) << i;
    }
    EXPECT_EQ(physvib_pads_strike(pads, 0, &events.front()), PHYSVIB_ERROR_FULL);
    physvib_pads_free(pads);
}

// Two threads that render at once: one of them is told, and the renderer has rendered what the other asked.

TEST(Busy, ASecondThreadIsToldAndEachFrameIsRenderedOnce) {
    const auto settings = test::begun(physvib_renderer_settings_init);
    const physvib_renderer renderer = test::rendererOf(settings);
    constexpr int frames = 4096;
    const int channels = settings.channels > 0 ? settings.channels : settings.layout.count;
    std::atomic<int> done{0}, busy{0}, others{0};
    std::atomic<bool> ends{false};
    const auto render = [&] {
        std::vector<float> samples(static_cast<std::size_t>(channels) * frames);
        while (!ends) {
            const int code = physvib_renderer_pull_interleaved(renderer, samples.data(), channels, frames);
            ++(code == PHYSVIB_OK ? done : code == PHYSVIB_ERROR_BUSY ? busy : others);
        }
    };
    std::thread one{render}, two{render};
    // as long as it takes until they meet, which on any machine is soon
    for (int i = 0; i < 30'000 && busy == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds{1});
    ends = true;
    one.join();
    two.join();
    EXPECT_GT(busy, 0) << "two threads rendered at once " << done << " times";
    EXPECT_EQ(others, 0);
    auto status = test::begun(physvib_renderer_status_init);
    ASSERT_EQ(physvib_renderer_get_status(renderer, &status), PHYSVIB_OK);
    EXPECT_EQ(status.frames, static_cast<physvib_int64>(done) * frames);
    EXPECT_EQ(physvib_renderer_free(renderer), PHYSVIB_OK);
}

} // namespace physvib::storm_test
