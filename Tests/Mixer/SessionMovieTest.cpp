// SPDX-License-Identifier: GPL-3.0-or-later
// The last part of what the mixer played as a movie: whole, or not there at all.
#include "Calls/MovieOutput.h"
#include "Mixer/Model/MixerModel.h"
#include "Mixer/Widgets/Cards.h"
#include "Mixer/Window/PageLink.h"
#include "MixerTesting.h"
#include "OnlyScript.h"
#include "Scene/SceneFile.h"
#include "Support/FullDisk.h"
#include <gtest/gtest.h>

namespace physvib::session_movie_test {

using namespace test;

int picturesIn(const juce::File& webp) {
    juce::MemoryBlock bytes;
    webp.loadFileAsData(bytes);
    const std::string_view text{static_cast<const char*>(bytes.getData()), bytes.getSize()};
    if (text.substr(0, 4) != "RIFF" || text.substr(8, 4) != "WEBP") return 0;
    int found = 0;
    for (auto at = text.find("ANMF"); at != std::string_view::npos; at = text.find("ANMF", at + 4)) ++found;
    return found;
}

class SessionMovie : public testing::Test {
protected:
    bool play(std::int64_t untilNs) {
        return runUntil([&] { return model.poll().session.sessionNs >= untilNs; });
    }
    /// More than a second of the first scene.
    SavedSession someSecond() {
        EXPECT_TRUE(play(1'200'000'000));
        return model.savedSession();
    }
    std::string path(const char* name) const { return folder(name).getFullPathName().toStdString(); }
    template <class GoesOn>
    std::string write(const SavedSession& session, double seconds, const std::string& to, GoesOn keepGoing) {
        return writeSessionMovie(session, model.mix().layout, seconds, to, keepGoing);
    }
    int files() const { return folder.folder.getNumberOfChildFiles(juce::File::findFiles); }

    static constexpr auto on = [](double) { return true; };
    const TestFolder folder;
    MixerModel model{onlyNoDevice(), noDevice};
};

TEST_F(SessionMovie, ShowsTheLastPartOfASessionWithItsPausesAndScenes) {
    ASSERT_TRUE(play(400'000'000));
    model.setSlowness(0);
    ASSERT_TRUE(play(600'000'000));
    setScene(model, *findBuiltInScene("drop"));
    model.setSlowness(1);
    ASSERT_TRUE(play(1'200'000'000));
    const SavedSession session = model.savedSession();
    double last = 0.0;
    EXPECT_EQ(write(session, 1.0, path("last.webp"),
                    [&](double share) {
                        EXPECT_GE(share, last - 1e-9);
                        last = share;
                        return true;
                    }),
              "");
    EXPECT_GT(last, 0.9);
    EXPECT_GE(picturesIn(folder("last.webp")), 15) << "twenty a second, but those where nothing is another";
    EXPECT_LE(picturesIn(folder("last.webp")), 22);
}

/// What ffmpeg gets to hear.
struct SessionMovieSound : SessionMovie {
    // the second input becomes the movie
    const OnlyScript ffmpeg{folder, "ffmpeg",
                            "for word; do case $before in -i) sound=$word;; -ac) echo \"$word\" >\"$(dirname "
                            "\"$0\")/channels\";; "
                            "esac; before=$word; done\ncat \"$sound\" >\"$word\"\n"};
    juce::MemoryBlock bytes;
    const float* samplesOf(const SavedSession& session, double seconds) {
        EXPECT_EQ(write(session, seconds, path("last.mp4"), on), "");
        folder("last.mp4").loadFileAsData(bytes);
        const auto expectedSize = 2 * sizeof(float) * static_cast<std::size_t>(48000.0 * seconds);
        EXPECT_EQ(bytes.getSize(), expectedSize);
        bytes.ensureSize(expectedSize, true);
        return static_cast<const float*>(bytes.getData());
    }
};

TEST_F(SessionMovieSound, IsThatOfTheContacts) {
    EXPECT_EQ(movieEnding(), ".mp4");
    const auto* samples = samplesOf(someSecond(), 1.0);
    EXPECT_EQ(folder("programs/channels").loadFileAsString().trim(), "2");
    float most = 0.0f, apart = 0.0f;
    for (int k = 0; k < 48000; ++k) {
        most = std::max(most, std::abs(samples[2 * k]));
        apart = std::max(apart, std::abs(samples[2 * k] - samples[2 * k + 1]));
    }
    EXPECT_GT(most, 0.001f);
    EXPECT_LE(most, 0.1f) << "a full-scale impact is at -20 dB";
    EXPECT_GT(apart, 0.0f) << "left and right";
    EXPECT_EQ(files(), 1) << "no pictures and no sound";
}

TEST_F(SessionMovieSound, OfAPartIsAsStrongAsInTheWhole) {
    SavedSession session = someSecond();
    session.lengthNs = 1'000'000'000;
    session.log.runs.resize(1);
    Scene scene = *session.log.runs[0].scene;
    scene.bodies.clear(), scene.joints.clear(), scene.script.clear();
    session.log.runs[0].scene = std::make_shared<const Scene>(scene);
    auto& method = session.shaping.method;
    method.fixesAmplitude = method.holdsLevel = true, method.fixedAmplitude = 0.5;
    CollisionEvent strike;
    strike.frequencyHz = 200.0, strike.decayPerSecond = 1.0, strike.source.fixture = 0;
    for (const std::int64_t ms : {100, 600})
        strike.timeNs = 1'000'000 * ms, session.log.strikes.push_back(strike);
    const auto* samples = samplesOf(session, 0.5);
    EXPECT_NEAR(*std::max_element(samples, samples + 48000), 0.0197, 0.001) << "what the first leaves";
}

TEST_F(SessionMovie, WithoutFfmpegItIsAWebpAndAFailureLeavesNothing) {
    const auto session = someSecond();
    const auto writeOne = [&] { return write(session, 0.2, path("last.mp4"), on); };
    {
        const OnlyScript other{folder, "another", "exit 0\n"};
        EXPECT_EQ(movieEnding(), ".webp");
        EXPECT_NE(writeOne().find("need the program ffmpeg"), std::string::npos);
    }
    for (const auto& [script, why] :
         {std::pair{"echo No space left on device >&2; exit 1\n", "No space left on device"},
          {"kill -9 $$\n", "it was ended by signal 9"}}) {
        const OnlyScript ill{folder, "ffmpeg", script};
        EXPECT_EQ(writeOne(), path("last.mp4") + ": ffmpeg failed: " + why);
        EXPECT_EQ(files(), 0);
    }
}

TEST_F(SessionMovie, OnAFullDiskItSaysSoByItsOwnNameAndLeavesNothingNew) {
    const auto session = someSecond();
    const OnlyScript ffmpeg{folder, "ffmpeg", "exit 0\n"};
    folder("last.mp4").replaceWithText("an earlier one");
    for (const rlim_t bytes : {1000, 400'000}) { // at the sound, at the pictures
        const FileSizeLimit full{bytes};
        const auto error = write(session, 1.0, path("last.mp4"), on);
        EXPECT_TRUE(error.starts_with(path("last.mp4") + ": cannot be written: ")) << error;
    }
    EXPECT_EQ(folder("last.mp4").loadFileAsString(), "an earlier one");
    EXPECT_EQ(files(), 1);
}

TEST_F(SessionMovie, IsCancelledWhileFfmpegWorks) {
    const auto session = someSecond();
    const OnlyScript ffmpeg{folder, "ffmpeg", "touch \"$(dirname \"$0\")/begun\"\nexec sleep 60\n"};
    const auto begin = juce::Time::getMillisecondCounter();
    EXPECT_EQ(
        write(session, 0.2, path("last.mp4"), [&](double) { return !folder("programs/begun").exists(); }),
        "cancelled");
    EXPECT_LT(juce::Time::getMillisecondCounter() - begin, 20'000u);
    EXPECT_EQ(files(), 0);
}

TEST_F(SessionMovie, ACancelledOneLeavesNothing) {
    ASSERT_TRUE(play(300'000'000));
    for (const double end : {0.0, 0.2, 0.6})
        EXPECT_EQ(
            write(model.savedSession(), 60.0, path("last.webp"), [end](double share) { return share < end; }),
            "cancelled");
    EXPECT_EQ(folder.folder.getNumberOfChildFiles(juce::File::findFilesAndDirectories), 0);
}

// A link holds the world as the page's link.js reads it.

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
    Mix mix = MixerModel::defaultMix();
    EXPECT_EQ(pageLink(mix, *mix.scene).value, "scene=shake-the-box");
    mix.seed = 3;
    mix.law = PanningLaw::energy;
    mix.layout = presetLayout("phone2");
    EXPECT_EQ(pageLink(mix, *findBuiltInScene("marbles")).value,
              "scene=marbles&seed=3&at=0,0.5+1,0.5&law=energy");
}

TEST(PageLink, ASceneOfOnesOwnGoesAlongWhole) {
    const Mix mix = MixerModel::defaultMix();
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
    Mix mix = MixerModel::defaultMix();
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
    const Mix mix = MixerModel::defaultMix();
    Scene own = *mix.scene;
    own.name = "mine";
    for (const Scene& scene : {*mix.scene, own}) {
        const auto link = "http://127.0.0.1:8000/#" + pageLink(mix, scene).value;
        const auto picture = qrPicture(link);
        ASSERT_FALSE(picture.isNull()) << link.size();
        EXPECT_LE(picture.getWidth(), maxPictureSize);
        if (scene.name == own.name) EXPECT_GT(picture.getWidth(), 400) << "three pixels a module";
        EXPECT_EQ(decoded(picture), juce::String{link});
    }
    EXPECT_TRUE(qrPicture(std::string(4000, 'x')).isNull()) << "no code holds so much";
}

} // namespace physvib::session_movie_test
