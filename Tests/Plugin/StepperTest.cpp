// SPDX-License-Identifier: GPL-3.0-or-later
// One thread for all: those of equal pace come in one waking, who renders nothing seldom, who has left never.
#include "PluginTesting.h"
#include "Takes.h"
#include <chrono>
#include <fstream>

namespace physvib {
namespace {

using namespace test;

struct Counted final : Stepped {
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

std::int64_t figureOf(const std::string& file, const std::string& name) {
    std::ifstream in{file};
    for (std::string word; in >> word;)
        if (word == name + ":") {
            std::int64_t value = 0;
            in >> value;
            return value;
        }
    return 0;
}

// Figures for people: what fifty instances cost that are prepared and render nothing.
TEST(Stepper, DISABLED_FiftyInstances) {
    for (const bool hasWorld : {true, false}) {
        const auto memory = figureOf("/proc/self/status", "VmRSS");
        std::vector<std::unique_ptr<TestHost>> hosts;
        for (int i = 0; i < 50; ++i) {
            auto& host = *hosts.emplace_back(std::make_unique<TestHost>());
            if (!hasWorld) ASSERT_TRUE(host.plugin->apply(newPluginState()));
            host.prepare(48000, 512, false);
        }
        std::this_thread::sleep_for(std::chrono::seconds{2});
        juce::SharedResourcePointer<Stepper> stepper;
        const auto before = stepper->wakeUps();
        std::this_thread::sleep_for(std::chrono::seconds{10});
        std::printf("%s: wake-ups of the stepping thread: %.1f a second; memory: %.1f MB an instance\n",
                    hasWorld ? "worlds" : "instruments",
                    static_cast<double>(stepper->wakeUps() - before) / 10.0,
                    static_cast<double>(figureOf("/proc/self/status", "VmRSS") - memory) / 1024.0 / 50.0);
    }
}

} // namespace
} // namespace physvib
