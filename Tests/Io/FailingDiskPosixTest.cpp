// SPDX-License-Identifier: MIT
// No write, flush or rename that fails is told as saved, and no file is left half.
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Text/CsvTable.h"
#include "Support/FailingDisk.h"
#include "Support/FileTesting.h"
#include <fstream>
#include <vector>

namespace physvib::failing_disk_posix_test {

using namespace test;

class FailingDisks : public FolderTest {};

TEST_F(FailingDisks, AreToldByAFileThatIsNewOrReplaced) {
    for (const bool isThere : {false, true})
        expectToldByEachFault(
            folder,
            [&] {
                if (isThere) put(folder / "a.csv", "old");
            },
            [&] { return writeFile(folder / "a.csv", "new and longer"); });
}

TEST_F(FailingDisks, AreToldByAFileOfManyPieces) {
    expectToldByEachFault(
        folder, [] {},
        [&] {
            AtomicFile file{folder / "a.wav"};
            for (int i = 0; i < 3; ++i) file.writeAt(100 * i, std::string(100, 'a'));
            file.writeAt(4, "size"); // a head that is mended at the end
            return file.commit();
        });
}

TEST_F(FailingDisks, AreToldByAFileThatIsSeenWhileItGrows) {
    expectToldByEachFault(
        folder, [] {},
        [&] {
            AtomicFile file{folder / "a.txt"};
            file.write("head\n");
            if (const std::string error = file.publish(); !error.empty()) return error;
            file.writeAt(5, "tail\n");
            return file.commit();
        },
        true);
}

/// Whatever stands in a cell, and wherever: it is read again, in the first column as well.
TEST(CsvCells, WithEachSpecialCharacterAtEachPlaceAreReadAgain) {
    for (const char special : std::string("#,\"' =+-@;|"))
        for (const std::string words :
             {std::string{special}, special + std::string("a"), "a" + std::string{special} + "b",
              "a" + std::string{special}, std::string(2, special) + "1", special + std::string("1")})
            for (const bool isFirst : {true, false}) {
                std::string line;
                if (!isFirst) line = "x,";
                appendCell(line, words);
                if (isFirst) line += ",x";
                const auto table = readCsvTable("one,two\n" + line + "\ny,z\n", "t.csv");
                ASSERT_TRUE(table) << table.error << ": " << line;
                ASSERT_EQ(table.value.rows.size(), 2U) << line;
                EXPECT_EQ(table.value.rows[0].cells[isFirst ? 0 : 1], words) << line;
                EXPECT_EQ(table.value.rows[0].cells[isFirst ? 1 : 0], "x") << line;
            }
}

// Paths are compared by what they are.

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
        return fileClashError(outputs, inputs);
    };
    EXPECT_EQ(clash({out, "", there}, {"", link}),
              there + ": expected another file to write, this is the input " + link);
    EXPECT_EQ(clash({out, "", again}, {link}),
              again + ": expected another file to write, this is the output " + out);
    EXPECT_EQ(clash({out, "", there}, {"", "phone4", "0.5"}), "");
}

} // namespace physvib::failing_disk_posix_test
