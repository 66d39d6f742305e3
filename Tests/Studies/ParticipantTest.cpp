// SPDX-License-Identifier: GPL-3.0-or-later
// A scripted participant completes a short study of each kind by mouse and keyboard; the rows are what the
// script answered, and `physvib analyse` takes them.
#include "Participant.h"
#include "Lab/Files/ProtocolFile.h"
#include <cstdlib>

namespace physvib {
namespace {

constexpr const char* estimate = R"({"name": "main", "task": "estimate", "question": "How strong?"})";
constexpr const char* point =
    R"("layout": "phone2", "level_g": 0.2, "stimuli": "grid", "columns": 1, "rows": 1, "seconds": 0.05)";
constexpr const char* twoPoints =
    R"("layout": "phone2", "stimuli": "grid", "columns": 2, "rows": 1, "seconds": 0.05)";
const std::string tone = "stimulus phantom --at 0.5,0.5 --seconds 0.05 --level-g ";

/// Stimuli of a call with one factor, whose values stand in a list of JSON.
std::string calls(const std::string& factor, const std::string& values, const std::string& call) {
    return R"("stimuli": "calls", "factors": [{"name": ")" + factor + R"(", "values": )" + values +
           R"(}], "call": ")" + call + "\"";
}

class ByAParticipant : public test::StudyTest {
protected:
    ByAParticipant() { p->tab().setFolder(folder); }

    /// Writes the protocol and begins with it.
    void begin(const std::string& sessions, const std::string& stimuli, const std::string& more = {}) {
        StudyTest::begin(*p, test::shortProtocol(stimuli, sessions, more));
    }
    void goOn() { StudyTest::goOn(*p); }
    /// Past the page before a session, by mouse.
    void passPage() {
        ASSERT_EQ(p->screen()->page(), StudyScreen::Page::ready);
        p->click("Next");
        ASSERT_EQ(p->screen()->page(), StudyScreen::Page::trial);
    }
    void close() {
        ASSERT_EQ(p->screen()->page(), StudyScreen::Page::done);
        p->enter();
        ASSERT_TRUE(p->isGone());
        EXPECT_NE(p->find("Tabs"), nullptr) << "the mixer is back";
    }
    /// The events of the file of times.
    juce::String events() const {
        juce::StringArray events;
        const auto times = folder.getChildFile("short-P01.times.txt").loadFileAsString();
        for (const auto& line : juce::StringArray::fromLines(times.trim()))
            events.add(
                line.fromFirstOccurrenceOf(",", false, false).upToFirstOccurrenceOf(",", false, false));
        return events.joinIntoString(" ");
    }
    /// A column of the rows of a task.
    std::vector<std::string> column(const std::string& name, const std::string& task) const {
        const auto table = rows();
        std::vector<std::string> cells;
        for (const auto& row : table.rows)
            if (row.cells[*table.column("task")] == task) cells.push_back(row.cells[*table.column(name)]);
        return cells;
    }
    void analyse(const std::string& kind) const { call("analyse " + kind + " short-P01.csv > /dev/null"); }

