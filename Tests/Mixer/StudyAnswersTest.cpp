// SPDX-License-Identifier: GPL-3.0-or-later
// The components with which participants answer, and the tab that chooses a study, without a screen: each
// answer is of what was felt, and what is chosen is what stands there.
#include "Lab/Files/ProtocolFile.h"
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/Studies/StudyParts.h"
#include "Mixer/Widgets/Cards.h"
#include "MixerTesting.h"
#include "TestPlaces.h"

namespace physvib::study_answers_test {

using namespace test;

// Objects come in another order in each trial, and the rows have a column for each.
TEST(StudyAnswers, RatingsSideBySideAreOfTheObjectThatWasFeltAtEachLetter) {
    const auto protocol = loadProtocol(PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/side-by-side.json");
    ASSERT_TRUE(protocol) << protocol.error;
    const StudyTexts texts;
    const auto layout = presetLayout("phone2");
    std::set<std::vector<std::string>> orders;
    for (Experiment experiment{protocol.value, {}}; !experiment.isDone();) {
        const Trial trial = experiment.trial();
        const auto& objects = experiment.session().objects;
        const auto answer = makeStudyAnswer(experiment, layout, texts);
        std::vector<double> expected;
        for (std::size_t object = 0; object < objects.size(); ++object) {
            expected.push_back(15.0 + 20.0 * static_cast<double>(object));
            const auto part = std::find(trial.parts.begin() + 1, trial.parts.end(), objects[object]);
            ASSERT_NE(part, trial.parts.end()); // the first is the reference, which has no slider
            const auto letter = partLetter(static_cast<std::size_t>(part - trial.parts.begin() - 1));
            EXPECT_FALSE(answer->isComplete());
            the<juce::Slider>(*answer, letter).setValue(expected.back(), juce::sendNotificationSync);
        }
        EXPECT_TRUE(answer->isComplete());
        EXPECT_EQ(answer->answer().scores, expected);
        orders.insert(trial.parts);
        experiment.acceptAnswer(answer->answer());
    }
    EXPECT_GT(orders.size(), 2u) << "in one order alone, none could be mixed up";
}

/// Of two stimuli that have names.
std::string weakOrStrong(const std::string& more = {}) {
    return R"({"physvib_protocol": 1, "name": "short", "conditions": [{"name": "c", "layout": "phone2", "stimuli": "calls",
        "factors": [{"name": "n", "values": ["weak", "strong"]}], "call": "stimulus phantom --layout phone2 --at 0.5,0.5 --seconds 0.05 --level-g 0.1"}],
        "sessions": [{"name": "main", "task": "identify"}])" +
           more + "}";
}

TEST(StudyAnswers, EachNameIsAButtonThatAnswersItAndSaysWhetherItWasFelt) {
    TestFolder folder;
    folder("short.json").replaceWithText(weakOrStrong());
    const auto protocol = loadProtocol(pathOf(folder("short.json")));
    ASSERT_TRUE(protocol) << protocol.error;
    const StudyTexts texts;
    const Experiment experiment{protocol.value, {}};
    const auto layout = presetLayout("phone2");
    const auto answer = makeStudyAnswer(experiment, layout, texts);
    answer->setSize(900, 600);
    EXPECT_FALSE(answer->isComplete());
    answer->markPlayed({"strong"});
    auto &weak = the<juce::Button>(*answer, "weak"), &strong = the<juce::Button>(*answer, "strong");
    EXPECT_FALSE(weak.getBounds().isEmpty() || weak.getBounds().intersects(strong.getBounds()));
    for (auto* button : {&strong, &weak}) {
        button->onClick();
        EXPECT_EQ(utf8(answer->answer().response), button->getTitle());
        EXPECT_EQ(button->getDescription(), button == &strong ? "was felt" : "");
    }
    EXPECT_TRUE(answer->isComplete());
}

struct ChosenStudy : testing::Test, MixerInView {
    TestFolder folder;
    StudiesTab& tab = (view.tabs().choose("Studies"), *view.tabs().find<StudiesTab>());

    std::string choose(const std::string& more) {
        folder("short.json").replaceWithText(weakOrStrong(more));
        return tab.chooseProtocol(pathOf(folder("short.json")));
    }
    juce::String shown(const juce::String& title) { return the<juce::ComboBox>(tab, title).getText(); }
};

TEST_F(ChosenStudy, HasItsNoiseAsLoudAsItSays) {
    for (const auto& [db, text] :
         {std::pair{"-30", "\u221230 dBFS"}, {"-30.4", "\u221230.4 dBFS"}, {"-33", "\u221233.0 dBFS"}}) {
        ASSERT_EQ(choose(std::string{R"(, "pink_noise": true, "pink_noise_db": )"} + db), "");
        EXPECT_EQ(shown("Level of the pink noise"), utf8(text));
    }
}

TEST_F(ChosenStudy, StaysWhereAFileIsNoneAndTheNextCanBeChosen) {
    folder("bad.json").replaceWithText("{}");
    tab.setFolder(folder.folder);
    const auto before = shown("Protocol");
    for (int k = 0; k < 2; ++k) {
        chooseIn(tab, "Protocol", "Protocol file");
        auto* const card = dynamic_cast<FileCard*>(view.card());
        ASSERT_NE(card, nullptr) << "asked " << k << " times before";
        card->setName("bad");
        card->accept();
        ASSERT_TRUE(runUntil([&] { return view.card() == nullptr; }));
        EXPECT_EQ(shown("Protocol"), before) << "which Begin would begin";
    }
}

} // namespace physvib::study_answers_test
