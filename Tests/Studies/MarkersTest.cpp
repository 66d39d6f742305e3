// SPDX-License-Identifier: GPL-3.0-or-later
// Markers of a study, taken by a library that stands in for liblsl.
#include "Participant.h"
#include <cstdlib>

namespace physvib::markers_test {

class StudyMarkersTest : public test::StudyTest {
protected:
    StudyMarkersTest() {
        setenv("PHYSVIB_FAKE_LSL", folder.getChildFile("lsl.txt").getFullPathName().toRawUTF8(), 1);
    }
    ~StudyMarkersTest() override {
        unsetenv("PHYSVIB_LSL");
        unsetenv("PHYSVIB_FAKE_LSL");
    }
    void takeOneTrial() {
        test::Participant p;
        begin(p, test::shortProtocol(
                     R"("layout": "phone4", "stimuli": "grid", "columns": 3, "rows": 2, "seconds": 0.05)",
                     R"({"name": "main", "task": "identify"})"));
        p.click("Next");
        p.feel();
        p.click("Row 1, column 2");
        p.click("Next");
        ASSERT_TRUE(p.hasTaken(1));
    }
};

TEST_F(StudyMarkersTest, SayWhatWasFeltWhenAndWhatWasAnswered) {
    setenv("PHYSVIB_LSL", PHYSVIB_FAKE_LSL_PATH, 1);
    takeOneTrial();
    juce::StringArray lines;
    lines.addLines(folder.getChildFile("lsl.txt").loadFileAsString());
    ASSERT_GE(lines.size(), 4);
    EXPECT_EQ(lines[0], "0.0\tphysvib-short");
    EXPECT_EQ(lines[1], "0.0\tMarkers");
    EXPECT_TRUE(lines[2].contains("\tfelt;condition=c;session=main;trial=1;stimulus=")) << lines[2];
    EXPECT_GT(lines[2].getDoubleValue(), 20.0) << "when it is felt, not when it was asked for: " << lines[2];
    EXPECT_LT(lines[2].getDoubleValue(), 500.0);
    EXPECT_TRUE(lines[3].startsWith("0.0\tanswer;condition=c;session=main;trial=1;")) << lines[3];
    EXPECT_TRUE(lines[3].contains("response=1,2")) << lines[3];
    EXPECT_TRUE(lines.contains("0.0\tclosed"));
}

TEST_F(StudyMarkersTest, AreNotNeeded) {
    setenv("PHYSVIB_LSL", "/nowhere/liblsl.so", 1);
    takeOneTrial();
    EXPECT_FALSE(folder.getChildFile("lsl.txt").existsAsFile());
}

} // namespace physvib::markers_test
