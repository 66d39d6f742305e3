// SPDX-License-Identifier: MIT
// Exact values, and the estimates on simulated data whose truth is known.
#include "Lab/Study/Identification.h"
#include "Lab/Thesis/ThesisPage.h"
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib::information_transfer_test {

std::vector<IdentificationTrial> identity(int stimuli, int each) {
    std::vector<IdentificationTrial> trials;
    for (int i = 0; i < stimuli * each; ++i)
        trials.push_back({std::to_string(i % stimuli), std::to_string(i % stimuli)});
    return trials;
}

TEST(InformationTransfer, OfPerfectAnswersIsLog2OfTheirNumber) {
    for (const auto& [count, bits] : {std::pair{28, 4.81}, {78, 6.29}, {168, 7.39}})
        for (const int each : {1, 3}) {
            const auto it = informationTransfer(ConfusionMatrix{identity(count, each)});
            EXPECT_NEAR(it.bits, std::log2(count), 1e-12);
            EXPECT_NEAR(it.bits, bits, 0.005);
            EXPECT_EQ(it.biasBits, 0.0) << "nothing varies";
            EXPECT_NEAR(it.minBits, it.bits, 1e-12) << "Fano's bound is tight";
        }
}

TEST(InformationTransfer, OfIndependentAnswersIsZero) {
    std::vector<IdentificationTrial> trials;
    for (int s = 0; s < 9; ++s)
        for (int r = 0; r < 9; ++r) trials.push_back({std::to_string(s), std::to_string(r)});
    const auto it = informationTransfer(ConfusionMatrix{trials});
    EXPECT_NEAR(it.bits, 0.0, 1e-12);
    EXPECT_EQ(it.minBits, 0.0);
    EXPECT_EQ(it.correctedBits(), 0.0);
}

TEST(InformationTransfer, OfNothingOrOneStimulusIsZeroAndNoNumberIsMissing) {
    for (const auto& trials :
         {std::vector<IdentificationTrial>{}, {{"a", "a"}}, {{"a", "b"}}, {{"a", "b"}, {"a", "c"}}}) {
        const auto it = informationTransfer(ConfusionMatrix{trials});
        EXPECT_EQ(it.bits, 0.0);
        EXPECT_TRUE(std::isfinite(it.biasBits) && std::isfinite(it.minBits) && std::isfinite(it.maxBits) &&
                    std::isfinite(it.trialsPerCell));
    }
}

TEST(InformationTransfer, FanosBoundShowsThatAPrintedValueIsImpossible) {
    // RING 5 x 5 with tolerance: 2.62 is printed (erratum 13)
    EXPECT_NEAR(fanoBits(std::log2(25.0), 0.835, 25), 3.24, 0.005);
}

TEST(InformationTransfer, FanosBoundHoldsWhereResponsesAreNoStimulus) {
    std::vector<IdentificationTrial> trials; // after "none" either may have been felt
    for (const char* stimulus : {"a", "b"})
        for (int i = 0; i < 20; ++i) trials.push_back({stimulus, i < 3 ? stimulus : "none"});
    const auto it = informationTransfer(ConfusionMatrix{trials});
    EXPECT_NEAR(it.bits, 0.15, 1e-12);
    EXPECT_LE(it.minBits, it.bits);
    for (int i = 0; i < 400; ++i) trials.push_back({"a", "a"}), trials.push_back({"b", "b"});
    const auto most = informationTransfer(ConfusionMatrix{trials});
    EXPECT_LE(most.minBits, most.bits);
    EXPECT_GT(most.minBits, 0.7) << "a bound that says something";
}

/// A channel with a known transition matrix: on a line of `size` places, a normal blur of `blur` places.
struct Channel {
    Channel(int size, double blur)
        : shares(static_cast<std::size_t>(size), std::vector<double>(static_cast<std::size_t>(size))) {
        const auto below = [blur](double x) { return 0.5 * std::erfc(-x / blur / std::numbers::sqrt2); };
        for (int i = 0; i < size; ++i)
            for (int j = 0; j < size; ++j)
                shares[std::size_t(i)][std::size_t(j)] =
                    (j == size - 1 ? 1.0 : below(j - i + 0.5)) - (j == 0 ? 0.0 : below(j - i - 0.5));
    }
    double trueBits() const {
        const auto n = static_cast<double>(shares.size());
        double bits = 0.0;
        for (std::size_t j = 0; j < shares.size(); ++j) {
            double column = 0.0;
            for (const auto& row : shares) column += row[j] / n;
            for (const auto& row : shares)
                if (row[j] > 0.0) bits += row[j] / n * std::log2(row[j] / column);
        }
        return bits;
    }
    ConfusionMatrix sample(SeededRandom& random, std::size_t each) const {
        std::vector<IdentificationTrial> trials;
        for (std::size_t i = 0; i < shares.size(); ++i)
            for (std::size_t k = 0; k < each; ++k) {
                std::size_t j = 0;
                for (double left = random.uniform(); j + 1 < shares.size() && left >= shares[i][j]; ++j)
                    left -= shares[i][j];
                trials.push_back({std::to_string(i), std::to_string(j)});
            }
        return ConfusionMatrix{trials};
    }
    std::vector<std::vector<double>> shares;
};

struct Errors {
    double plain = 0.0, miller = 0.0, corrected = 0.0, bound = 0.0;
    int boundTooHigh = 0;
};

/// Mean errors in bits over `runs` samples of so many trials per cell.
Errors meanErrors(const Channel& channel, double perCell, int runs) {
    SeededRandom random{1, "estimates"};
    Errors e;
    const auto size = static_cast<double>(channel.shares.size()), truth = channel.trueBits();
    const auto each = static_cast<std::size_t>(std::lround(perCell * size));
    for (int run = 0; run < runs; ++run) {
        const auto it = informationTransfer(channel.sample(random, each));
        const double miller =
            (size - 1.0) * (size - 1.0) / (2.0 * size * static_cast<double>(each) * std::numbers::ln2);
        e.plain += (it.bits - truth) / runs;
        e.miller += (it.bits - miller - truth) / runs;
        e.corrected += (it.correctedBits() - truth) / runs;
        e.bound += (it.minBits - truth) / runs;
        if (it.minBits > truth) ++e.boundTooHigh;
    }
    return e;
}

TEST(InformationTransfer, EstimatesOnSimulatedDataOfKnownTruth) {
    std::printf("blur  truth  trials/cell   plain  Miller  corrected  Fano's bound (too high in)\n");
    for (const double blur : {0.3, 0.6, 1.2, 2.5}) {
        const Channel channel{16, blur};
        for (const double perCell : {0.2, 0.5, 1.0, 2.0, 5.0, 10.0}) {
            constexpr int runs = 60;
            const Errors e = meanErrors(channel, perCell, runs);
            std::printf("%4.1f  %5.2f  %11.1f  %+6.3f  %+6.3f  %+9.3f  %+6.3f (%d of %d)\n", blur,
                        channel.trueBits(), perCell, e.plain, e.miller, e.corrected, e.bound, e.boundTooHigh,
                        runs);
            EXPECT_GE(e.plain, -0.005) << "biased upward, or not at all";
            EXPECT_LE(std::abs(e.corrected), std::max(std::abs(e.miller), std::abs(e.plain)) + 0.002);
            if (perCell >= trialsPerCellForCorrection) {
                EXPECT_LE(std::abs(e.corrected), 0.025);
                EXPECT_LE(std::abs(e.corrected), e.plain + 0.002);
                EXPECT_EQ(e.boundTooHigh, 0);
            }
        }
    }
}

TEST(InformationTransfer, ParticipantsTransferForThemselves) {
    std::vector<IdentificationTrial> trials;
    for (const char* stimulus : {"a", "b", "c", "d"})
        trials.push_back({stimulus, stimulus, "P1"}), trials.push_back({stimulus, "a", "P2"});
    const auto transfers = transferByParticipant(trials);
    ASSERT_EQ(transfers.size(), 2u);
    EXPECT_EQ(transfers[1].participant, "P2");
    EXPECT_NEAR(transfers[0].transfer.bits, 2.0, 1e-12);
    EXPECT_NEAR(transfers[1].transfer.bits, 0.0, 1e-12);
    EXPECT_EQ(transfers[1].matrix.correct(), 1u);
    EXPECT_LT(informationTransfer(ConfusionMatrix{trials}).bits, 1.0)
        << "pooled, one participant's guesses take from the other";
}

// Labels, counts and tolerance.

TEST(ConfusionMatrix, CountsEveryPairOnce) {
    const ConfusionMatrix matrix{{{"b", "b"}, {"a", "b"}, {"a", "a"}, {"a", "b"}}};
    ASSERT_EQ(matrix.stimuli(), 2u);
    EXPECT_EQ(matrix.label(0), "a");
    EXPECT_EQ(matrix.count(0, 0), 1u);
    EXPECT_EQ(matrix.count(0, 1), 2u);
    EXPECT_EQ(matrix.count(1, 1), 1u);
    EXPECT_EQ(matrix.correct(), 2u);
    EXPECT_EQ(matrix.trials(), 4u);
    EXPECT_EQ(matrix.stimulusTotals(), (std::vector<std::uint64_t>{3, 1}));
    EXPECT_EQ(matrix.responseTotals(), (std::vector<std::uint64_t>{1, 3}));
}

TEST(ConfusionMatrix, ResponsesThatAreNoStimulusStandLastAndAreWrong) {
    const ConfusionMatrix matrix{{{"b", "a"}, {"b", "b"}}};
    ASSERT_EQ(matrix.stimuli(), 1u);
    ASSERT_EQ(matrix.responses(), 2u);
    EXPECT_EQ(matrix.label(1), "a");
    EXPECT_EQ(matrix.correct(), 1u);
}

TEST(ConfusionMatrix, GridLabelsAreOrderedByNumber) {
    const ConfusionMatrix matrix{{{"10,1", "10,1"}, {"2,10", "2,10"}, {"2,9", "2,9"}}};
    EXPECT_EQ(matrix.label(0), "2,9");
    EXPECT_EQ(matrix.label(1), "2,10");
    EXPECT_EQ(matrix.label(2), "10,1");
}

TEST(ConfusionMatrix, GridLabelsAreTwoNumbersFromOne) {
    EXPECT_EQ(parseGridCell("2,5"), (GridCell{2, 5}));
    EXPECT_EQ(parseGridCell(" 2 , 5 "), (GridCell{2, 5}));
    for (const char* bad : {"", ",", "2", "2,", ",5", "0,1", "-1,2", "1,2,3", "a,b", "99999999999,1"})
        EXPECT_FALSE(parseGridCell(bad)) << bad;
}

TEST(ConfusionMatrix, ToleranceCountsNeighboursAsTheStimulus) {
    const auto trials = tolerate({{"2,2", "2,3"}, {"2,2", "3,3"}, {"2,2", "2,2"}, {"2,2", "x"}}, 1);
    EXPECT_EQ(trials[0].response, "2,2");
    EXPECT_EQ(trials[1].response, "3,3");
    EXPECT_EQ(trials[2].response, "2,2");
    EXPECT_EQ(trials[3].response, "x");
}

// The published percent counts give the published resolutions (thesis Fig. 4.9); merging against brute force.

PercentCounts printed(const thesis::Counts& one) {
    return {std::string{one.condition},
            thesis::printedRows,
            thesis::printedColumns,
            {one.percent.begin(), one.percent.end()}};
}

const PercentCounts phoneLinear = printed(thesis::counts[0]);

TEST(PercentCounts, PublishedTablesGiveThePublishedResolutionsAndDeviations) {
    for (const thesis::Counts& one : thesis::counts) {
        const PercentCounts counts = printed(one);
        const auto found = perceptualResolution(counts);
        EXPECT_TRUE(found.columns == one.columns && found.rows == one.rows) << one.condition;
        EXPECT_NEAR(counts.sum(), 100.0, 35 * 0.005);
        EXPECT_NEAR(counts.standardDeviation(), one.deviation, 0.005);
    }
    EXPECT_EQ(perceptualResolution(phoneLinear).ties.size(), 1u);
    EXPECT_EQ(perceptualResolution(printed(thesis::counts[3])).ties.size(), 2u)
        << "row 2 may join row 1 or row 3";
}

TEST(PercentCounts, TheThresholdIsInclusive) {
    EXPECT_EQ(perceptualResolution(phoneLinear, 1.4286).rows, 3u)
        << "the exact half of a uniform cell: 7 x 3";
    const PercentCounts sums{"sums", 1, 2, {0.71 + 0.71, 98.58}}; // in binary a little off 1.42
    EXPECT_EQ(perceptualResolution(sums).columns, 2u);
    const PercentCounts exact{"exact", 1, 2, {1.42, 98.58}}, below{"below", 1, 2, {1.41, 98.59}};
    EXPECT_EQ(perceptualResolution(exact).columns, 2u);
    EXPECT_EQ(perceptualResolution(below).columns, 1u);
}

TEST(PercentCounts, MergedCellsAreSums) {
    const auto grid = mergedCounts(phoneLinear, perceptualResolution(phoneLinear).ties.front());
    EXPECT_NEAR(grid.at(0, 0), 6.05, 1e-9); // as printed in Fig. 4.9 (b)
    EXPECT_NEAR(grid.at(1, 0), 1.61, 1e-9);
    EXPECT_NEAR(grid.at(4, 4), 5.77, 1e-9); // printed 5.78, from figures that were not yet rounded
    EXPECT_NEAR(grid.sum(), phoneLinear.sum(), 1e-9);
}

TEST(PercentCounts, AFieldThatNeverReachesTheThresholdHasNoResolution) {
    const PercentCounts empty{"none", 2, 2, {0.1, 0.1, 0.1, 0.1}};
    EXPECT_EQ(perceptualResolution(empty).columns, 0u);
    EXPECT_TRUE(perceptualResolution(empty).ties.empty());
    EXPECT_TRUE(perceptualResolution({}).ties.empty());
}

/// Every pair of divisions, one by one.
std::pair<std::size_t, std::size_t> bruteForce(const PercentCounts& counts, double least) {
    std::size_t best = 0, ties = 0;
    const auto groups = [](std::size_t lines, unsigned ends) {
        std::vector<std::size_t> sizes{1};
        for (std::size_t i = 0; i + 1 < lines; ++i) ends >> i & 1 ? sizes.push_back(1) : void(++sizes.back());
        return sizes;
    };
    for (unsigned r = 0; r < 1u << (counts.rows - 1); ++r)
        for (unsigned c = 0; c < 1u << (counts.columns - 1); ++c) {
            const GridMerge merge{groups(counts.columns, c), groups(counts.rows, r)};
            const std::size_t cells = merge.columnGroups.size() * merge.rowGroups.size();
            const auto grid = mergedCounts(counts, merge);
            if (std::ranges::any_of(grid.percent, [=](double p) { return p < least - 1e-9; }) || cells < best)
                continue;
            ties = cells > best ? 1 : ties + 1;
            best = cells;
        }
    return {best, ties};
}

TEST(PercentCounts, MergingFindsWhatBruteForceFinds) {
    SeededRandom random{7};
    for (int i = 0; i < 200; ++i) {
        PercentCounts counts{"random", 1 + random.below(5), 1 + random.below(6), {}};
        for (std::size_t k = 0; k < counts.rows * counts.columns; ++k)
            counts.percent.push_back(static_cast<double>(random.below(6)));
        const double threshold = 0.5 + static_cast<double>(random.below(12));
        const auto found = perceptualResolution(counts, threshold);
        const auto [cells, ties] = bruteForce(counts, threshold);
        EXPECT_EQ(found.columns * found.rows, cells);
        EXPECT_EQ(found.ties.size(), ties);
    }
}

} // namespace physvib::information_transfer_test
