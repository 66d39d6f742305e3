// SPDX-License-Identifier: MIT
// LinkedLimiter at 20 dB of random overload: ceilings, ratios, slopes, release to 1, what never passes.
#include "Core/Actuators/ActuatorStage.h"
#include "Core/Actuators/GainRamp.h"
#include "Core/Actuators/OutputGuard.h"
#include "Support/ClosedForm.h"
#include "Support/Sets.h"
#include <array>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

namespace physvib::linked_limiter_test {

constexpr int rate = 48000, channels = 8;
using Block = std::vector<std::vector<float>>;

Block noise(int frames, double level, std::uint32_t seed) {
    test::Random random{seed};
    Block block(channels, std::vector<float>(static_cast<std::size_t>(frames)));
    for (auto& channel : block)
        for (auto& x : channel) x = static_cast<float>(random.uniform(-level, level));
    return block;
}

struct Limited {
    std::unique_ptr<LinkedLimiter> limiter = std::make_unique<LinkedLimiter>();
    explicit Limited(bool enabled = true, InstructionSet set = InstructionSet::best) {
        limiter->prepare(rate, channels, enabled, set);
    }
    Block operator()(Block block, int size = 100) {
        for (std::size_t done = 0; done < block[0].size(); done += static_cast<std::size_t>(size)) {
            std::vector<float*> at;
            for (auto& channel : block) at.push_back(channel.data() + done);
            limiter->process(at.data(), static_cast<int>(std::min(block[0].size() - done,
                                                                  static_cast<std::size_t>(size))));
        }
        return block;
    }
    std::size_t latency() const { return static_cast<std::size_t>(limiter->latencyFrames()); }
};

/// The one gain of each frame, from the channel where it can be told most exactly.
std::vector<double> gainsOf(const Block& in, const Block& out, std::size_t latency) {
    std::vector<double> gains;
    for (std::size_t n = latency; n < out[0].size(); ++n) {
        std::size_t loudest = 0;
        for (std::size_t j = 1; j < channels; ++j)
            if (std::abs(in[j][n - latency]) > std::abs(in[loudest][n - latency])) loudest = j;
        gains.push_back(double(out[loudest][n]) / double(in[loudest][n - latency]));
    }
    return gains;
}

TEST(LinkedLimiter, NoChannelExceedsItsCeiling) {
    Limited limited;
    for (int j = 0; j < channels; ++j) limited.limiter->setCeiling(j, 0.2f + 0.1f * static_cast<float>(j));
    const Block out = limited(noise(5 * rate, 10, 1));
    for (std::size_t j = 0; j < channels; ++j)
        for (const float y : out[j]) ASSERT_LE(std::abs(y), 0.2f + 0.1f * static_cast<float>(j));
}

/// A tone of full scale on all channels; from `changeFrame` on, the ceiling of channel 2 is another.
Block toneAcrossACeiling(int changeFrame, float before, float after, int size,
                         InstructionSet set = InstructionSet::best) {
    Limited limited{true, set};
    limited.limiter->setCeiling(2, before);
    Block in(channels, std::vector<float>(rate));
    for (auto& channel : in)
        for (std::size_t n = 0; n < channel.size(); ++n)
            channel[n] =
                static_cast<float>(std::sin(2.0 * std::numbers::pi * 205.0 * static_cast<double>(n) / rate));
    Block rest(channels);
    for (std::size_t j = 0; j < channels; ++j) rest[j].assign(in[j].begin() + changeFrame, in[j].end());
    for (auto& channel : in) channel.resize(static_cast<std::size_t>(changeFrame));
    Block out = limited(in, size);
    limited.limiter->setCeiling(2, after);
    rest = limited(rest, size);
    for (std::size_t j = 0; j < channels; ++j) out[j].insert(out[j].end(), rest[j].begin(), rest[j].end());
    return out;
}

TEST(LinkedLimiter, ACeilingThatChangesIsARamp) {
    constexpr double slope = 2.0 * std::numbers::pi * 205.0 / rate; // the tone's own, the most in a frame
    constexpr double ramp = 1.0 / (limits::channelRampSeconds * rate);
    for (const auto& [before, after] : {std::pair{1.0f, 0.3f}, {0.3f, 1.0f}, {0.9f, 0.05f}})
        for (int change = 20000; change < 20240; change += 13) { // anywhere in a period
            const std::vector<float> out = toneAcrossACeiling(change, before, after, 100)[2];
            for (std::size_t n = 1; n < out.size(); ++n)
                ASSERT_LE(std::abs(out[n] - out[n - 1]), slope + ramp)
                    << before << ' ' << after << ' ' << change << ' ' << n;
            const auto settled =
                static_cast<std::size_t>(change + limits::channelRampSeconds * rate) + Limited{}.latency();
            for (std::size_t n = 0; n < out.size(); ++n)
                ASSERT_LE(std::abs(out[n]), n < static_cast<std::size_t>(change) ? before
                                            : n < settled                        ? std::max(before, after)
                                                                                 : after)
                    << n;
        }
}

TEST(LinkedLimiter, ACeilingsRampIsTheSameForEveryBlockSizeAndInstructionSet) {
    const Block whole = toneAcrossACeiling(20111, 1.0f, 0.3f, rate);
    for (const int size : {1, 7, 64, 333})
        ASSERT_EQ(toneAcrossACeiling(20111, 1.0f, 0.3f, size), whole) << size;
    ASSERT_EQ(toneAcrossACeiling(20111, 1.0f, 0.3f, 64, InstructionSet::scalar), whole);
}

TEST(LinkedLimiter, ACeilingChangesInSilenceToo) {
    Limited limited;
    std::vector<float> silence(rate, 0.0f);
    std::vector<float*> at(channels, silence.data());
    limited.limiter->process(at.data(), rate / 2, true);
    limited.limiter->setCeiling(2, 0.3f);
    limited.limiter->process(at.data(), rate / 2, true);
    const Block out = limited(noise(rate / 10, 10, 11));
    for (const float y : out[2]) ASSERT_LE(std::abs(y), 0.3f);
}

TEST(LinkedLimiter, ChannelRatiosAreThoseOfTheInput) {
    Limited limited;
    const Block in = noise(2 * rate, 10, 2), out = limited(in);
    const auto gains = gainsOf(in, out, limited.latency());
    for (std::size_t i = 0; i < gains.size(); ++i)
        for (std::size_t j = 0; j < channels; ++j)
            ASSERT_NEAR(out[j][i + limited.latency()], in[j][i] * gains[i], 1e-6);
}

TEST(LinkedLimiter, GainNeverMovesFasterThanItsStatedSlopes) {
    Limited limited;
    Block in = noise(3 * rate, 10, 3);
    for (auto& channel : in)
        for (std::size_t n = rate; n < 2 * rate; ++n) channel[n] *= 0.05f; // let it release and attack anew
    const auto gains = gainsOf(in, limited(in), limited.latency());
    double attack = 0, release = 0;
    for (std::size_t i = 1; i < gains.size(); ++i) {
        attack = std::max(attack, gains[i - 1] - gains[i]);
        release = std::max(release, gains[i] - gains[i - 1]);
    }
    EXPECT_LE(attack, limited.limiter->maxAttackPerFrame() + 2e-7);
    EXPECT_LE(release, limited.limiter->maxReleasePerFrame() + 2e-7);
    EXPECT_GT(attack, 0.0);
}

TEST(LinkedLimiter, OneSecondAfterTheOverloadTheInputPassesBitForBit) {
    Limited limited;
    limited(noise(rate, 10, 4));
    limited(noise(rate, 0.9, 5));
    const Block in = noise(rate, 0.9, 6), out = limited(in);
    for (std::size_t j = 0; j < channels; ++j)
        for (std::size_t n = limited.latency(); n < rate; ++n)
            ASSERT_EQ(out[j][n], in[j][n - limited.latency()]);
    EXPECT_EQ(limited.limiter->gain(), 1.0f);
}

TEST(LinkedLimiter, NothingNonFiniteOrDenormalPasses) {
    Limited limited;
    Block in = noise(rate, 10, 7);
    test::Random random{8};
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                         std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity(),
                         std::numeric_limits<float>::denorm_min(),
                         -1e-39f,
                         1.3e-38f};
    for (auto& channel : in)
        for (auto& x : channel)
            if (random.below(10) == 0) x = bad[random.below(6)];
    for (const auto& channel : limited(in))
        for (const float y : channel) ASSERT_TRUE(y == 0.0f || std::isnormal(y)) << y;
    EXPECT_GT(limited.limiter->nonFiniteSamples(), 0u);
}

