// SPDX-License-Identifier: GPL-3.0-or-later
// No text of the window is cut or crushed, on any page, at seven sizes, with up to 64 actuators.
#include "CutTexts.h"
#include "MixerTesting.h"

namespace physvib {
namespace {

using namespace test;

class CutTexts : public testing::TestWithParam<std::tuple<std::pair<int, int>, int>> {
protected:
    Desk desk{onlyNoDevice(), noDevice, Desk::firstMix(), {.isPaused = true}};
    MixerView view{desk};
    int texts = 0;

    CutTexts() {
        const auto& [size, actuators] = GetParam();
        view.setSize(size.first, size.second);
        for (int k = 0; k < 12; ++k) view.refresh(); // some numbers wait for the twelfth
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
    /// JUCE places letters by a component's own pixels: a scale changes the picture and not what is cut.
    void expectWhole(const std::string& state) {
        desk.dispatchPendingMessages();
        for (int k = 0; k < 2; ++k) view.refresh();
        const auto read = readTexts(view, 1.0f);
        texts += read.words.size();
        EXPECT_GT(read.words.size(), 20) << state;
        for (const auto& cut : read.cut) {
            if (cut.why == "cut by an edge" && isEdgeOfRow(view, cut.edge)) continue;
            juce::String where;
            for (auto* c = view.getComponentAt(cut.at); c != nullptr; c = c->getParentComponent())
                if (c->getTitle().isNotEmpty()) where << " < " << c->getTitle();
            ADD_FAILURE() << state << ": \"" << cut.words << "\" " << cut.why << " at " << cut.at.toString()
                          << where;
        }
    }
    /// Whether a row that scrolls sideways, such as the strips', ends there: it hides what is longer than its
    /// panel.
    bool isEdgeOfRow(const juce::Component& in, juce::Point<int> edge) const {
        for (const auto* child : in.getChildren()) {
            const auto* page = dynamic_cast<const juce::Viewport*>(child);
            const auto area = view.getLocalArea(child, child->getLocalBounds());
            if (child->isVisible() && page != nullptr && page->isHorizontalScrollBarShown() &&
                edge.y >= area.getY() && edge.y <= area.getBottom() &&
                std::min(std::abs(edge.x - area.getX()), std::abs(edge.x - area.getRight())) <= 1)
                return true;
            if (child->isVisible() && isEdgeOfRow(*child, edge)) return true;
        }
        return false;
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
