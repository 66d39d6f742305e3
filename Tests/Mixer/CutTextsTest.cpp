// SPDX-License-Identifier: GPL-3.0-or-later
// No text of the window is cut or crushed, on any page, at six sizes and two scales, with up to 64 actuators.
#include "CutTexts.h"
#include "MixerTesting.h"

namespace physvib {
namespace {

using namespace test;

class CutTexts : public testing::TestWithParam<std::tuple<std::pair<int, int>, int>> {
protected:
    Desk desk{onlyNoDevice(), noDevice, Desk::firstMix(), {.isPaused = true}};
    MixerView view{desk};
    std::size_t texts = 0;

    CutTexts() {
        const auto& [size, actuators] = GetParam();
        view.setSize(size.first, size.second);
        while (desk.mix().count() < actuators && desk.attach(0.5, 0.5)) {
        }
        if (actuators == 1)
            desk.change("One", [](Mix& m) {
                auto one = m.layout.geometry;
                one.count = 1;
                m.layout = describeLayout("one", one);
                m.resizeStrips();
            });
    }
    void expectWhole(const std::string& state) {
        desk.dispatchPendingMessages();
        for (int k = 0; k < 12; ++k) view.refresh(); // some numbers wait for the twelfth
        for (const float scale : {1.0f, 2.0f}) {
            if (scale * static_cast<float>(view.getWidth()) > 6000.0f) continue; // larger than any display
            const auto read = readTexts(view, scale);
            texts += static_cast<std::size_t>(read.words.size());
            EXPECT_GT(read.words.size(), 20) << state;
            for (const auto& cut : read.cut) {
                juce::String where;
                for (auto* c = view.getComponentAt(cut.at); c != nullptr; c = c->getParentComponent())
                    if (c->getTitle().isNotEmpty()) where << " < " << c->getTitle();
                ADD_FAILURE() << state << " at " << scale << ": \"" << cut.words << "\" " << cut.why << " at "
                              << cut.at.toString() << where;
            }
        }
    }
    void TearDown() override { std::cout << texts << " texts\n"; }
};

TEST_P(CutTexts, AreOnNoPage) {
    for (const auto& name : view.tabs().names()) {
        view.tabs().choose(name);
        expectWhole(name.toStdString());
    }
    for (const auto& name : view.scope().names()) {
        view.scope().choose(name);
        expectWhole(name.toStdString());
    }
}

// An actuator that is attached while others play begins quietly: its strip says by how much.
TEST(StripTexts, AGainIsWrittenBesideTheName) {
    Desk desk{onlyNoDevice(), noDevice, Desk::firstMix(), {.isPaused = true}};
    MixerView view{desk};
    desk.attach(0.5, 0.5);
    desk.dispatchPendingMessages();
    const auto wordsOf = [&view](const char* strip) {
        return readTexts(*find(view, strip), 1.0f).words.joinIntoString(" ");
    };
    EXPECT_EQ(wordsOf("Strip A").upToFirstOccurrenceOf(" ", false, false), "A");
    EXPECT_TRUE(wordsOf("Strip E").contains(juce::String::fromUTF8("\xe2\x88\x92") + "12.0"))
        << wordsOf("Strip E");
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, CutTexts,
    testing::Combine(testing::Values(std::pair{MixerView::leastWidth, MixerView::leastHeight},
                                     std::pair{1024, 700}, std::pair{1280, 720}, std::pair{1440, 900},
                                     std::pair{1920, 1080}, std::pair{2560, 1440}, std::pair{3840, 2160}),
                     testing::Values(1, 4, 16, 64)),
    [](const auto& p) {
        const auto size = std::get<0>(p.param);
        return std::to_string(size.first) + "x" + std::to_string(size.second) + "_" +
               std::to_string(std::get<1>(p.param));
    });

} // namespace
} // namespace physvib
