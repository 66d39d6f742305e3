// SPDX-License-Identifier: GPL-3.0-or-later
// The finished VST3 modules under guard, in a bare host with every bus on: JUCE's wrapper around the render
// call takes no memory either.
#include "Plugin/Formats/RawLv2.h"
#include "Plugin/Formats/RawVst3.h"
#include "Plugin/PluginTesting.h"
#include "Realtime/RealtimeGuard.h"
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

namespace physvib::realtime_module_test {

using namespace test;

Steinberg::tresult guarded(vst::IAudioProcessor& to, vst::ProcessData& data) {
    const RealtimeGuard guard;
    return to.process(data);
}

/// No faster than time: for a host that runs ahead the world is stepped in the call, which takes memory.
void keepPace() { std::this_thread::sleep_for(std::chrono::microseconds{5400}); } // of 256 frames

void expectNoMemoryTaken(const std::string& name, std::size_t musicChannels) {
    SCOPED_TRACE(name + ", channels of music: " + std::to_string(musicChannels));
    RawVst3 host{PHYSVIB_PLUGINS "/" + name + ".vst3", name};
    ASSERT_TRUE(host.isLoaded());
    auto state = shakenBox();
    state.parameters = {{"beats", 100.0}};
    ASSERT_TRUE(host.setState(pluginStateJson(state)));
    if (musicChannels > 0) ASSERT_TRUE(host.hear(musicChannels, 256));
    host.call = guarded;
    host.mode = vst::kRealtime; // offline the render call steps the world itself
    host.start(256);
    for (int b = 0; b < 10; ++b) { // buffers of JUCE's for notes grow once
        host.note(36);
        host.process();
        keepPace();
    }
    Random random{7};
    RealtimeGuard::forget();
    for (int b = 0; b < 200; ++b) {
        if (b % 10 == 0) host.note(36 + b % 12);
        for (auto& channel : host.music)
            for (float& sample : channel)
                sample = b % 20 == 0 ? static_cast<float>(random.uniform(-1, 1)) : 0.0f;
        ASSERT_TRUE(host.process());
        keepPace();
    }
    EXPECT_EQ(RealtimeGuard::count(RealtimeGuard::allocates), 0u);
    EXPECT_EQ(RealtimeGuard::count(RealtimeGuard::frees), 0u);
    host.stop();
}

TEST(RealtimeModule, TakesNoMemoryWithEveryBusOn) {
    for (const char* name : {"PhysVib", "PhysVib-Pairs"})
        for (const std::size_t musicChannels : {0u, 1u, 2u}) expectNoMemoryTaken(name, musicChannels);
}

// Floods, with expression, by ids, not in their order.
TEST(RealtimeModule, TakesNoMemoryHoweverManyNotesComeInABlock) {
    RawVst3 host{PHYSVIB_PLUGINS "/PhysVib.vst3", "PhysVib"};
    ASSERT_TRUE(host.isLoaded());
    host.call = guarded;
    host.mode = vst::kRealtime;
    host.start(256);
    host.process();
    Random random{11};
    for (int b = 0; b < 10; ++b) {
        for (int n = 0; n < 10'000; ++n) {
            host.note(random.below(128), b % 2 == 0 ? n * 256 / 10'000 : random.below(256));
            auto& event = host.event();
            event.noteOn.noteId = n;
            if (n % 3 == 0) event.type = vst::Event::kNoteOffEvent;
            if (n % 3 != 1) continue;
            event.type = vst::Event::kNoteExpressionValueEvent;
            event.noteExpressionValue = {vst::kTuningTypeID, n - 1, random.uniform(0, 1)};
        }
        RealtimeGuard::forget();
        const auto began = std::chrono::steady_clock::now();
        ASSERT_TRUE(host.process());
        std::printf(
            "10,000 events, %s: %.1f ms\n", b % 2 == 0 ? "in order" : "in none",
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count());
        for (const auto which : {RealtimeGuard::allocates, RealtimeGuard::frees, RealtimeGuard::locks})
            EXPECT_EQ(RealtimeGuard::count(which), 0u) << RealtimeGuard::names[which];
    }
    host.stop();
}

TEST(RealtimeModule, OfLv2TakesNoMemoryAndNoLock) {
    RawLv2 host{256, 256};
    host.offline = 0.0f;
    ASSERT_TRUE(host.isLoaded());
    host.call = [](const LV2_Descriptor& to, LV2_Handle handle, std::uint32_t frames) {
        const RealtimeGuard guard;
        to.run(handle, frames);
    };
    host.activate();
    for (int b = -10; b < 200; ++b) {
        if (b == 0) RealtimeGuard::forget();
        host.run(256);
        keepPace();
    }
    std::printf("LV2: %d pieces of memory and %d locks taken in 200 render calls\n",
                static_cast<int>(RealtimeGuard::count(RealtimeGuard::allocates)),
                static_cast<int>(RealtimeGuard::count(RealtimeGuard::locks)));
    for (const auto which : {RealtimeGuard::allocates, RealtimeGuard::frees, RealtimeGuard::locks})
        EXPECT_EQ(RealtimeGuard::count(which), 0u) << RealtimeGuard::names[which];
    host.deactivate();
}

} // namespace physvib::realtime_module_test
