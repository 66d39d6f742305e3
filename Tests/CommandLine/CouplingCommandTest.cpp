// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib render --coupling`: hits on a 7 x 5 grid, felt through simulated enchanters that move each other.
#include "Calls.h"
#include "TestPlaces.h"
#include <cmath>
#include <cstring>
#include <sstream>

namespace physvib {
namespace {

constexpr int rate = 8000, enchanters = 4, columns = 7, rows = 5, framesPerHit = 1600, delayFrames = 9;
constexpr double frequencyHz = 200.0;
constexpr double share = 0.2; ///< of a neighbour's vibration, delayed; across half of it
constexpr double placesX[] = {0.0, 0.1, 0.0, 0.1}, placesY[] = {0.1, 0.1, 0.0, 0.0};

double shareOf(int i, int j) { return i == j ? 1.0 : i + j == 3 ? 0.5 * share : share; }

using Signals = std::vector<std::vector<double>>; // [enchanter][frame]

class CouplingCommand : public test::CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        write("hits.csv", hits());
        write(
            "four.json",
            R"({"extent_m": [0.1, 0.1], "enchanters": [{"x_m": 0, "y_m": 0.1}, {"x_m": 0.1, "y_m": 0.1}, {"x_m": 0, "y_m": 0}, {"x_m": 0.1, "y_m": 0}]})");
        write("c.json", coupling(-360.0 * frequencyHz * delayFrames / rate, 1.0));
    }

    static std::string hits() {
        std::ostringstream text;
        text << "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n";
        for (int k = 0; k < columns * rows; ++k)
            text << 0.2 * k + 0.01 << ',' << frequencyHz << ",40,0.5," << 0.1 * (k % columns) / (columns - 1)
                 << ',' << 0.1 * (k / columns) / (rows - 1) << '\n';
        return text.str();
    }

    /// The file on the enchanters below at `frequencyHz`, the others' phase and share as given.
    static std::string coupling(double degrees, double share) {
        std::ostringstream magnitudes, phases;
        for (int i = 0; i < enchanters; ++i) {
            magnitudes << (i ? ", [" : "[");
            phases << (i ? ", [" : "[");
            for (int j = 0; j < enchanters; ++j) {
                magnitudes << (j ? ", " : "") << (i == j ? 1.0 : share * shareOf(i, j));
                phases << (j ? ", " : "") << (i == j ? 0.0 : degrees);
            }
            magnitudes << ']';
            phases << ']';
        }
        std::ostringstream text;
        text
            << R"({"physvib_coupling": 1, "name": "square", "source": "simulated", "measured": [{"frequency_hz": )"
            << frequencyHz << R"(, "magnitude": [)" << magnitudes.str() << R"(], "phase_deg": [)"
            << phases.str() << "]}]}";
        return text.str();
    }

    Signals rendered(const std::string& options) const {
        const auto outcome = call(render + options);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        constexpr std::size_t frames = framesPerHit * columns * rows;
        const std::string wav = read("a.wav");
        Signals x(enchanters, std::vector<double>(frames));
        if (wav.size() < 4 * enchanters * frames) return ADD_FAILURE() << "too short", x;
        const char* at = wav.data() + wav.size() - 4 * enchanters * frames;
        for (std::size_t n = 0; n < frames; ++n)
            for (std::size_t j = 0; j < enchanters; ++j, at += 4) {
                float sample;
                std::memcpy(&sample, at, 4);
                x[j][n] = static_cast<double>(sample);
            }
        return x;
    }

    /// What is felt at each enchanter: its own drive, and that of the others, weaker and later.
    static Signals felt(const Signals& driven) {
        Signals sum = driven;
        for (int i = 0; i < enchanters; ++i)
            for (int j = 0; j < enchanters; ++j)
                for (std::size_t n = delayFrames; i != j && n < sum[0].size(); ++n)
                    sum[static_cast<std::size_t>(i)][n] +=
                        shareOf(i, j) * driven[static_cast<std::size_t>(j)][n - delayFrames];
        return sum;
    }

