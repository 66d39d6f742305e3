// SPDX-License-Identifier: MIT
// Compensated drives within their limit, and where the phantom's centroid lands on a 7 x 5 grid with and
// without them.
#include "Lab/Study/Coupling.h"
#include "Core/PhantomPanner.h"
#include "Io/Disk/AtomicFile.h"
#include "Support/FileTesting.h"
#include "Support/Has.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace physvib::coupling_test {

struct Centroid {
    double x = 0.0, y = 0.0;
};

ActuatorLayout unitSquare() { return {1, 1, 4, {{{0, 1}, {1, 1}, {0, 0}, {1, 0}}}}; }

Centroid centroidOf(const ComplexAmplitudes& felt) {
    Centroid c;
    double sum = 0.0;
    for (std::size_t j = 0; j < felt.size(); ++j) {
        const double weight = std::abs(felt[j]);
        c.x += weight * unitSquare().places[j].xMetres;
        c.y += weight * unitSquare().places[j].yMetres;
        sum += weight;
    }
    return {c.x / sum, c.y / sum};
}

/// Neighbours couple with `share` and `degrees`, those across with half of it.
CouplingMatrix coupled(double share, double degrees) {
    CouplingMatrix c(4);
    const auto turn = std::polar(1.0, degrees * std::numbers::pi / 180.0);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            if (i != j) c.at(i, j) = turn * (i + j == 3 ? 0.5 * share : share);
    return c;
}

/// Mean distance, in percent of the square's side, between where the phantom is meant and where it lands.
double errorOf(const CouplingMatrix& truth, const CouplingMatrix& drives) {
    const PhantomPanner panner{unitSquare(), PanningLaw::linear, 1, 1, 1};
    double sum = 0.0;
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 7; ++column) {
            PhantomPanner::Gains gains{};
            panner.gainsAt(column / 6.0, row / 4.0, gains);
            const ComplexAmplitudes wanted(gains.begin(), gains.begin() + 4);
            const Centroid meant = centroidOf(wanted), lands = centroidOf(truth.times(drives.times(wanted)));
            sum += std::hypot(lands.x - meant.x, lands.y - meant.y);
        }
    return 100.0 * sum / 35.0;
}

TEST(Coupling, WithoutCouplingTheDriveIsWhatIsWanted) {
    const CouplingMatrix none(4), drives = compensationMatrix(none);
    for (std::size_t k = 0; k < drives.entries.size(); ++k)
        EXPECT_NEAR(std::abs(drives.entries[k] - none.entries[k]), 0.0, 1e-8);
    EXPECT_NEAR(maxDrive(none), 1.0, 1e-4);
}

TEST(Coupling, WithinTheLimitWhatIsFeltIsWhatIsWanted) {
    const CouplingMatrix coupling = coupled(0.2, 90.0);
    EXPECT_NEAR(relativeAmplitudeError(coupling, CouplingMatrix(4)), 0.3, 1e-12); // 0.2, 0.2 and 0.1 from the
                                                                                  // others
    EXPECT_LT(relativeAmplitudeError(coupling, compensationMatrix(coupling)), 1e-6);
}

TEST(Coupling, NoGainsOfAPannerDriveMoreThanThreeDecibelsMore) {
    SeededRandom random(1, "gains");
    for (const double share : {0.1, 0.3, 0.5, 0.66, 0.9})
        for (const double degrees : {0.0, 60.0, 120.0, 180.0}) {
            const CouplingMatrix drives = compensationMatrix(coupled(share, degrees));
            double most = 0.0;
            for (int draw = 0; draw < 200; ++draw) { // the strongest drive is at a corner: first
                ComplexAmplitudes wanted(4);
                for (std::size_t j = 0; j < 4; ++j)
                    wanted[j] = draw < 16 ? (draw >> j & 1) : random.uniform();
                for (const auto& d : drives.times(wanted)) most = std::max(most, std::abs(d));
            }
            EXPECT_LE(most, 1.41254) << share << ' ' << degrees;
            EXPECT_LE(most, maxDrive(drives)) << share << ' ' << degrees;
            EXPECT_GE(most, 0.999 * maxDrive(drives)) << share << ' ' << degrees;
        }
}

TEST(Coupling, TheStrongestDriveIsAnyEnchanters) {
    for (const std::size_t driven : {0u, 1u, 2u}) {
        CouplingMatrix drives(3);
        drives.at(driven, (driven + 1) % 3) = {0.0, -0.75};
        // its own and the other's, a quarter turn apart
        EXPECT_NEAR(maxDrive(drives), 1.25, 1e-4) << driven;
    }
}

