// SPDX-License-Identifier: GPL-3.0-or-later
// What a message may have read, and what a saved session says of a clip that has changed.
#include "Formats/ClipFile.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/ReadFile.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Live/Recordings/ReadRecording.h"
#include "Support/WavBytes.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace physvib::clip_folder_test {

namespace fs = std::filesystem;

constexpr const char* knock =
    R"({"perceptions": [{"perception_modality": "Vibrotactile", "channels": [{"bands": [{"band_type": "VectorialWave", "effects": [{"effect_type": "Basis", "keyframes": [
    {"relative_position": 0, "amplitude_modulation": 0.5, "frequency_modulation": 100}, {"relative_position": 100, "amplitude_modulation": 0}]}]}]}]}]})";

struct ClipFolderTest : testing::Test {
    // Each test has its own: they run side by side.
    fs::path top =
        fs::path{testing::TempDir()} /
        (std::string{"clip-folder-"} + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::path folder = top / "clips";
    void SetUp() override {
        fs::remove_all(top);
        fs::create_directories(folder / "more");
        for (const fs::path& path : {top / "outside.hjif", folder / "a.hjif", folder / "more" / "b.hjif"})
            std::ofstream{path} << knock;
        fs::create_symlink(top / "outside.hjif", folder / "link.hjif");
    }
    void TearDown() override { fs::remove_all(top); }
};

TEST_F(ClipFolderTest, ReadsWhatLiesBelowIt) {
    const ClipFolder clips{folder};
    for (const std::string name : {"a.hjif", "more/b.hjif", "more/../a.hjif"}) {
        const auto clip = clips(name);
        ASSERT_EQ(clip.error, "") << name;
        ASSERT_EQ(clip.value.channels.size(), 1u);
        EXPECT_EQ(clip.value.channels[0].samples.size(), 4800u);
        EXPECT_EQ(clip.value.channels[0].file.hash.size(), 16u);
    }
}

/// What each part of a clip is where it is read by itself.
void expectTheSameInParts(const fs::path& path, const std::vector<ActuatorPlace>& shares) {
    const auto clip = loadWholeClip(path);
    ASSERT_EQ(clip.error, "") << path;
    const auto sound = readRecording(path);
    const std::string hash = contentHash(readFile(path, 1'000'000).value);
    std::vector<ContactRecording> channels;
    for (const auto& samples : sound.value.channels)
        channels.push_back({0.0, sound.value.sampleRateHz, samples, {.path = path.string(), .hash = hash}});
    EXPECT_EQ(clip.value.channels, channels) << path;
    ASSERT_EQ(clip.value.places.size(), shares.size()) << path;
    for (std::size_t j = 0; j < shares.size(); ++j) {
        EXPECT_NEAR(clip.value.places[j].xMetres, shares[j].xMetres, 1e-12) << path;
        EXPECT_NEAR(clip.value.places[j].yMetres, shares[j].yMetres, 1e-12) << path;
    }
}

TEST_F(ClipFolderTest, SamplesHashAndPlacesAreThoseOfTheFile) {
    const auto channelAt = [](std::optional<ActuatorPlace> place, double hz) {
        return ClipChannel{
            .label = "A",
            .place = place,
            .bands = {{{{.amplitude = {{0.0, 0.5}, {0.1, 0.0}}, .frequencyHz = {{0.0, hz}}}}}}};
    };
    const Clip placed{
        "",
        0.2,
        0.1,
        {channelAt(ActuatorPlace{0.05, 0.1}, 100.0), channelAt(ActuatorPlace{0.2, 0.0}, 150.0)}};
    Clip half = placed;
    half.channels[1].place.reset();
    for (const auto& [name, clip] : {std::pair{"placed.hjif", placed}, {"half.hjif", half}})
        std::ofstream{folder / name} << clipBytes(clip, ClipFormat::hjif);
    std::ofstream{folder / "sampled.wav", std::ios::binary} << test::wavBytes({.channels = 2}, "abcdefgh");
    expectTheSameInParts(folder / "placed.hjif", {{0.25, 1.0}, {1.0, 0.0}});
    expectTheSameInParts(folder / "half.hjif", {});
    expectTheSameInParts(folder / "a.hjif", {});
    expectTheSameInParts(folder / "sampled.wav", {});
}

std::string floatWav(const std::vector<float>& samples) {
    return test::wavBytes({.format = 3, .channels = 1, .rateHz = 8000, .bits = 32},
                          {reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(float)});
}

TEST_F(ClipFolderTest, WhatWouldHoldACoilAtDirectCurrentIsTakenAwayAndTold) {
    std::vector<float> tone(8000), offset(8000);
    for (std::size_t n = 0; n < tone.size(); ++n) {
        tone[n] = 0.5f * std::sin(0.16f * static_cast<float>(n));
        offset[n] = tone[n] + 0.25f;
    }
    std::ofstream{folder / "tone.wav", std::ios::binary} << floatWav(tone);
    std::ofstream{folder / "offset.wav", std::ios::binary} << floatWav(offset);
    std::ofstream{folder / "constant.wav", std::ios::binary} << floatWav(std::vector<float>(8000, 1.0f));
    constexpr const char* slow =
        R"({"perceptions": [{"perception_modality": "Vibrotactile", "channels": [{"bands": [{"band_type": "VectorialWave", "effects": [{"effect_type": "Basis", "keyframes": [
        {"relative_position": 0, "amplitude_modulation": 1, "frequency_modulation": 1}, {"relative_position": 10000, "amplitude_modulation": 1}]}]}]}]}]})";
    std::ofstream{folder / "slow.hjif"} << slow;
    const auto load = [&](const char* name) { return loadWholeClip(folder / name).value.channels.at(0); };
    EXPECT_EQ(load("tone.wav").samples, tone) << "to the bit";
    EXPECT_EQ(load("tone.wav").note, "");
    const auto without = load("offset.wav"), nothing = load("constant.wav"), drawn = load("slow.hjif");
    for (std::size_t n = 0; n < tone.size(); ++n) ASSERT_NEAR(without.samples[n], tone[n], 0.01);
    EXPECT_EQ(without.note, (folder / "offset.wav").string() +
                                ": what lies below 5 Hz is not played: a mean of 0.25, of full scale");
    EXPECT_TRUE(std::ranges::all_of(nothing.samples, [](float x) { return x == 0.0f; }));
    EXPECT_NE(nothing.note.find("a mean of 1.00"), std::string::npos);
    for (std::size_t n = drawn.samples.size() / 10; n < drawn.samples.size() * 9 / 10; ++n)
        ASSERT_LT(std::abs(drawn.samples[n]), 0.04);
    EXPECT_NE(drawn.note.find("up to 0.9"), std::string::npos) << drawn.note;
}

