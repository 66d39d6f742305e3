// SPDX-License-Identifier: GPL-3.0-or-later
// Fifty idleInstances that nobody plays: asleep, and small.
#include "PluginRuns.h"
#include "PluginTesting.h"
#include "Support/Growth.h"
#include "Support/HeapBytes.h"
#include <chrono>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace physvib::idle_test {

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
    for (auto& one : all) prepareBlocks(*one, 512);
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
    prepareBlocks(*one, 512);
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
    const auto order = std::make_shared<RunSpec>();
    order->setup = makeSessionSetup(newPluginState());
    const auto& setup = order->setup;
    const RendererSettings settings{.channels = setup.channels, .panner = setup.panner, .modes = setup.modes};
    const std::size_t bank = heapOf([&] {
        auto one = std::make_unique<ModeBank>();
        const int gates = settings.scaledToModes(limits::maxGates, limits::maxModes, 256);
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
        heapOf([&] { return std::make_unique<PluginRun>(order, 48000, 512, StepTiming::safe); });
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

// One thread for all: those of equal pace come in one waking, who renders nothing seldom, who has left never.

struct Counted final : StepClient {
    explicit Counted(bool doesRender)
        : renders{doesRender} {}
    void tick() override {
        ++ticks;
        if (renders) ++rendered;
        isElsewhere = isElsewhere || (thread != std::thread::id{} && thread != std::this_thread::get_id());
        thread = std::this_thread::get_id();
    }
    int ticksPerSecond() const noexcept override { return 500; }
    double idleSeconds() const noexcept override { return 0.02; }
    std::uint64_t blocks() const noexcept override { return rendered; }
    const bool renders;
    std::atomic<std::uint64_t> ticks{0}, rendered{0};
    std::thread::id thread;
    bool isElsewhere = false;
};

void waitForTicks(const Counted& one, std::uint64_t count) {
    while (one.ticks < count) std::this_thread::sleep_for(std::chrono::milliseconds{1});
}

TEST(Stepper, ThoseOfEqualPaceComeInOneWakingOfOneThread) {
    std::vector<std::unique_ptr<Counted>> all;
    Stepper stepper;
    for (int i = 0; i < 50; ++i) stepper.add(*all.emplace_back(std::make_unique<Counted>(true)));
    waitForTicks(*all.back(), 200);
    const auto wakeUps = stepper.wakeUps();
    std::uint64_t ticks = 0;
    for (auto& one : all) stepper.remove(*one);
    for (auto& one : all) {
        EXPECT_EQ(one->thread, all.front()->thread);
        EXPECT_FALSE(one->isElsewhere);
        ticks += one->ticks;
    }
    EXPECT_GE(ticks, 50u * 190);
    EXPECT_LT(wakeUps, 400u) << "not one for each of " << ticks;
}

TEST(Stepper, WhoRendersNothingIsVisitedSeldomAndWhoHasLeftNever) {
    Counted playing{true}, idle{false};
    Stepper stepper;
    stepper.add(playing);
    stepper.add(idle);
    waitForTicks(playing, 1000); // two seconds, of which the first may be a pause
    const auto before = idle.ticks.load();
    waitForTicks(playing, 1500);
    EXPECT_LT(idle.ticks - before, 250u) << "of 500";
    EXPECT_GT(idle.ticks - before, 2u);
    stepper.remove(playing);
    const auto left = playing.ticks.load();
    waitForTicks(idle, idle.ticks + 3);
    EXPECT_EQ(playing.ticks, left);
    stepper.remove(idle);
}

// A host that plays notes and automation for hours, in blocks that are not realtime: what the plug-in holds
// does not grow. The ten hours are for Tests/ten-hours.sh.

struct Player {
    explicit Player(int rate) {
        auto state = shakenBox();
        state.notes = {{.note = 62, .kind = NoteKind::spawn, .material = 1}};
        EXPECT_TRUE(host.plugin->apply(state)) << host.plugin->errorText();
        host.prepare(rate, 480);
    }
    void step(std::int64_t i) {
        host.setNormal(Parameter::tilt, static_cast<float>(i % 1000) / 1000.0f);
        const auto block = static_cast<int>(i % 480), velocity = static_cast<int>(1 + i % 127);
        host.block(480, i % 20 == 0 ? oneNote(62, velocity, block) : juce::MidiBuffer{});
    }
    void look() {
        host.plugin->runs().drainLog();
        host.plugin->runs().readPoses(poses);
    }
    TestHost host;
    std::vector<BodyPose> poses;
};

void playHours(double hours, int rate, Player& one, Player& other, Growth& growth) {
    const auto blocks = static_cast<std::int64_t>(hours * 3600 * rate / 480);
    for (std::int64_t i = 0; i < blocks; ++i) {
        growth.step(
            static_cast<double>(i) * 480 / rate, [&] { one.step(i); }, [&] { other.step(i); });
        if (i % 100 == 0) one.look(), other.look();
    }
    EXPECT_LT(one.poses.size(), one.host.plugin->state().scene.bodies.size() + 64 + 8)
        << "what is there, and what has just gone";
}

TEST(PluginForHours, DISABLED_HoldsNoMoreAndGetsNoSlower) {
    Growth growth{"a plug-in with tilt in every block and notes"};
    Player one{48000}, other{48000};
    playHours(hoursWanted(), 48000, one, other, growth);
    growth.expectFlat();
}

TEST(PluginForHours, AMinuteLeavesNothingBehindThatGrows) {
    Growth growth{""};
    Player one{8000}, other{8000};
    playHours(1.0 / 60, 8000, one, other, growth);
}

} // namespace physvib::idle_test
