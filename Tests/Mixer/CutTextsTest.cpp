// SPDX-License-Identifier: GPL-3.0-or-later
// No text of the window is cut or crushed, on any page, in small and large windows, with up to 64 actuators.
#include "CutTexts.h"
#include "Contrast.h"
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/Widgets/Cards.h"
#include "MixerTesting.h"

namespace physvib::cut_texts_test {

using namespace test;

struct CutTexts {
    MixerModel model{onlyNoDevice(), noDevice, MixerModel::defaultMix(), {.isPaused = true}};
    MixerView view{model};
    std::string size;

    CutTexts(int width, int height, int actuators)
        : size{std::to_string(width) + "x" + std::to_string(height) + " with " + std::to_string(actuators)} {
        view.setSize(width, height);
        for (int k = 0; k < 12; ++k) view.refresh(); // some numbers wait for the twelfth
        while (model.mix().count() < actuators && model.attach(0.5, 0.5)) {
        }
        while (model.mix().count() > actuators) model.detach(0);
    }
    /// JUCE places letters by a component's own pixels: a scale changes the picture and not what is cut.
    void expectWhole(const std::string& state, int leastWords = 20) {
        model.dispatchPendingMessages();
        for (int k = 0; k < 2; ++k) view.refresh();
        const auto read = readTexts(view);
        EXPECT_GT(read.words.size(), leastWords) << size << state;
        for (const auto& cut : read.cut) {
            if (cut.why == "cut by an edge" && isEdgeOfRow(view, cut.edge)) continue;
            juce::String where;
            for (auto* c = view.getComponentAt(cut.at); c != nullptr; c = c->getParentComponent())
                if (c->getTitle().isNotEmpty()) where << " < " << c->getTitle();
            ADD_FAILURE() << size << ", " << state << ": \"" << cut.words << "\" " << cut.why << " at "
                          << cut.at.toString() << where;
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
};

// Below 1400 pixels the bar has two lines; 1000 x 640 is the smallest window. One process pays for the
// typefaces.
TEST(CutTexts, AreOnNoPageAtAnySize) {
    struct Case {
        int width, height, actuators;
    };
    for (const auto& [width, height, actuators] : {Case{MixerView::minWidth, MixerView::minHeight, 1},
                                                   {MixerView::minWidth, MixerView::minHeight, 64},
                                                   {1024, 700, 4},
                                                   {1280, 800, 16},
                                                   {1440, 900, 64},
                                                   {1920, 1080, 16},
                                                   {2560, 1440, 4}}) {
        CutTexts texts{width - 240, height, actuators};
        for (int k = 0; k < std::ssize(texts.model.world().scene().materials); ++k)
            texts.model.world().edit("Grain", TextureAction{k, 0.006, 1.6, {}, 0.2});
        texts.model.setSilent(true);
        for (auto* panel : {&texts.view.tabs(), &texts.view.scope()})
            for (const auto& name : panel->names()) {
                panel->choose(name);
                texts.expectWhole(name.toStdString());
            }
        texts.view.setSize(width, height);
        texts.view.setMode(Mode::play);
        texts.expectWhole("to play", 8);
        texts.view.world().drawing().setTool(DrawTool::select);
        texts.view.world().drawing().select({texts.model.world().drawing().drawn().bodies.back().name});
        texts.expectWhole("a chosen body", 8);
        texts.view.setMode(Mode::engineer);
        texts.view.setPanels({true, true});
        texts.view.world().drawing().selectAll();
        texts.model.messages().show(
            {"This study is felt on 16 actuators, and headphones are two. " +
                 juce::String::repeatedString("What is said of it is long, and stays whole. ", 3),
             true,
             {"Choose Direction discrimination instead", [] {}},
             "long"});
        texts.expectWhole("an offer", 8);
        texts.view.world().drawing().setTool(DrawTool::wall);
        texts.model.messages().withdraw("long");
        texts.expectWhole("materials", 8);
        texts.view.setPanels({false, true});
        texts.view.setMode(Mode::play);
        texts.view.world().drawing().setTool(DrawTool::hand);
        texts.view.setFirstStart(std::make_unique<FirstStart>(
            texts.model,
            std::vector<PlaybackChoice>{{"Four-channel board: /dev/ttyACM0  ST-Link", noDevice, 4},
                                        {"No device: seen, not felt", noDevice, 0}}));
        texts.expectWhole("first start", 8);
        texts.view.firstStart()->test(4);
        texts.expectWhole("test of the first start", 8);
        texts.view.setFirstStart(nullptr);
        TestFolder folder;
        texts.view.setCard(
            std::make_unique<FileCard>(FileCard::Choice{"Save", ".json", folder.folder, true}));
        texts.expectWhole("files", 8);
        texts.view.setCard(nullptr);
    }
}

// A tooltip has as many lines as its words take in the one size.
TEST(CutTexts, NamesAreBrokenNowhereAndALongFolderShowsItsEnd) {
    CutTexts texts{1024, 900, 4};
    texts.view.tabs().choose("Studies");
    auto& studies = *texts.view.tabs().find<StudiesTab>();
    studies.chooseProtocol("patterns");
    studies.setFolder(juce::File{"/home/" + juce::String::repeatedString("a folder of many letters/", 4)});
    const auto& folder = the<juce::TextEditor>(texts.view, "Folder of the trial files");
    EXPECT_EQ(folder.getCaretPosition(), folder.getText().length());
    for (int width = MixerView::minWidth; width < 1500; width += 20) {
        texts.view.setSize(width, 900);
        for (const auto& word : readTexts(studies).words) EXPECT_FALSE(word.endsWith("-")) << width << word;
    }
}

TEST(CutTexts, ASilencedMixerHasNothingThatRingsAndThePanelOfABodyHasWholeLines) {
    CutTexts texts{1440, 900, 4};
    texts.model.setSilent(true);
    for (int k = 0; k < 13; ++k) texts.view.refresh();
    EXPECT_TRUE(readTexts(*find(texts.view, "Transport and device")).words.contains("silenced"));
    texts.view.world().drawing().setTool(DrawTool::select);
    for (int more = 0; more < 3; ++more) { // as many materials fill a row
        texts.view.world().drawing().select({texts.model.world().drawing().drawn().bodies.back().name});
        auto& panel = *find(texts.view, "Chosen bodies");
        EXPECT_TRUE(readTexts(panel).words.contains("hapticsource"));
        const auto& materials = texts.model.world().drawing().drawn().materials;
        EXPECT_EQ(the(panel, "New material for what is chosen").getY(),
                  the(panel, "Made of " + utf8(materials.back().name)).getY())
            << materials.size();
        texts.model.change("More", [&](Mix& mix) {
            Scene scene = texts.model.world().drawing().drawn();
            scene.materials.push_back(scene.materials.front());
            scene.materials.back().name = "more " + std::to_string(more);
            mix.scene = std::make_shared<const Scene>(scene);
        });
        texts.model.dispatchPendingMessages();
    }
}

TEST(Tooltips, HaveOneSizeOfLetters) {
    struct Sizes final : LetterRenderer {
        using LetterRenderer::LetterRenderer;
        void draw(int, const juce::AffineTransform&, const std::function<void()>&) override {
            EXPECT_EQ(getFont().getHeight(), text::small);
            ++letters;
        }
        int letters = 0;
    };
    Look look;
    for (const auto& tool : drawTools) {
        const auto tip = juce::String{tool.name} + ": " + tool.help + " (I)";
        const auto area = look.getTooltipBounds(tip, {}, {1024, 700});
        Sizes sizes{juce::Image{juce::Image::RGB, area.getWidth(), area.getHeight(), true,
                                juce::SoftwareImageType{}}};
        juce::Graphics g{sizes};
        look.drawTooltip(g, tip, area.getWidth(), area.getHeight());
        EXPECT_GE(sizes.letters, tip.removeCharacters(" ").length()) << tip;
    }
}

// An actuator that is attached while others play begins quietly: its strip says by how much.
TEST(StripTexts, AGainIsWrittenBesideTheName) {
    MixerModel model{onlyNoDevice(), noDevice, MixerModel::defaultMix(), {.isPaused = true}};
    MixerView view{model};
    model.attach(0.5, 0.5);
    model.dispatchPendingMessages();
    const auto wordsOf = [&view](const char* strip) {
        return readTexts(*find(view, strip)).words.joinIntoString(" ");
    };
    EXPECT_EQ(wordsOf("Strip A").upToFirstOccurrenceOf(" ", false, false), "A");
    EXPECT_TRUE(wordsOf("Strip E").contains(juce::String::fromUTF8("\xe2\x88\x92") + "12.0"))
        << wordsOf("Strip E");
}

// Every text of the window stands out by 4.5, every control by 3, in both looks, as measured in pictures.

using namespace test;

constexpr double leastOfText = 4.5, leastOfControl = 3.0;
constexpr float scale = 2.0f;

bool isDrawnControl(const juce::Component& c) {
    const auto* bar = dynamic_cast<const juce::ScrollBar*>(&c);
    return dynamic_cast<const juce::Button*>(&c) || dynamic_cast<const juce::ComboBox*>(&c) ||
           dynamic_cast<const juce::Slider*>(&c) || dynamic_cast<const juce::TextEditor*>(&c) ||
           dynamic_cast<const Divider*>(&c) || (bar && bar->isVisible());
}

juce::String nameOf(const juce::Component* c) {
    juce::String name;
    for (; c != nullptr; c = c->getParentComponent())
        if (c->getTitle().isNotEmpty()) name = c->getTitle() + (name.isEmpty() ? "" : " < " + name);
    return name;
}

/// What is seen of it: a page that scrolls shows a part.
juce::Rectangle<int> seenOf(juce::Component& root, juce::Component& c) {
    auto area = root.getLocalArea(&c, c.getLocalBounds());
    for (auto* p = c.getParentComponent(); p != nullptr && p != root.getParentComponent();
         p = p->getParentComponent())
        area = area.getIntersection(root.getLocalArea(p, p->getLocalBounds()));
    return area;
}

void expectControls(juce::Component& root, juce::Component& c, const Picture& picture,
                    const std::string& state) {
    for (auto* child : c.getChildren()) {
        if (!child->isVisible()) continue;
        const auto seen = seenOf(root, *child);
        auto* on = seen.isEmpty() ? nullptr : root.getComponentAt(seen.getCentre());
        const bool isSeen = on != nullptr && (on == child || child->isParentOf(on) || on->isParentOf(child));
        if (isDrawnControl(*child) && isSeen && child->isEnabled() &&
            seen.getHeight() >= child->getHeight() / 2)
            EXPECT_GE(contrastOfControl(picture.image, seen * juce::roundToInt(scale)), leastOfControl)
                << state << ": " << nameOf(child) << " at " << seen.toString();
        expectControls(root, *child, picture, state);
    }
}

struct Contrasts : testing::TestWithParam<Theme> {
    MixerModel model{onlyNoDevice(), noDevice, MixerModel::defaultMix(), {.isPaused = true}};
    MixerView view{model};

    Contrasts() {
        view.setSize(1280, 720);
        view.setTheme(GetParam() == Theme::dark ? Theme::light : Theme::dark);
        view.setTheme(GetParam()); // what was written in the other is read in this one
    }
    void expectReadable(const std::string& state) {
        model.dispatchPendingMessages();
        for (int k = 0; k < 2; ++k) view.refresh();
        const auto picture = pictureOf(view, scale);
        for (const auto& text : picture.texts) {
            const auto at = (text.area.toFloat() / scale).getCentre().toInt();
            EXPECT_GE(text.contrast, leastOfText)
                << state << ": " << nameOf(view.getComponentAt(at)) << " at " << at.toString() << ", "
                << text.ink.toDisplayString(false) << " on " << text.ground.toDisplayString(false);
        }
        EXPECT_GT(picture.texts.size(), 5U) << state;
        expectControls(view, view, picture, state);
    }
};

TEST_P(Contrasts, OfEveryPage) {
    for (auto* panel : {&view.tabs(), &view.scope()})
        for (const auto& name : panel->names()) {
            panel->choose(name);
            expectReadable(name.toStdString());
        }
}

TEST_P(Contrasts, OfStatesAndTools) {
    model.change("Strips", [](Mix& m) {
        m.strips[0].isMuted = m.strips[1].isSolo = m.strips[2].isInverted = true;
        m.strips[3].delayMs = 5.0;
    });
    model.report("session.json: expected a number, found none");
    expectReadable("muted and a fault");
    model.setSilent(true);
    expectReadable("silent");
    view.world().drawing().setTool(DrawTool::rain);
    expectReadable("rain");
    view.world().drawing().setTool(DrawTool::select);
    view.world().drawing().select({model.world().scene().bodies.front().name});
    expectReadable("a body");
}

TEST_P(Contrasts, OfTheStrongestHit) {
    const auto& sentence = the<juce::Label>(view, "Strongest hit");
    model.setSlowness(1);
    ASSERT_TRUE(runUntil([&] { return view.refresh(), sentence.getText().contains(" g "); }, 10.0));
    model.setSlowness(0);
    expectReadable("a hit");
}

TEST_P(Contrasts, OfSixtyFourActuators) {
    while (model.mix().count() < 64 && model.attach(0.5, 0.5)) {
    }
    expectReadable("64 actuators");
}

TEST_P(Contrasts, OfCards) {
    view.setFirstStart(std::make_unique<FirstStart>(
        model, std::vector<PlaybackChoice>{{"JACK:system, 8 outputs", noDevice, 8},
                                           {"No device: seen, not felt", noDevice, 0}}));
    expectReadable("first start");
    view.setFirstStart(nullptr);
    TestFolder folder;
    folder("there.json").replaceWithText("{}");
    view.setCard(
        std::make_unique<FileCard>(FileCard::Choice{"Save", ".json", folder.folder, true, "session"}));
    expectReadable("files");
    view.setCard(std::make_unique<QuestionCard>(
        "Share", "Words of the question",
        std::vector<QuestionCard::Answer>{{"Take", [] {}}, {"Cancel", [] {}}},
        std::vector<QuestionCard::Field>{{"Link", "http://127.0.0.1:8000/#scene=shake-the-box"}}));
    expectReadable("question");
}

INSTANTIATE_TEST_SUITE_P(Looks, Contrasts, testing::Values(Theme::dark, Theme::light),
                         [](const auto& theme) { return theme.param == Theme::dark ? "dark" : "light"; });

} // namespace physvib::cut_texts_test