TEST(LinkedLimiter, DisabledItOnlyDelaysByTheSameTime) {
    Limited limited{false}, enabled;
    const Block in = noise(rate, 10, 10), out = limited(in);
    EXPECT_EQ(limited.latency(), enabled.latency());
    for (std::size_t n = limited.latency(); n < rate; ++n) ASSERT_EQ(out[0][n], in[0][n - limited.latency()]);
}

TEST(LinkedLimiter, SilenceThatIsToldIsSilenceThatIsSeen) {
    Limited told, seen;
    for (const double level : {10.0, 0.5, 3.0}) {
        ASSERT_EQ(told(noise(1000, level, 12)), seen(noise(1000, level, 12)));
        for (int i = 0; i < 150; ++i) { // until after the release
            Block a = noise(100, 0, 13), b = a;
            std::vector<float*> at;
            for (auto& channel : a) at.push_back(channel.data());
            told.limiter->process(at.data(), 100, true);
            ASSERT_EQ(a, seen(b)) << i;
        }
        EXPECT_EQ(told.limiter->gain(), 1.0f);
    }
}

TEST(LinkedLimiter, IsTheSameToTheBitOnEachInstructionSetAndAtEachBlockSize) {
    Block in = noise(rate / 2, 1.05, 9); // over now and then
    in[3][777] = std::numeric_limits<float>::infinity();
    in[4][778] = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t n = 5000; n < 6000; ++n) in[5][n] = n % 2 == 0 ? 1e-39f : -0.0f;
    for (const bool enabled : {true, false}) {
        Limited oracle{enabled, InstructionSet::scalar};
        const Block expected = oracle(in);
        for (const auto set : test::runnableSets())
            for (const int size : {1, 13, 64, 1000}) {
                Limited limited{enabled, set};
                const Block out = limited(in, size);
                for (std::size_t j = 0; j < channels; ++j)
                    for (std::size_t n = 0; n < in[0].size(); ++n)
                        ASSERT_EQ(std::bit_cast<std::uint32_t>(out[j][n]),
                                  std::bit_cast<std::uint32_t>(expected[j][n]))
                            << nameOf(set) << ", block " << size << ", frame " << n;
                EXPECT_EQ(limited.limiter->nonFiniteSamples(), 2U);
            }
    }
}

