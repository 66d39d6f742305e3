// SPDX-License-Identifier: GPL-3.0-or-later
// Receipts say what the device's buffers held, for every span, whatever the device does: it stops, stalls,
// comes back with another period or rate.
#include "Live/Devices/Receipts.h"
#include "FakeAudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Session/FakeHost.h"
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <thread>

namespace physvib::receipts_test {

using namespace test;
using namespace std::chrono_literals;

constexpr int rate = 48000, bin = rate / Receipts::binsPerSecond;

std::int64_t nsOf(std::int64_t frame, int hz = rate) {
    return frame / hz * 1'000'000'000 + frame % hz * 1'000'000'000 / hz;
}

/// What left, frame by frame.
struct Given {
    float sample = 0.0f;
    bool hasOutput = false;
    int piece = 0; ///< frames of one piece follow each other
};

/// The receipt of [from, until) by the frames themselves.
Receipt summed(const std::map<std::int64_t, Given>& given, std::int64_t from, std::int64_t until) {
    Receipt all;
    all.isRunning = true;
    double squares = 0.0;
    int piece = -1;
    for (std::int64_t n = from; n < until; ++n) {
        const auto at = given.find(n);
        if (at == given.end() || !at->second.hasOutput || (piece >= 0 && piece != at->second.piece)) {
            all.isRunning = false;
            if (at == given.end() || !at->second.hasOutput) continue;
        }
        piece = at->second.piece;
        ++all.frames;
        all.peak = std::max(all.peak, std::abs(static_cast<double>(at->second.sample)));
        squares += static_cast<double>(at->second.sample) * static_cast<double>(at->second.sample);
    }
    all.meanSquare = all.frames > 0 ? squares / static_cast<double>(all.frames) : 0.0;
    return all;
}

void expectSame(const Receipt& told, const Receipt& is, const std::string& where) {
    EXPECT_EQ(told.frames, is.frames) << where;
    EXPECT_EQ(told.peak, is.peak) << where;
    EXPECT_NEAR(told.meanSquare, is.meanSquare, 2e-6 * is.meanSquare) << where;
    EXPECT_EQ(told.isRunning, is.isRunning) << where;
}

TEST(Receipts, EqualWhatWasGivenForEverySpan) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        Random random{seed};
        Receipts receipts{2};
        std::map<std::int64_t, Given> given; // of actuator 1
        std::int64_t place = -random.below(5000);
        int piece = 0;
        bool hasOutput = true;
        receipts.begin();
        const std::int64_t from = 20'000 + random.below(10'000), until = from + 1 + random.below(9000);
        receipts.alignBinsTo(nsOf(from), nsOf(until));
        std::vector<float> one(4096), two(4096);
        while (place < 60'000) {
            const int frames = 1 + random.below(random.below(10) == 0 ? 4096 : 300);
            if (random.below(60) == 0) receipts.begin(), ++piece;
            if (random.below(60) == 0) place += bin * (1 + random.below(9)), ++piece;
            if (place % bin == 0 && random.below(4) == 0) hasOutput = !hasOutput;
            for (int n = 0; n < frames; ++n) {
                const auto at = static_cast<std::size_t>(n);
                one[at] = 1.0f;
                two[at] = static_cast<float>(random.below(2001) - 1000) / 1000.0f;
                given[place + n] = {two[at], hasOutput, piece};
            }
            const std::array<const float*, 2> outputs{one.data(), hasOutput ? two.data() : nullptr};
            receipts.addBlock(0, place, rate, outputs.data(), frames);
            place += frames;
        }
        // an output that comes and goes within a bin counts as none in all of it: only whole bins do here
        const auto expectAt = [&](std::int64_t a, std::int64_t b) {
            const Receipt told = receipts.receiptFor(nsOf(a), nsOf(b), 1);
            EXPECT_TRUE(told.hasEnded && told.isInMemory);
            expectSame(told, summed(given, a, b),
                       "seed " + std::to_string(seed) + ", " + std::to_string(a) + " to " +
                           std::to_string(b));
        };
        for (int k = 0; k < 100; ++k) {
            const std::int64_t a = bin * random.below(100), b = a + bin * (1 + random.below(20));
            expectAt(a, b);
        }
        expectAt(from, until);
    }
}