    std::unique_ptr<test::Participant> p = std::make_unique<test::Participant>();
};

using Texts = std::vector<std::string>;

TEST_F(ByAParticipant, IdentifiesPatternsByTwoClicksAfterATraining) {
    begin(
        R"({"name": "training", "training": true, "task": "explore"}, {"name": "main", "task": "identify", "most_plays": 2})",
        R"("layout": "phone2", "stimuli": "patterns", "enchanters": 2, "pulse_s": [0.03], "gap_s": 0.01)");
    const auto items = conditionStimuli(p->screen()->study().protocol().conditions[0]);
    const auto titleOf = [](const std::string& label) {
        juce::StringArray words;
        for (const char c : label.substr(0, label.find('-')))
            words.add(juce::String::charToString(static_cast<juce::juce_wchar>(c)));
        return words.joinIntoString(" then ") + ", 30 ms";
    };
    const auto firstOf = [](const std::string& label) {
        return "First pulse: " + juce::String::charToString(static_cast<juce::juce_wchar>(label[0]));
    };
    passPage();
    Texts felt;
    for (const auto& item : items) {
        p->click(firstOf(item.label));
        p->click(titleOf(item.label));
        felt.push_back(item.label);
        ASSERT_TRUE(p->hasTaken(static_cast<int>(felt.size()))) << item.label;
    }
    EXPECT_EQ(column("response", "explore"), felt);
    p->click(firstOf(items[0].label)); // once more, as often as wanted
    p->click(titleOf(items[0].label));
    ASSERT_TRUE(p->hasTaken(static_cast<int>(items.size()) + 1));
    ASSERT_EQ(p->screen()->page(), StudyScreen::Page::trial)
        << "a training ends when its participant says so";
    p->click("Next");
    passPage();
    Texts answers;
    for (std::size_t n = 0; n < items.size(); ++n) {
        const std::string label = items[(5 * n + 3) % items.size()].label; // whatever it was
        EXPECT_FALSE(p->isAnswerOpen(firstOf(label))) << "nothing was felt yet";
        p->feel();
        if (n == 4) {
            p->feel();
            p->space(); // a third time is one too many
        }
        if (n % 2 == 0)
            p->click(firstOf(label));
        else
            p->type(label.substr(0, 1));
        // thought better of it
        if (n == 2) p->click(titleOf(items[(5 * n) % items.size()].label)), p->click(firstOf(label));
        p->click(titleOf(label));
        p->click("Next");
        answers.push_back(label);
    }
    close();
    EXPECT_EQ(column("response", "identify"), answers);
    EXPECT_EQ(column("observer", "identify"), Texts(items.size(), "person"));
    EXPECT_EQ(column("replays", "identify").size(), items.size());
    analyse("confusion");
}

TEST_F(ByAParticipant, IdentifiesPointsOfAGridAndGoesOnWhereTheWindowWasClosed) {
    const char *const
        session = R"({"name": "main", "task": "identify", "repetitions": 2})",
        *const points = R"("layout": "phone4", "stimuli": "grid", "columns": 3, "rows": 2, "seconds": 0.05)";
    begin(session, points);
    Texts answers, asked;
    for (int n = 0; n < 12; ++n) {
        if (n == 0) passPage();
        if (n == 7) { // the window goes, as in a crash; the rows are there
            p = std::make_unique<test::Participant>();
            begin(session, points);
            EXPECT_EQ(p->experiment().answeredTrials(), 7);
            passPage();
        }
        asked.push_back(p->experiment().trial().stimulus);
        p->feel();
        const int row = 1 + n % 2, col = 1 + n % 3;
        if (n != 5) {
            p->click("Row " + juce::String{row} + ", column " + juce::String{col});
            p->click("Next");
            answers.push_back(std::to_string(row) + "," + std::to_string(col));
        } else { // the arrows begin at the lower left of the middle
            p->key(juce::KeyPress::rightKey);
            juce::Component::unfocusAllComponents(); // another window takes the focus for a moment
            p->enter();
            EXPECT_EQ(p->experiment().answeredTrials(), 5) << "chosen, not confirmed";
            p->enter();
            ASSERT_TRUE(p->hasTaken(6));
            answers.push_back("2,2");
        }
    }
    close();
    EXPECT_EQ(column("response", "identify"), answers);
    EXPECT_EQ(column("stimulus", "identify"), asked);
    analyse("confusion");
}

TEST_F(ByAParticipant, AClosedWindowPausesSaysSoAndThenLeaves) {
    EXPECT_FALSE(p->view.pauseStudy()) << "no study: the mixer asks as ever";
    begin(R"({"name": "main", "task": "identify", "repetitions": 2})", twoPoints);
    passPage();
    p->feel();
    EXPECT_TRUE(p->view.pauseStudy());
    p->pump();
    ASSERT_EQ(p->screen()->page(), StudyScreen::Page::paused);
    EXPECT_TRUE(p->words().contains("The study is paused."));
    EXPECT_FALSE(p->screen()->isStimulusPlaying());
    p->click("Next");
    passPage();
    EXPECT_EQ(p->experiment().answeredTrials(), 0) << "what was not answered begins anew";
    p->feel();
    EXPECT_TRUE(p->view.pauseStudy());
    EXPECT_TRUE(p->view.pauseStudy()) << "again";
    ASSERT_TRUE(p->isGone());
    EXPECT_EQ(events(), "event start pause go-on pause leave");
}

TEST_F(ByAParticipant, AWindowClosedInABreakDoesNotBeginTheBreakAnew) {
    begin(R"({"name": "main", "task": "identify", "break_before_s": 3})", twoPoints);
    EXPECT_TRUE(p->words().contains("A break"));
    EXPECT_TRUE(p->view.pauseStudy());
    ASSERT_EQ(p->screen()->page(), StudyScreen::Page::paused);
    test::runFor(3.0);
    p->click("Next");
    EXPECT_FALSE(p->words().contains("A break")) << "it went on meanwhile";
    passPage();
    for (int n = 0; n < 2; ++n) p->feel(), p->click("Row 1, column 1"), p->click("Next");
    close();
    goOn();
    close();
    EXPECT_EQ(events(), "event start break pause go-on go-on end") << "it ended once";
}

TEST_F(ByAParticipant, FeelsAPairByOnePressAndIsToldWhatWasRight) {
    begin(
        R"({"name": "main", "task": "choose", "interval_s": 0.2, "feedback": true, "instruction": "Two vibrations follow one another.", "alternatives": [{"name": "a"}, {"name": "b"}],
            "staircase": {"alternative": "b", "most_db": 10, "most_trials": 2}})",
        point);
    EXPECT_TRUE(p->words().contains("Two vibrations follow one another."));
    passPage();
    p->space();
    ASSERT_TRUE(test::runUntil([&] {
        return p->pump(), p->screen()->plays() == 2 && !p->screen()->isStimulusPlaying();
    })) << "one press plays both";
    const bool isRight = p->experiment().trial().parts[0] == "b";
    p->click("Answer: number 1");
    p->click("Next");
    p->pump();
    EXPECT_TRUE(p->words().contains(isRight ? "That was right." : "That was wrong.")) << p->words();
    EXPECT_EQ(column("correct", "choose"), Texts{isRight ? "1" : "0"});
}

