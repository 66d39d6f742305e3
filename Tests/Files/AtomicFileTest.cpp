// SPDX-License-Identifier: MIT
// A file appears whole or not at all, and nothing is left behind.
#include "Files/Disk/AtomicFile.h"
#include "FileTesting.h"
#include "Files/Disk/ReadFile.h"
#include <csignal>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace physvib {
namespace {

namespace fs = std::filesystem;
using AtomicFileTest = FolderTest;

void put(const fs::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}
std::string contentOf(const fs::path& path) {
    return readFile(path, 1'000'000).value;
}

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

TEST_F(AtomicFileTest, WritesEveryByte) {
    const std::string bytes("a\r\n\0\xff z", 7);
    EXPECT_EQ(writeFile(folder / "new.bin", bytes), "");
    EXPECT_EQ(contentOf(folder / "new.bin"), bytes);
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFileTest, NothingAppearsBeforeCommit) {
    AtomicFile file(folder / "out.wav");
    ASSERT_EQ(file.error(), "");
    EXPECT_EQ(file.temporaryPath().parent_path(), folder);
    EXPECT_TRUE(file.writeAt(4, "les"));
    EXPECT_TRUE(file.writeAt(0, "samp"));
    EXPECT_FALSE(fs::exists(folder / "out.wav"));
    EXPECT_EQ(file.commit(), "");
    EXPECT_EQ(contentOf(folder / "out.wav"), "samples");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFileTest, WithoutCommitTheOldFileStaysAndTheNewOneGoes) {
    put(folder / "out.wav", "old");
    {
        AtomicFile file(folder / "out.wav");
        file.writeAt(0, "half");
        EXPECT_EQ(filesInFolder(), 2u);
    }
    EXPECT_EQ(contentOf(folder / "out.wav"), "old");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFileTest, OnePathHasOneWriterHoweverItIsSpelled) {
    put(folder / "out.csv", "old");
    fs::create_directory(folder / "sub");
    fs::create_symlink("out.csv", folder / "link.csv");
    AtomicFile first(folder / "out.csv");
    for (const fs::path& path : {folder / "out.csv", folder / "sub" / ".." / "out.csv", folder / "link.csv"})
        EXPECT_EQ(writeFile(path, "second"), path.string() + ": cannot be written: it is being written already, here or by another program");
    EXPECT_TRUE(AtomicFile(folder / "out.csv").isTaken());
    first.write("first");
    EXPECT_EQ(first.commit(), "");
    EXPECT_EQ(contentOf(folder / "out.csv"), "first");
    EXPECT_EQ(writeFile(folder / "out.csv", "second"), "") << "and the next one may";
    EXPECT_EQ(filesInFolder(), 3u);
}

TEST_F(AtomicFileTest, WhatAKilledProgramLeftBehindIsRemoved) {
    const fs::path left = AtomicFile(folder / "out.csv").temporaryPath();
    for (int i = 0; i < 3; ++i) { // or a thousand
        put(left, "half");
        ASSERT_EQ(writeFile(folder / "out.csv", "new"), "") << i;
    }
    EXPECT_EQ(contentOf(folder / "out.csv"), "new");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFileTest, ALinkInTheWayLeadsNowhere) {
    const fs::path left = AtomicFile(folder / "out.csv").temporaryPath();
    put(folder / "victim", "mine");
    fs::create_hard_link(folder / "victim", left);
    EXPECT_EQ(writeFile(folder / "out.csv", "new"), "");
    fs::create_symlink("victim", left);
    EXPECT_TRUE(writeFile(folder / "out.csv", "newer").starts_with((folder / "out.csv").string() + ": cannot be written: another program is writing it, or left"));
    EXPECT_EQ(contentOf(folder / "victim"), "mine");
    EXPECT_EQ(contentOf(folder / "out.csv"), "new");
}

TEST_F(AtomicFileTest, ALinkPutInBetweenIsNotWrittenThrough) {
    put(folder / "victim", "mine");
    AtomicFile file(folder / "out.csv");
    fs::remove(file.temporaryPath());
    fs::create_symlink("victim", file.temporaryPath());
    file.write("new");
    EXPECT_EQ(file.commit(), (folder / "out.csv").string() + ": cannot be written: its temporary file was replaced by another");
    EXPECT_EQ(contentOf(folder / "victim"), "mine");
    EXPECT_FALSE(fs::exists(folder / "out.csv"));
}

/// Writes three files, puts one in its place, and is ended by a signal.
void endWhileWriting(const fs::path& folder) {
    std::signal(SIGTERM, [](int) {
        removeAllOnEnd();
        _exit(3);
    });
    AtomicFile first(folder / "a.csv"), second(folder / "b.csv"), third(folder / "done.csv");
    third.write("new");
    if (third.commit().empty()) std::raise(SIGTERM);
}

TEST_F(AtomicFileTest, ASignalThatEndsTheProgramRemovesWhatIsBeingWritten) {
    put(folder / "done.csv", "old");
    EXPECT_EXIT(endWhileWriting(folder), testing::ExitedWithCode(3), "");
    EXPECT_EQ(contentOf(folder / "done.csv"), "new");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFileTest, ReplacingKeepsPermissions) {
    put(folder / "out.csv", "old");
    fs::permissions(folder / "out.csv", fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(writeFile(folder / "out.csv", "new"), "");
    EXPECT_EQ(contentOf(folder / "out.csv"), "new");
    EXPECT_EQ(fs::status(folder / "out.csv").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFileTest, ALinkIsFollowed) {
    put(folder / "real.csv", "old");
    fs::create_symlink("real.csv", folder / "link.csv");
    EXPECT_EQ(writeFile(folder / "link.csv", "new"), "");
    EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
    EXPECT_EQ(contentOf(folder / "real.csv"), "new");
}

TEST_F(AtomicFileTest, MissingFolderIsNamed) {
    EXPECT_FALSE(AtomicFile(folder / "none" / "f").isTaken()) << "nobody else's fault";
    const fs::path path = folder / "absent" / "out.csv";
    EXPECT_EQ(writeFile(path, "x"), path.string() + ": cannot be written: the folder " +
                                        (folder / "absent").string() + " does not exist");
    EXPECT_EQ(filesInFolder(), 0u);
}

// A pipe of its own stands for all devices: a broken AtomicFile run by root would replace a real one.
TEST_F(AtomicFileTest, FoldersAndPipesAreNotReplaced) {
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

TEST_F(AtomicFileTest, WhatMayNotBeWrittenIsLeftAlone) {
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

TEST_F(AtomicFileTest, AFolderThatMayNotBeEnteredIsNotCalledMissing) {
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

TEST_F(AtomicFileTest, ADiskThatFillsUpLeavesTheOldFile) {
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

TEST_F(AtomicFileTest, ABufferThatDoesNotFitIsNoticedWhenClosing) {
    std::string error;
    {
        const FileSizeLimit full(10);
        error = writeFile(folder / "out.csv", std::string(100, 'x'));
    }
    EXPECT_NE(error, "");
    EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(AtomicFileTest, CommitFailsIfTheTemporaryIsGone) {
    AtomicFile file(folder / "out.csv");
    fs::remove(file.temporaryPath());
    EXPECT_EQ(file.commit(),
              (folder / "out.csv").string() + ": cannot be written: No such file or directory");
    EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(AtomicFileTest, RenameRefusedByAFolderThatAppearedLeavesNothing) {
    AtomicFile file(folder / "out.csv");
    fs::create_directory(folder / "out.csv");
    EXPECT_NE(file.commit(), "");
    EXPECT_EQ(filesInFolder(), 1u);
}

} // namespace
} // namespace physvib
