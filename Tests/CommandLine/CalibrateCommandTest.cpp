// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib calibrate` from two recordings, and how bad ones are told.
#include "Calls.h"
#include "Scene/ActuatorFile.h"
#include "Scene/LayoutFile.h"
#include "Support/SimulatedActuator.h"
#include "Support/WavBytes.h"
#include <algorithm>
#include <limits>
#include <sstream>
#include <vector>

namespace physvib::calibrate_command_test {

class CalibrateCommand : public test::CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        runs("calibrate --sweep sweep.wav --seconds 2 --rate 8000");
        sweep_ = channelsOf("sweep.wav").at(0);
        ASSERT_EQ(sweep_.size(), 3u * 8000);
    }
    std::vector<float> felt() const {
        SimulatedActuator actuator{{205, 9}, 8000};
        std::vector<float> out;
        for (const float x : sweep_)
            out.push_back(static_cast<float>(0.5 * actuator.process(static_cast<double>(x))));
        return out;
    }
    void record(const std::vector<float>& samples) const {
        const std::string bytes{reinterpret_cast<const char*>(samples.data()), 4 * samples.size()};
        write("felt.wav", test::wavBytes({.format = 3, .rateHz = 8000, .bits = 32}, bytes));
    }
    static constexpr const char* pair = "calibrate --played sweep.wav --recorded felt.wav --out mine.json ";

    std::vector<float> sweep_;
};

TEST_F(CalibrateCommand, WritesTheProfileOfWhatWasRecorded) {
    record(felt());
    runs(std::string{pair} + "--name coin --g-per-unit 4 --drive-volts 2.5");
    const auto profile = loadActuator(folder_ / "mine.json");
    ASSERT_TRUE(profile) << profile.error;
    const ActuatorProfile& p = profile.value;
    EXPECT_EQ(p.name, "coin");
    EXPECT_NEAR(*p.resonanceHz, 205.0, 1.0);
    EXPECT_NEAR(*p.q, 9.0, 0.45);
    EXPECT_NEAR(*p.fullScaleG, 2.0, 0.1);
    EXPECT_EQ(p.driveLimitVolts, 2.5);
    EXPECT_EQ(equaliserError(p), "");
    runs(std::string{pair} + "--band 150-300");
    EXPECT_EQ(loadActuator(folder_ / "mine.json").value.bandOrUnknown(), (FrequencyBand{150, 300}));
    EXPECT_FALSE(loadActuator(folder_ / "mine.json").value.fullScaleG); // nobody said what a sample is
}

TEST_F(CalibrateCommand, WiredTheOtherWayRoundAnActuatorIsAsStrong) {
    std::vector<float> turned = felt();
    for (float& sample : turned) sample = -sample;
    record(turned);
    runs(std::string{pair} + "--g-per-unit 4");
    const auto profile = loadActuator(folder_ / "mine.json");
    ASSERT_TRUE(profile) << profile.error;
    EXPECT_NEAR(*profile.value.fullScaleG, 2.0, 0.1);
}

TEST_F(CalibrateCommand, AnInvertedGainIsToldAsSuchOfAnActuatorAndOfACable) {
    for (const float sign : {1.0f, -1.0f})
        for (const bool isCable : {false, true}) {
            std::vector<float> samples = isCable ? sweep_ : felt();
            for (float& sample : samples) sample *= sign;
            record(samples);
            const auto outcome = runs(isCable ? "calibrate --played sweep.wav --recorded felt.wav --loopback"
                                              : std::string{pair});
            const auto at = outcome.out.find(" gain ");
            ASSERT_NE(at, outcome.out.npos) << outcome.out;
            EXPECT_NEAR(std::stod(outcome.out.substr(at + 6)), sign * (isCable ? 1.0 : 0.5), 0.03);
        }
}