TEST_F(ByAParticipant, FeedbackStandsOnThePageAfterTheAnswerAndNotInAnotherSession) {
    begin(
        R"({"name": "a", "task": "choose", "feedback": true, "alternatives": [{"name": "a"}, {"name": "b"}],
            "staircase": {"alternative": "b", "most_db": 10, "most_trials": 1}}, {"name": "b", "task": "identify"})",
        point);
    passPage();
    p->feel();
    p->feel();
    p->click("Answer: number 1");
    p->click("Next");
    ASSERT_EQ(p->screen()->page(), StudyScreen::Page::ready);
    EXPECT_TRUE(p->words().contains("That was")) << p->words();
    passPage();
    EXPECT_FALSE(p->words().contains("That was")) << "it was of the session before";
}

TEST_F(ByAParticipant, AnAnswerWhileTheLastPartPlaysCountsOnceThatIsOver) {
    begin(
        R"({"name": "main", "task": "choose", "alternatives": [{"name": "a"}, {"name": "b"}],
            "staircase": {"alternative": "b", "most_db": 10, "most_trials": 1}})",
        R"("layout": "phone2", "level_g": 0.2, "stimuli": "grid", "columns": 1, "rows": 1, "seconds": 1.5)");
    passPage();
    p->feel();
    EXPECT_FALSE(p->isAnswerOpen("Answer: number 1"));
    p->space();
    ASSERT_TRUE(test::runUntil([&] { return p->pump(), p->screen()->plays() == 2; }));
    ASSERT_TRUE(p->screen()->isStimulusPlaying() && p->isAnswerOpen("Answer: number 1"));
    p->click("Answer: number 1");
    ASSERT_TRUE(p->screen()->isStimulusPlaying()) << "it is not over";
    EXPECT_FALSE(p->isAnswerOpen("Next"));
    p->click("Next");
    EXPECT_EQ(p->experiment().answeredTrials(), 1);
}

TEST_F(ByAParticipant, WhatTheExperimenterWasToldIsNoInstruction) {
    p->model.report("expected the outputs as in the trials before");
    begin(R"({"name": "main", "task": "identify"})", point);
    passPage();
    EXPECT_FALSE(p->words().contains("trials before")) << p->words();
    p->model.report("the cable was pulled");
    ASSERT_TRUE(test::runUntil([&] { return p->pump(), p->words().contains("the cable was pulled"); }));
}

TEST_F(ByAParticipant, BeginWaitsForTheCheck) {
    ASSERT_EQ(p->tab().chooseProtocol("model-or-sound"), "");
    EXPECT_FALSE(p->tab().check()) << "it goes on";
    p->click("Begin the study");
    EXPECT_EQ(p->screen(), nullptr);
    ASSERT_TRUE(test::runUntil([&] { return p->pump(), p->screen() != nullptr; }));
    EXPECT_TRUE(p->tab().check());
}

TEST_F(ByAParticipant, FindingsOfTheCheckStandBesideTheProtocol) {
    ASSERT_EQ(p->tab().chooseProtocol("model-or-sound"), "");
    EXPECT_FALSE(p->tab().check()) << "it is made beside the window";
    ASSERT_TRUE(test::runUntil([&] { return p->pump(), p->tab().check().has_value(); }));
    const auto count = p->tab().check()->warnings.size();
    EXPECT_GT(count, 10u);
    p->click("Findings of the check");
    ASSERT_NE(p->tab().analysis(), nullptr);
    EXPECT_EQ(p->tab().analysis()->report().warnings.size(), count);
    EXPECT_TRUE(p->tab().advice().joinIntoString("\n").contains("threshold of detection"));
    p->enter();
    ASSERT_TRUE(test::runUntil([&] { return p->tab().analysis() == nullptr; }));
}

TEST_F(ByAParticipant, PointsAtPlacesAfterFreeTouches) {
    begin(
        R"({"name": "training", "training": true, "task": "explore", "fewest_touches": 3}, {"name": "main", "task": "locate", "repetitions": 4})",
        R"("layout": "phone4", "stimuli": "grid", "columns": 2, "rows": 2, "seconds": 0.05)");
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    std::vector<FieldPlace> touched;
    const auto touch = [&](FieldPlace at) {
        ASSERT_TRUE(p->canUse("Field"));
        auto* field = p->find("Field");
        p->clickAt(p->view.getLocalPoint(
            field, toPixel(fitField(field->getLocalBounds().toFloat().reduced(24.0f), layout), at)));
        touched.push_back(at);
    };
    passPage();
    for (int n = 1; n <= 3; ++n) {
        touch({0.25 * n, 0.2 * n});
        ASSERT_TRUE(p->hasTaken(n));
        EXPECT_EQ(p->isAnswerOpen("Next"), n == 3) << "how many touches are left is not told";
    }
    p->click("Next");
    passPage();
    for (int n = 0; n < 16; ++n) {
        p->feel();
        if (n != 2) {
            if (n == 1) touch({0.9, 0.9}), touched.pop_back(); // another place first
            touch({0.05 + 0.05 * n, 0.1 + 0.2 * (n * n % 5)});
        } else {
            for (int k = 0; k < 11; ++k) { // from wherever it is to the upper left
                p->key(juce::KeyPress::leftKey, juce::ModifierKeys::shiftModifier);
                p->key(juce::KeyPress::upKey, juce::ModifierKeys::shiftModifier);
            }
            p->key(juce::KeyPress::rightKey, juce::ModifierKeys::shiftModifier);
            p->key(juce::KeyPress::downKey);
            // as JUCE does when what lies under the mouse changes
            juce::Desktop::getInstance().getMainMouseSource().triggerFakeMove();
            p->pump();
            touched.push_back({0.1, 0.01});
            p->enter();
        }
        EXPECT_EQ(p->experiment().answeredTrials(), 3 + n) << "a mark is no answer yet";
        ASSERT_TRUE(p->canUse("Next"));
        if (n % 2 == 0)
            p->enter();
        else
            p->click("Next");
    }
    close();
    auto x = column("x", "explore"), y = column("y", "explore");
    for (const auto& cell : column("x", "locate")) x.push_back(cell);
    for (const auto& cell : column("y", "locate")) y.push_back(cell);
    ASSERT_EQ(x.size(), 19u);
    for (std::size_t n = 0; n < x.size(); ++n) {
        EXPECT_NEAR(std::stod(x[n]), touched[n].x, 2e-3) << n; // a pixel
        EXPECT_NEAR(std::stod(y[n]), touched[n].y, 2e-3) << n;
    }
    analyse("resolution");
}

