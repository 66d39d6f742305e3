// SPDX-License-Identifier: GPL-3.0-or-later
// `render --method SV`: recorded contacts in place of modes.
#include "Calls.h"
#include <algorithm>
#include <cmath>
#include <cstring>

namespace physvib::sound_method_test {

class SoundMethod : public test::CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        writeHits("one.csv", "0.1,349,40,0.8,0,0\n");
        runs("render --from-events one.csv --layout phone1 --seconds 1 --out knock.wav");
        writeHits("hits.csv", "0.2,349,40,0.4,0,0\n0.6,349,40,0.1,0,0\n");
    }
    std::vector<float> samplesOf(const std::string& name) const { return channelsOf(name).at(0); }
    static float peakOf(const std::vector<float>& samples, double from, double to, double rate) {
        float most = 0.0f;
        for (auto n = static_cast<std::size_t>(from * rate); n < static_cast<std::size_t>(to * rate); ++n)
            most = std::max(most, std::abs(samples[n]));
        return most;
    }
};

TEST_F(SoundMethod, TheRecordingPlaysAtEachHitWithTheHitsAmplitudeAsItsPeak) {
    const std::string render = "render --from-events hits.csv --layout phone1 --seconds 1 --limiter off "
                               "--method SV --sound 349=knock.wav --out a.wav ";
    runs(render);
    const auto a = samplesOf("a.wav");
    EXPECT_NEAR(peakOf(a, 0.2, 0.55, 48000), 0.4f, 1e-4f);
    EXPECT_NEAR(peakOf(a, 0.6, 0.99, 48000), 0.1f, 1e-4f);
    EXPECT_EQ(peakOf(a, 0.0, 0.199, 48000), 0.0f);
    runs(render + "--rate 44100"); // resampled
    EXPECT_NEAR(peakOf(samplesOf("a.wav"), 0.2, 0.55, 44100), 0.4f, 0.002f);
}

TEST_F(SoundMethod, MaterialsOfOneFrequencyHaveRecordingsOfTheirOwn) {
    write("two.csv", "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m,material\n0.1,349,40,0.4,0,0,oak\n"
                     "0.5,349,40,0.4,0,0,pine\n0.8,349,40,0.1,0,0,\n");
    const std::string render = "render --from-events two.csv --layout phone1 --seconds 1 --limiter off "
                               "--method SV --out a.wav ";
    const std::string both = "--sound oak=knock.wav --sound pine=synthetic-3 ";
    refuses(render + both, 1, "two.csv: expected a --sound for 349 Hz, found none", 4);
    refuses(render + "--sound oak=knock.wav", 1, "two.csv: expected a --sound for pine or 349 Hz, found none",
            4);
    refuses(render + "--sound elm=knock.wav", 1,
            "--sound elm=knock.wav: expected a material of two.csv that vibrates, or a frequency", 4);
    runs(render + both + "--sound 349=knock.wav --events again.csv");
    const auto a = samplesOf("a.wav");
    const auto differ = [&](double first, double second) {
        float most = 0.0f;
        for (int n = 0; n < 4800; ++n)
            most = std::max(
                most, std::abs(a[static_cast<std::size_t>(first * 48000.0) + static_cast<std::size_t>(n)] -
                               a[static_cast<std::size_t>(second * 48000.0) + static_cast<std::size_t>(n)]));
        return most;
    };
    EXPECT_GT(differ(0.1, 0.5), 0.1f);
    EXPECT_TRUE(has(read("a.wav"), "sound=oak=knock.wav"));
    EXPECT_TRUE(has(read("again.csv"), ",oak\n"));
    EXPECT_TRUE(has(read("again.csv"), ",pine\n"));
}

TEST_F(SoundMethod, MarksAreAFileOfTheirOwnInSyncWithWhatIsFelt) {
    writeHits("close.csv", "0.2000005,349,40,0.4,0,0\n0.6000005,349,40,0.1,0,0\n0.6002,349,40,0.1,0,0\n");
    const std::string render =
        "render --from-events close.csv --layout phone1 --seconds 1 --out a.wav --marker m.wav";
    const auto outcome = runs(render);
    EXPECT_TRUE(has(outcome.out, "m.wav  a pulse at each onset: 1 channel, 2 pulses for 3 onsets: 1 came "
                                 "within 0.5 ms of another"));
    const auto felt = samplesOf("a.wav"), marks = samplesOf("m.wav");
    ASSERT_EQ(felt.size(), marks.size());
    for (const std::size_t onset : {9601u, 28801u}) {
        EXPECT_EQ(marks[onset - 1], 0.0f);
        for (std::size_t n = onset; n < onset + 96; ++n) ASSERT_EQ(marks[n], 1.0f) << n;
        EXPECT_EQ(marks[onset + 96], 0.0f);
    }
    EXPECT_EQ(felt[9600], 0.0f);
    EXPECT_NE(felt[9601], 0.0f);
    EXPECT_EQ(call(render + " --marker-of hits").out.find("0 pulses") == std::string::npos, false)
        << "a list without fixtures has no hits of a world";
    EXPECT_EQ(call(render + " --marker-of some").exitCode, 2);
}