// GainRamp: straight lines between gains, exact at both ends.

/// Ones behind a ramp of a tenth per frame, or as fast as `hurry` frames ask, in two blocks.
std::vector<float> ramped(float from, float to, int frames, int first, int hurry = 1000) {
    GainRamp ramp;
    ramp.prepare(1000, 0.01, from);
    ramp.moveTo(to, hurry);
    std::vector<float> x(static_cast<std::size_t>(frames), 1.0f);
    float* at = x.data();
    ramp.apply(&at, 1, first);
    at += first;
    ramp.apply(&at, 1, frames - first);
    EXPECT_TRUE(ramp.isResting());
    return x;
}

TEST(GainRamp, AtOneItChangesNoBit) {
    GainRamp ramp;
    ramp.prepare(1000, 0.01, 1.0f);
    std::vector<float> x{0.1f, -3e-20f, 7.0f}, before = x;
    float* at = x.data();
    ramp.apply(&at, 1, 3);
    EXPECT_EQ(x, before);
}

TEST(GainRamp, MovesInAStraightLineAcrossBlocksAndIsThereExactly) {
    const auto up = ramped(0.0f, 1.0f, 20, 7), down = ramped(1.0f, 0.0f, 30, 30);
    for (std::size_t n = 0; n < 20; ++n)
        EXPECT_NEAR(up[n], std::min(1.0f, 0.1f * static_cast<float>(n + 1)), 1e-6);
    EXPECT_EQ(up.back(), 1.0f);
    EXPECT_EQ(down[9], 0.0f);
    EXPECT_EQ(down[29], 0.0f);
    for (int frames = 1; frames <= 9; ++frames)
        EXPECT_EQ(ramped(1.0f, 0.0f, frames, frames, frames).back(), 0.0f) << frames << ", in a hurry";
}

TEST(GainRamp, MovesOnThroughSilence) {
    GainRamp passed, applied;
    std::array<float, 100> zeros{}, a{}, b{};
    a.fill(1.0f);
    b.fill(1.0f);
    float *silence = zeros.data(), *atA = a.data(), *atB = b.data();
    for (auto* ramp : {&passed, &applied}) {
        ramp->prepare(48000, 0.01, 1.0f);
        ramp->moveTo(-0.5f);
    }
    passed.skip(100);
    applied.apply(&silence, 1, 100);
    passed.apply(&atA, 1, 100);
    applied.apply(&atB, 1, 100);
    EXPECT_EQ(a, b);
    EXPECT_LT(a[99], a[0]);
}

// A channel's delay: exact when it rests, without a step when it changes, silent when it is empty.

std::vector<float> sine(int frames) {
    std::vector<float> x(static_cast<std::size_t>(frames));
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] = static_cast<float>(std::sin(0.02 * static_cast<double>(n)));
    return x;
}

TEST(ChannelDelay, DelaysByWholeFramesAtAnyBlockSize) {
    const auto in = sine(3000);
    for (const int block : {1, 7, 64, 3000}) {
        ChannelDelay<500> delay;
        delay.prepare(100, 123);
        auto out = in;
        for (int done = 0; done < 3000; done += block)
            delay.process(out.data() + done, std::min(block, 3000 - done), false);
        for (std::size_t n = 0; n < out.size(); ++n) ASSERT_EQ(out[n], n < 123 ? 0.0f : in[n - 123]) << n;
    }
}