TEST_F(ByAParticipant, MatchesLevelsAndChoosesAtTheMatchedOnes) {
    begin(
        R"({"name": "matching", "training": true, "task": "adjust", "alternatives": [{"name": "150"}, {"name": "250"}],
              "adjustment": {"alternative": "250", "start_db": 3, "step_db": 1.5, "least_db": -20, "most_db": 10}},
             {"name": "main", "task": "choose", "both_orders": true, "repetitions": 2, "alternatives": [{"name": "150"}, {"name": "250"}], "levels_from": "matching"})",
        R"("layout": "phone1", "stimuli": "calls", "factors": [{"name": "n", "values": ["one"]}],
             "variables": [{"name": "g", "at_0_db": 0.1}],
             "call": "stimulus phantom --at 0.5,0.5 --layout phone1 --seconds 0.05 --level-g {g} --frequency {alternative}")");
    passPage();
    p->feel();
    EXPECT_FALSE(p->isAnswerOpen("Next")) << "the second was not felt";
    p->feel();
    p->click("Softer");
    p->click("Softer");
    p->key(juce::KeyPress::upKey);
    p->feel();
    p->click("Next");
    passPage();
    Texts choices;
    for (int n = 0; n < 4; ++n) {
        const auto parts = p->experiment().trial().parts;
        EXPECT_EQ(p->experiment().trial().levelDb, 1.5) << "the matched one";
        p->feel();
        p->feel();
        choices.push_back(parts[static_cast<std::size_t>(n / 2)]);
        if (n % 2 == 0)
            p->type(n / 2 == 0 ? "21" : "12"), p->enter(); // the last one counts
        else
            p->click(n / 2 == 0 ? "Answer: number 1" : "Answer: number 2"), p->click("Next");
    }
    close();
    EXPECT_EQ(column("value", "adjust"), Texts{"1.5"});
    EXPECT_EQ(column("choice", "choose"), choices);
    analyse("choices");
    analyse("levels");
}

TEST_F(ByAParticipant, FeelsRecordingsAgainstTheModelAtTheLevelThatWasMatched) {
    begin(
        R"({"name": "matching", "training": true, "task": "adjust", "alternatives": [{"name": "AV-FV-DRV"}, {"name": "SV", "level_db": -12}],
              "adjustment": {"alternative": "AV-FV-DRV", "start_db": -12, "step_db": 2, "least_db": -30, "most_db": -6}},
             {"name": "main", "task": "choose", "both_orders": true, "alternatives": [{"name": "AV-FV-DRV"}, {"name": "SV", "level_db": -12}], "levels_from": "matching"})",
        R"("layout": "phone1", "stimuli": "calls", "factors": [{"name": "pair", "values": ["wood-wood"]}],
             "call": "render drop --set pair={pair} --seconds 1 --layout phone1 --method {alternative} --sound-match rms --level-db {level_db}")",
        R"(, "sounds": [{"frequency_hz": 349, "file": "synthetic-5"}])");
    passPage();
    p->feel();
    p->feel();
    p->click("Softer");
    p->feel();
    p->click("Next");
    passPage();
    for (int n = 0; n < 2; ++n) {
        p->feel();
        p->feel();
        p->type("1");
        p->enter();
    }
    close();
    const auto log = p->model.savedSession().log;
    ASSERT_GE(log.recordings.size(), 4u);
    for (std::size_t i = 0; i < log.recordings.size(); ++i)
        EXPECT_EQ(log.recordings[i].files.size(), (i + 1) % 2)
            << "the recording and the model in turn, at last the desk's own modes";
    EXPECT_EQ(log.recordings.front().files.front().path, "synthetic-5");
    for (const auto& calls : column("render", "choose")) {
        EXPECT_NE(calls.find("--method AV-FV-DRV --sound-match rms --level-db -14"), std::string::npos)
            << calls;
        EXPECT_NE(calls.find("--method SV --sound-match rms --level-db -12 --sound 349=synthetic-5"),
                  std::string::npos)
            << calls;
    }
}

