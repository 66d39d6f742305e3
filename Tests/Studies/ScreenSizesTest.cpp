// SPDX-License-Identifier: GPL-3.0-or-later
// Every page of every built-in study on small displays, below a title bar: nothing is cut, nothing covers a
// button.
#include "Core/PhantomPanner.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/SimulatedObserver.h"
#include "Mixer/Widgets/Typefaces.h"
#include "Participant.h"
#include "Stimuli/Stimulus.h"
#include <algorithm>
#include <utility>

namespace physvib::screen_sizes_test {

constexpr int titleBar = 37; // pixels of a desktop's usual one
constexpr std::pair<int, int> displays[] = {{1280, 720}, {1440, 900}};

/// Visible components below `root`, with what is wrong with where they are.
void findCut(const juce::Component& root, const std::string& page, std::vector<std::string>& faults) {
    std::vector<const juce::Component*> buttons;
    int iconHeight = 0; // of patterns: in each row the same, or the last one cannot be read
    for (const auto* child : root.getChildren()) {
        bool takesClicks = false, childrenDo = false;
        child->getInterceptsMouseClicks(takesClicks, childrenDo);
        const bool isOutline = !takesClicks && !childrenDo; // of what has the focus: drawn around it
        if (!child->isVisible() || isOutline) continue;
        const auto name = page + ": " + child->getTitle().toStdString() + " at " +
                          child->getBounds().toString().toStdString() + " in " +
                          root.getLocalBounds().toString().toStdString();
        if (!root.getLocalBounds().contains(child->getBounds())) faults.push_back(name);
        if (child->getBounds().isEmpty()) faults.push_back(name + ": no room for it");
        if (dynamic_cast<const juce::Button*>(child) != nullptr) {
            if (child->getTitle().endsWith(" ms") && std::exchange(iconHeight, child->getHeight()) != 0 &&
                iconHeight != buttons.back()->getHeight())
                faults.push_back(name + ": lower than the icon before it");
            for (const auto* other : buttons)
                if (other->getBounds().intersects(child->getBounds()))
                    faults.push_back(name + ": covers " + other->getTitle().toStdString());
            buttons.push_back(child);
        }
        if (dynamic_cast<const juce::Viewport*>(child) == nullptr) findCut(*child, page, faults);
    }
}

class OnASmallDisplay : public test::StudyTest {
protected:
    /// The trials before the first of that session are answered by the simulated observer.
    void answerUntil(const Protocol& protocol, std::size_t session, const juce::File& rows) const {
        const Participant participant{"P01", 1, "person"};
        StudyInProgress study{{protocol, participant, rows.getFullPathName().toStdString()}};
        const SimulatedObserver observer{{}, protocol, participant};
        const auto isThere = [&] {
            return study.experiment().isDone() || study.experiment().trial().session == session;
        };
        while (!isThere()) {
            if (study.experiment().mayEnd())
                study.endSession();
            else if (!study.acceptAnswer(observer.answer(study.experiment())))
                return;
        }
    }

