// SPDX-License-Identifier: MIT
// Paths are compared by what they are.
#include "Io/Disk/FileClash.h"
#include "Support/FileTesting.h"
#include <fstream>
#include <vector>

namespace physvib {
namespace {

namespace fs = std::filesystem;

struct FileClash : FolderTest {
    void SetUp() override {
        FolderTest::SetUp();
        std::ofstream{folder / "there.json"} << "{}";
        fs::create_directory(folder / "sub");
        fs::create_directory_symlink("sub", folder / "other");
        fs::create_symlink("there.json", folder / "link.json");
        fs::create_hard_link(folder / "there.json", folder / "hard.json");
    }
    bool same(const char* a, const char* b) const { return isSameFile(folder / a, folder / b); }
};

TEST_F(FileClash, FilesThatAreThereAreComparedByTheSystem) {
    for (const char* spelling :
         {"there.json", "./there.json", "sub/../there.json", "sub//..//there.json", "link.json", "hard.json"})
        EXPECT_TRUE(same("there.json", spelling)) << spelling;
    EXPECT_FALSE(same("there.json", "sub"));
    EXPECT_FALSE(same("there.json", "new.json"));
    EXPECT_FALSE(same("there.json", "sub/there.json"));
}

TEST_F(FileClash, NewFilesAreComparedByFolderAndName) {
    EXPECT_TRUE(same("sub/new.json", "other/new.json"));
    EXPECT_TRUE(same("new.json", "sub/../new.json"));
    EXPECT_FALSE(same("new.json", "sub/new.json"));
    EXPECT_FALSE(same("sub/new.json", "sub/newer.json"));
    EXPECT_FALSE(same("nowhere/new.json", "nothing/new.json"));
    const auto before = fs::current_path();
    fs::current_path(folder);
    EXPECT_TRUE(isSameFile("new.json", folder / "new.json"));
    fs::current_path(before);
}

TEST_F(FileClash, IsToldWithBothSpellings) {
    const std::string there = folder / "there.json", link = folder / "link.json", out = folder / "out.wav",
                      again = folder / "sub/../out.wav";
    const auto clash = [](std::vector<std::string> outputs, std::vector<std::string> inputs) {
        return fileClash(outputs, inputs);
    };
    EXPECT_EQ(clash({out, "", there}, {"", link}),
              there + ": expected another file to write, this is the input " + link);
    EXPECT_EQ(clash({out, "", again}, {link}),
              again + ": expected another file to write, this is the output " + out);
    EXPECT_EQ(clash({out, "", there}, {"", "phone4", "0.5"}), "");
}

} // namespace
} // namespace physvib
