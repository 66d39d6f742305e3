// SPDX-License-Identifier: GPL-3.0-or-later
// Copies of sessions: nothing that was whole goes before what takes its place is whole, whoever is killed
// when. POSIX: fork, FIFOs.
#include "Mixer/Window/MixerFiles.h"
#include "MixerTesting.h"
#include "Support/FileTesting.h"
#include "Support/FullDisk.h"
#include <csignal>
#include <map>
#include <set>
#include <sys/stat.h>
#include <sys/wait.h>

namespace physvib::recovery_copies_posix_test {

namespace fs = std::filesystem;

/// A process that does so much, and then waits until it is killed.
class OtherRun {
public:
    template <class Work>
    explicit OtherRun(Work work) {
        int ready[2];
        EXPECT_EQ(pipe(ready), 0);
        number_ = fork();
        if (number_ == 0) {
            work([&] { EXPECT_EQ(::write(ready[1], "x", 1), 1); });
            for (;;) pause();
        }
        close(ready[1]);
        pipe_ = ready[0];
    }
    ~OtherRun() { killNow(); }
    void wait() {
        char word;
        EXPECT_EQ(read(pipe_, &word, 1), 1);
    }
    void killNow() {
        if (number_ <= 0) return;
        kill(number_, SIGKILL);
        waitpid(number_, nullptr, 0);
        close(pipe_);
        number_ = 0;
    }

private:
    pid_t number_ = 0;
    int pipe_ = -1;
};

class RecoveryCopiesTest : public FolderTest {
protected:
    fs::path copy(const std::string& name) const { return folder / ("recovery-" + name + ".json"); }
    std::size_t copies() const { return RecoveryCopies(folder).abandonedCopies().size(); }
    /// A run that keeps a copy, or forgets it again, and goes on.
    auto keeping(bool forgets) const {
        return [this, forgets](auto ready) {
            RecoveryCopies mine(folder);
            EXPECT_EQ(mine.write("{}"), "");
            if (forgets) mine.discardOwn(); // its lock stays
            ready();
            pause();
        };
    }
};

TEST_F(RecoveryCopiesTest, ACopyIsOfferedOnceItsRunHasEndedHoweverItDid) {
    OtherRun run(keeping(false));
    run.wait();
    EXPECT_EQ(copies(), 0u) << "its run goes on";
    fs::path kept;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".json") kept = entry.path();
    EXPECT_NE(RecoveryCopies::remove(kept), "") << "of another that goes on";
    EXPECT_TRUE(fs::exists(kept));
    run.killNow();
    EXPECT_EQ(copies(), 1u);
    EXPECT_EQ(RecoveryCopies::remove(kept), "");
    EXPECT_EQ(filesInFolder(), 0u) << "its lock goes with it";
}

TEST_F(RecoveryCopiesTest, ANumberOfALivingProcessIsJustAName) {
    put(copy(std::to_string(getpid())), "{}");
    EXPECT_EQ(copies(), 1u);
}

TEST_F(RecoveryCopiesTest, WhatIsGoneOnFromStaysWhileTheDiskIsFull) {
    put(copy("before"), "{\"whole\": 1}");
    RecoveryCopies mine(folder);
    mine.adopt(copy("before"));
    {
        const FileSizeLimit full{4};
        EXPECT_NE(mine.write("{\"whole\": 2}"), "");
    }
    EXPECT_EQ(contentOf(copy("before")), "{\"whole\": 1}");
    EXPECT_TRUE(mine.abandonedCopies().empty()) << "this run has it already";
    EXPECT_EQ(mine.write("{\"whole\": 2}"), "");
    EXPECT_FALSE(fs::exists(copy("before")));
    mine.discardOwn();
    EXPECT_EQ(copies(), 0u);
}

