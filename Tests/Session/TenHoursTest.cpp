// SPDX-License-Identifier: MIT
// What `play --listen --save` does, for hours of simulated time: inputs and a journal. For
// Tests/ten-hours.sh.
#include "FakeHost.h"
#include "Live/Session/SessionJournal.h"
#include "Support/Growth.h"
#include "Support/HeapBytes.h"
#include <filesystem>
#include <gtest/gtest.h>

namespace physvib::ten_hours_test {

using namespace test;

struct Monday {
    explicit Monday(const std::filesystem::path& file)
        : session{setup}
        , journal{file, session, setup, {}} {
        session.prepare(hostRate, 480);
        session.advance();
    }
    static SessionSetup streamed() {
        auto setup = shakeTheBoxSetup(0.02);
        setup.log = LogUse::stream;
        return setup;
    }
    void input(std::int64_t i) {
        if (i % 50 == 0)
            ASSERT_EQ(session.submit({TiltAction{0.001 * static_cast<double>(i % 1000)}}).error, "");
        if (i % 500 == 0)
            ASSERT_TRUE(session.submit(
                {RenderControl{.kind = RenderControl::Kind::gain, .channel = 1, .value = 0.5f}}));
    }
    void step() {
        session.render(block.at.data(), 480, RenderMode::realtime);
        session.advance();
        for (PlayedEvent e; session.played().pop(e);) journal.onPlayed(e, session.timeline().sampleRateHz());
    }
    const SessionSetup setup = streamed();
    Session session;
    SessionJournal journal;
    Block block;
};

TEST(SessionForHours, DISABLED_HoldsNoMoreAndGetsNoSlower) {
    Growth growth{"play --listen --save, two inputs a second"};
    const auto folder =
        std::filesystem::temp_directory_path() / ("physvib-hours-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    {
        Monday one{folder / "one.json"}, other{folder / "other.json"};
        const auto blocks = static_cast<std::int64_t>(hoursWanted() * 360'000);
        for (std::int64_t i = 0; i < blocks; ++i) {
            for (Monday* monday : {&one, &other}) monday->input(i);
            growth.step(
                static_cast<double>(i) * 0.01, [&] { one.step(); }, [&] { other.step(); });
        }
        growth.expectFlat();
        for (Monday* monday : {&one, &other}) {
            monday->journal.end(monday->session.status().sessionNs);
            EXPECT_EQ(monday->journal.finish(), "");
            EXPECT_EQ(monday->journal.currentError(), "");
        }
    }
    std::filesystem::remove_all(folder);
}

// What a session takes from the heap. Tests/House/size.sh reads the line that is printed.

TEST(SessionMemory, APreparedSessionTakesTwoMegabytes) {
    if (!test::countsHeap) GTEST_SKIP() << "only glibc counts it";
    auto setup = test::shakeTheBoxSetup(0.02);
    setup.modes = 256;
    const std::size_t before = test::heapBytes();
    const auto session = std::make_unique<Session>(setup);
    session->prepare(48000, 512);
    const std::size_t prepared = test::heapBytes() - before;
    std::printf("sizeof RenderControl %zu, PartPanners %zu, Session %zu; a prepared session %zu bytes\n",
                sizeof(RenderControl), sizeof(PartPanners), sizeof(Session), prepared);
    EXPECT_LT(prepared, 2'000'000U);
    EXPECT_GT(prepared, 500'000U) << "it is counted";
}

} // namespace physvib::ten_hours_test
