// SPDX-License-Identifier: GPL-3.0-or-later
// The components with which participants answer, without a screen: each answer is of what was felt.
#include "Lab/Files/ProtocolFile.h"
#include "Mixer/Studies/StudyParts.h"
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

} // namespace physvib::study_answers_test