TEST(Coupling, AKnownCouplingIsMadeUpForAndAMisjudgedOneInPart) {
    SeededRandom random(1, "mismatch");
    const CouplingMatrix plain(4);
    for (const double share : {0.1, 0.2, 0.4})
        for (const double degrees : {0.0, 90.0, 180.0}) {
            const CouplingMatrix believed = coupled(share, degrees), drives = compensationMatrix(believed);
            const double before = errorOf(believed, plain), matched = errorOf(believed, drives);
            double misjudged = 0.0, after = 0.0;
            constexpr int draws = 20;
            for (int i = 0; i < draws; ++i) {
                const CouplingMatrix truth = withRandomMismatch(believed, random);
                misjudged += errorOf(truth, plain) / draws;
                after += errorOf(truth, drives) / draws;
            }
            const std::string name = std::to_string(static_cast<int>(100 * share)) + "_" +
                                     std::to_string(static_cast<int>(degrees));
            if (share < 0.4 || degrees < 180.0) {
                const bool isWithinLimit = share < 0.2 || degrees < 180.0;
                EXPECT_LT(matched, (isWithinLimit ? 0.1 : 0.55) * before) << name;
                EXPECT_LT(after, 0.7 * misjudged) << name;
            } else {
                EXPECT_GT(matched, before)
                    << "four that cancel each other out: 3 dB are not enough, Docs/actuators.md says so";
            }
        }
}

TEST(Coupling, DrivesBetweenTwoFrequenciesAreBetweenTheirsAndBeyondThemTheNearest) {
    const MeasuredCoupling measured{{100.0, 300.0}, {coupled(0.1, 0.0), coupled(0.2, 90.0)}};
    const CouplingDrives drives(measured);
    const CouplingMatrix low = compensationMatrix(measured.matrices[0]),
                         high = compensationMatrix(measured.matrices[1]);
    const double gains[] = {1.0, 0.5, 0.25, 0.0};
    const auto expectAt = [&](double hz, double share) {
        double inPhase[4], ahead[4];
        drives.view().apply(hz, gains, inPhase, ahead);
        for (std::size_t i = 0; i < 4; ++i) {
            std::complex<double> sum;
            for (std::size_t j = 0; j < 4; ++j)
                sum += gains[j] * ((1.0 - share) * low.at(i, j) + share * high.at(i, j));
            EXPECT_NEAR(inPhase[i], sum.real(), 1e-12) << hz;
            EXPECT_NEAR(ahead[i], sum.imag(), 1e-12) << hz;
        }
    };
    expectAt(20.0, 0.0);
    expectAt(100.0, 0.0);
    expectAt(150.0, 0.25);
    expectAt(300.0, 1.0);
    expectAt(900.0, 1.0);
}

TEST(Coupling, TheResidualIsThatOfTheWorstFrequency) {
    const CouplingResidual r = couplingResidual({{100.0, 300.0}, {coupled(0.1, 0.0), coupled(0.2, 90.0)}});
    EXPECT_NEAR(r.uncompensated, 0.3, 1e-12);
    EXPECT_LT(r.compensated, 1e-6);
    EXPECT_GT(r.mismatchedUncompensated, r.mismatchedCompensated);
    EXPECT_GT(r.mismatchedCompensated, 0.1);
    EXPECT_LE(r.maxDrive, 1.41254);
}

TEST(Coupling, AttenuationIsEquation31And32) {
    const double isolated[] = {0.1, 0.2, 3.0}, reference[] = {1.0, 1.0, 2.0};
    const auto ratios = attenuationRatios(isolated, reference);
    ASSERT_EQ(ratios.size(), 3u);
    EXPECT_NEAR(ratios[0], 0.9, 1e-15);
    EXPECT_NEAR(ratios[1], 0.8, 1e-15);
    EXPECT_NEAR(ratios[2], -0.5, 1e-15);
    EXPECT_NEAR(combinedAttenuation(ratios), std::sqrt(0.81 + 0.64 + 0.25), 1e-15);
}

TEST(IsolationLevels, ReferencesOfADriveCountByTheirMeanAndMustHaveTheSameChannels) {
    const auto measured = [](double hz, bool isReference, std::vector<double> levels) {
        return IsolationMeasurement{
            {"foam", "", "3", "1.8", "x", hz}, isReference, std::move(levels), "f.wav"};
    };
    std::vector<IsolationMeasurement> all{measured(50.0, true, {0.5, 2.0}), measured(50.0, true, {1.5, 6.0}),
                                          measured(80.0, true, {8.0, 8.0}), measured(50.0, false, {0.5, 1.0}),
                                          measured(80.0, false, {2.0, 2.0})};
    const IsolationStudy study = summariseIsolation(all);
    ASSERT_EQ(study.error, "");
    ASSERT_EQ(study.results.size(), 2u);
    EXPECT_NEAR(study.results[0].mean, std::hypot(1.0 - 0.5 / 1.0, 1.0 - 1.0 / 4.0), 1e-12);
    EXPECT_NEAR(study.results[1].mean, std::hypot(0.75, 0.75), 1e-12);
    all.push_back(measured(50.0, true, {1.0, 4.0, 1.0}));
    EXPECT_EQ(summariseIsolation(all).error, "f.wav: expected a reference of the same frequency, voltage and "
                                             "axis, with as many channels");
}

// A measured coupling is read as it was written, and a bad one is named by its place.

