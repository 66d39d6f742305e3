// SPDX-License-Identifier: MIT
// A file appears whole or not at all, and nothing is left behind.
#include "Io/Disk/AtomicFile.h"
#include "Support/FileTesting.h"

namespace physvib {
namespace {

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

} // namespace
} // namespace physvib
