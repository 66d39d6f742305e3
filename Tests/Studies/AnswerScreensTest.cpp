// SPDX-License-Identifier: GPL-3.0-or-later
// Where answers are: points at their stimuli, a window of their own, letters instead of boxes.
#include "Core/PhantomPanner.h"
#include "Mixer/Widgets/Typefaces.h"
#include "Participant.h"
#include "Stimuli/Stimulus.h"

namespace physvib {
namespace {

std::vector<juce::Button*> pointsOf(juce::Component& answer) {
    std::vector<juce::Button*> points;
    for (auto* child : answer.getChildren())
        if (auto* button = dynamic_cast<juce::Button*>(child)) points.push_back(button);
    return points;
}

juce::Point<double> centreOf(const juce::Component& c) {
    return {c.getX() + 0.5 * c.getWidth(), c.getY() + 0.5 * c.getHeight()};
}

TEST(AnswerScreens, PointsStandWhereTheirStimuliAreInEveryGridAndLayout) {
    for (const char* name : {"phone1", "phone2", "phone3", "phone4", "ring1", "ring2", "ring3", "ring4"}) {
        EnchanterLayout geometry;
        ASSERT_TRUE(layoutPreset(name, geometry));
        const auto layout = describeLayout(name, geometry);
        juce::Rectangle<double> corners; // of the 3 x 3 grid: the field
        for (const GridSet& grid : {GridSet{3, 3}, GridSet{4, 4}, GridSet{5, 5},
                                    GridSet{7, 5, PhantomGrid::Points::middles}, GridSet{16, 2}}) {
            const auto answer = makeCellAnswer(grid, layout);
            answer->setSize(1300, 620);
            const auto points = pointsOf(*answer);
            const auto cells = grid.grid().cells();
            ASSERT_EQ(points.size(), cells.size());
            if (corners.isEmpty()) corners = {centreOf(*points.front()), centreOf(*points.back())};
            for (std::size_t i = 0; i < cells.size(); ++i) {
                const auto stimulus =
                    phantomStimulus(grid.grid().place(cells[i]), geometry, grid.law, grid.exponent, {});
                const double x = stimulus.events.front().x / stimulus.panner.fieldWidthMetres(),
                             y = 1.0 - stimulus.events.front().y / stimulus.panner.fieldHeightMetres();
                const juce::Point<double> meant{corners.getX() + x * corners.getWidth(),
                                                corners.getY() + y * corners.getHeight()};
                // pixels are whole
                EXPECT_LE(centreOf(*points[i]).getDistanceFrom(meant), 1.5)
                    << name << " " << grid.columns << " x " << grid.rows << ": " << points[i]->getTitle();
                for (std::size_t k = 0; k < i; ++k)
                    EXPECT_FALSE(points[i]->getBounds().intersects(points[k]->getBounds()))
                        << name << ": one click, one point";
            }
        }
    }
}

TEST(AnswerScreens, TheCornersOfAGridAreTheEnchanters) {
    EnchanterLayout phone;
    ASSERT_TRUE(layoutPreset("phone4", phone));
    for (const int n : {3, 4, 5}) {
        const PhantomGrid grid{n, n};
        int j = 0;
        for (const GridCell& cell : {GridCell{1, 1}, GridCell{1, n}, GridCell{n, 1}, GridCell{n, n}})
            EXPECT_EQ(placeOf(phone, j++), grid.place(cell));
    }
}

class AParticipantElsewhere : public testing::Test {
protected:
    void SetUp() override {
        folder.createDirectory();
        p.tab().setFolder(folder);
    }
    void TearDown() override { folder.deleteRecursively(); }
    void begin(const std::string& stimuli, const std::string& session) {
        const auto file = folder.getChildFile("short.json");
        file.replaceWithText(
            utf8(R"({"physvib_protocol": 1, "name": "short", "conditions": [{"name": "c", )" + stimuli +
                 R"(}], "sessions": [{"name": "main", )" + session + "}]}"));
        ASSERT_EQ(p.tab().chooseProtocol(file.getFullPathName().toStdString()), "");
        ASSERT_EQ(p.tab().begin(), "");
        p.pump();
        p.click("Next");
    }
    juce::File folder = juce::File::createTempFile("physvib-elsewhere");
    test::Participant p;
};

TEST_F(AParticipantElsewhere, AnswersMayBeGivenInASecondWindow) {
    p.tab().setAnswersElsewhere(true);
    begin(R"("layout": "phone4", "stimuli": "grid", "columns": 2, "rows": 1, "seconds": 0.05)",
          R"("task": "identify")");
    EXPECT_EQ(p.find("Row 1, column 1"), nullptr) << "not in the first one";
    auto& answers = p.screen()->answers();
    ASSERT_NE(answers.getPeer(), nullptr);
    EXPECT_NE(answers.getPeer(), p.view.getPeer());
    p.feel();
    auto* point = p.findBelow(answers, "Row 1, column 2");
    ASSERT_NE(point, nullptr);
    p.clickOn(*point);
    p.clickOn(*p.findBelow(answers, "Next"));
    EXPECT_EQ(p.experiment().trialsTaken(), 1);
    p.feel();
    p.click("Leave the study; what was answered is kept");
    ASSERT_TRUE(test::runUntil([&] { return p.screen() == nullptr; }));
}

TEST_F(AParticipantElsewhere, KoreanScreensShowLettersAndNoBoxes) {
    const Words korean = findWords("ko").value;
    const auto typeface = typefaceFor(korean);
    ASSERT_EQ(p.tab().chooseWords("ko"), "");
    if (!typeface) {
        EXPECT_NE(p.tab().begin().find("expected a font with the letters of ko"), std::string::npos);
        GTEST_SKIP() << "no Korean font is installed (fonts-nanum has one)";
    }
    begin(
        R"("stimuli": "calls", "factors": [{"name": "pair", "values": ["1"]}], "call": "stimulus phantom --at 0.5,0.5 --seconds 0.05 --frequency {object}{pair}")",
        R"("task": "rate", "scales": ["realism", "harmony"], "definitions": ["The vibration felt realistic.", "I liked the vibration."], "objects": ["20", "30"])");
    EXPECT_TRUE(p.screen()->getDescription().contains(utf8(korean.of("Rate what you felt."))))
        << p.screen()->getDescription();
    p.feel();
    p.feel();
    EXPECT_TRUE(hasLetters({}, utf8(korean.of("Rate what you felt."))))
        << "drawn by the typeface that screens are drawn with";
    auto missed = p.screen()->words().missed();
    for (const char* own : {"20", "30"}) missed.erase(own); // the protocol's
    EXPECT_TRUE(missed.empty()) << *missed.begin();
}

} // namespace
} // namespace physvib