TEST(Receipts, EverySetOfInstructionsMeasuresWhatIsThere) {
    Random random{3};
    for (const auto set :
         {InstructionSet::sse4, InstructionSet::avx2, InstructionSet::avx512, InstructionSet::neon})
        for (std::size_t frames = 0; frames < 200; ++frames) {
            const TileKernel* const kernel = tileKernel(set);
            if (kernel == nullptr) break; // not of this processor
            std::array<MeasuredLanes, 2> lanes;
            float peak = 0.0f, squares = 0.0f;
            for (int times = 0; times < 2; ++times) {
                std::vector<float> samples(frames); // of its own, so that reading beyond is seen
                for (float& x : samples) {
                    x = static_cast<float>(random.below(2001) - 1000) / 1000.0f;
                    peak = std::max(peak, std::abs(x)), squares += x * x;
                }
                const std::array<const float*, 2> outputs{nullptr, samples.data()};
                kernel->measure(outputs.data(), 2, 0, frames, lanes.data());
            }
            std::array<Measured, 2> joined, again;
            kernel->join(lanes.data(), 2, joined.data());
            kernel->join(lanes.data(), 2, again.data());
            const auto [all, none] = std::pair{joined[1], again[1]};
            EXPECT_EQ(all.peak, peak) << frames;
            EXPECT_NEAR(all.squares, squares, 1e-5f * squares) << frames;
            EXPECT_EQ(none.peak + none.squares + joined[0].peak, 0.0f);
        }
}

TEST(Receipts, TellWhatIsPendingForgottenOrOfAnotherSession) {
    Receipts receipts{1};
    const std::vector<float> samples(static_cast<std::size_t>(bin), 0.5f);
    const float* const at = samples.data();
    const auto add = [&](std::uint32_t session, std::int64_t place) {
        receipts.addBlock(session, place, rate, &at, bin);
    };
    EXPECT_FALSE(receipts.receiptFor(0, nsOf(bin), 0).hasEnded) << "nothing has run";
    receipts.begin();
    for (int k = 0; k < 10; ++k) add(0, k * bin);
    EXPECT_TRUE(receipts.receiptFor(0, nsOf(10 * bin), 0).isRunning);
    EXPECT_FALSE(receipts.receiptFor(0, nsOf(10 * bin + 1), 0).hasEnded);
    EXPECT_FALSE(receipts.receiptFor(0, nsOf(10 * bin + 1), 0).isRunning);
    EXPECT_EQ(receipts.receiptFor(0, nsOf(bin), 1).frames, 0) << "no such actuator";
    for (int k = 0; k < 10; ++k) add(1, k * bin);
    for (int k = 10; k < 20; ++k) add(0, k * bin);
    EXPECT_FALSE(receipts.receiptFor(0, nsOf(20 * bin), 0).isRunning) << "another one played in between";
    EXPECT_TRUE(receipts.receiptFor(nsOf(10 * bin), nsOf(20 * bin), 0).isRunning);
    EXPECT_TRUE(receipts.receiptFor(0, nsOf(10 * bin), 0, 1).isRunning);
    EXPECT_FALSE(receipts.receiptFor(0, nsOf(10 * bin + 1), 0, 1).hasEnded);
    for (std::int64_t k = 20; k < Receipts::maxBins; ++k) add(0, k * bin);
    EXPECT_FALSE(receipts.receiptFor(0, nsOf(bin), 0).isInMemory);
    EXPECT_FALSE(receipts.receiptFor(0, nsOf(bin), 0).isRunning);
    const std::int64_t minute = 60 * Receipts::binsPerSecond, end = Receipts::maxBins;
    const Receipt lately = receipts.receiptFor(nsOf((end - minute) * bin), nsOf(end * bin), 0);
    EXPECT_TRUE(lately.isInMemory && lately.isRunning) << "a minute is kept";
    EXPECT_EQ(lately.frames, minute * bin);
}