TEST_F(CalibrateCommand, WritesTheLayoutThatHasItsFullScale) {
    record(felt());
    const auto plain = call(std::string{pair} + "--g-per-unit 10");
    EXPECT_TRUE(has(plain.out, "full scale 5.0"));
    EXPECT_TRUE(has(plain.out, "--layout-out FILE.json")); // it is offered
    runs(std::string{pair} + "--g-per-unit 10 --layout phone4 --place B --layout-out four.json");
    const auto layout = loadLayout(folder_ / "four.json");
    ASSERT_TRUE(layout) << layout.error;
    EXPECT_NEAR(layout.value.actuators[1].fullScaleG, 5.0, 0.25);
    EXPECT_EQ(layout.value.actuators[1].actuator, "mine.json");
    EXPECT_EQ(layout.value.actuators[0].fullScaleG, 1.0);
    refuses(std::string{pair} + "--layout phone4 --layout-out five.json", 2,
            "--layout-out: expected --g-per-unit", 4);
    refuses(std::string{pair} + "--g-per-unit 10 --layout phone4 --place Z --layout-out five.json", 1,
            "--place: phone4 has no actuator \"Z\"", 4);
    refuses(std::string{pair} + "--g-per-unit 10 --layout phone4 --layout-out mine.json", 2, "mine.json", 4);
}

TEST_F(CalibrateCommand, BadRecordingsAreOneLineAndLeaveNoProfile) {
    const auto refusesIt = [&](const std::vector<float>& samples, const std::string& words) {
        record(samples);
        refuses(pair, 1, words, 2);
    };
    auto samples = felt();
    refusesIt(std::vector<float>(samples.size(), 0.0f),
              "felt.wav: what was recorded: expected the sweep, found silence");
    refusesIt({0.1f}, "felt.wav: what was recorded: expected at least 0.1 s, found 1 sample");
    refusesIt({}, "felt.wav: expected samples, found none");
    refusesIt(std::vector<float>(601u * 8000), "felt.wav: expected at most 600 s");
    samples[800] = std::numeric_limits<float>::quiet_NaN();
    refusesIt(samples, "felt.wav: expected finite samples, found NaN at 0.1000 s in channel 1");
    samples = felt();
    for (float& x : samples) x = std::clamp(x, -0.05f, 0.05f);
    refusesIt(samples, "felt.wav: what was recorded: expected a recording that is not clipped");
    refusesIt(sweep_, "felt.wav: expected a resonance from 20 to 1000 Hz, found none"); // a cable
    write("felt.wav", test::wavBytes({.rateHz = 4000}, std::string(8000, '\1')));
    refuses(pair, 1, "felt.wav: expected the rate of sweep.wav, 8000 Hz, found 4000 Hz", 2);
    write("felt.wav", "not a recording");
    refuses(pair, 1, "felt.wav: expected a WAV, AIFF, FLAC, Ogg Vorbis or Opus file", 2);
    refuses("calibrate --device Nowhere --out mine.json", 1, "Nowhere: no such audio device", 2);
}

TEST_F(CalibrateCommand, BadCallsAreUsageErrors) {
    refuses("calibrate --out mine.json", 2, "expected --device, or --played and --recorded, or --sweep", 1);
    refuses("calibrate --played sweep.wav --out mine.json", 2, "expected both --played and --recorded", 1);
    for (const auto& [options, words] : std::vector<std::pair<std::string, const char*>>{
             {"", "expected --out FILE.json"},
             {"--out mine.txt", "--out: expected a name that ends in .json, found \"mine.txt\""},
             {"--out m.json --band 9", "--band: expected LO-HI"},
             {"--out m.json --place A", "--place: expected with --layout and --layout-out"}})
        refuses("calibrate --played sweep.wav --recorded sweep.wav " + options, 2, words, 1);
    refuses("calibrate --device x --out m.json --channel 0", 2, "--channel", 1);
    refuses("calibrate --device x --out m.json --level 3", 2, "--level", 1);
    refuses("calibrate --sweep s.wav --device x", 2, "--sweep stands alone", 1);
}

