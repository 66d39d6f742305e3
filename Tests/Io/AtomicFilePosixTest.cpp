// SPDX-License-Identifier: MIT
// The same where there are links, pipes, permissions and limits as POSIX has them.
#include "Io/Disk/AtomicFile.h"
#include "Support/FileTesting.h"
#include "Support/FullDisk.h"
#include <csignal>
#include <cstdlib>
#include <sys/stat.h>
#include <unistd.h>

namespace physvib::atomic_file_posix_test {

namespace fs = std::filesystem;
using AtomicFilePosixTest = FolderTest;

/// While it lives, the test is nobody if it was root (who may write everything), and `folder` is its own.
class WithoutRoot {
public:
    explicit WithoutRoot(const fs::path& folder)
        : before_(geteuid()) {
        constexpr uid_t nobody = 65534;
        if (before_ == 0)
            isUser = chown(folder.c_str(), nobody, static_cast<gid_t>(-1)) == 0 && seteuid(nobody) == 0;
    }
    ~WithoutRoot() { isUser = seteuid(before_) == 0; }
    WithoutRoot(const WithoutRoot&) = delete;
    WithoutRoot& operator=(const WithoutRoot&) = delete;

    bool isUser = true;

private:
    uid_t before_;
};

TEST_F(AtomicFilePosixTest, ALinkInTheWayLeadsNowhere) {
    const fs::path left = AtomicFile(folder / "out.csv").temporaryPath();
    put(folder / "victim", "mine");
    fs::create_hard_link(folder / "victim", left);
    EXPECT_EQ(writeFile(folder / "out.csv", "new"), "");
    fs::create_symlink("victim", left);
    EXPECT_TRUE(writeFile(folder / "out.csv", "newer")
                    .starts_with((folder / "out.csv").string() +
                                 ": cannot be written: another program is writing it, or left"));
    EXPECT_EQ(contentOf(folder / "victim"), "mine");
    EXPECT_EQ(contentOf(folder / "out.csv"), "new");
}

TEST_F(AtomicFilePosixTest, ALinkPutInBetweenIsNotWrittenThrough) {
    put(folder / "victim", "mine");
    AtomicFile file(folder / "out.csv");
    fs::remove(file.temporaryPath());
    fs::create_symlink("victim", file.temporaryPath());
    file.write("new");
    EXPECT_EQ(file.commit(), (folder / "out.csv").string() +
                                 ": cannot be written: its temporary file was replaced by another");
    EXPECT_EQ(contentOf(folder / "victim"), "mine");
    EXPECT_FALSE(fs::exists(folder / "out.csv"));
}

TEST_F(AtomicFilePosixTest, ReplacingKeepsPermissions) {
    put(folder / "out.csv", "old");
    fs::permissions(folder / "out.csv", fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(writeFile(folder / "out.csv", "new"), "");
    EXPECT_EQ(contentOf(folder / "out.csv"), "new");
    EXPECT_EQ(fs::status(folder / "out.csv").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFilePosixTest, ALinkIsFollowed) {
    put(folder / "real.csv", "old");
    fs::create_symlink("real.csv", folder / "link.csv");
    EXPECT_EQ(writeFile(folder / "link.csv", "new"), "");
    EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
    EXPECT_EQ(contentOf(folder / "real.csv"), "new");
}

// A pipe of its own stands for all devices: a broken AtomicFile run by root would replace a real one.
TEST_F(AtomicFilePosixTest, FoldersAndPipesAreNotReplaced) {
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    fs::create_directory(folder / "sub");
    for (const fs::path& path : {folder / "sub", folder / "sub/", folder / "pipe", fs::path("")}) {
        const std::string error = writeFile(path, "x");
        EXPECT_TRUE(error.starts_with(path.string() + ": cannot be written: ")) << error;
    }
    EXPECT_TRUE(fs::is_directory(folder / "sub"));
    EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
    EXPECT_EQ(filesInFolder(), 2u);
}

TEST_F(AtomicFilePosixTest, WhatMayNotBeWrittenIsLeftAlone) {
    const WithoutRoot user(folder);
    ASSERT_TRUE(user.isUser);
    put(folder / "mine.csv", "old");
    fs::permissions(folder / "mine.csv", fs::perms::owner_read);
    EXPECT_EQ(writeFile(folder / "mine.csv", "x"),
              (folder / "mine.csv").string() + ": cannot be written: Permission denied");
    EXPECT_EQ(contentOf(folder / "mine.csv"), "old");
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_EQ(writeFile(folder / "new.csv", "x"),
              (folder / "new.csv").string() + ": cannot be written: Permission denied");
    fs::permissions(folder, fs::perms::owner_all);
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFilePosixTest, AFolderThatMayNotBeEnteredIsNotCalledMissing) {
    fs::create_directories(folder / "closed" / "inner");
    fs::permissions(folder / "closed", fs::perms::none);
    std::string error;
    {
        const WithoutRoot user(folder);
        error = writeFile(folder / "closed" / "inner" / "out.csv", "x");
    }
    fs::permissions(folder / "closed", fs::perms::owner_all);
    EXPECT_TRUE(error.ends_with(": cannot be written: Permission denied")) << error;
}

TEST_F(AtomicFilePosixTest, ADiskThatFillsUpLeavesTheOldFile) {
    put(folder / "out.csv", "old");
    std::string error;
    {
        const FileSizeLimit full(1000);
        error = writeFile(folder / "out.csv", std::string(100'000, 'x'));
    }
    EXPECT_EQ(error, (folder / "out.csv").string() + ": cannot be written: File too large");
    EXPECT_EQ(contentOf(folder / "out.csv"), "old");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFilePosixTest, ABufferThatDoesNotFitIsNoticedWhenClosing) {
    std::string error;
    {
        const FileSizeLimit full(10);
        error = writeFile(folder / "out.csv", std::string(100, 'x'));
    }
    EXPECT_NE(error, "");
    EXPECT_EQ(filesInFolder(), 0u);
}

/// Writes three files, puts one in its place, and is ended by a signal.
void endWhileWriting(const fs::path& folder) {
    std::signal(SIGTERM, [](int) {
        removeFilesOnSignal();
        std::_Exit(3);
    });
    AtomicFile first(folder / "a.csv"), second(folder / "b.csv"), third(folder / "done.csv");
    third.write("new");
    if (third.commit().empty()) std::raise(SIGTERM);
}

TEST_F(AtomicFilePosixTest, ASignalThatEndsTheProgramRemovesWhatIsBeingWritten) {
    put(folder / "done.csv", "old");
    EXPECT_EXIT(endWhileWriting(folder), testing::ExitedWithCode(3), "");
    EXPECT_EQ(contentOf(folder / "done.csv"), "new");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFilePosixTest, CommitFailsIfTheTemporaryIsGone) {
    AtomicFile file(folder / "out.csv");
    fs::remove(file.temporaryPath());
    EXPECT_EQ(file.commit(),
              (folder / "out.csv").string() + ": cannot be written: No such file or directory");
    EXPECT_EQ(filesInFolder(), 0u);
}

// Who records reads this at the end, and not that all is well.
TEST_F(AtomicFilePosixTest, WhatOthersDoToAShownFileIsTold) {
    const std::string
        path = (folder / "out.wav").string(),
        gone = path + ": cannot be written: it was removed, moved or replaced while it was being written",
        cut = path + ": cannot be written: another program changed its length while it was being written";
    const auto after = [&](auto act) {
        AtomicFile file(path);
        file.writeAt(0, "begun");
        EXPECT_EQ(file.publish(), "");
        act();
        file.writeAt(5, " and ended");
        return file.commit();
    };
    EXPECT_EQ(after([] {}), "");
    EXPECT_EQ(contentOf(path), "begun and ended");
    EXPECT_EQ(after([&] { fs::remove(path); }), gone);
    EXPECT_EQ(after([&] { fs::rename(path, folder / "kept.wav"); }), gone);
    EXPECT_EQ(contentOf(folder / "kept.wav"), "begun and ended") << "a move loses nothing";
    EXPECT_EQ(after([&] { put(folder / "other", "mine"), fs::rename(folder / "other", path); }), gone);
    EXPECT_EQ(contentOf(path), "mine");
    EXPECT_EQ(after([&] { fs::resize_file(path, 0); }), cut);
    EXPECT_EQ(after([&] { fs::resize_file(path, 1000); }), cut);
    fs::remove(path);
    fs::create_directory(folder / "sub");
    put(folder / "sub" / "real.wav", "old");
    fs::create_symlink("sub/real.wav", path);
    EXPECT_EQ(after([] {}), "") << "through a link";
    EXPECT_EQ(contentOf(folder / "sub" / "real.wav"), "begun and ended");
    EXPECT_EQ(after([&] { fs::remove(folder / "sub" / "real.wav"); }), gone);
}

} // namespace physvib::atomic_file_posix_test
