// SPDX-License-Identifier: MIT
// What is printed and cannot be, what follows from it, and what is marked as simulated.
#include "Thesis/ThesisReport.h"
#include "Lab/Thesis/ThesisPage.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& words) {
    std::size_t times = 0;
    for (auto at = text.find(words); at != text.npos; at = text.find(words, at + 1)) ++times;
    return times;
}

TEST(Thesis, StandsBesideWhatFollowsFromIt) {
    const auto files = thesisPage().files;
    const std::string transfer = files.at("transfer.csv"), resolutions = files.at("resolutions.csv");
    EXPECT_EQ(count(transfer, ",NO: "), 1u) << transfer;
    EXPECT_TRUE(has(transfer.substr(transfer.rfind("RING-5x5")), "tolerance 1,25,2.62,")) << transfer;
    for (const char* line : {"PHONE-LINEAR,", "PHONE-LOGARITHM,", "RING-LINEAR,", "RING-LOGARITHM,"})
        EXPECT_TRUE(has(resolutions, line)) << resolutions;
    for (const char* grid : {",5 x 5,5 x 5,", ",5 x 4,5 x 4,", ",6 x 4,6 x 4,", ",7 x 4,7 x 4,"})
        EXPECT_TRUE(has(resolutions, grid)) << resolutions;
    EXPECT_EQ(count(files.at("printed-tests.csv"), "Table 4.1;"), 24u);
}

TEST(Thesis, RehearsalsAreMarkedAsSimulated) {
    const auto files = thesisReport();
    const std::string html = files.at("index.html");
    EXPECT_TRUE(has(html, "SIMULATED"));
    EXPECT_EQ(count(html, ">SIMULATED</text>"), count(html, ">rehearsed (simulated)<"))
        << "rehearsals' pictures, and no other";
    for (const char* study :
         {"patterns", "phantom-grids", "phantom-places", "model-or-sound", "eight-methods"}) {
        EXPECT_TRUE(has(html, std::string("href=\"") + study + "/index.html\"")) << study;
        EXPECT_TRUE(has(files.at(std::string{study} + "/index.html"), ">SIMULATED</div>")) << study;
    }
}

} // namespace
} // namespace physvib