// A bin of constant value has a mean square that is its peak's: a torn one has not.
TEST(Receipts, AReaderNeverGetsHalfABin) {
    Receipts receipts{1};
    std::atomic<bool> ends{false};
    std::atomic<std::int64_t> newest{0};
    constexpr int width = 5000 / Receipts::binsPerSecond;
    std::thread writer{[&] {
        std::vector<float> samples(static_cast<std::size_t>(width));
        const float* const at = samples.data();
        receipts.begin();
        for (std::int64_t k = 0; !ends; ++k) {
            std::ranges::fill(samples, static_cast<float>(1 + k % 64) / 64.0f);
            receipts.addBlock(0, k * width, 5000, &at, width);
            newest = k;
        }
    }};
    std::int64_t read = 0;
    for (int k = 0; k < 3000 || read < 300; ++k) {
        const std::int64_t bin = std::max<std::int64_t>(0, newest - (k % 2 == 0 ? 0 : Receipts::maxBins - 3));
        const Receipt told = receipts.receiptFor(nsOf(width * bin, 5000), nsOf(width * (bin + 1), 5000), 0);
        if (!told.isInMemory || !told.hasEnded) continue;
        ++read;
        EXPECT_EQ(told.peak, static_cast<double>(1 + bin % 64) / 64.0);
        EXPECT_EQ(told.meanSquare, told.peak * told.peak);
        EXPECT_TRUE(told.isRunning);
        if (testing::Test::HasFailure()) break; // the writer is to be joined
    }
    ends = true;
    writer.join();
}

/// An output on a fake interface, and what its buffers held at each session time, as it is felt.
struct OneOutput {
    explicit OneOutput(bool isReal = false) {
        setup.channels = 4;
        interface.isReal = isReal;
        EXPECT_EQ(output.open({"hands", {3, 1, 0, -1}, 0, 0, 0.7f}), "");
    }

    /// One block; pieces of what the device played without a break.
    void play(int frames, int piece) {
        session.advance();
        const Timeline& time = session.timeline();
        const std::int64_t place = time.framesRendered() - time.outputLatencyFrames();
        const auto out = interface.play(frames);
        if (out.empty() || time.framesRendered() == place + time.outputLatencyFrames()) return;
        for (int n = 0; n < frames; ++n) {
            constexpr std::array<std::size_t, 3> at{2, 1, 0}; // of outputs 1, 2, 4, which are open
            for (std::size_t j = 0; j < at.size(); ++j)
                given[j][place + n] = {out[at[j]][static_cast<std::size_t>(n)], true, piece};
        }
        for (PlayedEvent none; session.played().pop(none);) {
        }
    }
    void expectAll(const std::string& where) const {
        const int hz = output.sampleRateHz(), width = hz / Receipts::binsPerSecond;
        const std::int64_t last = given[0].rbegin()->first / width * width;
        for (std::int64_t a = 0; a < last; a += width)
            for (const std::int64_t length : {1, 50})
                for (int j = 0; j < 4; ++j) {
                    const std::int64_t b = std::min(last, a + length * width);
                    const Receipt told = output.receiptFor(nsOf(a, hz), nsOf(b, hz), j);
                    ASSERT_TRUE(told.hasEnded && told.isInMemory) << where;
                    if (j == 3) {
                        EXPECT_EQ(told.frames, 0) << "it has no output";
                        EXPECT_FALSE(told.isRunning);
                        continue;
                    }
                    expectSame(told, summed(given[static_cast<std::size_t>(j)], a, b),
                               where + ", actuator " + std::to_string(j) + ", " + std::to_string(a) + " to " +
                                   std::to_string(b));
                }
    }

    FakeInterface interface;
    SessionSetup setup = shakeTheBoxSetup(0.02);
    Session session{setup};
    AudioOutput output{session, fakeDrivers({&interface})};
    std::array<std::map<std::int64_t, Given>, 3> given;
};