TEST_F(RecoveryCopiesTest, OfTwoThousandOneIsGoneOnFromAndTheOthersStay) {
    for (int k = 0; k < 2000; ++k) put(copy(std::to_string(k)), "{}");
    RecoveryCopies mine(folder);
    const auto found = mine.abandonedCopies();
    ASSERT_EQ(found.size(), 2000u);
    for (std::size_t k = 1; k < found.size(); ++k)
        EXPECT_GE(fs::last_write_time(found[k - 1]), fs::last_write_time(found[k]));
    mine.adopt(found.front());
    EXPECT_EQ(mine.write("{}"), "");
    EXPECT_EQ(mine.abandonedCopies().size(), 1999u);
}

TEST_F(RecoveryCopiesTest, WhatIsNoWholeCopyIsToldAndStays) {
    ASSERT_EQ(mkfifo(copy("pipe").c_str(), 0600), 0);
    ASSERT_EQ(mkfifo((folder / "recovery-cut.lock").c_str(), 0600), 0);
    put(copy("cut"), "{\"physvib_session\": 8, \"takes\": [");
    fs::create_directory(copy("folder"));
    fs::create_symlink("/dev/zero", copy("link"));
    for (const auto& each : RecoveryCopies(folder).abandonedCopies()) {
        const auto session = RecoveryCopies::read(each);
        EXPECT_FALSE(session);
        EXPECT_TRUE(session.error.starts_with(each.string() + ": ")) << session.error;
        EXPECT_EQ(session.error.find('\n'), std::string::npos);
    }
    EXPECT_EQ(copies(), 4u);
}

TEST_F(RecoveryCopiesTest, WhatARunLeavesBeforeItsFirstCopyGoesWithTheNext) {
    put(folder / "recovery-a.lock", "");
    put(folder / "recovery-a.json.physvib.part", "{");
    OtherRun run(keeping(true));
    run.wait();
    EXPECT_EQ(copies(), 0u);
    EXPECT_EQ(filesInFolder(), 1u) << "the lock of the run that goes on";
}

