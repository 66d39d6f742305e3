// SPDX-License-Identifier: MIT
// No write, flush or rename that fails is told as saved, and no file is left half.
#include "Io/Disk/AtomicFile.h"
#include "Io/Text/CsvTable.h"
#include "Support/FailingDisk.h"

namespace physvib {
namespace {

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
            if (const std::string error = file.show(); !error.empty()) return error;
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

} // namespace
} // namespace physvib
