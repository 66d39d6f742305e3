// SPDX-License-Identifier: GPL-3.0-or-later
// Fifty idleInstances that nobody plays: asleep, and small.
#include "PluginTesting.h"
#include "Support/HeapBytes.h"
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace physvib {
namespace {

using namespace test;

constexpr int idleInstances = 50;
constexpr double idleSeconds = 4.0;

/// Of all threads of this process: how often they went to sleep, so how often they were woken.
std::int64_t sleeps() {
    std::int64_t all = 0;
    for (const auto& thread : std::filesystem::directory_iterator{"/proc/self/task"}) {
        std::ifstream file{thread.path() / "status"};
        for (std::string line; std::getline(file, line);)
            if (line.starts_with("voluntary_ctxt_switches:")) all += std::stoll(line.substr(24));
    }
    return all;
}

std::int64_t bytesInMemory() {
    std::ifstream file{"/proc/self/statm"};
    std::int64_t all = 0, resident = 0;
    file >> all >> resident;
    return resident * sysconf(_SC_PAGESIZE);
}

TEST(Idle, DISABLED_FiftyInstancesSleepAndAreSmall) {
    const auto wakeUpsPerSecond = [] { // beside what waits for the time itself
        const auto before = sleeps();
        runFor(idleSeconds);
        return static_cast<double>(sleeps() - before) / idleSeconds;
    };
    PluginProcessor{"PhysVib", {}}; // what the process has once
    const double none = wakeUpsPerSecond();
    std::vector<std::unique_ptr<PluginProcessor>> all;
    const auto before = bytesInMemory();
    for (int i = 0; i < idleInstances; ++i)
        all.push_back(std::make_unique<PluginProcessor>("PhysVib", BusPlan{}));
    const double made = (wakeUpsPerSecond() - none) / idleInstances;
    const double madeMegabytes = static_cast<double>(bytesInMemory() - before) / 1e6 / idleInstances;
    for (auto& one : all) {
        one->setRateAndBufferSizeDetails(48000, 512);
        one->prepareToPlay(48000, 512);
    }
    runFor(3.0); // until the threads have seen that nothing is rendered
    const double prepared = (wakeUpsPerSecond() - none) / idleInstances;
    const double preparedMegabytes = static_cast<double>(bytesInMemory() - before) / 1e6 / idleInstances;
    std::printf(
        "each of %d idleInstances: made %.2f wake-ups/s, %.2f MB; prepared %.2f wake-ups/s, %.2f MB\n",
        idleInstances, made, madeMegabytes, prepared, preparedMegabytes);
    EXPECT_LT(made, 1.0);
    EXPECT_LT(prepared, 1.0);
    EXPECT_LT(madeMegabytes, 2.0);
    EXPECT_LT(preparedMegabytes, 4.0); // a renderer of four channels and what it delays
}

std::unique_ptr<PluginProcessor> prepared(int preset) {
    auto one = std::make_unique<PluginProcessor>("PhysVib", BusPlan{});
    if (preset >= 0) one->setCurrentProgram(preset);
    one->setRateAndBufferSizeDetails(48000, 512);
    one->prepareToPlay(48000, 512);
    return one;
}

/// Of what `make` returns, while it lives.
template <class Make>
std::size_t heapOf(Make make) {
    const std::size_t before = heapBytes();
    const auto made = make();
    return heapBytes() - before;
}

TEST(PluginMemory, APreparedInstanceTakesTwoMegabytes) {
    if (!countsHeap) GTEST_SKIP() << "only glibc counts it";
    prepared(0); // what the process has once
    for (int preset = -1; preset < static_cast<int>(builtInScenes().size()); ++preset) {
        std::string name;
        const std::size_t bytes = heapOf([&] {
            auto one = prepared(preset);
            name = one->state().scene.name;
            return one;
        });
        std::printf("an instance of the plug-in, prepared: %zu bytes, %s\n", bytes, name.c_str());
        // a world's with what Timing tight would else take in the render call
        EXPECT_LT(bytes, 2'000'000U);
        EXPECT_GT(bytes, 500'000U) << "it is counted";
    }
}

TEST(PluginMemory, OfAnInstanceByKind) {
    if (!countsHeap) GTEST_SKIP() << "only glibc counts it";
    const auto opened = [](PluginProcessor& of) {
        return std::unique_ptr<juce::AudioProcessorEditor>{of.createEditorIfNeeded()};
    };
    opened(*prepared(0)).reset(); // what the process has once
    const auto order = std::make_shared<TakeSpec>();
    order->setup = sessionSetupOf(newPluginState());
    const auto& setup = order->setup;
    const RendererSettings settings{.channels = setup.channels, .panner = setup.panner, .modes = setup.modes};
    const std::size_t bank = heapOf([&] {
        auto one = std::make_unique<ModeBank>();
        const int gates = settings.shareOf(limits::maxGates, limits::maxModes, 256);
        EXPECT_TRUE(one->prepare(48000, setup.channels, settings.instructions, setup.modes, gates));
        return one;
    });
    const std::size_t renderer = heapOf([&] {
        auto one = std::make_unique<HapticRenderer>();
        EXPECT_TRUE(one->prepare(settings));
        return one;
    });
    const std::size_t session = heapOf([&] {
        auto one = std::make_unique<Session>(std::shared_ptr<const SessionSetup>{order, &setup});
        one->prepare(48000, 512);
        return one;
    });
    const std::size_t take =
        heapOf([&] { return std::make_unique<Take>(order, 48000, 512, TakeTiming::safe); });
    const std::size_t made = heapOf([] { return std::make_unique<PluginProcessor>("PhysVib", BusPlan{}); });
    const std::size_t keys = heapOf([] { return prepared(-1); });
    const std::size_t world = heapOf([] { return prepared(0); });
    const auto one = prepared(-1);
    const std::size_t editor = heapOf([&] { return opened(*one); });
    const std::pair<const char*, std::size_t> kinds[]{
        {"a bank of modes", bank},
        {"the rest of a renderer: tones, recordings, limiter, events", renderer - bank},
        {"a session's queues and inputs", session - renderer},
        {"a take's queues", take - session},
        {"parameters, state and presets, as made", made},
        {"beside it: meters, guard, music", keys - made - take},
        {"a world, Shake the box", world - keys},
        {"an open window, beside", editor}};
    for (const auto& [kind, bytes] : kinds) {
        std::printf("memory of an instance: %7zu bytes, %s\n", bytes, kind);
        EXPECT_GT(bytes, 0U) << kind;
        EXPECT_LT(bytes, 2'000'000U) << kind;
    }
}

} // namespace
} // namespace physvib
