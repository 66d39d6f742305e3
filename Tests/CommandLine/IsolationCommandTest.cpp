// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib attenuation FOLDER` and `physvib coupling`: recordings whose answers are known.
#include "Calls.h"
#include "Lab/Study/Coupling.h"
#include "Support/WavBytes.h"
#include "TestPlaces.h"
#include <cmath>
#include <numbers>
#include <sstream>

namespace physvib::isolation_command_test {

struct Tone {
    double amplitude = 0.0, degrees = 0.0;
};

class Isolation : public test::CommandLine {
protected:
    /// 0.4 s of a sine per channel, and what gravity adds, in 32-bit float.
    void record(const std::string& name, double hz, const std::vector<Tone>& channels) const {
        constexpr std::uint32_t rate = 8000, frames = 3200;
        std::string data;
        for (std::uint32_t n = 0; n < frames; ++n)
            for (const Tone& tone : channels) {
                const auto x = static_cast<float>(
                    0.3 + tone.amplitude *
                              std::cos(2.0 * std::numbers::pi * (hz * n / rate + tone.degrees / 360.0)));
                data.append(reinterpret_cast<const char*>(&x), 4);
            }
        const auto count = static_cast<std::uint32_t>(channels.size());
        write(name, test::wavBytes({.format = 3, .channels = count, .rateHz = rate, .bits = 32}, data));
    }
    void recordLayers() const {
        std::filesystem::create_directory(folder_ / "study");
        std::string table = "file,material,thickness_mm,frequency_hz,voltage_v,axis\n";
        for (const int hz : {50, 250})
            for (const char* axis : {"x", "z"}) {
                const auto add = [&](const std::string& material, const std::string& thickness,
                                     int repetition, double share) {
                    const std::string name = material + thickness + axis + std::to_string(hz) + "-" +
                                             std::to_string(repetition) + ".wav";
                    record("study/" + name, hz, {{0.5 * share}, {0.4 * share}, {0.2 * share}});
                    table += name + "," + material + "," + thickness + "," + std::to_string(hz) + ",1.8," +
                             axis + "\n";
                };
                add("reference", "", 1, 1.0);
                for (const int repetition : {1, 2})
                    add("0030-15", "3", repetition, hz == 50 ? 0.3 : 0.1 * repetition);
            }
        write("study/conditions.csv", table);
    }
};

TEST_F(Isolation, AFolderOfConditionsIsATableOfGammaWithCurves) {
    recordLayers();
    const auto outcome = runs("attenuation study --export all.csv --picture gamma.svg");
    std::istringstream lines{outcome.out};
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "material,thickness_mm,frequency_hz,voltage_v,axis,repetitions,gamma,standard_deviation");
    std::vector<std::string> rows;
    while (std::getline(lines, line)) rows.push_back(line);
    ASSERT_EQ(rows.size(), 4u) << outcome.out;
    EXPECT_TRUE(rows[0].starts_with("0030-15,3,50,1.8,x,2,1.212")) << rows[0];  // 0.7 sqrt(3)
    EXPECT_TRUE(rows[1].starts_with("0030-15,3,250,1.8,x,2,1.472")) << rows[1]; // 0.85 sqrt(3)
    EXPECT_NEAR(std::stod(rows[1].substr(rows[1].rfind(',') + 1)), 0.1 * std::sqrt(3.0) / std::sqrt(2.0),
                1e-4);
    const std::string all = read("all.csv");
    EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 9) << all;
    const std::string picture = read("gamma.svg");
    for (const char* words : {"<title>Isolation, axis x</title>", ">0030-15, 3 mm, 1.8 V<"})
        EXPECT_TRUE(has(picture, words));
}

TEST_F(Isolation, ASoftenerIsAFactorOfItsOwn) {
    recordLayers();
    std::string table = read("study/conditions.csv");
    for (std::size_t at = 0; (at = table.find(",0030-15,", at)) != table.npos; at += 9)
        table.replace(at, 9, table[at - 5] == '1' ? ",0030,5," : ",0030,15,"); // FILE-1.wav, FILE-2.wav
    for (std::size_t at = 0; (at = table.find(",reference,", at)) != table.npos; at += 11)
        table.insert(at + 10, ",");
    write("study/conditions.csv", table.replace(table.find("material,"), 9, "material,softener_percent,"));
    const auto outcome = call("attenuation study --picture gamma.svg");
    EXPECT_TRUE(outcome.out.starts_with("material,softener_percent,thickness_mm,"))
        << outcome.out << outcome.err;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 9) << outcome.out;
    EXPECT_TRUE(has(read("gamma.svg"), ">0030, 15 %, 3 mm<"));
}

TEST_F(Isolation, WhatIsMissingOfAStudyIsTold) {
    recordLayers();
    const std::string table = read("study/conditions.csv");
    for (const auto& [rows, words] : std::vector<std::pair<std::string, const char*>>{
             {table + "referencez50-1.wav,0030-15,6,50,2.4,z\n",
              "referencez50-1.wav: expected a reference of the same frequency, voltage and axis"},
             {table + "none.wav,0030-15,6,50,2.4,z\n", "none.wav: cannot be read"},
             {table + "referencez50-1.wav,0030-15,6,fast,2.4,z\n",
              "conditions.csv:14: column frequency_hz: expected a number from 1 to 20000, found \"fast\""},
             {"file,axis,frequency_hz\nnone.wav,z,50\n", "expected a column material, found none"},
             {"material,axis,frequency_hz\n0030-15,z,50\n", "expected a column file, found none"}}) {
        write("study/conditions.csv", rows);
        refuses("attenuation study --picture a.svg", 1, words, 1);
    }
    refuses("attenuation nowhere", 2, "expected a reference beside \"nowhere\", or a folder of conditions",
            1);
    record("one.wav", 50, {{0.5}});
    record("quiet.wav", 50, {{0.5}, {}});
    refuses("attenuation one.wav quiet.wav", 1, "one.wav: expected the channels of quiet.wav, 2, found 1", 3);
    refuses("attenuation quiet.wav quiet.wav", 1, "quiet.wav: channel 2: expected a vibration, found silence",
            3);
}

