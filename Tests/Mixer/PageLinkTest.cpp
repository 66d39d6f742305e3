// SPDX-License-Identifier: GPL-3.0-or-later
// A link holds the world as the page's link.js reads it.
#include "Mixer/Window/PageLink.h"
#include "Mixer/Model/MixerModel.h"
#include "Mixer/Widgets/Cards.h"
#include "MixerTesting.h"
#include "OnlyScript.h"
#include "Scene/SceneFile.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

/// As the page unpacks it.
std::string unpacked(const juce::String& code) {
    auto text = code.replaceCharacters("-_", "+/");
    while (text.length() % 4 != 0) text += "=";
    juce::MemoryOutputStream bytes;
    EXPECT_TRUE(juce::Base64::convertFromBase64(bytes, text));
    juce::MemoryInputStream in{bytes.getData(), bytes.getDataSize(), false};
    juce::GZIPDecompressorInputStream deflated{&in, false, juce::GZIPDecompressorInputStream::deflateFormat};
    return deflated.readEntireStreamAsString().toStdString();
}

TEST(PageLink, ABuiltInSceneIsItsNameAndOnlyWhatDiffersIsSaid) {
    Mix mix = MixerModel::firstMix();
    EXPECT_EQ(pageLink(mix, *mix.scene).value, "scene=shake-the-box");
    mix.seed = 3;
    mix.law = PanningLaw::energy;
    mix.layout = presetLayout("phone2");
    EXPECT_EQ(pageLink(mix, *findBuiltInScene("marbles")).value,
              "scene=marbles&seed=3&at=0,0.5+1,0.5&law=energy");
}

TEST(PageLink, ASceneOfOnesOwnGoesAlongWhole) {
    const Mix mix = MixerModel::firstMix();
    Scene own = *mix.scene;
    own.name = "my scene & more";
    own.materials[0].frequencyHz = 165.0;
    own.materials[0].decayPerSecond = 22.0;
    const auto link = pageLink(mix, own);
    ASSERT_TRUE(link) << link.error;
    const auto words = juce::StringArray::fromTokens(juce::String{link.value}, "&", {});
    ASSERT_EQ(words.size(), 2);
    EXPECT_EQ(words[0], "scene=my+scene+%26+more.json");
    ASSERT_TRUE(words[1].startsWith("file="));
    EXPECT_TRUE(words[1].substring(5).containsOnly(
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"));
    EXPECT_EQ(unpacked(words[1].substring(5)), sceneJson(own));
    EXPECT_LT(link.value.size(), 2900U) << "small enough for a QR code";
}

TEST(PageLink, ABrowserGetsTheLinkToTheLetterAndAShellNothing) {
    const test::TestFolder folder;
    const test::OnlyScript browser{folder, "xdg-open",
                                   "printf %s \"$1\" >\"$0.part\"; mv \"$0.part\" \"$0.got\"\n"};
    const auto got = folder("programs/xdg-open.got");
    const juce::String link{"http://127.0.0.1:8000/#scene=my+scene+%26.json&file=rVVd-_&at=0,1+1,1"};
    for (const auto& [opened, expected] :
         {std::pair{link, link},
          {juce::String{"http://a/`b` $(c)\"\\#d=1"}, juce::String{"http://a/%60b%60%20%24(c)%22%5C#d=1"}}}) {
        got.deleteFile();
        openLink(opened);
        ASSERT_TRUE(test::runUntil([&] { return got.existsAsFile(); }));
        EXPECT_EQ(got.loadFileAsString(), expected);
    }
}

TEST(PageLink, AnAddressOfThisComputerAloneIsKnown) {
    for (const char* alone : {"http://127.0.0.1:8000/", "http://localhost/", "https://[::1]:80/"})
        EXPECT_TRUE(isLoopback(alone)) << alone;
    for (const char* reached : {"http://192.168.1.5:8000/", "https://example.org/127."})
        EXPECT_FALSE(isLoopback(reached)) << reached;
}

TEST(PageLink, WhatALinkCannotHoldIsSaid) {
    Mix mix = MixerModel::firstMix();
    mix.exponent = 2.0;
    EXPECT_NE(pageLink(mix, *mix.scene).error.find("exponent"), std::string::npos);
    mix.exponent = 1.0;
    mix.layout = presetLayout("vest16");
    EXPECT_EQ(pageLink(mix, *mix.scene).error, "A link holds at most 8 actuators, found 16");
}

/// What a reader of QR codes finds in the picture.
juce::String decoded(const juce::Image& picture) {
    test::TestFolder folder;
    const auto file = folder("code.png");
    juce::FileOutputStream out{file};
    juce::PNGImageFormat{}.writeImageToStream(picture, out);
    out.flush();
    juce::ChildProcess reader;
    if (!reader.start(juce::StringArray{"zbarimg", "--quiet", "--raw", file.getFullPathName()},
                      juce::ChildProcess::wantStdOut))
        return {};
    return reader.readAllProcessOutput().trim();
}

TEST(PageLink, AsAQrCodeItIsReadByOthers) {
    if (juce::ChildProcess reader; !reader.start("zbarimg --version") ||
                                   !reader.waitForProcessToFinish(5000) || reader.getExitCode() != 0)
        GTEST_SKIP() << "needs the package zbar-tools";
    const Mix mix = MixerModel::firstMix();
    Scene own = *mix.scene;
    own.name = "mine";
    for (const Scene& scene : {*mix.scene, own}) {
        const auto link = "http://127.0.0.1:8000/#" + pageLink(mix, scene).value;
        const auto picture = qrPicture(link);
        ASSERT_FALSE(picture.isNull()) << link.size();
        EXPECT_LE(picture.getWidth(), mostPicture);
        if (scene.name == own.name) EXPECT_GT(picture.getWidth(), 400) << "three pixels a module";
        EXPECT_EQ(decoded(picture), juce::String{link});
    }
    EXPECT_TRUE(qrPicture(std::string(4000, 'x')).isNull()) << "no code holds so much";
}

} // namespace
} // namespace physvib
