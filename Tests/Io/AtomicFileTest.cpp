// SPDX-License-Identifier: MIT
// A file appears whole or not at all, and nothing is left behind.
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ReadFile.h"
#include "Support/FileTesting.h"
#if !defined(_WIN32)
#include <csignal>
#include <sys/stat.h>
#include <thread>
#endif

namespace physvib::atomic_file_test {

namespace fs = std::filesystem;
using AtomicFileTest = FolderTest;

TEST_F(AtomicFileTest, WritesEveryByte) {
    const std::string bytes("a\r\n\0\xff z", 7);
    EXPECT_EQ(writeFile(folder / "new.bin", bytes), "");
    EXPECT_EQ(contentOf(folder / "new.bin"), bytes);
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFileTest, NamesAreWrittenInAnyAlphabet) {
    const fs::path path = folder / fs::path(u8"K\u00f6rper \u03c4 \uc9c4\ub3d9.csv");
    EXPECT_EQ(writeFile(path, "bytes"), "");
    EXPECT_EQ(contentOf(path), "bytes");
    EXPECT_EQ(fs::directory_iterator(folder)->path(), path);
}

TEST_F(AtomicFileTest, AFolderIsNotReplaced) {
    fs::create_directory(folder / "sub");
    for (const fs::path& path : {folder / "sub", folder / "sub/", fs::path("")})
        EXPECT_TRUE(writeFile(path, "x").starts_with(path.string() + ": cannot be written: "));
    EXPECT_TRUE(fs::is_directory(folder / "sub"));
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
    std::vector<fs::path> spellings{folder / "out.csv", folder / "sub" / ".." / "out.csv"};
    std::error_code hasNoLinks; // Wine
    if (fs::create_symlink("out.csv", folder / "link.csv", hasNoLinks); !hasNoLinks)
        spellings.push_back(folder / "link.csv");
    AtomicFile first(folder / "out.csv");
    for (const fs::path& path : spellings)
        EXPECT_EQ(writeFile(path, "second"),
                  path.string() +
                      ": cannot be written: it is being written already, here or by another program");
    first.write("first");
    EXPECT_EQ(first.commit(), "");
    EXPECT_EQ(contentOf(folder / "out.csv"), "first");
    EXPECT_EQ(writeFile(folder / "out.csv", "second"), "") << "and the next one may";
    EXPECT_EQ(filesInFolder(), spellings.size());
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

TEST_F(AtomicFileTest, MissingFolderIsNamed) {
    const fs::path path = folder / "absent" / "out.csv";
    EXPECT_EQ(writeFile(path, "x"), path.string() + ": cannot be written: the folder " +
                                        (folder / "absent").string() + " does not exist");
    EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(AtomicFileTest, RenameRefusedByAFolderThatAppearedLeavesNothing) {
    AtomicFile file(folder / "out.csv");
    fs::create_directory(folder / "out.csv");
    EXPECT_NE(file.commit(), "");
    EXPECT_EQ(filesInFolder(), 1u);
}

// A file is read whole, up to a limit, or the reason is named.

using ReadFileTest = FolderTest;

TEST_F(ReadFileTest, GivesEveryByteAcrossItsBlocks) {
    std::mt19937 random(2);
    std::string bytes(200'000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random() & 0xff);
    ASSERT_EQ(writeFile(folder / "a.bin", bytes), "");
    const Result<std::string> read = readFile(folder / "a.bin", bytes.size());
    EXPECT_EQ(read.error, "");
    EXPECT_TRUE(read.value == bytes);
}

TEST_F(ReadFileTest, RefusesAFileAboveTheLimit) {
    ASSERT_EQ(writeFile(folder / "a.txt", "12345"), "");
    const Result<std::string> read = readFile(folder / "a.txt", 4);
    EXPECT_FALSE(read);
    EXPECT_EQ(read.error, (folder / "a.txt").string() + ": expected at most 4 bytes, found more");
    EXPECT_EQ(read.value, "");
}

#if !defined(_WIN32)
TEST_F(ReadFileTest, RefusesWhatMayNeverEndBeforeItReads) {
    for (const char* device : {"/dev/zero", "/dev/full", "/dev/null", "/dev"})
        EXPECT_EQ(readFile(device, 1'000'000).error,
                  std::string(device) +
                      ": cannot be read: expected a file or a pipe, found a folder or a device");
}

TEST_F(ReadFileTest, ReadsAPipeToItsEndHoweverLateItBegins) {
    const std::string path = (folder / "pipe").string();
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    for (const int ms : {0, 300}) {
        std::thread writer{[&] { // as `slow command | cat >pipe`
            const FileHandle pipe{std::fopen(path.c_str(), "wb")};
            std::this_thread::sleep_for(std::chrono::milliseconds{ms});
            for (int k = 0; k < 30'000; ++k) std::fputs("line\n", pipe.get());
        }};
        const auto read = readFile(path, 1'000'000);
        writer.join();
        EXPECT_EQ(read.error, "");
        EXPECT_EQ(read.value.size(), 150'000U);
        EXPECT_TRUE(read.value.starts_with("line\nline\n"));
    }
    EXPECT_EQ(readFile(path, 1'000'000).error, path + ": cannot be read: no program writes to this pipe");
}

TEST_F(ReadFileTest, EndsAtTheLimitOfAPipeWithoutEnd) {
    const std::string path = (folder / "pipe").string();
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    std::thread writer{[&] {
        std::signal(SIGPIPE, SIG_IGN);
        const FileHandle pipe{std::fopen(path.c_str(), "wb")};
        const std::string block(100'000, 'x');
        while (std::fwrite(block.data(), 1, block.size(), pipe.get()) == block.size()) {
        }
    }};
    const auto read = readFile(path, 10 * maxPipeBytes);
    writer.join();
    EXPECT_EQ(read.error, path + ": expected at most " + std::to_string(maxPipeBytes) + " bytes, found more");
}
#endif

TEST_F(ReadFileTest, NamesAMissingFile) {
    EXPECT_EQ(readFile(folder / "no.txt", 10).error,
              (folder / "no.txt").string() + ": cannot be read: No such file or directory");
}

TEST_F(ReadFileTest, NamesAFolder) {
    const std::string error = readFile(folder, 10).error; // the reason is the system's
    EXPECT_TRUE(error.starts_with(folder.string() + ": cannot be read: ")) << error;
}

} // namespace physvib::atomic_file_test