const std::string good =
    R"({"physvib_coupling": 1, "name": "mine", "source": "measured by hand", "measured": [
  {"frequency_hz": 100, "magnitude": [[1, 0.2], [0.25, 1]], "phase_deg": [[0, -90], [180, 0]]},
  {"frequency_hz": 200, "magnitude": [[1, 0.125], [0.5, 0.875]], "phase_deg": [[0, 0], [0, 0]]}]})";

/// The file above with one thing replaced.
std::string errorOf(const std::string& what, const std::string& with) {
    std::string text = good;
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    const auto read = readCoupling(text.replace(at, what.size(), with), "c.json");
    EXPECT_FALSE(read) << text;
    EXPECT_TRUE(read.value.frequenciesHz.empty() && read.value.matrices.empty());
    return read.error;
}

TEST(CouplingFile, IsReadRowByRow) {
    const auto read = readCoupling(good, "c");
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(read.value.enchanters(), 2u);
    EXPECT_EQ(read.value.frequenciesHz, (std::vector{100.0, 200.0}));
    EXPECT_NEAR(std::abs(read.value.matrices[0].at(0, 1) - std::complex{0.0, -0.2}), 0.0, 1e-15);
    EXPECT_NEAR(std::abs(read.value.matrices[0].at(1, 0) - std::complex{-0.25, 0.0}), 0.0, 1e-15);
    EXPECT_EQ(read.value.matrices[1].at(1, 1), 0.875);
}

TEST(CouplingFile, FaultsNameTheirPlace) {
    EXPECT_EQ(errorOf("0.25", "-0.25"), "c.json: measured[0].magnitude[1][0]: expected 0 to 4, found -0.25");
    EXPECT_EQ(errorOf("0.25", "\"much\""),
              "c.json: measured[0].magnitude[1][0]: expected a number, found a string");
    EXPECT_TRUE(errorOf("0.25", "1e999").starts_with("c.json: "));
    EXPECT_EQ(errorOf("-90", "-900"),
              "c.json: measured[0].phase_deg[0][1]: expected -360 to 360, found -900");
    EXPECT_EQ(
        errorOf("0.875", "0"),
        "c.json: measured[1].magnitude[1][1]: expected an enchanter that moves by its own drive, found 0");
    EXPECT_EQ(errorOf("[0.25, 1]]", "[0.25]]"),
              "c.json: measured[0].magnitude[1]: expected 2 items, found 1");
    EXPECT_EQ(errorOf("[[0, -90], [180, 0]]", "[[0, -90]]"),
              "c.json: measured[0].phase_deg: expected 2 items, found 1");
    EXPECT_EQ(
        errorOf("[[1, 0.125], [0.5, 0.875]], \"phase_deg\": [[0, 0], [0, 0]]", "[[1]], \"phase_deg\": [[0]]"),
        "c.json: measured[1].magnitude: expected as many enchanters as at the first frequency, 2, found 1");
    EXPECT_EQ(errorOf("200", "100"),
              "c.json: measured[1].frequency_hz: expected frequencies that rise, found 100 after 100");
    EXPECT_EQ(errorOf("100", "0"), "c.json: measured[0].frequency_hz: expected 1 to 20000, found 0");
    EXPECT_EQ(errorOf("\"phase_deg\": [[0, -90]", "\"phase_rad\": [[0, -90]"),
              "c.json: measured[0]: unknown field \"phase_rad\"");
    EXPECT_EQ(errorOf("\"name\": \"mine\", ", ""), "c.json: field \"name\" is missing");
    EXPECT_EQ(errorOf("\"physvib_coupling\": 1", "\"physvib_coupling\": 2"),
              "c.json: physvib_coupling: made for a newer PhysVib: expected a version up to 1, found 2");
    EXPECT_EQ(readCoupling(R"({"physvib_coupling": 1, "name": "", "source": "", "measured": []})", "c").error,
              "c: measured: expected 1 to 256 items, found 0");
}

TEST(CouplingFile, NoAccidentGetsPastTheReaderUnnoticed) {
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
        const auto read = readCoupling(mutated(good, "{}[]\",:0123456789.-e nul", random), "f");
        if (!read) {
            EXPECT_TRUE(read.error.starts_with("f: ")) << read.error;
            continue;
        }
        EXPECT_EQ(read.value.frequenciesHz.size(), read.value.matrices.size());
        for (const CouplingMatrix& m : read.value.matrices)
            for (const auto& entry : m.entries) EXPECT_LE(std::abs(entry), 4.0 + 1e-9);
    }
}

using CouplingFileOnDiskTest = FolderTest;

TEST_F(CouplingFileOnDiskTest, LoadsWhatWasWrittenAndSaysWhatIsNotThere) {
    const std::string path = (folder / "mine.json").string();
    ASSERT_EQ(writeFile(path, good), "");
    EXPECT_EQ(loadCoupling(path).value.enchanters(), 2u);
    EXPECT_TRUE(has(loadCoupling((folder / "none.json").string()).error, "cannot be read"));
}

} // namespace physvib::coupling_test