TEST_F(ByAParticipant, RatesOnlyWhatWasFeltForLongEnough) {
    begin(
        R"({"name": "main", "task": "rate", "repetitions": 2, "least_s": 0.3, "break_every": 1, "break_s": 0.2, "scales": ["realism", "liking"], "objects": ["150", "200", "250"]})",
        R"("layout": "phone1", "stimuli": "calls", "factors": [{"name": "n", "values": ["one"]}],
             "call": "stimulus phantom --at 0.5,0.5 --layout phone1 --seconds 0.2 --level-g 0.1 --frequency {object}")");
    for (int n = 0; n < 2; ++n) {
        passPage(); // also after the break
        for (int k = 0; k < 5; ++k) {
            p->feel();
            EXPECT_FALSE(p->isAnswerOpen("Realism"))
                << "one of the three was felt for 0.2 s, asked for are 0.3";
        }
        p->feel();
        ASSERT_TRUE(p->canUse("Realism"));
        EXPECT_FALSE(p->isAnswerOpen("Next")) << "no scale is set";
        dynamic_cast<juce::Slider*>(p->find("Realism"))->grabKeyboardFocus();
        for (int k = 0; k <= n; ++k) p->key(juce::KeyPress::rightKey);
        EXPECT_FALSE(p->isAnswerOpen("Next")) << "one scale is set";
        auto* slider = p->find("Liking");
        p->clickAt(p->view.getLocalPoint(slider, slider->getLocalBounds().toFloat().getCentre().withX(2.0f)));
        p->click("Next");
    }
    close();
    EXPECT_EQ(column("realism", "rate"), (Texts{"51", "52"}));
    EXPECT_EQ(column("liking", "rate"), (Texts{"0", "0"}));
    analyse("ratings");
}

TEST_F(ByAParticipant, GivesTheNumberThatWasTypedWhereverTheFocusWent) {
    begin(estimate, calls("level_g", R"(["0.05", "0.1"])", tone + "{level_g}"));
    passPage();
    const juce::String number{"12.5"};
    for (const bool isWindowLeft : {true, false}) {
        p->feel();
        ASSERT_TRUE(p->canUse("Number"));
        for (const auto character : number) { // between two pictures, as a busy display does
            if (isWindowLeft)
                juce::Component::unfocusAllComponents();
            else
                p->screen()->grabKeyboardFocus();
            p->view.getPeer()->handleKeyPress(juce::KeyPress{static_cast<int>(character), 0, character});
        }
        p->pump();
        p->enter();
    }
    close();
    EXPECT_EQ(column("value", "estimate"), (Texts{"12.5", "12.5"}));
}

TEST_F(ByAParticipant, RowsTellWhatWasReallyFelt) {
    begin(estimate, calls("level_g", R"(["0.1", "0.2"])",
                          "stimulus phantom --at 0,0 --seconds 0.1 --level-g {level_g}"));
    passPage();
    Texts stimuli;
    for (int n = 0; n < 2; ++n) {
        stimuli.push_back(p->experiment().trial().stimulus);
        p->feel();
        p->type("1");
        p->enter();
    }
    close();
    const Texts peaks = column("peak_g", "estimate"), rms = column("rms_g", "estimate"),
                exposures = column("a8_m_per_s2", "estimate");
    ASSERT_EQ(peaks.size(), 2u);
    double squares = 0.0;
    for (std::size_t n = 0; n < 2; ++n) {
        const double levelG = std::stod(stimuli[n]) * masterGain(p->model.mix());
        EXPECT_NEAR(std::stod(peaks[n]), levelG, 0.01 * levelG) << "behind the master level";
        EXPECT_NEAR(std::stod(rms[n]), levelG / std::sqrt(2.0), 2e-4 * levelG)
            << "whatever the machine does beside";
        squares += 0.5 * levelG * levelG * 0.1 * std::pow(handWeighting::gain(205.0), 2);
        EXPECT_NEAR(std::stod(exposures[n]), dailyExposure(squares), 0.2 * dailyExposure(squares))
            << "what begins and ends has more than 205 Hz in it";
    }
}

TEST_F(ByAParticipant, ATrialHasOneLevelWheneverItIsAnswered) {
    // It still rings when the stimulus is over, and has faded when the next one begins.
    folder.getChildFile("ring.csv")
        .replaceWithText("time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n0.02,200,25,0.2,0,0\n");
    begin(
        R"({"name": "main", "task": "estimate", "repetitions": 3, "question": "How strong?"})",
        R"("layout": "study1", "stimuli": "calls", "call": "render --from-events ring.csv --layout study1 --seconds 0.1")");
    passPage();
    for (int n = 0; n < 3; ++n) {
        p->feel();
        for (int i = 0; i < 10 * n; ++i) p->pump();
        p->type("1");
        p->enter();
        for (int i = 0; i < 60; ++i) p->pump();
    }
    close();
    const Texts rms = column("rms_g", "estimate");
    ASSERT_EQ(rms.size(), 3u);
    EXPECT_GT(std::stod(rms[0]), 0.0);
    for (const auto& one : rms) EXPECT_NEAR(std::stod(one), std::stod(rms[0]), 2e-4 * std::stod(rms[0]));
}

