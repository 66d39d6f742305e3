// SPDX-License-Identifier: MIT
// A file is read whole, up to a limit, or the reason is named.
#include "Io/Disk/ReadFile.h"
#include "Io/Disk/AtomicFile.h"
#include "Support/FileTesting.h"

namespace physvib {
namespace {

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
TEST_F(ReadFileTest, EndsAtTheLimitOfAnEndlessDevice) { EXPECT_FALSE(readFile("/dev/zero", 1'000'000)); }
#endif

TEST_F(ReadFileTest, NamesAMissingFile) {
    EXPECT_EQ(readFile(folder / "no.txt", 10).error,
              (folder / "no.txt").string() + ": cannot be read: No such file or directory");
}

TEST_F(ReadFileTest, NamesAFolder) {
    const std::string error = readFile(folder, 10).error; // the reason is the system's
    EXPECT_TRUE(error.starts_with(folder.string() + ": cannot be read: ")) << error;
}

} // namespace
} // namespace physvib