/// What a run is killed in: it goes on from the newest, keeps copies that say so, each of many a page, some
/// of them on a full disk.
void keepCopies(const fs::path& folder, unsigned seed, int run) {
    std::mt19937 random(seed);
    RecoveryCopies mine(folder);
    std::string names = "run" + std::to_string(run) + " ";
    if (const auto found = mine.abandonedCopies(); !found.empty() && random() % 3 != 0) {
        const auto& from = found[random() % found.size()];
        const std::string text = contentOf(from);
        if (!text.ends_with("whole")) return;
        names += text.substr(0, text.find('\n')); // all that it holds is held on
        mine.adopt(from);
    }
    for (;;) {
        std::optional<FileSizeLimit> full;
        if (random() % 4 == 0) full.emplace(random() % 40'000);
        (void)mine.write(names + "\n" + std::string(random() % 60'000, '.') + "whole");
    }
}

// Every name that was once in a whole copy is in one after each kill.
TEST_F(RecoveryCopiesTest, OfTwoHundredKillsNoneLosesWhatWasWhole) {
    std::mt19937 random(1);
    std::set<std::string> known;
    for (int k = 0; k < 200; ++k) {
        {
            const unsigned seed = random();
            OtherRun run([this, seed, k](auto) { keepCopies(folder, seed, k); });
            usleep(random() % 20'000);
        }
        std::set<std::string> held;
        for (const auto& each : RecoveryCopies(folder).abandonedCopies()) {
            const std::string text = contentOf(each);
            EXPECT_TRUE(text.ends_with("whole"));
            std::istringstream names(text.substr(0, text.find('\n')));
            for (std::string name; names >> name;) held.insert(name);
        }
        for (const auto& name : known) ASSERT_TRUE(held.contains(name)) << name << " after kill " << k;
        known = held;
    }
    EXPECT_GT(known.size(), 5u) << "hardly a run has kept anything";
}

class SettingsTest : public FolderTest {
protected:
    fs::path settings() const { return folder / "mixer.settings"; }
    static std::string xml(const std::string& body) {
        return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\n<PROPERTIES>\n" + body + "</PROPERTIES>\n";
    }
    static std::string nested(int deep, const std::string& open, const std::string& close) {
        std::string text;
        for (int k = 0; k < deep; ++k) text += open;
        for (int k = 0; k < deep; ++k) text += close;
        return text;
    }
    juce::File asFile() const { return juce::File{folder.string()}; }
};

TEST_F(SettingsTest, OldOnesLoad) {
    put(settings(), xml("  <VALUE name=\"look\" val=\"light\"/>\n  <VALUE name=\"recent\" val=\"" +
                        folder.string() + "/s&#228;ge.json\"/>\n"));
    put(folder / "s\xc3\xa4ge.json", "{}");
    MixerFiles files{asFile()};
    EXPECT_EQ(files.settingsError(), "");
    EXPECT_EQ(files.settings().getValue("look"), "light");
    EXPECT_EQ(files.recentFiles().getNumFiles(), 1);
}

TEST_F(SettingsTest, WhatCannotBeReadIsPutAsideInOneLine) {
    const std::map<std::string, std::string> bad{
        {"nested", xml("<VALUE name=\"x\">" + nested(300'000, "<a>", "</a>") + "</VALUE>")},
        {"nested, small", xml("<VALUE name=\"x\">" + nested(20'000, "<a>", "</a>") + "</VALUE>")},
        {"cut", xml("").substr(0, 50)},
        {"empty", ""},
        {"entities", "<?xml version=\"1.0\"?><!DOCTYPE x [<!ENTITY a \"aaaa\">]><PROPERTIES/>"},
        {"another's", "<?xml version=\"1.0\"?><svg/>"},
        {"long", xml("<VALUE name=\"x\" val=\"" + std::string(1u << 20, 'a') + "\"/>")},
    };
    for (const auto& [name, text] : bad) {
        put(settings(), text);
        MixerFiles files{asFile()};
        EXPECT_TRUE(files.settingsError().starts_with(settings().string() + ": "))
            << name << ": " << files.settingsError();
        EXPECT_EQ(files.settingsError().find('\n'), std::string::npos);
        EXPECT_EQ(fs::file_size(folder / "mixer.settings.unread"), text.size()) << name;
        files.settings().setValue("look", "light");
        EXPECT_TRUE(files.settings().save());
        EXPECT_EQ(MixerFiles{asFile()}.settings().getValue("look"), "light") << name;
    }
}

TEST_F(SettingsTest, APipeIsPutAsideAndNotWaitedFor) {
    ASSERT_EQ(mkfifo(settings().c_str(), 0600), 0);
    MixerFiles files{asFile()};
    EXPECT_NE(files.settingsError().find("expected a regular file"), std::string::npos)
        << files.settingsError();
    EXPECT_FALSE(fs::exists(settings()));
}

TEST_F(SettingsTest, AValueOfTagsIsNotReadAgainWhenItIsWritten) {
    put(settings(), xml("<VALUE name=\"x\" val=\" " + nested(25'000, "&lt;a>", "") +
                        "\"/><VALUE name=\"look\" val=\"light\"/>"));
    MixerFiles files{asFile()};
    files.settings().setValue("hint-seen", true);
    EXPECT_TRUE(files.settings().save());
    EXPECT_EQ(files.settings().getValue("look"), "light");
}

TEST_F(SettingsTest, TheExposureOfAnotherDayIsNotTodays) {
    MixerFiles files{asFile()};
    files.setExposureToday(2.5, true);
    const auto kept = files.settings().getValue("exposure"); // "2...-..-.. 2.5"
    ASSERT_TRUE(kept.startsWith("2") && kept.endsWith(" 2.5")) << kept;
    files.settings().setValue("exposure", "1" + kept.substring(1));
    EXPECT_EQ(files.exposureToday(), 0.0);
}

} // namespace physvib::recovery_copies_posix_test
