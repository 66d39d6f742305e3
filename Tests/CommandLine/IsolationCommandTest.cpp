// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib attenuation FOLDER` and `physvib coupling`: recordings whose answers are known.
#include "Calls.h"
#include "Lab/Study/Coupling.h"
#include <cmath>
#include <cstring>
#include <numbers>

namespace physvib {
namespace {

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
        const auto word = [](std::uint32_t value, std::size_t bytes) {
            return std::string(reinterpret_cast<const char*>(&value), bytes);
        };
        const auto count = static_cast<std::uint32_t>(channels.size());
        write(name, "RIFF" + word(36 + static_cast<std::uint32_t>(data.size()), 4) + "WAVEfmt " +
                        word(16, 4) + word(3, 2) + word(count, 2) + word(rate, 4) +
                        word(rate * count * 4, 4) + word(count * 4, 2) + word(32, 2) + "data" +
                        word(static_cast<std::uint32_t>(data.size()), 4) + data);
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
    const auto outcome = call("attenuation study --export all.csv --picture gamma.svg");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
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
        EXPECT_NE(picture.find(words), std::string::npos) << words;
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
    EXPECT_NE(read("gamma.svg").find(">0030, 15 %, 3 mm<"), std::string::npos);
}

TEST_F(Isolation, WhatIsMissingOfAStudyIsTold) {
    recordLayers();
    const std::string table = read("study/conditions.csv");
    write("study/conditions.csv", table + "reference"
                                          "z50-1.wav,0030-15,6,50,2.4,z\n");
    refuses("attenuation study --picture a.svg", 1,
            "referencez50-1.wav: expected a reference of the same frequency, voltage and axis", 1);
    write("study/conditions.csv", table + "none.wav,0030-15,6,50,2.4,z\n");
    refuses("attenuation study", 1, "none.wav: cannot be read", 1);
    write("study/conditions.csv", table + "referencez50-1.wav,0030-15,6,fast,2.4,z\n");
    refuses("attenuation study", 1,
            "conditions.csv:14: column frequency_hz: expected a number from 1 to 20000, found \"fast\"", 1);
    write("study/conditions.csv", "file,axis,frequency_hz\nnone.wav,z,50\n");
    refuses("attenuation study", 1, "expected a column material, found none", 1);
    refuses("attenuation nowhere", 2, "expected a reference beside \"nowhere\", or a folder of conditions",
            1);
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
    const auto outcome = call("coupling rec --layout two.json --out c.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
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
    EXPECT_EQ(call("render drop --layout two.json --seconds 1 --coupling c.json --out drop.wav").exitCode, 0);
    std::filesystem::remove(folder_ / "drop.wav");
    write("rec/conditions.csv", "file,driven,frequency_hz\na1.wav,A,205\n");
    refuses("coupling rec --layout two.json --out d.json", 1,
            "expected a recording with actuator B driven at 205 Hz, found none", 3);
    write("rec/conditions.csv", "file,driven,frequency_hz\na1.wav,C,205\n");
    refuses("coupling rec --layout two.json --out d.json", 1,
            "column driven: expected the label of an actuator of the layout, found \"C\"", 3);
    refuses("coupling rec --layout phone4 --out d.json", 1,
            "rec/a1.wav: expected a channel per actuator of the layout, 4, found 2", 3);
}

} // namespace
} // namespace physvib
