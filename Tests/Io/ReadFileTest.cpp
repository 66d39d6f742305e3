// SPDX-License-Identifier: MIT
// A file is read whole, up to a limit, or the reason is named.
#include "Io/Disk/ReadFile.h"
#include "Io/Disk/AtomicFile.h"
#include "Support/FileTesting.h"
#if !defined(_WIN32)
#include <csignal>
#include <sys/stat.h>
#include <thread>
#endif

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
            const OpenFile pipe{std::fopen(path.c_str(), "wb")};
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
        const OpenFile pipe{std::fopen(path.c_str(), "wb")};
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

} // namespace
} // namespace physvib