// `physvib material` as users and scripts hold on to it.

class MaterialCommand : public test::CommandLine {
protected:
    /// What `render` makes of one hit on one enchanter.
    void record(const std::string& hit, const std::string& seconds = "1") const {
        writeHits("hit.csv", hit + "\n");
        runs("render --from-events hit.csv --layout phone1 --seconds " + seconds + " --out hit.wav");
    }
};

TEST_F(MaterialCommand, PrintsFrequencyAndDecayOfARenderedHit) {
    record("0.1,349,106.99,0.8,0,0");
    const auto outcome = runs("material hit.wav --band 90-1000");
    std::istringstream lines{outcome.out};
    std::string header, row, more;
    std::getline(lines, header);
    std::getline(lines, row);
    EXPECT_EQ(header, "frequency_hz,decay_per_s");
    EXPECT_FALSE(std::getline(lines, more));
    EXPECT_NEAR(std::stod(row), 349, 0.17);
    EXPECT_NEAR(std::stod(row.substr(row.find(',') + 1)), 106.99, 0.53);
    EXPECT_TRUE(has(outcome.err, "confidence high"));
    EXPECT_EQ(call("material hit.wav --band 90-1000").out, outcome.out);
    runs("material hit.wav --rule two-peaks");
    runs("material hit.wav --band 90-1000 --picture hit.svg");
    EXPECT_EQ(test::wordsIn(read("hit.svg"), "(349\\.\\d) Hz, in the band").size(), 1u);
    refuses("material --list --picture list.svg", 2, "--picture goes with FILE.wav", 3);
}

TEST_F(MaterialCommand, ListsTheThreeMeasuredPairsAndTheirSource) {
    const auto outcome = runs("material --list");
    EXPECT_EQ(outcome.out.rfind("# Table 5.1", 0), 0u) << outcome.out;
    for (const char* pair :
         {"\nconcrete block,80,34.13\n", "\nwooden board,349,106.99\n", "\nsteel plate,430,11.97\n"})
        EXPECT_TRUE(has(outcome.out, pair));
}

TEST_F(MaterialCommand, BadRecordingsAreOneLine) {
    record("0.1,349,106.99,0,0,0");
    refuses("material hit.wav", 1, "hit.wav: expected a hit, found silence", 2);
    write("text.wav", "not a recording");
    refuses("material text.wav", 1, "text.wav: expected a WAV, AIFF, FLAC, Ogg Vorbis or Opus file", 3);
    refuses("material none.wav", 1, "none.wav: cannot be read", 3);
    write("one.wav", test::wavBytes({}, "\1\2"));
    refuses("material one.wav", 1, "one.wav: expected at least 0.01 s, found 1 sample", 4);
    write("hour.wav", test::wavBytes({.rateHz = 5000}, std::string(2u * 3600 * 5000, '\0')));
    refuses("material hour.wav", 1, "hour.wav: expected at most 600 s", 5);
    write("none-in-it.wav", test::wavBytes({}, ""));
    refuses("material none-in-it.wav", 1, "none-in-it.wav: expected samples, found none", 6);
}

/// A crate is pushed over a ridged floor at a steady speed, as `render` plays it.
constexpr const char* ridges =
    R"({"physvib_scene": 1, "name": "ridges", "description": "a crate on ridges", "field_m": [8, 4], "gravity_m_per_s2": [0, -10], "normalisation": {"a_star_s_per_m": 1, "hand_mass_kg": 0},
  "materials": [{"name": "steel", "density_kg_per_m2": 10, "friction": 0, "restitution": 0, "frequency_hz": 349, "decay_per_s": 107, "grain_m": 0.004, "grain_pattern": "regular", "roughness": 0.5},
                {"name": "felt", "density_kg_per_m2": 10, "friction": 0, "restitution": 0}],
  "bodies": [{"name": "floor", "type": "static", "position_m": [4, 1], "mass_kg": 20, "fixtures": [{"shape": "box", "size_m": [8, 0.2], "material": "steel", "camera": true}]},
             {"name": "ball", "position_m": [1, 1.3], "velocity_m_per_s": [0.8, 0], "fixtures": [{"shape": "circle", "radius_m": 0.2, "material": "felt"}]}]})";