TEST_F(SoundMethod, TheContactSoundIsAFileOfItsOwnInSyncWithWhatIsFelt) {
    const std::string render =
        "render --from-events hits.csv --layout phone1 --seconds 1 --out a.wav --contact-sound b.wav ";
    auto outcome = call(render);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "b.wav  what is heard of each hit: 1 channel, at full scale -20 dBFS"));
    const auto felt = samplesOf("a.wav"), heard = samplesOf("b.wav");
    ASSERT_EQ(felt.size(), heard.size());
    for (std::size_t n = 0; n < felt.size(); ++n) ASSERT_NEAR(heard[n], 0.1f * felt[n], 1e-6f) << n;
    runs(render + "--contact-sound-db -6 --sound 349=knock.wav");
    const auto recorded = samplesOf("b.wav");
    EXPECT_NEAR(peakOf(recorded, 0.2, 0.55, 48000), 0.4f * 0.5012f, 1e-4f);
    EXPECT_EQ(peakOf(recorded, 0.0, 0.2, 48000), 0.0f);
    EXPECT_EQ(samplesOf("a.wav"), felt) << "the hands feel the mode";
    runs(render + "--contact-sound-channels 2");
    const auto both = channelsOf("b.wav"); // every place has the power of the one channel
    ASSERT_EQ(both.size(), 2u);
    float apart = 0.0f;
    for (std::size_t n = 0; n < felt.size(); ++n) {
        ASSERT_NEAR(std::hypot(both[0][n], both[1][n]), std::abs(heard[n]), 1e-6f) << n;
        apart = std::max(apart, std::abs(both[0][n] - both[1][n]));
    }
    EXPECT_GT(apart, 0.001f) << "by place";
}

TEST_F(SoundMethod, LevelsMoveAllHitsAndRecordingsCanBeAsStrongAsTheMode) {
    const std::string render =
        "render --from-events hits.csv --layout phone1 --seconds 1 --limiter off --out a.wav ";
    runs(render);
    const auto plain = samplesOf("a.wav");
    runs(render + "--level-db -6.0206");
    const auto half = samplesOf("a.wav");
    for (std::size_t n = 0; n < plain.size(); ++n) ASSERT_NEAR(half[n], 0.5f * plain[n], 1e-6f) << n;
    runs(render + "--method SV --sound 349=synthetic-7 --level-db -6.0206");
    EXPECT_NEAR(peakOf(samplesOf("a.wav"), 0.2, 0.55, 48000), 0.2f, 1e-4f);
    EXPECT_TRUE(has(read("a.wav"), "sound=349=synthetic-7")) << "what is synthetic says so";
    runs(render + "--method SV --sound 349=synthetic-7 --sound-match rms");
    const auto energy = [&](const std::vector<float>& x) {
        double sum = 0.0;
        for (std::size_t n = 9600; n < 9600 + 12000; ++n) sum += double{x[n]} * x[n];
        return sum;
    };
    EXPECT_NEAR(energy(samplesOf("a.wav")) / energy(plain), 1.0, 0.01);
    refuses(render + "--level-db 90", 2, "--level-db: expected -80 to 80 dB, found \"90\"", 4);
}

TEST_F(SoundMethod, WhatIsMissingOrNoHitIsToldInOneLine) {
    const std::string render = "render --from-events hits.csv --layout phone1 --seconds 1 --out a.wav ";
    refuses(render + "--method SV", 2, "--method SV: expected a --sound for each material", 3);
    refuses(render + "--sound 349=knock.wav", 2,
            "--sound: expected --method SV, to feel it, or --contact-sound, to hear it", 3);
    refuses(render + "--sound 349=knock.wav --contact-sound b.wav --method AV-FF-DRV", 2,
            "--sound: expected hits at their material's own frequency, found --method AV-FF-DRV", 3);
    refuses(render + "--method SV --sound knock.wav", 2, "--sound: expected MATERIAL=FILE.wav", 3);
    refuses(render + "--method SV --sound 80=knock.wav", 1,
            "hits.csv: expected a --sound for 349 Hz, found none", 3);
    refuses(render + "--method SV --sound 349=none.wav", 1, "none.wav: cannot be read", 3);
    refuses(render + "--method SV --sound 349=hits.csv", 1,
            "hits.csv: expected a WAV, AIFF, FLAC, Ogg Vorbis or Opus file", 3);
    writeHits("silence.csv", "0.1,349,40,0,0,0\n");
    runs("render --from-events silence.csv --layout phone1 --seconds 1 --out silence.wav");
    refuses(render + "--method SV --sound 349=silence.wav", 1, "silence.wav: expected a hit, found silence",
            5);
}

