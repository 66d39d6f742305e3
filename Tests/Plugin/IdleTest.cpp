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

TEST(PluginMemory, APreparedInstanceTakesTwoMegabytes) {
    if (!countsHeap) GTEST_SKIP() << "only glibc counts it";
    const auto prepared = [](int preset) {
        auto one = std::make_unique<PluginProcessor>("PhysVib", BusPlan{});
        if (preset >= 0) one->setCurrentProgram(preset);
        one->setRateAndBufferSizeDetails(48000, 512);
        one->prepareToPlay(48000, 512);
        return one;
    };
    prepared(0); // what the process has once
    for (int preset = -1; preset < static_cast<int>(builtInScenes().size()); ++preset) {
        const std::size_t before = heapBytes();
        const auto one = prepared(preset);
        const std::size_t bytes = heapBytes() - before;
        std::printf("an instance of the plug-in, prepared: %zu bytes, %s\n", bytes,
                    one->state().scene.name.c_str());
        // a world's with what Timing tight would else take in the render call
        EXPECT_LT(bytes, 2'000'000U);
        EXPECT_GT(bytes, 500'000U) << "it is counted";
    }
}

} // namespace
} // namespace physvib