TEST(ChannelDelay, ChangesWithoutAStep) {
    auto io = sine(4000);
    ChannelDelay<500> delay;
    delay.prepare(200, 0);
    EXPECT_TRUE(delay.isBypassed());
    delay.process(io.data(), 1000, false);
    delay.moveTo(400);
    delay.process(io.data() + 1000, 1500, false);
    delay.moveTo(0);
    delay.process(io.data() + 2500, 1500, false);
    EXPECT_TRUE(delay.isBypassed());
    for (std::size_t n = 1; n < io.size(); ++n) ASSERT_LT(std::abs(io[n] - io[n - 1]), 0.04f) << n;
}

TEST(ChannelDelay, EndsWhereItWasMovedLastHoweverOftenAndSoon) {
    const auto in = sine(4000);
    for (const std::vector<int>& moves :
         std::vector<std::vector<int>>{{400}, {400, 0}, {400, 250}, {100, 400, 30}, {300, 123, 300}})
        for (const bool isSilent : {false, true}) { // while it moves
            ChannelDelay<500> delay;
            delay.prepare(200, 123);
            const auto play = [&](int frames) {
                std::vector<float> part(static_cast<std::size_t>(frames), isSilent ? 0.0f : 1.0f);
                delay.process(part.data(), frames, isSilent);
            };
            for (const int frames : moves) delay.moveTo(frames), play(50); // a quarter of a fade
            play(1000);
            auto out = in;
            delay.process(out.data(), 4000, false);
            const auto last = static_cast<std::size_t>(moves.back());
            for (std::size_t n = last; n < out.size(); ++n)
                ASSERT_EQ(out[n], in[n - last]) << moves.size() << " moves, the last to " << last;
        }
}

TEST(ChannelDelay, TellsWhenNothingIsOnItsWay) {
    std::vector<float> io(100, 0.0f);
    ChannelDelay<500> delay;
    delay.prepare(10, 250);
    EXPECT_TRUE(delay.process(io.data(), 100, true));
    io[0] = 1.0f;
    EXPECT_FALSE(delay.process(io.data(), 100, false));
    int heard = 0;
    for (int block = 0; block < 10; ++block) {
        std::fill(io.begin(), io.end(), 0.0f);
        const bool isSilent = delay.process(io.data(), 100, true);
        for (const float x : io) heard += x != 0.0f ? 1 : 0;
        EXPECT_EQ(isSilent, block >= 5) << block;
    }
    EXPECT_EQ(heard, 1);
}

TEST(ActuatorStage, KeepsEachSettingAtAnotherRate) {
    for (const bool hasBegun : {false, true}) // else nothing is a ramp yet
        for (const int newRate : {8000, 44100, 48000, 192000}) {
            const auto stage = std::make_unique<ActuatorStage>();
            ASSERT_TRUE(stage->prepare(rate, 3));
            float next = 1.0f; // each sample is its number
            const auto play = [&](int frames) {
                Block io(3, std::vector<float>(static_cast<std::size_t>(frames)));
                for (auto& channel : io) std::iota(channel.begin(), channel.end(), next);
                next += static_cast<float>(frames);
                stage->process(std::array{io[0].data(), io[1].data(), io[2].data()}.data(), frames, false);
                return io;
            };
            if (hasBegun) play(10);
            stage->setGain(0, -0.5f);
            stage->setLevel(0.5f);
            stage->setMuted(1, true);
            stage->setDelay(2, 0.02f);
            stage->setDelay(2, 0.01f); // waits until the one before is reached
            if (hasBegun) play(10);
            ASSERT_TRUE(stage->changeRate(newRate));
            const float first = next;
            const auto on = play(newRate / 20);
            const std::size_t delay = static_cast<std::size_t>(newRate) / 100;
            for (std::size_t n = 0; n < on[0].size(); ++n) {
                const float in = first + static_cast<float>(n);
                ASSERT_EQ(on[0][n], -0.25f * in) << newRate;
                ASSERT_EQ(on[1][n], 0.0f) << newRate;
                ASSERT_EQ(on[2][n], n < delay ? 0.0f : 0.5f * (in - static_cast<float>(delay))) << newRate;
            }
            stage->setDelay(2, 0.03f);
            const auto later = play(newRate / 10);
            EXPECT_EQ(later[2].back(), 0.5f * (next - 1.0f - 3.0f * static_cast<float>(delay))) << newRate;
        }
}

} // namespace physvib::linked_limiter_test