TEST_F(ByAParticipant, DoesNotBeginWhatTheCheckRefuses) {
    const std::string drop = R"("call": "render drop --seconds 0.5 --layout study1 --set height=)",
                      pair = R"("task": "choose", "alternatives": [{"name": "a"}, {"name": "b"}])";
    folder.getChildFile("tap.csv").replaceWithText(
        juce::File{PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/taps-wood.csv"}.loadFileAsString());
    for (
        const auto& [calls, task, says] : std::vector<std::array<std::string, 3>>{
            {drop + "1.5\"", R"("task": "estimate")", "expected one of 1, 2, 3, found \"1.5\""},
            {drop +
                 R"({height}", "factors": [{"name": "height", "values": ["1.5"], "alternative": "b", "otherwise": "1"}])",
             pair, "expected one of 1, 2, 3, found \"1.5\""},
            {R"("call": "render --from-events {file}.csv --layout study1 --seconds 0.5", "factors": [{"name": "file", "values": ["tap", "gone"]}])",
             R"("task": "estimate")", "short: condition c, gone: "}}) {
        std::string refused =
            choose(*p, test::shortProtocol(R"("layout": "study1", "stimuli": "calls", )" + calls,
                                           R"({"name": "main", )" + task + "}"));
        if (refused.empty()) refused = p->tab().begin();
        EXPECT_NE(refused.find(says), std::string::npos) << refused;
        ASSERT_EQ(p->screen(), nullptr) << calls;
    }
}

TEST_F(ByAParticipant, PausesWhereTheDaysExposureReachesTheProtocolsLimit) {
    p->model.change("Level", [](Mix& mix) { mix.levelDb = 0.0; });
    begin(R"({"name": "main", "task": "estimate", "repetitions": 20, "question": "How strong?"})",
          calls("level_g", R"(["1"])",
                "stimulus phantom --at 0,0 --seconds 0.8 --frequency 40 --level-g {level_g}"),
          R"(, "exposure_limit_m_per_s2": 0.02)");
    passPage();
    int trials = 0;
    for (; p->screen()->page() == StudyScreen::Page::trial && trials < 20; ++trials) {
        p->feel();
        p->type("1");
        p->enter();
    }
    EXPECT_EQ(p->screen()->page(), StudyScreen::Page::exposureLimit);
    EXPECT_GT(trials, 1) << "0.8 s of 1 g at 40 Hz are an A(8) of about 0.015 m/s^2";
    EXPECT_LT(trials, 4);
    EXPECT_TRUE(p->words().contains("the study pauses")) << p->words();
    EXPECT_TRUE(p->words().contains("this study's limit is 0.02 m/s^2")) << p->words();
    p->enter();
    ASSERT_TRUE(p->isGone());
    goOn();
    EXPECT_EQ(p->screen()->page(), StudyScreen::Page::exposureLimit) << "the same day";
    p->enter();
    ASSERT_TRUE(p->isGone());
    const juce::File rows = folder.getChildFile("short-P01.csv");
    rows.setLastModificationTime(juce::Time::getCurrentTime() - juce::RelativeTime::days(2));
    goOn();
    EXPECT_EQ(p->screen()->page(), StudyScreen::Page::ready) << "another day";
    EXPECT_EQ(p->experiment().answeredTrials(), trials);
}

TEST_F(ByAParticipant, GivesNumbers) {
    begin(estimate, calls("level_g", R"(["0.05", "0.1", "0.2"])", tone + "{level_g}"));
    passPage();
    const Texts numbers{"7", "12.5", "0.3"};
    for (const auto& n : numbers) {
        p->feel();
        ASSERT_TRUE(p->canUse("Number"));
        p->enter(); // nothing is typed yet
        p->type(n);
        p->enter();
    }
    close();
    EXPECT_EQ(column("value", "estimate"), numbers);
    p->click("Analyse the participant's trials, or other files");
    ASSERT_NE(p->tab().analysis(), nullptr);
    const auto& report = p->tab().analysis()->report();
    EXPECT_EQ(report.error, "");
    EXPECT_FALSE(report.isSimulated);
    EXPECT_NE(report.table.find(",1,1,7,"), std::string::npos) << report.text;
    ASSERT_NE(p->tab().analysis()->picture(), nullptr);
    EXPECT_GT(p->tab().analysis()->picture()->getWidth(), 100);
    p->click("Close the analysis");
    ASSERT_TRUE(test::runUntil([&] { return p->tab().analysis() == nullptr; }));
    EXPECT_NE(p->find("Tabs"), nullptr) << "the mixer is back";
    analyse("levels");
}

TEST_F(ByAParticipant, DescribesInWords) {
    for (const bool mayBeEmpty : {false, true}) {
        begin(std::string{R"({"name": "main", "task": "describe")"} +
                  (mayBeEmpty ? R"(, "may_be_empty": true})" : "}"),
              calls("level_g", R"(["0.05", "0.1"])", tone + "{level_g}"));
        passPage();
        p->feel();
        ASSERT_TRUE(p->canUse("Words"));
        EXPECT_EQ(p->isAnswerOpen("Next"), mayBeEmpty);
        if (!mayBeEmpty) p->enter(); // nothing is written yet
        p->type(mayBeEmpty ? "" : "like, ");
        if (!mayBeEmpty) p->screen()->grabKeyboardFocus(); // as a busy display does
        p->type(mayBeEmpty ? "" : "a \"tap\"");
        EXPECT_EQ(p->screen()->plays(), 1) << "space is a letter";
        p->enter();
        p->feel();
        ASSERT_TRUE(p->canUse("Words"));
        p->type("=soft ");
        p->enter();
        close();
        EXPECT_EQ(column("response", "describe"),
                  (mayBeEmpty ? Texts{"", "=soft"} : Texts{"like, a \"tap\"", "=soft"}));
        folder.getChildFile("short-P01.csv").deleteFile();
        folder.getChildFile("short-P01.times.txt").deleteFile();
    }
}

