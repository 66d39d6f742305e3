// SPDX-License-Identifier: MIT
// The vector kernels against the scalar oracle and each other; the low-rank rows and their index.
#include "Core/Modes/ModeTiles.h"
#include "Core/Modes/ModeBank.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include "Support/Sets.h"
#include <complex>
#include <gtest/gtest.h>
#include <map>

namespace physvib {
namespace {

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
    double worst = 0, peak = 1;
    for (std::size_t j = 0; j < a.size(); ++j)
        for (std::size_t n = 0; n < a[j].size(); ++n) {
            worst = std::max(worst, double{std::abs(a[j][n] - b[j][n])});
            peak = std::max(peak, double{std::abs(a[j][n])});
        }
    return worst / peak;
}

TEST(ModeTiles, EverySetAgreesWithTheScalarKernelForAnyNumberOfChannels) {
    for (const int channels : {1, 2, 3, 5, 7, 8, 13, 17, 64}) {
        const auto oracle = rendered(InstructionSet::scalar, channels, 16000);
        for (const auto set : test::runnableSets())
            EXPECT_LT(difference(oracle, rendered(set, channels, 16000)), 1e-6)
                << nameOf(set) << ' ' << channels;
    }
}

TEST(ModeTiles, EverySetAgreesWithTheScalarKernelAtEveryRank) {
    for (const int rate : {5000, 12000, 96000}) { // 20 to 1000 Hz: from nearly constant in a tile to 13 turns
        const auto oracle = rendered(InstructionSet::scalar, 4, rate);
        for (const auto set : test::runnableSets())
            EXPECT_LT(difference(oracle, rendered(set, 4, rate)), 1e-6) << nameOf(set) << ' ' << rate;
    }
}

TEST(ModeTiles, EverySetAgreesWithTheScalarKernelWhenModesAreStolen) {
    const auto oracle = rendered(InstructionSet::scalar, 2, 8000, true);
    for (const auto set : test::runnableSets())
        EXPECT_LT(difference(oracle, rendered(set, 2, 8000, true)), 1e-6) << nameOf(set);
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

} // namespace
} // namespace physvib