TEST_F(ClipFolderTest, WhatCannotBeReadIsToldAsByReadRecording) {
    std::ofstream{folder / "broken.hjif"} << "{";
    std::ofstream{folder / "large.hjif"};
    fs::resize_file(folder / "large.hjif", 24'000'001);
    std::ofstream{folder / "broken.wav"} << "RIFF";
    fs::create_directory(folder / "folder.hjif");
    for (const char* name : {"broken.hjif", "large.hjif", "broken.wav", "folder.hjif", "no.hjif", "no.wav"}) {
        EXPECT_NE(loadWholeClip(folder / name).error, "") << name;
        EXPECT_EQ(loadWholeClip(folder / name).error, readRecording(folder / name).error);
    }
}

TEST_F(ClipFolderTest, ReadsNothingElse) {
    const ClipFolder clips{folder};
    for (const std::string& name :
         std::vector<std::string>{"../outside.hjif", "link.hjif", (folder / "a.hjif").string(), "/etc/passwd",
                                  "", "more/../../outside.hjif"}) {
        const auto clip = clips(name);
        EXPECT_FALSE(clip) << name;
        EXPECT_NE(clip.error.find("or below"), std::string::npos) << clip.error;
    }
    EXPECT_FALSE(clips("no.hjif"));
    EXPECT_FALSE(clips("more"));
    EXPECT_NE(ClipFolder{top / "gone"}("a.hjif").error.find("expected a folder of clips"), std::string::npos);
}

TEST_F(ClipFolderTest, AClipThatHasChangedIsNotTheOneThatWasFelt) {
    const auto clip = ClipFolder{folder}("a.hjif");
    std::vector<ClipFile> kept{{clip.value.channels.at(0).file, 0}};
    EXPECT_EQ(loadSessionClips(kept).error, "");
    EXPECT_EQ(loadSessionClips(kept).value, clip.value.channels);
    kept.push_back({kept[0].file, 1});
    EXPECT_NE(loadSessionClips(kept).error.find("expected at least 2 channels, found 1"), std::string::npos);
    kept.pop_back();
    std::ofstream{folder / "a.hjif", std::ios::app} << ' ';
    EXPECT_NE(loadSessionClips(kept).error.find("it has changed since"), std::string::npos);
    fs::remove(folder / "a.hjif");
    EXPECT_NE(loadSessionClips(kept).error.find("a.hjif"), std::string::npos);
}

} // namespace physvib::clip_folder_test
