// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib export`, and its files through `physvib render`: how near they are to what was exported.
#include "Calls.h"
#include "TestPlaces.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

namespace physvib::export_command_test {

using ClipSignals = std::vector<std::vector<float>>; // [channel][frame]

class ExportCommand : public test::CommandLine {
protected:
    static double farthest(const ClipSignals& a, const ClipSignals& b) {
        EXPECT_EQ(a.size(), b.size());
        double most = 0.0;
        for (std::size_t j = 0; j < std::min(a.size(), b.size()); ++j)
            for (std::size_t n = 0; n < std::min(a[j].size(), b[j].size()); ++n)
                most = std::max(most, static_cast<double>(std::abs(a[j][n] - b[j][n])));
        return most;
    }
};

TEST_F(ExportCommand, EveryScenePlaysAsItsRenderDoes) {
    for (const std::string scene : {"shake-the-box", "fruit-basket", "driving", "drop", "box-study"}) {
        runs("render " + scene + " --seconds 3 --limiter off --out direct.wav");
        runs("export " + scene + " --seconds 3 --error 0.001 --to a.hjif");
        runs("render a.hjif --seconds 3 --limiter off --out again.wav");
        EXPECT_LE(farthest(channelsOf("direct.wav"), channelsOf("again.wav")), 1e-3) << scene;
        // there is something to compare
        EXPECT_GE(farthest(channelsOf("direct.wav"), ClipSignals(4, std::vector<float>(144000))), 1e-3)
            << scene;
    }
}

TEST_F(ExportCommand, GivesTheSameBytesTwice) {
    for (const std::string ending : {"hjif", "haptic", "ahap"}) {
        runs("export drop --seconds 2 --layout phone1 --to a." + ending);
        runs("export drop --seconds 2 --layout phone1 --to b." + ending);
        EXPECT_FALSE(read("a." + ending).empty());
        EXPECT_TRUE(read("a." + ending) == read("b." + ending));
    }
}

TEST_F(ExportCommand, KeepsEveryHitOfAListAndOfASessionWhereItWasAndWhen) {
    std::ostringstream list;
    constexpr int hits = 30;
    for (int k = 0; k < hits; ++k)
        list << 0.1 + 0.25 * k + 1.3e-6 * k << ",250,60," << (k % 3 ? 0.5 : 0.02) << ',' << 0.004 * k << ','
             << 0.002 * (hits - k) << '\n';
    writeHits("hits.csv", list.str());
    std::ostringstream strikes;
    for (int k = 0; k < hits; ++k)
        strikes << (k ? "," : "") << R"({"time_s": )" << 0.1 + 0.25 * k + 1.3e-6 * k
                << R"(, "frequency_hz": 250, "decay_per_s": 60, "amplitude": )" << (k % 3 ? 0.5 : 0.02)
                << R"(, "x_m": )" << 0.04 * k << R"(, "y_m": )" << 0.02 * (hits - k)
                << R"(, "duration_s": 0})";
    write(
        "hits.json",
        R"({"physvib_session": 5, "seconds": 8, "steps_per_second": 100, "timing": "onset", "location": "contact", "limiter": false, "channels": 4,
        "panning": {"layout": {"extent_m": [0.12, 0.06], "enchanters": [{"label": "A", "x_m": 0, "y_m": 0.06}, {"label": "B", "x_m": 0.12, "y_m": 0.06}, {"label": "C", "x_m": 0, "y_m": 0}, {"label": "D", "x_m": 0.12, "y_m": 0}]},
                    "law": "linear", "exponent": 1, "field_m": [1.2, 0.6]},
        "takes": [{"start_s": 0, "world_end_s": 8, "seed": 1, "scene": {"name": "quiet", "field_m": [1.2, 0.6], "gravity_m_per_s2": [0, 0], "materials": [], "bodies": []}, "inputs": [], "stalls": []}],
        "strikes": [)" +
            strikes.str() + "]}");
    for (const std::string layout : {"phone4", "ring4", "session"}) {
        const bool isSession = layout == "session";
        runs(isSession
                 ? "render hits.json --out direct.wav"
                 : "render --from-events hits.csv --field 0.12,0.06 --seconds 8 --limiter off --layout " +
                       layout + " --out direct.wav");
        runs(isSession ? "export hits.json --to a.hjif"
                       : "export hits.csv --field 0.12,0.06 --layout " + layout + " --to a.hjif");
        runs("render a.hjif --seconds 8 --limiter off --out again.wav");
        const ClipSignals direct = channelsOf("direct.wav"), again = channelsOf("again.wav");
        ASSERT_EQ(direct.size(), again.size());
        for (int k = 0; k < hits; ++k) {
            const auto from = static_cast<std::size_t>(48000 * (0.1 + 0.25 * k)) - 10;
            double centroid[2] = {};
            std::size_t onset[2] = {};
            for (int which = 0; which < 2; ++which) {
                const ClipSignals& signals = which ? again : direct;
                double x = 0.0, sum = 0.0;
                for (std::size_t j = 0; j < signals.size(); ++j) {
                    double energy = 0.0;
                    for (std::size_t n = from; n < from + 11000; ++n)
                        energy += static_cast<double>(signals[j][n]) * signals[j][n];
                    x += (j % 2 ? 1.0 : 0.0) * std::sqrt(energy);
                    sum += std::sqrt(energy);
                }
                centroid[which] = x / sum;
                for (onset[which] = from; onset[which] < from + 100;) {
                    bool sounds = false;
                    for (const auto& channel : signals)
                        sounds = sounds || std::abs(channel[onset[which]]) > 1e-5f;
                    if (sounds) break;
                    ++onset[which];
                }
            }
            EXPECT_NEAR(centroid[0], centroid[1], 0.03) << layout << ' ' << k;
            EXPECT_NEAR(static_cast<double>(onset[0]), static_cast<double>(onset[1]), 1.0)
                << layout << ' ' << k;
        }
    }
}

TEST_F(ExportCommand, KeepsASessionsLayoutsAndInputs) {
    std::ifstream file{PHYSVIB_SOURCE_DIR "/Source/Scene/Scenes/shake-the-box.json"};
    std::string scene{std::istreambuf_iterator<char>{file}, {}};
    scene.erase(scene.find("\"physvib_scene\": 1,"), 19);
    const auto panning = [](double left) {
        std::ostringstream text;
        text
            << R"({"layout": {"name": "", "extent_m": [0.12, 0.06], "enchanters": [{"label": "A", "x_m": )"
            << left
            << R"(, "y_m": 0.03}, {"label": "B", "x_m": 0.12, "y_m": 0.03}]}, "law": "linear", "exponent": 1, "field_m": [6.4, 3.6]})";
        return text.str();
    };
    write(
        "run.json",
        R"({"physvib_session": 1, "seconds": 6, "steps_per_second": 100, "timing": "onset", "location": "contact", "limiter": false, "ceilings": [1, 1], "channels": 2, "panning": )" +
            panning(0.0) + R"(, "takes": [{"start_s": 0, "world_end_s": 6, "seed": 3, "scene": )" + scene +
            R"(, "inputs": [{"time_s": 1, "input": "tilt", "angle_rad": 0.3}], "stalls": []}],
                          "controls": [{"time_s": 3, "control": "layout", "panning": )" +
            panning(0.06) + "}]}");
    runs("render run.json --out direct.wav");
    EXPECT_TRUE(has(read("direct.wav"), " seed=3 ")) << "of the session: it is no option of this call";
    runs("export run.json --error 0.001 --to run.hjif");
    runs("render run.hjif --seconds 6 --limiter off --out again.wav");
    EXPECT_LE(farthest(channelsOf("direct.wav"), channelsOf("again.wav")), 1e-3);
    EXPECT_GE(farthest(channelsOf("direct.wav"), ClipSignals(2, std::vector<float>(288000))), 0.1);
}

TEST_F(ExportCommand, WhatMovesIsExportedInStepsThatGoOnInPhase) {
    write(
        "moves.json",
        R"({"physvib_session": 5, "seconds": 1, "steps_per_second": 100, "timing": "onset", "location": "contact", "limiter": false, "channels": 2,
        "panning": {"layout": {"extent_m": [1, 1], "enchanters": [{"label": "A", "x_m": 0, "y_m": 0}, {"label": "B", "x_m": 1, "y_m": 0}]}, "law": "linear", "exponent": 1, "field_m": [1, 1]},
        "takes": [{"start_s": 0, "world_end_s": 1, "seed": 1, "scene": {"name": "quiet", "field_m": [1, 1], "gravity_m_per_s2": [0, 0], "materials": [], "bodies": []}, "inputs": [], "stalls": []}],
        "strikes": [{"time_s": 0.1, "frequency_hz": 149.7, "decay_per_s": 0, "amplitude": 0.5, "x_m": 0, "y_m": 0, "duration_s": 0.3, "to_x_m": 0.4, "to_y_m": 0, "travel_s": 0.3, "spread": "linear"},
                    {"time_s": 0.4, "frequency_hz": 149.7, "decay_per_s": 0, "amplitude": 0.5, "x_m": 0.4, "y_m": 0, "duration_s": 0.5, "to_x_m": 1, "to_y_m": 0, "travel_s": 0.5, "since_s": 0.3, "spread": "linear"}]})");
    runs("render moves.json --out direct.wav");
    runs("export moves.json --error 0.001 --to moves.hjif");
    runs("render moves.hjif --seconds 1 --limiter off --out again.wav");
    EXPECT_LE(farthest(channelsOf("direct.wav"), channelsOf("again.wav")), 0.01)
        << "half a step"; // 0.35 if it stayed
    EXPECT_GE(farthest(channelsOf("direct.wav"), ClipSignals(2, std::vector<float>(48000))), 0.4);
}

TEST_F(ExportCommand, WritesAFileForEachEnchanterWhereAFormatHasOneChannel) {
    const auto outcome = runs("export shake-the-box --seconds 7 --to box.ahap");
    EXPECT_EQ(files().size(), 4u);
    for (const char* label : {"A", "B", "C", "D"})
        EXPECT_TRUE(has(read("box-" + std::string(label) + ".ahap"), "HapticContinuous"));
    EXPECT_TRUE(has(outcome.err, "a file for each actuator"));
    EXPECT_TRUE(has(outcome.err, "where a hit was is not carried"));
    EXPECT_TRUE(has(outcome.out, "box-D.ahap  1 channel, "));
}

TEST_F(ExportCommand, TurnsOneFormatIntoAnother) {
    runs("export drop --seconds 2 --layout phone1 --to a.haptic");
    runs("export a.haptic --to b.hjif");
    runs("export b.hjif --to c.ahap");
    runs("render c.ahap --layout phone1 --out c.wav --picture c.png");
    EXPECT_GT(farthest(channelsOf("c.wav"), ClipSignals(1, std::vector<float>(96000))), 0.01);
}

TEST_F(ExportCommand, TellsWhatOfAClipIsLeftOut) {
    write(
        "a.ahap",
        R"({"Pattern": [{"Event": {"EventType": "HapticTransient", "EventParameters": [{"ParameterID": "AttackTime", "ParameterValue": 0.1},]}}, {"Event": {"EventType": "AudioCustom"}}]})");
    for (const char* arguments : {"export a.ahap --to a.hjif", "render a.ahap --layout phone1 --out a.wav"}) {
        const auto outcome = runs(arguments);
        EXPECT_TRUE(
            has(outcome.err, "physvib: warning: a.ahap: left out: AttackTime (1), AudioCustom (1)\n"));
    }
}

TEST_F(ExportCommand, ReadsClipsWhereARecordingIs) {
    runs("export drop --seconds 2 --layout phone1 --to a.haptic");
    runs("stimulus wav a.haptic --at 0.3,0.4 --level-g 0.5 --out s.wav");
    EXPECT_EQ(channelsOf("s.wav").size(), 4u);
    runs("stimulus clip a.haptic --at 0.3,0.4 --level-g 0.5 --out t.wav");
    EXPECT_TRUE(read("s.wav") == read("t.wav"));
}

TEST_F(ExportCommand, FeelsChannelsWithoutPlacesOneOnEachEnchanter) {
    write(
        "two.hjif",
        R"({"perceptions": [{"perception_modality": "Vibrotactile", "channels": [{"bands": [{"band_type": "VectorialWave", "effects": [{"effect_type": "Basis", "keyframes": [
        {"relative_position": 0, "amplitude_modulation": 0.5, "frequency_modulation": 100}, {"relative_position": 500, "amplitude_modulation": 0.5}]}]}]}, {"bands": []}]}]})");
    runs("render two.hjif --layout ring2 --out two.wav");
    const ClipSignals two = channelsOf("two.wav");
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(two[0].size(), 24000u);
    EXPECT_NEAR(*std::ranges::max_element(two[0]), 0.5, 1e-3);
    EXPECT_NEAR(*std::ranges::max_element(two[1]), 0.0, 1e-6);
    refuses(
        "render two.hjif --layout ring3 --out three.wav", 1,
        "two.hjif: expected one channel, places, or as many channels as the layout has actuators, 3, found 2",
        2);
}