TEST_F(ByAParticipant, AnalysesFilesAsTheProgramDoesAndMarksWhatIsSimulated) {
    call("study run phantom-grids --observer simulated-RING > /dev/null && '" PHYSVIB_PROGRAM
         "' analyse confusion phantom-grids-P01.csv > told.txt 2> warned.txt");
    p->tab().analyse({folder.getChildFile("phantom-grids-P01.csv")});
    ASSERT_NE(p->tab().analysis(), nullptr);
    const auto& report = p->tab().analysis()->report();
    EXPECT_TRUE(report.isSimulated);
    EXPECT_EQ("SIMULATED: a simulated observer answered, not a person\n" + report.text,
              folder.getChildFile("told.txt").loadFileAsString().toStdString());
    const auto warned = folder.getChildFile("warned.txt").loadFileAsString();
    for (const auto& warning : report.warnings)
        EXPECT_TRUE(warned.contains(juce::String::fromUTF8(warning.c_str()))) << warning;
    EXPECT_NE(p->tab().analysis()->picture(), nullptr);
    p->key(juce::KeyPress::escapeKey);
    EXPECT_TRUE(p->model.isSilent()) << "the world goes on behind it";
    p->click("Silence");
    EXPECT_FALSE(p->model.isSilent());
    folder.getChildFile("diary.csv").replaceWithText("dear,diary\n1,2\n");
    p->tab().analysis()->analyse({folder.getChildFile("diary.csv")});
    EXPECT_NE(p->tab().analysis()->report().error.find("diary.csv: expected trials of a study"),
              std::string::npos);
    EXPECT_EQ(p->tab().analysis()->picture(), nullptr);
}

TEST_F(ByAParticipant, SilenceHoldsAndTheMixComesBack) {
    p->model.change("Mute", [](Mix& mix) { mix.strips[1].isMuted = true; });
    begin(R"({"name": "main", "task": "identify"})", twoPoints);
    EXPECT_EQ(p->model.session().world().slowness(), 0) << "the world stands still";
    passPage();
    p->key(juce::KeyPress::escapeKey);
    EXPECT_TRUE(p->model.isSilent());
    p->space();
    EXPECT_EQ(p->screen()->plays(), 0) << "silent: nothing is felt, nothing counts";
    p->click("Silence");
    EXPECT_FALSE(p->model.isSilent());
    p->feel();
    p->click("Row 1, column 1");
    p->click("Next");
    ASSERT_TRUE(p->leave());
    EXPECT_EQ(p->model.session().world().slowness(), 1);
    EXPECT_EQ(column("response", "identify"), Texts{"1,1"});
}

TEST_F(ByAParticipant, BeginsWithWhatTheCallOfTheProgramChose) {
    p->view.tabs().choose("Materials");
    const auto file = folder.getChildFile("short.json");
    file.replaceWithText(test::shortProtocol(twoPoints, R"({"name": "main", "task": "identify"})"));
    p->view.chooseStudy({file.getFullPathName(), "Q7", 7, folder.getChildFile("rows").getFullPathName()});
    folder.getChildFile("rows").createDirectory();
    p->pump();
    ASSERT_TRUE(p->tab().isShowing());
    ASSERT_EQ(p->tab().begin(), "");
    EXPECT_EQ(p->screen()->study().path().filename(), "short-Q7.csv");
}

TEST_F(ByAParticipant, HearsPinkNoiseOnTheChosenOutputsForAsLongAsTheStudyGoesOn) {
    const auto choices = p->tab().noiseChoices();
    ASSERT_FALSE(choices.empty());
    EXPECT_EQ(choices.front(), (std::vector<int>{4, 5})) << "four enchanters have the first outputs";
    p->tab().setNoise({6, 7}, -30.0);
    begin(R"({"name": "main", "task": "identify"})", twoPoints,
          R"(, "pink_noise": true, "pink_noise_db": -35)");
    EXPECT_EQ(p->model.device().listening().settings().noise, (std::vector<int>{6, 7}));
    EXPECT_EQ(p->model.device().listening().settings().noiseDb, -35.0)
        << "the protocol's level, as it was chosen later";
    EXPECT_EQ(p->model.device().listening().beginStudy({{3}, -40.0, {}, 0.0}),
              "output 4 is an actuator's; expected another one to listen to");
    ASSERT_TRUE(p->leave());
    EXPECT_TRUE(p->model.device().listening().settings().noise.empty());
}