    test::Participant p;
};

TEST_F(OnASmallDisplay, NothingOfAnyStudyIsCut) {
    p.model.change("Level", [](Mix& mix) { mix.levelDb = 0.0; });
    std::vector<std::string> faults;
    for (Protocol protocol : builtInProtocols()) {
        protocol.conditionBreakSeconds = 0.0; // nobody waits here
        protocol.conditionOrder = Protocol::ConditionOrder::given;
        std::ranges::reverse(protocol.conditions); // what needs most room is first
        for (SessionPlan& session : protocol.sessions) session.breakBeforeSeconds = 0.0;
        const auto file = folder.getChildFile(utf8(protocol.name) + ".json");
        file.replaceWithText(utf8(protocolJson(protocol)));
        for (std::size_t session = 0; session < protocol.sessions.size(); ++session) {
            const auto rows =
                folder.getChildFile(utf8(protocol.name) + juce::String{static_cast<int>(session)});
            rows.createDirectory();
            p.tab().setFolder(rows);
            answerUntil(protocol, session, rows);
            ASSERT_EQ(p.tab().chooseProtocol(file.getFullPathName().toStdString()), "");
            ASSERT_EQ(p.tab().begin(), "");
            if (p.experiment().trial().session < session) { // a training is ended by who does it
                p.click("Next");
                p.click("Next");
            }
            for (const bool isTrial : {false, true}) {
                if (isTrial) p.click("Next");
                const auto& condition = p.experiment().condition();
                if (isTrial && std::holds_alternative<PatternSet>(condition.stimuli)) {
                    if (p.experiment().session().answerKind() == AnswerKind::label) p.feel();
                    p.type("a");
                }
                for (const auto& [width, height] : displays) {
                    p.view.setSize(width, height - titleBar);
                    p.pump();
                    const std::string page = protocol.name + ", session " + std::to_string(session) +
                                             (isTrial ? ", trial" : ", page before") + ", " +
                                             std::to_string(width) + " x " + std::to_string(height);
                    findCut(*p.screen(), page, faults);
                }
            }
            p.tab().end();
        }
    }
    for (const std::string& fault : faults) ADD_FAILURE() << fault;
}

TEST_F(OnASmallDisplay, WhatAProtocolAsksForHasALineUntilItIsChosen) {
    ASSERT_EQ(p.tab().chooseProtocol("patterns"), "");
    p.view.tabs().choose("Studies");
    for (const auto& [width, height] : {std::pair{1440, 900 - titleBar},
                                        {1280, 720 - titleBar},
                                        {MixerView::minWidth, MixerView::minHeight}}) {
        p.view.setSize(width, height);
        p.pump();
        ASSERT_FALSE(p.tab().advice().isEmpty());
        EXPECT_TRUE(p.tab().advice()[0].contains("asks for pink noise")) << p.tab().advice()[0];
        EXPECT_GE(static_cast<float>(p.tab().adviceArea().getHeight()), text::medium)
            << "no room for a line at " << width << " x " << height;
    }
    p.tab().setNoise(p.tab().noiseChoices().front(), -40.0);
    EXPECT_FALSE(p.tab().advice().joinIntoString("|").contains("pink noise"));
}

TEST_F(OnASmallDisplay, HowMuchWeakerHitsAreIsToldBesideBeginWhereTheLevelIsRaised) {
    p.view.tabs().choose("Studies");
    auto* const fader = dynamic_cast<juce::Slider*>(p.find("Master gain, in a row"));
    ASSERT_NE(fader, nullptr);
    for (const auto& [width, height] :
         {std::pair{1440, 900 - titleBar}, {MixerView::minWidth, MixerView::minHeight}}) {
        p.view.setSize(width, height);
        p.pump();
        EXPECT_TRUE(fader->isShowing() && fader->getWidth() >= 60) << width << ": " << fader->getWidth();
        EXPECT_TRUE(p.tab().getLocalBounds().contains(p.tab().getLocalArea(fader, fader->getLocalBounds())));
    }
    fader->setValue(-20.0);
    p.pump();
    EXPECT_TRUE(p.tab().master().warning() == "10 times weaker") << p.tab().master().warning();
    fader->setValue(0.0);
    p.pump();
    EXPECT_EQ(p.model.mix().levelDb, 0.0);
    EXPECT_EQ(p.tab().master().warning(), "");
}

// Where answers are: points at their stimuli, a window of their own, letters instead of boxes.

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
        ActuatorLayout geometry;
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
    ActuatorLayout phone;
    ASSERT_TRUE(layoutPreset("phone4", phone));
    for (const int n : {3, 4, 5}) {
        const PhantomGrid grid{n, n};
        int j = 0;
        for (const GridCell& cell : {GridCell{1, 1}, GridCell{1, n}, GridCell{n, 1}, GridCell{n, n}})
            EXPECT_EQ(actuatorPlace(phone, j++), grid.place(cell));
    }
}

class AParticipantElsewhere : public test::StudyTest {
protected:
    AParticipantElsewhere() { p.tab().setFolder(folder); }
    void begin(const std::string& stimuli, const std::string& session) {
        StudyTest::begin(p, test::shortProtocol(stimuli, R"({"name": "main", )" + session + "}"));
        p.click("Next");
    }
    test::Participant p;
};

TEST_F(AParticipantElsewhere, AnswersMayBeGivenInASecondWindow) {
    p.tab().setAnswerWindow(true);
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
    EXPECT_EQ(p.experiment().answeredTrials(), 1);
    p.feel();
    ASSERT_TRUE(p.leave());
}

TEST_F(AParticipantElsewhere, KoreanScreensShowLettersAndNoBoxes) {
    const Translation korean = findTranslation("ko").value;
    const auto typeface = typefaceFor(korean);
    ASSERT_EQ(p.tab().chooseLanguage("ko"), "");
    if (!typeface) {
        EXPECT_NE(p.tab().begin().find("expected a font with the letters of ko"), std::string::npos);
        GTEST_SKIP() << "no Korean font is installed (fonts-nanum has one)";
    }
    begin(
        R"("stimuli": "calls", "factors": [{"name": "pair", "values": ["1"]}], "call": "stimulus phantom --at 0.5,0.5 --seconds 0.05 --frequency {object}{pair}")",
        R"("task": "rate", "scales": ["realism", "harmony"], "definitions": ["The vibration felt realistic.", "I liked the vibration."], "objects": ["20", "30"])");
    EXPECT_TRUE(p.words().contains(utf8(korean.translate("Rate what you felt.")))) << p.words();
    p.feel();
    p.feel();
    EXPECT_TRUE(hasLetters({}, utf8(korean.translate("Rate what you felt."))))
        << "drawn by the typeface that screens are drawn with";
    auto missed = p.screen()->texts().untranslated();
    for (const char* own : {"20", "30"}) missed.erase(own); // the protocol's
    EXPECT_TRUE(missed.empty()) << *missed.begin();
}

} // namespace physvib::screen_sizes_test