TEST_F(ExportCommand, RefusesInOneLine) {
    refuses("export", 2, "--to is required");
    refuses("export drop --to a.wav", 2,
            "--to: expected a name that ends in .hjif, .haptic, .ahap or .envelope, found \"a.wav\"");
    refuses("export --to a.hjif", 2, "export: give a scene");
    refuses("export nowhere --to a.hjif", 2, "nowhere");
    refuses("export drop --limiter off --to a.hjif", 2, "--limiter: says how something is played");
    refuses("export drop --error 2 --to a.hjif", 2, "--error");
    refuses("export absent.hjif --to a.hjif", 1, "absent.hjif: cannot be read");
    refuses("render absent.ahap --out a.wav", 1, "absent.ahap: cannot be read");
    write("bad.haptic", "{}");
    refuses("export bad.haptic --to a.hjif", 1, "bad.haptic: field \"version\" is missing", 1);
    refuses("render bad.haptic --seed 2 --out a.wav", 2, "--seed: a clip has no collisions", 1);
    refuses("export bad.haptic --to bad.haptic", 2, "bad.haptic", 1);
    EXPECT_EQ(read("bad.haptic"), "{}");
    write("giga.ahap", "{");
    std::filesystem::resize_file(folder_ / "giga.ahap", 1'000'000'000);
    refuses("render giga.ahap --out a.wav", 1, "giga.ahap: expected at most 24000000 bytes, found more", 2);
}

} // namespace physvib::export_command_test
