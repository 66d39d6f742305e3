// SPDX-License-Identifier: GPL-3.0-or-later
// What a message may have read, and what a saved session says of a clip that has changed.
#include "Host/Recordings/ClipFolder.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace physvib {
namespace {

namespace fs = std::filesystem;

constexpr const char* knock = R"({"perceptions": [{"perception_modality": "Vibrotactile", "channels": [{"bands": [{"band_type": "VectorialWave", "effects": [{"effect_type": "Basis", "keyframes": [
    {"relative_position": 0, "amplitude_modulation": 0.5, "frequency_modulation": 100}, {"relative_position": 100, "amplitude_modulation": 0}]}]}]}]}]})";

struct ClipFolderTest : testing::Test {
    fs::path top = fs::path{testing::TempDir()} / "clip-folder", folder = top / "clips";
    void SetUp() override {
        fs::remove_all(top);
        fs::create_directories(folder / "more");
        for (const fs::path& path : {top / "outside.hjif", folder / "a.hjif", folder / "more" / "b.hjif"}) std::ofstream{path} << knock;
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

TEST_F(ClipFolderTest, ReadsNothingElse) {
    const ClipFolder clips{folder};
    for (const std::string& name : std::vector<std::string>{"../outside.hjif", "link.hjif", (folder / "a.hjif").string(), "/etc/passwd", "", "more/../../outside.hjif"}) {
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
    EXPECT_EQ(loadKeptClips(kept).error, "");
    EXPECT_EQ(loadKeptClips(kept).value, clip.value.channels);
    kept.push_back({kept[0].file, 1});
    EXPECT_NE(loadKeptClips(kept).error.find("expected at least 2 channels, found 1"), std::string::npos);
    kept.pop_back();
    std::ofstream{folder / "a.hjif", std::ios::app} << ' ';
    EXPECT_NE(loadKeptClips(kept).error.find("it has changed since"), std::string::npos);
    fs::remove(folder / "a.hjif");
    EXPECT_NE(loadKeptClips(kept).error.find("a.hjif"), std::string::npos);
}

} // namespace
} // namespace physvib
