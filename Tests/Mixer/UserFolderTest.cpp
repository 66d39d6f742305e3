// SPDX-License-Identifier: GPL-3.0-or-later
// Where recordings and documents go, in homes with and without documents.
#include "Mixer/Model/MixerRecording.h"
#include "MixerTesting.h"
#include <cstdlib>

namespace physvib {
namespace {

using namespace test;

/// Another home folder for the test.
class Home {
public:
    explicit Home(const juce::File& home)
        : before_{juce::SystemStats::getEnvironmentVariable("HOME", {})} {
        setenv("HOME", home.getFullPathName().toRawUTF8(), 1);
    }
    ~Home() { setenv("HOME", before_.toRawUTF8(), 1); }

private:
    juce::String before_;
};

TEST(UserFolder, IsInTheDocumentsOrTheHomeAndCreatedWhenItIsNeeded) {
    TestFolder home;
    const Home here{home.folder};
    const UserFolder folder;
    const auto documents = home("Documents/PhysVib");
    EXPECT_EQ(folder.place(), documents);
    EXPECT_FALSE(documents.exists()) << "asked for, not used";
    EXPECT_EQ(folder.make().value, documents);
    EXPECT_TRUE(documents.isDirectory());
    documents.getParentDirectory().deleteRecursively();
    home("Documents").replaceWithText("a file");
    EXPECT_EQ(folder.make().value, home("PhysVib"));
    EXPECT_TRUE(home("PhysVib").isDirectory());
}

TEST(UserFolder, WhereNothingCanBeWrittenItSaysSo) {
    TestFolder home;
    home("no").replaceWithText("a file");
    const Home here{home("no")};
    UserFolder folder;
    EXPECT_EQ(folder.place(), juce::File{});
    EXPECT_NE(folder.make().error.find("no/Documents/PhysVib: expected a folder that can be written"),
              std::string::npos)
        << folder.make().error;
    folder.choose(home("chosen"));
    EXPECT_EQ(folder.make().value, home("chosen"));
    folder.choose(home("no/such"));
    EXPECT_FALSE(folder.fresh("take", {".wav"}));
}

TEST(UserFolder, NothingIsOverwritten) {
    TestFolder home;
    UserFolder folder;
    folder.choose(home.folder);
    const juce::StringArray endings{".wav", ".csv"};
    EXPECT_EQ(folder.fresh("take", endings).value, home("take.wav"));
    home("take.csv").replaceWithText("events of another take");
    EXPECT_EQ(folder.fresh("take", endings).value, home("take-2.wav"));
    home("take-2.wav").replaceWithText("a take");
    EXPECT_EQ(folder.fresh("take", endings).value, home("take-3.wav"));
}

} // namespace
} // namespace physvib