TEST(Receipts, EqualTheBuffersOfADeviceThatStopsAndComesBack) {
    for (const int moment : {1, 350, 601}) {
        OneOutput one;
        Random random{static_cast<std::uint32_t>(moment)};
        int piece = 0;
        for (int block = 0; block < 900; ++block) {
            if (block == moment) {
                one.interface.unplug(moment % 2 == 0);
                if (moment % 2 != 0) one.interface.device->close(); // it vanishes without a word
                one.interface.isPlugged = true;
                ASSERT_EQ(one.output.maintain(), "");
                ++piece;
            }
            if (block == moment + 100) one.output.setSilent(true);
            if (block == moment + 200) one.output.setSilent(false);
            one.play(1 + random.below(64), piece);
        }
        one.expectAll("moment " + std::to_string(moment));
    }
}

TEST(Receipts, ASpanOverAChangeOfPeriodOrRateIsNotInOnePiece) {
    for (const auto& [hz, block] : {std::pair{48000, 512}, {44100, 64}, {96000, 1024}}) {
        OneOutput one;
        for (int k = 0; k < 500; ++k) one.play(64, 0);
        const auto feltNs = [&] {
            return nsOf(one.session.timeline().framesRendered() -
                            one.session.timeline().outputLatencyFrames(),
                        one.output.sampleRateHz());
        };
        const std::int64_t changedNs = feltNs();
        const Receipt before = one.output.receiptFor(changedNs - 200'000'000, changedNs - 50'000'000, 0);
        EXPECT_TRUE(before.isRunning);
        one.interface.unplug(true);
        one.interface.isPlugged = true;
        one.interface.rate = hz;
        one.interface.block = block;
        one.output.maintain();
        for (int k = 0; k < hz / block; ++k) one.play(block, 1);
        const std::int64_t now = feltNs();
        const Receipt across = one.output.receiptFor(changedNs - 200'000'000, now - 100'000'000, 0),
                      after = one.output.receiptFor(changedNs + 50'000'000, now - 50'000'000, 0);
        EXPECT_TRUE(across.hasEnded && after.hasEnded);
        EXPECT_FALSE(across.isRunning);
        EXPECT_TRUE(after.isRunning);
        EXPECT_GT(after.opening, before.opening);
    }
}

TEST(Receipts, AStallOfTheDeviceIsABreak) {
    OneOutput one{true};
    // until a second runs through without a pause, however busy the machine is
    for (int tries = 0; tries < 100; ++tries) {
        const std::int64_t from = one.session.timeline().framesRendered();
        for (int k = 0; k < 200; ++k) one.play(64, 0);
        const std::int64_t until = from + 100 * 64;
        if (one.output.receiptFor(nsOf(from), nsOf(until), 0).isRunning) break;
        ASSERT_LT(tries, 99);
    }
    EXPECT_TRUE(one.output.status().isRunning);
    std::this_thread::sleep_for(120ms);
    EXPECT_FALSE(one.output.isPlaying());
    const std::int64_t stalled =
        one.session.timeline().framesRendered() - one.session.timeline().outputLatencyFrames();
    for (int k = 0; k < 200; ++k) one.play(64, 0);
    const Receipt across = one.output.receiptFor(nsOf(stalled - 480), nsOf(stalled + 480), 0);
    EXPECT_TRUE(across.hasEnded);
    EXPECT_FALSE(across.isRunning);
    EXPECT_GE(across.frames, 960);
}

TEST(Receipts, ABorrowedSessionHasItsOwn) {
    OneOutput one;
    for (int k = 0; k < 100; ++k) one.play(64, 0);
    Session lent{one.setup};
    ASSERT_TRUE(one.output.playInstead(&lent));
    const std::uint32_t number = one.output.playedSession();
    EXPECT_NE(number, 0u);
    for (int k = 0; k < 200; ++k) {
        lent.advance();
        one.interface.play(64);
    }
    EXPECT_TRUE(one.output.receiptFor(0, nsOf(4800), 0).isRunning);
    ASSERT_TRUE(one.output.playInstead(nullptr));
    EXPECT_EQ(one.output.playedSession(), 0u);
    EXPECT_TRUE(one.output.receiptFor(0, nsOf(4800), 0, number).isRunning)
        << "also afterwards, by its number";
    EXPECT_FALSE(one.output.receiptFor(0, nsOf(4800), 0).hasEnded) << "of the output's own";
}

} // namespace physvib::receipts_test
