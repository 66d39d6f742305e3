// SPDX-License-Identifier: GPL-3.0-or-later
// Components of studies without a screen: answers are of what was felt, and what is chosen stands there.
#include "Host/FakeAudioDevice.h"
#include "Lab/Files/ProtocolFile.h"
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/Studies/StudyParts.h"
#include "Mixer/Studies/StudyScreen.h"
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

TEST(StudyAnswers, AStimulusThatCameOutWeakerOrStrongerThanPlannedIsNotComplete) {
    for (const auto& [factor, status] : {std::pair{1.0f, PlaybackStatus::complete},
                                         {0.8f, PlaybackStatus::wrongLevel},
                                         {1.25f, PlaybackStatus::wrongLevel}}) {
        FakeInterface hands;
        MixerModel model{
            fakeDrivers({&hands}), {"Fake:hands", 0, 0}, MixerModel::defaultMix(), {.isPaused = true}};
        for (int k = 0; k < 50; ++k) hands.play(64);
        StimulusPlayer player{model};
        const auto stimulus = StimulusPlayer::prepare(
            model, StimulusJob{.stimulus = PhantomJob{.seconds = 0.1}, .levelG = 0.5});
        ASSERT_EQ(player.play(stimulus.value), "") << stimulus.error;
        for (int j = 0; j < model.mix().count(); ++j)
            (void)model.session().submit(
                {RenderControl{.kind = RenderControl::Kind::gain,
                               .channel = j,
                               .value = factor * stimulus.value.gains[static_cast<std::size_t>(j)]}});
        for (int k = 0; k < 3000 && player.isPlaying(); ++k) hands.play(64), player.update();
        EXPECT_EQ(player.status(), status) << factor;
    }
}

struct ChosenStudy : testing::Test, MixerInView {
    TestFolder folder;
    StudiesTab& tab = (view.tabs().choose("Studies"), *view.tabs().find<StudiesTab>());
    juce::String shown(const juce::String& title) { return the<juce::ComboBox>(tab, title).getText(); }
};

TEST_F(ChosenStudy, HasItsNoiseAsLoudAsItSays) {
    const juce::File file = folder("short.json"),
                     sample{PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/yes-no.json"};
    for (const auto& [db, text] : {std::pair{"-30", "\u221230 dBFS"}, {"-30.4", "\u221230.4 dBFS"}}) {
        file.replaceWithText(sample.loadFileAsString().replaceFirstOccurrenceOf(
            "{", juce::String{"{\"pink_noise_db\": "} + db + ","));
        ASSERT_EQ(tab.chooseProtocol(pathOf(file)), "");
        EXPECT_EQ(shown("Level of the pink noise"), utf8(text));
    }
}

TEST_F(ChosenStudy, StaysWhereAFileIsNoneAndTheNextCanBeChosen) {
    folder("bad.json").create();
    tab.setFolder(folder.folder);
    const auto before = shown("Protocol");
    for (int k = 0; k < 2; ++k) {
        chooseIn(tab, "Protocol", "Protocol file");
        auto& card = dynamic_cast<FileCard&>(*view.card());
        card.setName("bad");
        card.accept();
        ASSERT_TRUE(runUntil([&] { return view.card() == nullptr; }));
        EXPECT_EQ(shown("Protocol"), before) << "which Begin would begin";
    }
}

} // namespace physvib::study_answers_test
