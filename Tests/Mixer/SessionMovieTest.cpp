// SPDX-License-Identifier: GPL-3.0-or-later
// The last part of what the mixer played as a movie: whole, or not there at all.
#include "Calls/SessionMovie.h"
#include "MixerTesting.h"
#include "Scene/SceneCatalogue.h"

namespace physvib {
namespace {

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

TEST(SessionMovie, ShowsTheLastPartOfASessionWithItsPausesAndScenes) {
    const TestFolder folder;
    Desk desk{onlyNoDevice(), noDevice};
    const auto play = [&](std::int64_t untilNs) {
        return runUntil([&] { return desk.look().session.sessionNs >= untilNs; });
    };
    ASSERT_TRUE(play(400'000'000));
    desk.setSlowness(0);
    ASSERT_TRUE(play(600'000'000));
    desk.change("Scene",
                [](Mix& mix) { mix.scene = std::make_shared<const Scene>(*findBuiltInScene("drop")); });
    desk.setSlowness(1);
    ASSERT_TRUE(play(1'200'000'000));
    const SavedSession session = desk.saved();
    double last = 0.0;
    const auto path = folder("last.webp").getFullPathName().toStdString();
    EXPECT_EQ(writeSessionMovie(session, desk.mix().layout, 1.0, path,
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

TEST(SessionMovie, ACancelledOneLeavesNothing) {
    const TestFolder folder;
    Desk desk{onlyNoDevice(), noDevice};
    ASSERT_TRUE(runUntil([&] { return desk.look().session.sessionNs >= 300'000'000; }));
    const auto path = folder("last.webp").getFullPathName().toStdString();
    for (const double end : {0.0, 0.2, 0.6})
        EXPECT_EQ(writeSessionMovie(desk.saved(), desk.mix().layout, 60.0, path,
                                    [end](double share) { return share < end; }),
                  "cancelled");
    EXPECT_EQ(folder.folder.getNumberOfChildFiles(juce::File::findFilesAndDirectories), 0);
}

} // namespace
} // namespace physvib
