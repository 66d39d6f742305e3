// SPDX-License-Identifier: MIT
// A measured coupling is read as it was written, and a bad one is named by its place.
#include "Io/Disk/AtomicFile.h"
#include "Lab/Study/Coupling.h"
#include "Support/FileTesting.h"

namespace physvib {
namespace {

const std::string good =
    R"({"physvib_coupling": 1, "name": "mine", "source": "measured by hand", "measured": [
  {"frequency_hz": 100, "magnitude": [[1, 0.2], [0.25, 1]], "phase_deg": [[0, -90], [180, 0]]},
  {"frequency_hz": 200, "magnitude": [[1, 0.125], [0.5, 0.875]], "phase_deg": [[0, 0], [0, 0]]}]})";

/// The file above with one thing replaced.
std::string errorOf(const std::string& what, const std::string& with) {
    std::string text = good;
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    const auto read = readCoupling(text.replace(at, what.size(), with), "c.json");
    EXPECT_FALSE(read) << text;
    EXPECT_TRUE(read.value.frequenciesHz.empty() && read.value.matrices.empty());
    return read.error;
}

TEST(CouplingFile, IsReadRowByRow) {
    const auto read = readCoupling(good, "c");
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(read.value.enchanters(), 2u);
    EXPECT_EQ(read.value.frequenciesHz, (std::vector{100.0, 200.0}));
    EXPECT_NEAR(std::abs(read.value.matrices[0].at(0, 1) - std::complex{0.0, -0.2}), 0.0, 1e-15);
    EXPECT_NEAR(std::abs(read.value.matrices[0].at(1, 0) - std::complex{-0.25, 0.0}), 0.0, 1e-15);
    EXPECT_EQ(read.value.matrices[1].at(1, 1), 0.875);
}

TEST(CouplingFile, FaultsNameTheirPlace) {
    EXPECT_EQ(errorOf("0.25", "-0.25"), "c.json: measured[0].magnitude[1][0]: expected 0 to 4, found -0.25");
    EXPECT_EQ(errorOf("0.25", "\"much\""),
              "c.json: measured[0].magnitude[1][0]: expected a number, found a string");
    EXPECT_EQ(errorOf("0.25", "1e999").rfind("c.json: ", 0), 0u);
    EXPECT_EQ(errorOf("-90", "-900"),
              "c.json: measured[0].phase_deg[0][1]: expected -360 to 360, found -900");
    EXPECT_EQ(
        errorOf("0.875", "0"),
        "c.json: measured[1].magnitude[1][1]: expected an enchanter that moves by its own drive, found 0");
    EXPECT_EQ(errorOf("[0.25, 1]]", "[0.25]]"),
              "c.json: measured[0].magnitude[1]: expected 2 items, found 1");
    EXPECT_EQ(errorOf("[[0, -90], [180, 0]]", "[[0, -90]]"),
              "c.json: measured[0].phase_deg: expected 2 items, found 1");
    EXPECT_EQ(
        errorOf("[[1, 0.125], [0.5, 0.875]], \"phase_deg\": [[0, 0], [0, 0]]", "[[1]], \"phase_deg\": [[0]]"),
        "c.json: measured[1].magnitude: expected as many enchanters as at the first frequency, 2, found 1");
    EXPECT_EQ(errorOf("200", "100"),
              "c.json: measured[1].frequency_hz: expected frequencies that rise, found 100 after 100");
    EXPECT_EQ(errorOf("100", "0"), "c.json: measured[0].frequency_hz: expected 1 to 20000, found 0");
    EXPECT_EQ(errorOf("\"phase_deg\": [[0, -90]", "\"phase_rad\": [[0, -90]"),
              "c.json: measured[0]: unknown field \"phase_rad\"");
    EXPECT_EQ(errorOf("\"name\": \"mine\", ", ""), "c.json: field \"name\" is missing");
    EXPECT_EQ(errorOf("\"physvib_coupling\": 1", "\"physvib_coupling\": 2"),
              "c.json: physvib_coupling: made for a newer PhysVib: expected a version up to 1, found 2");
    EXPECT_EQ(readCoupling(R"({"physvib_coupling": 1, "name": "", "source": "", "measured": []})", "c").error,
              "c: measured: expected 1 to 256 items, found 0");
}

TEST(CouplingFile, NoAccidentGetsPastTheReaderUnnoticed) {
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
        const auto read = readCoupling(mutated(good, "{}[]\",:0123456789.-e nul", random), "f");
        if (!read) {
            EXPECT_EQ(read.error.rfind("f: ", 0), 0u) << read.error;
            continue;
        }
        EXPECT_EQ(read.value.frequenciesHz.size(), read.value.matrices.size());
        for (const CouplingMatrix& m : read.value.matrices)
            for (const auto& entry : m.entries) EXPECT_LE(std::abs(entry), 4.0 + 1e-9);
    }
}

using CouplingFileOnDiskTest = FolderTest;

TEST_F(CouplingFileOnDiskTest, LoadsWhatWasWrittenAndSaysWhatIsNotThere) {
    const std::string path = (folder / "mine.json").string();
    ASSERT_EQ(writeFile(path, good), "");
    EXPECT_EQ(loadCoupling(path).value.enchanters(), 2u);
    EXPECT_NE(loadCoupling((folder / "none.json").string()).error.find("cannot be read"), std::string::npos);
}

} // namespace
} // namespace physvib