TEST_F(ByAParticipant, GoesOnWithTheApparatusOfTheTrialsBefore) {
    const auto setMaster = [&](double db) {
        p->model.change("Master level", [db](Mix& mix) { mix.levelDb = db; });
        p->pump();
    };
    setMaster(0.0);
    begin(R"({"name": "main", "task": "estimate", "repetitions": 3})", calls("n", R"(["1"])", tone + "0.1"));
    passPage();
    p->feel();
    ASSERT_TRUE(p->canUse("Number"));
    p->type("7");
    p->enter();
    ASSERT_TRUE(p->leave());
    EXPECT_EQ(column("master_db", "estimate"), Texts{"0"});
    EXPECT_EQ(column("noise_db", "estimate"), Texts{"off"});
    EXPECT_EQ(column("limiter_db", "estimate"), Texts{"0"});
    EXPECT_EQ(column("version", "estimate"), Texts{PHYSVIB_VERSION});
    setMaster(-12.0); // as after a crash
    EXPECT_NE(p->tab().begin().find("expected the master level as in the trials before, 0 dB, found -12 dB"),
              std::string::npos);
    EXPECT_EQ(p->screen(), nullptr);
    ASSERT_EQ(p->model.messages().current().action.name, "Set 0.0 dB") << "the level is offered";
    p->model.messages().current().action.run();
    EXPECT_EQ(p->model.mix().levelDb, 0.0);
    p->tab().setNoise(p->tab().noiseChoices().front(), -35.0);
    EXPECT_NE(p->tab().begin().find("expected the pink noise as in the trials before, off, found -35 dB"),
              std::string::npos);
    EXPECT_TRUE(p->model.device().listening().settings().noise.empty())
        << "nothing is heard of a study that did not begin";
    p->tab().setNoise({}, -35.0);
    goOn();
    ASSERT_TRUE(p->leave());
}

TEST_F(ByAParticipant, AnswersInTimeOrTheTrialRunsOut) {
    begin(R"({"name": "main", "task": "estimate", "repetitions": 3, "answer_within_s": 1.5})",
          calls("n", R"(["1"])", tone + "0.1"));
    EXPECT_TRUE(p->words().contains("Answer within 1.5 s."));
    passPage();
    const auto taken = [&] { return p->experiment().answeredTrials(); };
    p->feel();
    ASSERT_TRUE(test::runUntil([&] { return taken() == 1; })) << "time is over";
    EXPECT_TRUE(p->words().contains("Time was over."));
    p->feel();
    p->model.setSilent(true);
    const double from = nowMs();
    test::runUntil([&] { return taken() > 1 || nowMs() > from + 2000.0; });
    EXPECT_EQ(taken(), 1) << "time stands still while all is silent";
    p->model.setSilent(false);
    ASSERT_TRUE(p->canUse("Number"));
    p->type("7");
    p->enter();
    ASSERT_TRUE(test::runUntil([&] { return taken() == 2; }));
    EXPECT_EQ(column("ran_out", "estimate"), (Texts{"1", "0"}));
    EXPECT_EQ(column("value", "estimate"), (Texts{"", "7"}));
}

TEST_F(ByAParticipant, WhatCannotBeFeltHereIsRefusedBeforeItBegins) {
    for (const auto& [call, says] : std::vector<std::pair<std::string, std::string>>{
             {"stimulus phantom --at 0.5,2", "expected X,Y from 0 to 1"},
             {tone + "40", "expected at most its full scale of 1 g"},
             {"render drop --method SV", "--method SV: expected a --sound for each material"},
             {"render drop --method SV --sound 80=gone.wav", "gone.wav: cannot be read"},
             {"render drop --method SV --sound 81=synthetic-1",
              "expected a --sound for concrete block or 80 Hz"},
             {"devices", "call: expected render or stimulus"}}) {
        std::string fault = choose(*p, test::shortProtocol(calls("n", R"(["1"])", call), estimate));
        if (fault.empty()) fault = p->tab().begin();
        EXPECT_NE(fault.find(says), std::string::npos) << fault;
    }
    EXPECT_EQ(p->screen(), nullptr);
    EXPECT_FALSE(folder.getChildFile("short-P01.csv").exists());
}

TEST(FeltStimuli, AreInGWhateverAnActuatorCanGive) {
    LayoutDescription layout = presetLayout("phone4");
    for (std::size_t j = 0; j < 4; ++j) layout.actuators[j].fullScaleG = 2.0 + static_cast<double>(j);
    const auto file = juce::File::createTempFile(".json");
    file.replaceWithText(juce::String{layoutJson(layout)});
    StimulusJob job{PhantomJob{}};
    job.layout = file.getFullPathName().toStdString();
    const auto felt = makePlayableStimulus(job, 48000);
    file.deleteFile();
    ASSERT_EQ(felt.value.gains.size(), 4u) << felt.error;
    for (std::size_t j = 0; j < 4; ++j)
        EXPECT_FLOAT_EQ(felt.value.gains[j], static_cast<float>(1.0 / (2.0 + static_cast<double>(j))));
}

} // namespace
} // namespace physvib

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (std::getenv("DISPLAY") == nullptr)
        return std::puts("skipped: a participant needs a display; run it by xvfb-run"), 77;
    // a program of its own: JUCE outlives errors of X
    juce::JUCEApplicationBase::createInstance = []() -> juce::JUCEApplicationBase* { return nullptr; };
    const juce::ScopedJuceInitialiser_GUI juce;
    return RUN_ALL_TESTS();
}