    /// Mean distance between the place of each hit and the centroid of the enchanters' levels, in percent of
    /// the side.
    static double centroidError(const Signals& x) {
        double sum = 0.0;
        for (int k = 0; k < columns * rows; ++k) {
            double all = 0.0, cx = 0.0, cy = 0.0;
            for (std::size_t j = 0; j < enchanters; ++j) {
                double power = 0.0;
                for (std::size_t n = 0; n < framesPerHit; ++n)
                    power += std::pow(x[j][static_cast<std::size_t>(k) * framesPerHit + n], 2);
                const double level = std::sqrt(power);
                all += level;
                cx += level * placesX[j];
                cy += level * placesY[j];
            }
            sum += std::hypot(cx / all - 0.1 * (k % columns) / (columns - 1),
                              cy / all - 0.1 * (k / columns) / (rows - 1)) /
                   0.1;
        }
        return 100.0 * sum / (columns * rows);
    }

    static double peakOf(const Signals& x) {
        double most = 0.0;
        for (const auto& channel : x)
            for (const double s : channel) most = std::max(most, std::abs(s));
        return most;
    }

    const std::string render =
        "render --from-events hits.csv --layout four.json --rate 8000 --seconds 7 --out a.wav ";
};

TEST_F(CouplingCommand, APhantomIsFeltWhereItIsMeant) {
    const Signals plain = rendered(""), compensated = rendered("--coupling c.json"),
                  misjudged = (write("off.json", coupling(-61.0, 1.2)), rendered("--coupling off.json"));
    const double meant = centroidError(plain), before = centroidError(felt(plain)),
                 after = centroidError(felt(compensated)), misjudgedError = centroidError(felt(misjudged));
    RecordProperty("meant_before_after_misjudged", std::to_string(meant) + " " + std::to_string(before) +
                                                       " " + std::to_string(after) + " " +
                                                       std::to_string(misjudgedError));
    EXPECT_LT(meant, 0.5); // the linear law, nearly: the first frames of a hit are not all of it
    EXPECT_GT(before, 10.0);
    EXPECT_LT(after, 0.25 * before);
    EXPECT_LT(misjudgedError, 0.5 * before);
}

TEST_F(CouplingCommand, TheDriveIsAtMostThreeDecibelsStrongerEvenWhereThatIsNotEnough) {
    const Signals plain = rendered("");
    // the four nearly cancel each other out: all at once they would need 32 dB more
    write("bad.json", coupling(180.0, 1.95));
    const double extra = 20.0 * std::log10(peakOf(rendered("--coupling bad.json")) / peakOf(plain));
    RecordProperty("extra_db", std::to_string(extra));
    EXPECT_LT(extra, 3.1); // peaks of other phases lie elsewhere under the envelope
    EXPECT_GT(peakOf(plain), 0.4);
}

TEST_F(CouplingCommand, TellsWhatIsLeftAndWhereTheDriveCameFrom) {
    const auto outcome = call(render + "--coupling c.json --events b.csv");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("coupling: what is felt differs from what is wanted by 0.0 %, without "
                               "compensation by 30.0 %; by 2"),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find(" where it is off by up to 2 dB and 20 degrees; strongest drive "),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(read("b.csv").find("coupling=c.json"), std::string::npos);
    const std::string once = read("a.wav");
    ASSERT_EQ(call(render + "--coupling c.json --events b.csv --block 17").exitCode, 0);
    EXPECT_EQ(read("a.wav"), once);
}

TEST_F(CouplingCommand, RefusesInOneLineWhatDoesNotFit) {
    refuses(render + "--coupling none.json", 1, "none.json: cannot be read", 3);
    refuses("render --from-events hits.csv --layout phone2 --out a.wav --coupling c.json", 1,
            "c.json: expected as many actuators as the layout has, 2, found 4", 3);
    refuses(render + "--coupling hits.csv", 1, "hits.csv: ", 3);
    refuses(render + "--coupling c.json --method SV --sound 200=b.wav", 2,
            "--coupling: expected a --method of modes", 3);
    refuses("play drop --device ALSA:null --coupling c.json", 2, "--coupling: not yet live; render has it",
            3);
    std::filesystem::copy_file(PHYSVIB_SOURCE_DIR "/Tests/Fuzz/corpus/session/two-takes.json",
                               folder_ / "session.json");
    refuses(
        "render session.json --out a.wav --coupling c.json", 1,
        "--coupling: expected a scene or events; a saved session may change its layout and play recordings",
        4);
    write("c.json", coupling(0.0, 1.0).replace(1, 21, "\"physvib_coupling\": 2"));
    refuses(render + "--coupling c.json", 1, "c.json: physvib_coupling: made for a newer PhysVib", 4);
}

} // namespace
} // namespace physvib