// --perceived-level in event lists, in files and in saved sessions, and where it is refused.

class PerceivedLevelCommand : public test::CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        writeHits("hits.csv",
                  "0.1,20,10,0.25,0,0\n0.2,80,34.13,0.25,0,0\n0.5,500,50,0.25,0,0\n0.7,500,50,0.75,0,0\n");
    }
    static std::string session(const std::string& shaping) {
        return R"({"physvib_session": 3, "seconds": 2, "steps_per_second": 100, "timing": "onset", "location": "contact", "limiter": true, )" +
               shaping +
               R"("channels": 1, "panning": {"layout": {"name": "", "extent_m": [0.1, 0.1], "enchanters": [{"label": "A", "x_m": 0, "y_m": 0, "actuator": "none", "full_scale_g": 1}]},
                   "law": "linear", "exponent": 1, "field_m": [4, 2]},
                 "takes": [{"start_s": 0, "world_end_s": 2, "seed": 1, "scene": {"name": "a ball falls on a plate", "field_m": [4, 2], "gravity_m_per_s2": [0, -9.8],
                   "materials": [{"name": "steel", "density_kg_per_m2": 850, "friction": 0.4, "restitution": 0.6, "frequency_hz": 430, "decay_per_s": 50}],
                   "bodies": [{"name": "plate", "type": "static", "position_m": [2, 0.1], "mass_kg": 740, "fixtures": [{"shape": "box", "size_m": [4, 0.2], "material": "steel", "camera": true}]},
                              {"name": "ball", "position_m": [1, 1.5], "fixtures": [{"shape": "circle", "radius_m": 0.15, "material": "steel"}]}]}}]})";
    }
    static constexpr const char* render =
        "render --from-events hits.csv --layout phone1 --seconds 1 --out a.wav ";
};

TEST_F(PerceivedLevelCommand, WeighsTheEventsThatAreListedAndPlayed) {
    runs(render);
    const auto plain = read("a.wav");
    runs(std::string{render} + "--perceived-level off");
    EXPECT_EQ(read("a.wav"), plain);
    runs(std::string{render} + "--perceived-level on --events b.csv");
    EXPECT_NE(read("a.wav"), plain);
    EXPECT_TRUE(has(read("a.wav"), "perceived_level=on"));
    const std::string listed = read("b.csv");
    for (const char* row : {"\n0.100000000,20,10,0.125,", "\n0.200000000,80,34.13,0.25,",
                            "\n0.500000000,500,50,0.5,", "\n0.700000000,500,50,1,"})
        EXPECT_TRUE(has(listed, row));
    runs("render --from-events b.csv --layout phone1 --seconds 1 --out b.wav");
    // without the line on its origin
    const auto tail = [](const std::string& wav) { return wav.substr(wav.size() - 100'000); };
    EXPECT_EQ(tail(read("b.wav")), tail(read("a.wav")));
}

TEST_F(PerceivedLevelCommand, ASavedSessionKeepsItUnlessTheCallSaysOtherwise) {
    const auto events = [&](const std::string& saved, const std::string& options) {
        runs("render " + saved + " --seconds 2 --events s.csv " + options);
        const std::string csv = read("s.csv");
        return csv.substr(csv.find("\ntime_s"));
    };
    write("plain.json", session(""));
    write("weighted.json", session(R"("shaping": {"perceived_level": true}, )"));
    const auto plain = events("plain.json", ""), weighted = events("plain.json", "--perceived-level on");
    EXPECT_TRUE(has(plain, ",430,")) << "the ball hits the plate: ";
    EXPECT_NE(weighted, plain);
    EXPECT_EQ(events("weighted.json", ""), weighted);
    EXPECT_EQ(events("weighted.json", "--perceived-level off"), plain);
}

TEST_F(PerceivedLevelCommand, IsRefusedWhereItMeansNothing) {
    refuses(std::string{render} + "--perceived-level loud", 2, "--perceived-level", 1);
    refuses(std::string{render} + "--perceived-level on --method SV --sound 80=synthetic-1", 2,
            "--perceived-level: recordings have no one frequency to be weighted by", 1);
    write("recorded.json",
          session(
              R"("recordings": [{"time_s": 0, "files": [{"frequency_hz": 430, "file": "synthetic-7"}]}], )"));
    refuses("render recorded.json --out a.wav --perceived-level on", 2,
            "--perceived-level: recordings have no one frequency to be weighted by", 2);
    runs("render recorded.json --out a.wav --perceived-level on --method AV-FV-DRV");
    std::filesystem::remove(folder_ / "a.wav");
    std::filesystem::remove(folder_ / "recorded.json");
    refuses("play drop --board /dev/none --perceived-level on", 2,
            "--board: not yet with --method, --level-db, --gamma, --perceived-level and --actuator", 1);
}

} // namespace physvib::sound_method_test