TEST_F(Isolation, TheCouplingOfALayoutIsWrittenFromRecordings) {
    std::filesystem::create_directory(folder_ / "rec");
    write(
        "two.json",
        R"({"extent_m": [0.1, 0.1], "enchanters": [{"label": "A", "x_m": 0, "y_m": 0}, {"label": "B", "x_m": 0.1, "y_m": 0, "full_scale_g": 2}]})");
    record("rec/a1.wav", 205, {{0.5, 20.0}, {0.1, -70.0}});
    record("rec/a2.wav", 205, {{0.25, 200.0}, {0.05, 110.0}}); // half the drive, turned round
    record("rec/b.wav", 205, {{0.1, 5.0}, {0.4, 65.0}});
    write("rec/conditions.csv", "file,driven,frequency_hz\na1.wav,A,205\na2.wav,A,205\nb.wav,B,205\n");
    runs("coupling rec --layout two.json --out c.json");
    const auto coupling = readCoupling(read("c.json"), "c.json");
    ASSERT_TRUE(coupling) << coupling.error;
    EXPECT_EQ(coupling.value.frequenciesHz, std::vector<double>{205.0});
    const auto near = [&](std::size_t i, std::size_t j, double magnitude, double degrees) {
        EXPECT_LT(std::abs(coupling.value.matrices[0].at(i, j) -
                           std::polar(magnitude, degrees * std::numbers::pi / 180.0)),
                  1e-3)
            << i << j;
    };
    near(0, 0, 1.0, 0.0);
    near(1, 1, 1.0, 0.0);
    near(1, 0, 0.1, -90.0); // 0.2 of A's acceleration is a tenth of what B does at full scale
    near(0, 1, 0.5, -60.0);
    runs("render drop --layout two.json --seconds 1 --coupling c.json --out drop.wav");
    std::filesystem::remove(folder_ / "drop.wav");
    write("rec/conditions.csv", "file,driven,frequency_hz\na1.wav,A,205\n");
    refuses("coupling rec --layout two.json --out d.json", 1,
            "expected a recording with actuator B driven at 205 Hz, found none", 3);
    record("rec/still.wav", 205, {{}, {0.1}});
    write("rec/conditions.csv", "file,driven,frequency_hz\nstill.wav,A,205\n");
    refuses("coupling rec --layout two.json --out d.json", 1,
            "rec/still.wav: expected that the driven actuator vibrates, found silence on its channel", 3);
    write("rec/conditions.csv", "file,driven,frequency_hz\na1.wav,C,205\n");
    refuses("coupling rec --layout two.json --out d.json", 1,
            "column driven: expected the label of an actuator of the layout, found \"C\"", 3);
    write("rec/conditions.csv", "file,driven,frequency_hz\na1.wav,A,4000\nb.wav,B,4000\n");
    refuses("coupling rec --layout two.json --out d.json", 1,
            "rec/conditions.csv:2: column frequency_hz: expected less than 4000, half the sample rate of "
            "a1.wav, found \"4000\"",
            3);
    write("rec/conditions.csv", "file,driven,frequency_hz\na1.wav,A,205\n");
    refuses("coupling rec --layout phone4 --out d.json", 1,
            "rec/a1.wav: expected a channel per actuator of the layout, 4, found 2", 3);
}

// `physvib render --coupling`: hits on a 7 x 5 grid, felt through simulated enchanters that move each other.

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
        writeHits("hits.csv", hits());
        write(
            "four.json",
            R"({"extent_m": [0.1, 0.1], "enchanters": [{"x_m": 0, "y_m": 0.1}, {"x_m": 0.1, "y_m": 0.1}, {"x_m": 0, "y_m": 0}, {"x_m": 0.1, "y_m": 0}]})");
        write("c.json", coupling(-360.0 * frequencyHz * delayFrames / rate, 1.0));
    }

    static std::string hits() {
        std::ostringstream text;
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
        runs(render + options);
        constexpr std::size_t frames = framesPerHit * columns * rows;
        const auto channels = channelsOf("a.wav");
        Signals x(enchanters, std::vector<double>(frames));
        if (channels.size() != enchanters || channels[0].size() < frames)
            return ADD_FAILURE() << "too short", x;
        for (std::size_t j = 0; j < enchanters; ++j) std::copy_n(channels[j].begin(), frames, x[j].begin());
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
    const auto outcome = runs(render + "--coupling c.json --events b.csv");
    EXPECT_TRUE(has(outcome.err, "coupling: what is felt differs from what is wanted by 0.0 %, without "
                                 "compensation by 30.0 %; by 2"));
    EXPECT_TRUE(has(outcome.err, " where it is off by up to 2 dB and 20 degrees; strongest drive "));
    EXPECT_TRUE(has(read("b.csv"), "coupling=c.json"));
    const std::string once = read("a.wav");
    runs(render + "--coupling c.json --events b.csv --block 17");
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

} // namespace physvib::isolation_command_test
