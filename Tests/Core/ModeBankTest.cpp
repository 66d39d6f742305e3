// SPDX-License-Identifier: MIT
// ModeBank: merging, gates, retirement and stealing, held against sums of single sinusoids.
#include "Core/Modes/ModeBank.h"
#include "Core/Modes/ModeTiles.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include "Support/Sets.h"
#include <algorithm>
#include <complex>
#include <gtest/gtest.h>
#include <map>
#include <memory>

namespace physvib::mode_bank_test {

constexpr int rate = 48000;

struct Bank {
    std::unique_ptr<ModeBank> bank = std::make_unique<ModeBank>();
    std::int64_t frame = 0;
    explicit Bank(InstructionSet set) { bank->prepare(rate, 1, set); }

    bool strike(double f, double tau, double amplitude, double lead = 0, std::int64_t frames = 0) {
        const double gain = 1;
        return bank->strike({f, tau, amplitude, {frame, lead}, frames > 0 ? frame + frames : Strike::never},
                            &gain);
    }
    /// Renders one channel up to absolute frame `end`, as a renderer would: cut at tiles and gates.
    std::vector<float> renderTo(std::int64_t end) {
        std::vector<float> out(static_cast<std::size_t>(end - frame));
        for (std::size_t done = 0; frame < end;) {
            while (bank->nextGateFrame() <= frame) bank->closeNextGate();
            const std::int64_t tileEnd = frame - frame % limits::tileFrames + limits::tileFrames;
            const auto part = std::min({end, tileEnd, bank->nextGateFrame()}) - frame;
            float* at = out.data() + done;
            bank->render(&at, frame, static_cast<int>(part));
            done += static_cast<std::size_t>(part);
            frame += part;
        }
        return out;
    }
};

class OnEachModeBank : public test::OnEachSet {};
INSTANTIATE_TEST_SUITE_P(ModeBank, OnEachModeBank, test::eachSet(), test::setName);

double sinusoid(double f, double tau, double t) {
    return t < 0 ? 0 : std::sin(2 * std::numbers::pi * f * t) * std::exp(-tau * t);
}

TEST_P(OnEachModeBank, OneStrikeIsTheClosedFormOverItsWholeLife) {
    Bank bank{GetParam()};
    bank.renderTo(777);
    bank.strike(205.3, 2, 1, 0.37);
    const auto out = bank.renderTo(777 + 8 * rate);
    double worst = 0;
    for (std::size_t n = 0; n < out.size(); ++n)
        worst =
            std::max(worst, std::abs(out[n] - sinusoid(205.3, 2, (static_cast<double>(n) + 0.37) / rate)));
    EXPECT_LT(worst, GetParam() == InstructionSet::scalar ? 7e-8 : 3e-7)
        << "scalar: one rounding to float, no more";
}

TEST(ModeBank, TenThousandStrikesOfOneMaterialCostOneModeAndEqualTheirSum) {
    struct Hit {
        std::int64_t frame;
        double lead, amplitude;
    };
    test::Random random{5};
    std::vector<Hit> hits;
    std::int64_t end = 0;
    for (int i = 0; i < 10'000; ++i, end += random.below(9))
        hits.push_back({end, random.below(1000) / 1000.0, random.uniform(-0.1, 0.1)});
    std::vector<double> expected(static_cast<std::size_t>(end));
    for (const auto& h : hits)
        for (std::int64_t n = h.frame; n < end; ++n)
            expected[static_cast<std::size_t>(n)] +=
                h.amplitude * sinusoid(205, 12, (static_cast<double>(n - h.frame) + h.lead) / rate);
    for (const auto set : test::runnableSets()) {
        Bank bank{set};
        std::vector<float> out;
        const auto renderTo = [&](std::int64_t frame) {
            const auto part = bank.renderTo(frame);
            out.insert(out.end(), part.begin(), part.end());
        };
        for (const auto& h : hits) {
            renderTo(h.frame);
            bank.strike(205, 12, h.amplitude, h.lead);
            ASSERT_EQ(bank.bank->liveModes(), 1);
        }
        renderTo(end);
        EXPECT_EQ(bank.bank->stolenModes(), 0u);
        double worst = 0, peak = 1;
        for (std::size_t n = 0; n < out.size(); ++n) {
            worst = std::max(worst, std::abs(out[n] - expected[n]));
            peak = std::max(peak, std::abs(expected[n]));
        }
        EXPECT_LT(worst / peak, 1e-6) << nameOf(set);
    }
}

TEST_P(OnEachModeBank, GatesOfOneMaterialOverlapAndEndInExactSilence) {
    Bank bank{GetParam()};
    bank.strike(180, 3, 1, 0.5, 5000);
    const auto first = bank.renderTo(2000);
    bank.strike(180, 3, 0.5, 0.25, 1000);
    EXPECT_EQ(bank.bank->liveModes(), 1);
    const auto both = bank.renderTo(3000), one = bank.renderTo(5000);
    EXPECT_NEAR(both[500], sinusoid(180, 3, 2500.5 / rate) + 0.5 * sinusoid(180, 3, 500.25 / rate), 1e-6);
    EXPECT_NEAR(one[1000], sinusoid(180, 3, 4000.5 / rate), 1e-6);
    for (const float y : bank.renderTo(6000)) ASSERT_EQ(y, 0.0f);
    EXPECT_EQ(bank.bank->liveModes(), 0);
}

TEST_P(OnEachModeBank, GatedAndFreeStrikesOfOneMaterialDoNotDisturbEachOther) {
    Bank with{GetParam()}, without{GetParam()};
    for (Bank* bank : {&with, &without}) bank->strike(205, 20, 1);
    with.strike(205, 20, 1, 0, 480);
    with.renderTo(480);
    without.renderTo(480);
    EXPECT_EQ(with.renderTo(rate), without.renderTo(rate));
}

TEST_P(OnEachModeBank, AGateMayCloseLongAfterItsStrikeHasDied) {
    Bank bank{GetParam()};
    bank.strike(100, 1500, 1, 0, rate); // dead after 10 ms, in a mode that the next ones keep alive
    for (int i = 0; i < 150; ++i) {
        bank.strike(100, 1500, 1, 0, 500);
        for (const float y : bank.renderTo(bank.frame + 400)) ASSERT_LE(std::abs(y), 2.1f);
        ASSERT_EQ(bank.bank->liveModes(), 1);
    }
    for (const float y : bank.renderTo(bank.frame + rate)) ASSERT_LE(std::abs(y), 1e-3f);
}

TEST_P(OnEachModeBank, RetiresAModeWhenItHasFallenBy140dBAndNotBefore) {
    Bank bank{GetParam()};
    bank.strike(205, 50, 1);
    const double lifeSeconds = 140 / 20.0 * std::log(10.0) / 50;
    bank.renderTo(static_cast<std::int64_t>(lifeSeconds * rate) - 64);
    EXPECT_EQ(bank.bank->liveModes(), 1);
    bank.renderTo(static_cast<std::int64_t>(lifeSeconds * rate) + 130);
    EXPECT_EQ(bank.bank->liveModes(), 0);
}

TEST_P(OnEachModeBank, SoundsOnAtAnotherRate) {
    Bank bank{GetParam()};
    bank.renderTo(100);
    bank.strike(205, 3, 1, 0.25);
    bank.strike(90, 0, 0.5, 0, rate / 2); // half a second
    bank.renderTo(100 + rate / 4 + 13);
    bank.bank->moveTo(bank.frame, 96000, 7777);
    bank.frame = 7777;
    const auto on = bank.renderTo(7777 + 96000);
    double worst = 0;
    for (std::size_t n = 0; n < on.size(); ++n) {
        const double t = 0.25 + 13.0 / rate + static_cast<double>(n) / 96000; // since the strikes
        const double gated = n + 26 < 24000 ? 0.5 * sinusoid(90, 0, t) : 0;
        worst = std::max(worst, std::abs(on[n] - sinusoid(205, 3, t + 0.25 / rate) - gated));
    }
    EXPECT_LT(worst, 1e-6);
}

TEST_P(OnEachModeBank, OfGatesThatOverlapOneClosesWithoutTheOtherAtAnotherRate) {
    for (const int newRate : {5000, 44100, 96000, 192000}) {
        Bank bank{GetParam()};
        bank.renderTo(100);
        bank.strike(180, 3, 1, 0.25, rate / 4);
        bank.renderTo(1301);
        bank.strike(180, 3, 0.5, 0.75, rate / 2);
        bank.renderTo(2000);
        bank.bank->moveTo(bank.frame, newRate, 7777);
        bank.frame = 7777;
        const auto on = bank.renderTo(7777 + newRate);
        const double step = 1.0 * rate / newRate; // a gate may close a frame earlier
        for (std::size_t n = 0; n < on.size(); ++n) {
            const double frame = 2000 + static_cast<double>(n) * step;
            if (std::abs(frame - 12100) <= step || std::abs(frame - 25301) <= step) continue;
            const double first = frame < 12100 ? sinusoid(180, 3, (frame - 99.75) / rate) : 0.0,
                         second = frame < 25301 ? 0.5 * sinusoid(180, 3, (frame - 1300.25) / rate) : 0.0;
            ASSERT_NEAR(on[n], first + second, 2e-6) << newRate << " Hz, frame " << n;
        }
    }
}

TEST_P(OnEachModeBank, AFullBankFadesTheQuietestModeWithoutAClick) {
    Bank bank{GetParam()};
    const int modes = limits::maxModes;
    for (int i = 0; i < modes; ++i) bank.strike(100 + 0.01 * i, 0.5, i == 7 ? 1e-3 : 1e-2);
    bank.renderTo(4833); // inside a tile
    EXPECT_EQ(bank.bank->stolenModes(), 0u);
    bank.strike(333, 0.5, 1e-2);
    EXPECT_EQ(bank.bank->stolenModes(), 1u);
    EXPECT_EQ(bank.bank->liveModes(), modes + 1);
    std::vector<double> expected(2000);
    for (std::size_t n = 0; n < expected.size(); ++n)
        for (int i = 0; i < modes; ++i) {
            const double t = (4833.0 + static_cast<double>(n)) / rate;
            const double kept =
                i == 7 ? 1e-3 * std::exp(-limits::stealFadePerSecond * static_cast<double>(n) / rate) : 1e-2;
            expected[n] += kept * sinusoid(100 + 0.01 * i, 0.5, t);
        }
    for (std::size_t n = 0; n < expected.size(); ++n)
        expected[n] += 1e-2 * sinusoid(333, 0.5, static_cast<double>(n) / rate);
    const auto out = bank.renderTo(6833);
    for (std::size_t n = 0; n < expected.size(); ++n) ASSERT_NEAR(out[n], expected[n], 4e-6) << n;
    EXPECT_EQ(bank.bank->liveModes(), modes);
}

TEST_P(OnEachModeBank, WhatFadesIsNobodysToMergeWith) {
    Bank bank{GetParam()};
    for (int i = 0; i <= limits::maxModes; ++i) bank.strike(100 + 0.01 * i, 0.5, i == 7 ? 1e-3 : 1e-2);
    EXPECT_EQ(bank.bank->stolenModes(), 1u);
    bank.strike(100.07, 0.5 + limits::stealFadePerSecond, 1e-2);
    EXPECT_EQ(bank.bank->stolenModes(), 2u);
}

TEST_P(OnEachModeBank, ManyMoreModesThanRoomStayBounded) {
    Bank bank{GetParam()};
    for (int i = 0; i < 3 * limits::maxModes; ++i) {
        ASSERT_TRUE(bank.strike(20 + 0.05 * i, 0.5, 1e-3));
        ASSERT_LE(bank.bank->liveModes(), ModeBank::slotCount);
    }
    for (const float y : bank.renderTo(100)) ASSERT_TRUE(std::isfinite(y));
}

TEST_P(OnEachModeBank, TooManyOpenGatesAreRefusedAndChangeNothing) {
    Bank bank{GetParam()}, twin{GetParam()};
    for (int i = 0; i < limits::maxGates; ++i) {
        ASSERT_TRUE(bank.strike(205, 0, 1e-3, 0, 1000));
        ASSERT_TRUE(twin.strike(205, 0, 1e-3, 0, 1000));
    }
    EXPECT_FALSE(bank.strike(300, 0, 1, 0, 1000));
    EXPECT_EQ(bank.renderTo(2000), twin.renderTo(2000));
}

TEST_P(OnEachModeBank, AGateBetweenTwoFramesLeavesNoSample) {
    Bank bank{GetParam()};
    const double gain = 1;
    EXPECT_TRUE(bank.bank->strike({205, 0, 1, {0, 0.5}, 0}, &gain));
    EXPECT_EQ(bank.bank->liveModes(), 0);
}

// The vector kernels against the scalar oracle and each other; the low-rank rows and their index.

using test::Channels;

/// Free, gated and merged strikes, more modes than the bank holds at once if `crowded`.
Channels rendered(InstructionSet set, int channels, int rate, bool crowded = false) {
    auto events = test::randomEvents(crowded ? 9000 : 600, 0.5, 21);
    for (auto& e : events) e.amplitude *= crowded ? 0.01 : 0.2;
    for (auto& e : events) e.decayPerSecond *= crowded ? 0.1 : 1;
    const auto layout = test::gridLayout(channels, 1);
    const RendererSettings settings{.sampleRateHz = rate,
                                    .channels = channels,
                                    .panner = {layout, PanningLaw::energy, 1, 1, 1},
                                    .limiterEnabled = false,
                                    .instructions = set};
    return test::renderEvents(events, settings, rate * 3 / 4).channels;
}

double difference(const Channels& a, const Channels& b) {
    test::Signal expected;
    for (const auto& channel : a) expected.emplace_back(channel.begin(), channel.end());
    return test::relativeError(expected, b);
}

// 20 to 1000 Hz at the three rates: from nearly constant in a tile to 13 turns, so every rank.
TEST(ModeTiles, EverySetAgreesWithTheScalarKernelForAnyChannelsAtEveryRankAndWhenModesAreStolen) {
    struct Case {
        int channels, rate;
        bool isCrowded = false;
    };
    std::vector<Case> cases{{4, 5000}, {4, 12000}, {4, 96000}, {2, 8000, true}};
    for (const int channels : {1, 2, 3, 5, 7, 8, 13, 17, 64}) cases.push_back({channels, 16000});
    for (const auto& [channels, rate, isCrowded] : cases) {
        const auto oracle = rendered(InstructionSet::scalar, channels, rate, isCrowded);
        for (const auto set : test::runnableSets())
            EXPECT_LT(difference(oracle, rendered(set, channels, rate, isCrowded)), 1e-6)
                << nameOf(set) << ' ' << channels << ' ' << rate;
    }
}

TEST(ModeTiles, TheVectorSetsAgreeToTheBit) {
    std::vector<InstructionSet> sets;
    for (const auto set : test::runnableSets())
        if (set != InstructionSet::scalar) sets.push_back(set);
    if (sets.size() < 2) GTEST_SKIP() << "only " << sets.size() << " of them here";
    for (const int channels : {1, 3, 4, 8, 13, 17})
        for (std::size_t i = 1; i < sets.size(); ++i)
            EXPECT_TRUE(rendered(sets[0], channels, 12000) == rendered(sets[i], channels, 12000))
                << nameOf(sets[i]) << ' ' << channels;
}

TEST(ModeTiles, ASetThatIsNotThereMeansTheScalarKernel) {
    const auto bank = std::make_unique<ModeBank>();
    bank->prepare(48000, 1, InstructionSet::scalar);
    EXPECT_EQ(bank->instructionSet(), InstructionSet::scalar);
    for (const auto set :
         {InstructionSet::sse4, InstructionSet::avx2, InstructionSet::avx512, InstructionSet::neon}) {
        bank->prepare(48000, 1, set);
        EXPECT_EQ(bank->instructionSet(), isAvailable(set) ? set : InstructionSet::scalar);
    }
}

TEST(ModeTiles, AStrikeInTheTileOfAClosingGateKeepsItsBits) {
    const auto with = std::make_unique<ModeBank>(), without = std::make_unique<ModeBank>();
    const double gain = 0.7;
    std::array<float, 64> a{}, b{};
    float *atA = a.data(), *atB = b.data();
    for (auto* bank : {with.get(), without.get()}) {
        bank->prepare(48000, 1);
        bank->strike({205, 20, 1, {10, 0.25}, Strike::never}, &gain);
    }
    with->strike({90, 1, 1, {12, 0.5}, 30}, &gain);
    with->render(&atA, 0, 30);
    without->render(&atB, 0, 30);
    EXPECT_NE(a, b);
    with->closeNextGate();
    with->render(&atA, 30, 34);
    without->render(&atB, 30, 34);
    EXPECT_TRUE(std::equal(a.begin(), a.begin() + 34, b.begin()));
}

// What it is turned by and what its mode is turned by are each other's opposites, rounded alike: unless the
// product is rounded once.
TEST(ModeTiles, AStrikeOnATilesFirstFrameBeginsAtExactlyZero) {
    for (const auto set : test::runnableSets()) {
        if (set == InstructionSet::scalar) continue; // rounds its amplitudes first
        const auto bank = std::make_unique<ModeBank>();
        std::array<float, 64> tile{};
        float* at = tile.data();
        const double gain = 0.7;
        for (int k = 0; k < 1000; ++k) {
            bank->prepare(48000, 1, set, 4, 4); // nothing else sounds
            bank->strike({40.0 + 0.7 * k, 200, 1, {64 * k, 0}, Strike::never}, &gain);
            bank->render(&at, 64 * k, 64);
            ASSERT_EQ(tile[0], 0.0f) << nameOf(set) << ' ' << k;
            ASSERT_GT(tile[1], 0.0f);
        }
    }
}

/// A tile of a bank that is struck so often, by more modes than it has room for, so that some are stolen;
/// `apart`: none waits for another.
Channels struck(InstructionSet set, int channels, bool apart) {
    const auto bank = std::make_unique<ModeBank>();
    bank->prepare(48000, channels, set, 5, 64);
    Channels out(static_cast<std::size_t>(channels), std::vector<float>(128));
    std::vector<float*> at;
    for (auto& channel : out) at.push_back(channel.data());
    test::Random random{5};
    std::vector<double> gains(static_cast<std::size_t>(channels));
    for (int i = 0; i < 39; ++i) {
        for (auto& g : gains) g = random.uniform(-1, 1);
        const bool isGated = i % 7 == 6;
        bank->strike({60.0 + 10 * random.below(9),
                      30,
                      0.1,
                      {64 + i * 3 / 2, random.uniform(0, 1)},
                      isGated ? 1000 : Strike::never},
                     gains.data());
        if (apart) bank->render(at.data(), 64, 0);
    }
    bank->render(at.data(), 64, 64);
    for (auto& channel : at) channel += 64;
    bank->render(at.data(), 128, 64);
    return out;
}

TEST(ModeTiles, StrikesThatWaitForOthersAreStrikesOneByOneToTheBit) {
    for (const auto set : test::runnableSets())
        for (const int channels : {1, 2, 3, 4, 5, 8, 11, 16})
            EXPECT_TRUE(struck(set, channels, false) == struck(set, channels, true))
                << nameOf(set) << ' ' << channels;
}

TEST(LowRankBasis, RowsOfTheChosenRankGiveTheModeBack) {
    const LowRankBasis basis;
    for (double radians = 1e-4; radians < 3.1; radians *= 1.07)
        for (int tilt = 0; tilt <= 8; ++tilt) { // from pure turning to pure decay
            const double angle = std::numbers::pi / 2 * tilt / 8;
            std::array<double, 64> cosPowers{}, sinPowers{};
            for (std::size_t t = 0; t < 64; ++t) {
                const auto p =
                    std::exp(std::complex<double>{-radians * std::sin(angle), radians * std::cos(angle)} *
                             static_cast<double>(t));
                cosPowers[t] = p.real();
                sinPowers[t] = p.imag();
            }
            const int rank = LowRankBasis::rankFor(radians);
            std::array<float, 128> row{};
            basis.project(cosPowers.data(), sinPowers.data(), rank, row.data());
            for (std::size_t t = 0; t < 64; ++t) {
                double sine = row[2 * t], cosine = row[2 * t + 1]; // rank 64: as they are
                if (rank < 64) sine = cosine = 0;
                for (std::size_t k = 0; rank < 64 && k < static_cast<std::size_t>(rank); ++k) {
                    const double u =
                        basis.halves()[k * 32 + (t < 32 ? t : 63 - t)] * (t >= 32 && k % 2 == 1 ? -1 : 1);
                    sine += u * row[2 * k];
                    cosine += u * row[2 * k + 1];
                }
                ASSERT_NEAR(sine, sinPowers[t], 2e-7)
                    << "rank " << rank << ", " << radians << " radians a frame";
                ASSERT_NEAR(cosine, cosPowers[t], 2e-7)
                    << "rank " << rank << ", " << radians << " radians a frame";
            }
        }
}

TEST(ModeIndex, FindsWhatIsThereWhateverCameAndWent) {
    ModeIndex<100> index;
    ASSERT_TRUE(index.resize(100));
    std::map<int, std::uint64_t> hashes; // by slot
    test::Random random{3};
    for (int i = 0; i < 100'000; ++i) {
        const int slot = random.below(100);
        if (hashes.count(slot) > 0) {
            index.erase(hashes[slot], slot);
            hashes.erase(slot);
        } else { // few homes: long chains, also around the end
            hashes[slot] = static_cast<std::uint64_t>(random.below(7) * 0x26ff'0000'0000LL) << 16 |
                           static_cast<std::uint64_t>(slot);
            index.insert(hashes[slot], slot);
        }
        const int wanted = random.below(100);
        const auto isMeant = [&](int s) { return s == wanted; };
        const auto found = hashes.find(wanted);
        ASSERT_EQ(index.find(found == hashes.end() ? 0 : found->second, isMeant),
                  found == hashes.end() ? -1 : wanted)
            << i;
    }
}

} // namespace physvib::mode_bank_test