TEST_F(MaterialCommand, TexturesOfARenderedScrapeAreThoseOfItsScene) {
    write("ridges.json", ridges);
    runs("render ridges.json --layout phone1 --seconds 3 --limiter off --out scrape.wav");
    const double newtons = 10.0 * 10.0 * 3.14159265 * 0.2 * 0.2;
    const auto outcome =
        runs("material --texture scrape.wav --speed 0.8 --mass 20 --load " + std::to_string(newtons));
    std::istringstream lines{outcome.out};
    std::string header, cell;
    std::getline(lines, header);
    EXPECT_EQ(header, "frequency_hz,decay_per_s,grain_m,roughness,grain_pattern");
    for (const auto& [expected, share] : {std::pair{349.0, 0.02}, {107.0, 0.25}, {0.004, 0.01}, {0.5, 0.1}}) {
        std::getline(lines, cell, ',');
        EXPECT_NEAR(std::stod(cell) / expected, 1.0, share) << outcome.out;
    }
    std::getline(lines, cell);
    EXPECT_EQ(cell, "regular");
    EXPECT_TRUE(has(outcome.err, " grains a second, "));
}

TEST_F(MaterialCommand, ModesAreTheOvertonesOfABody) {
    record("0.1,349,106.99,0.5,0,0\n0.1,610,150,0.25,0,0");
    const auto outcome = runs("material hit.wav --modes 4");
    std::istringstream lines{outcome.out};
    std::string head;
    std::getline(lines, head);
    EXPECT_EQ(head, "frequency_hz,decay_per_s,amplitude");
    for (const auto& [hz, decay, amplitude] : {std::tuple{349.0, 106.99, 1.0}, {610.0, 150.0, 0.5}}) {
        double found[3] = {};
        char comma = 0;
        lines >> found[0] >> comma >> found[1] >> comma >> found[2];
        EXPECT_NEAR(found[0], hz, 0.5);
        EXPECT_NEAR(found[1], decay, 0.02 * decay);
        EXPECT_NEAR(found[2], amplitude, 0.02);
    }
    refuses("material hit.wav --modes 5", 2, "--modes", 2);
}

TEST_F(MaterialCommand, WhatIsNoScrapeIsOneLine) {
    record("0.1,349,106.99,0,0,0");
    refuses("material --texture hit.wav --speed 1", 1, "hit.wav: expected a scrape, found silence", 2);
    record("0.1,349,106.99,0.5,0,0");
    refuses("material --texture hit.wav --speed 1", 1,
            "hit.wav: expected a scrape whose grains stand out or repeat, found none that do", 2);
    refuses("material --texture hit.wav", 2, "--texture and --speed go together", 2);
    refuses("material hit.wav --speed 1", 2, "--texture and --speed go together", 2);
    refuses("material hit.wav --texture hit.wav --speed 1", 2,
            "give either FILE.wav or --list or --texture FILE", 2);
    for (const char* speed : {"0", "-1", "nan", "101", "fast"})
        refuses(std::string{"material --texture hit.wav --speed="} + speed, 2, "--speed", 2);
}

TEST_F(MaterialCommand, BadCallsAreUsageErrors) {
    for (const char* band : {"90", "90-", "1000-90", "-90-100", "a-b", "0-100", "90-90"})
        refuses(std::string{"material a.wav --band="} + band, 2, "--band: expected LO-HI in Hz like 90-1000");
    refuses("material a.wav --rule guess", 2, "--rule");
    refuses("material", 2, "give either FILE.wav or --list");
    refuses("material a.wav --list", 2, "give either FILE.wav or --list");
}

} // namespace physvib::calibrate_command_test
