// SPDX-License-Identifier: GPL-3.0-or-later
// The window's components without a display: every control's name and keys, sizes, looks, clicks.
#include "Contrast.h"
#include "Live/Documents/Mix.h"
#include "Mixer/Window/MixerWindow.h"
#include "MixerTesting.h"
#include "Scene/SceneFile.h"
#include "Scene/World/BodyMass.h"
#include <cmath>
#include <set>

namespace physvib::mixer_view_test {

using namespace test;

struct ShownMixer : testing::Test, MixerInView {};

bool isControl(const juce::Component& c) {
    const auto* label = dynamic_cast<const juce::Label*>(&c);
    return dynamic_cast<const juce::Button*>(&c) != nullptr ||
           dynamic_cast<const juce::Slider*>(&c) != nullptr ||
           dynamic_cast<const juce::ComboBox*>(&c) != nullptr ||
           dynamic_cast<const juce::ListBox*>(&c) != nullptr || (label != nullptr && label->isEditable());
}

bool isPartOfControl(const juce::Component& c) {
    for (const auto* p = c.getParentComponent(); p != nullptr; p = p->getParentComponent())
        if (isControl(*p)) return true;
    return dynamic_cast<const juce::ScrollBar*>(c.getParentComponent()) != nullptr;
}

void walk(juce::Component& root, const std::function<void(juce::Component&)>& visit) {
    visit(root);
    for (auto* child : root.getChildren())
        if (child->isVisible()) walk(*child, visit);
}

/// That all controls under `root` which are visible now are named, reached, and seen when they are; the
/// names.
std::multiset<juce::String> expectRings(juce::Component& root) {
    std::multiset<juce::String> titles;
    walk(root, [&](juce::Component& c) {
        if (!isControl(c) || isPartOfControl(c)) return;
        const auto title = c.getTitle().isNotEmpty() ? c.getTitle() : c.getName();
        EXPECT_TRUE(title.isNotEmpty()) << typeid(c).name() << " in "
                                        << (c.getParentComponent() ? c.getParentComponent()->getTitle() : "");
        if (c.isEnabled()) EXPECT_TRUE(c.getWantsKeyboardFocus()) << title;
        EXPECT_TRUE(c.hasFocusOutline()) << title << ": focus has to be seen";
        EXPECT_TRUE(c.isAccessible()) << title;
        titles.insert(title);
    });
    return titles;
}

TEST_F(ShownMixer, WhatGoesWithAHiddenComponentIsNotHiddenAsWell) {
    struct Outlined final : juce::Component { // as JUCE's outline of what has the focus
        std::unique_ptr<juce::Component> outline = std::make_unique<juce::Component>();
        void visibilityChanged() override {
            if (!isVisible()) outline.reset();
        }
    } world;
    view.addAndMakeVisible(world);
    view.addAndMakeVisible(*world.outline);
    juce::Component screen;
    view.setScreen(&screen);
    EXPECT_EQ(world.outline, nullptr);
    view.setScreen(nullptr);
}

TEST_F(ShownMixer, NoKeyReachesWhatAScreenHides) {
    model.change("Mute", [](Mix& mix) { mix.strips[0].isMuted = true; });
    juce::Component screen;
    view.setScreen(&screen);
    view.keyPressed(KeyPress{'z', juce::ModifierKeys::commandModifier, 0});
    for (const int key : {int{KeyPress::spaceKey}, int{KeyPress::F2Key}, int{'B'}})
        view.keyPressed(KeyPress{key});
    EXPECT_TRUE(model.mix().strips[0].isMuted) << "nobody sees what is undone";
    EXPECT_EQ(model.session().world().slowness(), 1);
    EXPECT_EQ(view.mode(), Mode::engineer);
    EXPECT_EQ(view.world().drawing().tool(), DrawTool::hand);
    EXPECT_FALSE(model.isSilent());
    view.keyPressed(KeyPress{KeyPress::escapeKey});
    EXPECT_TRUE(model.isSilent());
    view.setScreen(nullptr);
}

TEST(MixerWindow, NoKeyReachesASessionThatAScreenHides) {
    TestFolder folder;
    MixerWindow window{onlyNoDevice(), "None:no device", {}, folder("config")};
    juce::Component screen; // it leaves keys, as one with a field for a comment does
    window.view().setScreen(&screen);
    for (const char key : {'s', 'o', 'e', 'n'})
        EXPECT_FALSE(window.keyPressed(KeyPress{key, juce::ModifierKeys::commandModifier, 0})) << key;
    window.view().setScreen(nullptr);
}

TEST_F(ShownMixer, EveryControlIsNamedAndReachedByTheKeyboard) {
    std::size_t controls = 0;
    model.setSlowness(0); // what is disabled cannot be reached
    model.dispatchPendingMessages();
    for (int k = 0; const auto& tab : view.tabs().names()) {
        view.tabs().choose(tab);
        view.scope().choose(view.scope().names()[k++ % view.scope().names().size()]);
        if (auto* list = dynamic_cast<juce::ListBox*>(find(view, "List of actuators"))) list->selectRow(1);
        const auto titles = expectRings(view);
        controls += titles.size();
        for (const auto& title : titles)
            EXPECT_EQ(titles.count(title), 1u) << title << " is the name of several controls of " << tab;
    }
    EXPECT_GT(controls, 60u);
}

TEST_F(ShownMixer, AnotherTabDoesNotFoldTheDrawerOnTheWay) {
    view.tabs().choose("Actuators");
    view.tabs().onOpen = [](bool isOpen) { EXPECT_TRUE(isOpen); };
    auto& output = the<juce::Button>(view.tabs(), "Output");
    output.triggerClick();
    EXPECT_TRUE(runUntil([&] { return output.getToggleState(); }));
}

TEST_F(ShownMixer, WhatComesLaterHasARingAsWell) {
    setScene(model, *findBuiltInScene("marbles"));
    model.dispatchPendingMessages();
    view.world().drawing().setTool(DrawTool::select);
    view.world().drawing().select({model.world().drawing().drawn().bodies.back().name});
    auto& palette = the(view, "Materials to draw with");
    EXPECT_GT(palette.getNumChildComponents(), 1) << "materials of the new scene";
    expectRings(view.world());
    view.world().drawing().setTool(DrawTool::hand);
    model.script().start();
    ASSERT_TRUE(runUntil([&] { return view.refresh(), model.script().seconds() > 0.0; }));
    ASSERT_EQ(model.world().apply(TiltAction{0.3}), "");
    expectRings(view.world());
    model.script().stop();
    model.dispatchPendingMessages();
    EXPECT_NE(find(view, "The script begins at"), nullptr);
    EXPECT_TRUE(runUntil([&] { return view.refresh(), the(view, "Script of hands").isVisible(); }));
    expectRings(view.world());
    view.setQuestion(std::make_unique<QuestionCard>(
        "Take it?", "It is there.", std::vector<QuestionCard::Answer>{{"Yes", [] {}}, {"No", [] {}}}));
    expectRings(view);
}

TEST(MixerView, ReturnIsTheFirstAnswerAndTheOthersAreButtonsAndKeys) {
    for (const std::string way : {"Return", "button", "key", "disabled"}) {
        MixerModel model{onlyNoDevice(), noDevice};
        MixerView view{model};
        std::string answer;
        std::vector<QuestionCard::Answer> answers{
            {"Yes", [&] { answer = "Return"; }, way != "disabled"},
            {"No", [&] { answer = "button", view.setQuestion(nullptr); }},
            {"Other", [&] { answer = "key"; }, true, KeyPress{KeyPress::rightKey}}};
        view.setQuestion(std::make_unique<QuestionCard>("Take it?", "It is there.", std::move(answers)));
        EXPECT_EQ(view.question()->getBounds().getCentreX(), view.getLocalBounds().getCentreX());
        if (way == "button")
            the<juce::Button>(*view.question(), "No").onClick();
        else
            view.keyPressed(KeyPress{way == "key" ? KeyPress::rightKey : KeyPress::returnKey});
        const std::string expected = way == "disabled" ? "" : way;
        runUntil([&] { return !answer.empty(); }, 1.0);
        EXPECT_EQ(answer, expected) << way;
    }
}

TEST_F(ShownMixer, TheTabKeyComesToEveryControl) {
    std::set<juce::Component*> reached;
    const auto traverser = view.createKeyboardFocusTraverser();
    for (auto* c : traverser->getAllComponents(&view)) reached.insert(c);
    walk(view, [&](juce::Component& c) {
        if (isControl(c) && !isPartOfControl(c) && c.isEnabled() && c.isShowing())
            EXPECT_EQ(reached.count(&c), 1u) << c.getTitle();
    });
}

TEST_F(ShownMixer, TextHasEnoughContrastInBothLooks) { // WCAG 2.1, 1.4.3: 4.5 for text, 3 for what is large
                                                       // or
                                                       // drawn
    for (const auto theme : {Theme::dark, Theme::light}) {
        view.setTheme(theme);
        for (const auto on : {Shade::panel, Shade::background, Shade::well, Shade::raised})
            for (const auto what : {Shade::text, Shade::muted, Shade::highlight, Shade::limit, Shade::accent})
                EXPECT_GE(contrast(shade(view, what), shade(view, on)), 4.5)
                    << static_cast<int>(what) << " on " << static_cast<int>(on)
                    << (theme == Theme::dark ? " dark" : " light");
        for (int j = 0; j < 64; ++j)
            EXPECT_GE(contrast(actuatorColour(view, j), shade(view, Shade::panel)), 3.0) << j;
    }
}

/// The strongest contrast of anything drawn against the ground behind it.
double drawnContrast(MixerView& view, juce::Component& c) {
    view.addAndMakeVisible(c);
    const auto image = c.createComponentSnapshot(c.getLocalBounds());
    juce::Image over{juce::Image::ARGB, c.getWidth(), c.getHeight(), true};
    juce::Graphics g{over};
    g.fillAll(shade(view, Shade::panel));
    g.drawImageAt(image, 0, 0);
    const auto ground = over.getPixelAt(over.getWidth() - 4, over.getHeight() / 2);
    double most = 1.0;
    for (int y = 4; y < over.getHeight() - 4; ++y)
        for (int x = 24; x < over.getWidth() - 8; ++x)
            most = std::max(most, contrast(over.getPixelAt(x, y), ground));
    return most;
}

TEST_F(ShownMixer, WhatIsDisabledCanBeRead) {
    for (const auto theme : {Theme::dark, Theme::light}) {
        view.setTheme(theme);
        juce::TextButton button{"NNNNNNNN"};
        juce::ToggleButton toggle{"NNNNNNNN"};
        juce::Label label{{}, "NNNNNNNN"};
        for (juce::Component* c : std::initializer_list<juce::Component*>{&button, &toggle, &label}) {
            c->setSize(140, 30);
            c->setEnabled(false);
            EXPECT_GE(drawnContrast(view, *c), 4.0)
                << typeid(*c).name() << (theme == Theme::dark ? " dark" : " light"); // 4.5 less edges
            view.removeChildComponent(c);
        }
    }
}

TEST(MixerView, LettersOfOtherScriptsAreDrawnWhereAFontIsThere) {
    const auto korean = juce::String::charToString(0xd55c);
    if (!typefaceFor(korean)) GTEST_SKIP() << "no font with Korean letters; on Debian, fonts-nanum";
    const bool wasThere = hasLetters({}, korean);
    {
        MixerModel model{onlyNoDevice(), noDevice};
        MixerView view{model};
        Scene scene = model.world().drawing().drawn();
        scene.name = korean.toStdString();
        setScene(model, scene);
        model.dispatchPendingMessages();
        EXPECT_TRUE(hasLetters({}, korean));
        EXPECT_TRUE(hasLetters({}, "Silence"));
    }
    EXPECT_EQ(hasLetters({}, korean), wasThere) << "only while they are shown";
}

TEST_F(ShownMixer, ButtonsDoWhatTheySay) {
    const auto press = [&](const juce::String& title) {
        auto& button = the<juce::Button>(view, title);
        button.onClick();
        model.dispatchPendingMessages();
    };
    press("Mute B");
    EXPECT_TRUE(model.mix().strips[1].isMuted);
    press("Polarity C");
    EXPECT_TRUE(model.mix().strips[2].isInverted);
    press("Silence");
    EXPECT_TRUE(model.isSilent());
    press("Silence");
    EXPECT_FALSE(model.isSilent());
    press("Pause the world (Space)");
    EXPECT_EQ(model.session().world().slowness(), 0);
    press("Attach an actuator");
    EXPECT_EQ(model.mix().count(), 5);
    EXPECT_NE(find(view, "Gain of E"), nullptr);
    for (int k = 0; k < 5; ++k) {
        view.keyPressed(KeyPress{KeyPress::escapeKey});
        EXPECT_TRUE(model.isSilent() && model.output().isSilent()) << "pressed " << k + 1 << " times";
    }
    view.keyPressed(KeyPress{'z', juce::ModifierKeys::commandModifier, 0});
    EXPECT_EQ(model.mix().count(), 4);
    model.dispatchPendingMessages();
    EXPECT_TRUE(the(view, "Redo").isEnabled());
    press("Redo");
    EXPECT_EQ(model.mix().count(), 5);
    EXPECT_FALSE(the(view, "Redo").isEnabled()) << "nothing is left of it";
    press("Undo");
    EXPECT_EQ(model.mix().count(), 4);
    EXPECT_TRUE(the(view, "Undo").isEnabled());
    bool isSaved = false, isOpened = false, isOutput = false;
    view.topBar().onDevice = [&] { isOutput = true; };
    the(view, "Device state").mouseUp(mouseAt(*find(view, "Device state"), {4.0f, 4.0f}));
    view.topBar().onSave = [&] { isSaved = true; };
    view.topBar().onMenu = [&](juce::Component&) { isOpened = true; };
    press("Save the session (Ctrl+S)");
    press("Menu");
    EXPECT_TRUE(isSaved && isOpened && isOutput);
}

TEST_F(ShownMixer, WhatIsSilentStandsStill) {
    ASSERT_TRUE(runUntil([&] { return view.refresh(), view.snapshot().masterPeak > 0.001f; }));
    model.setSilent(true);
    const auto isStill = [&] {
        view.refresh();
        const auto& moment = view.snapshot();
        return moment.masterPeak == 0.0f &&
               std::ranges::all_of(moment.meters.peaks, [](float p) { return p == 0.0f; }) &&
               std::ranges::all_of(moment.heldPeaks, [](float p) { return p == 0.0f; });
    };
    const auto played = model.poll().session.render.played;
    EXPECT_TRUE(isStill()) << "at once";
    EXPECT_TRUE(runUntil([&] { return model.poll().session.render.played > played + 5; }));
    EXPECT_TRUE(isStill()) << "though the world goes on";
    model.setSilent(false);
    EXPECT_TRUE(runUntil([&] { return view.refresh(), view.snapshot().masterPeak > 0.001f; }));
}

TEST_F(ShownMixer, MessagesWaitForEachOtherAndNoneIsGluedToAnother) {
    bool hasActed = false;
    model.report("one");
    model.messages().add({"two", false, {"Heal", [&] { hasActed = true; }}});
    model.dispatchPendingMessages();
    auto& label = the<juce::Label>(view, "Trouble");
    EXPECT_EQ(label.getText(), "one");
    EXPECT_EQ(find(view, "Heal"), nullptr);
    the<juce::Button>(view, "Dismiss the message").onClick();
    model.dispatchPendingMessages();
    EXPECT_EQ(label.getText(), "two");
    the<juce::Button>(view, "Heal").onClick();
    model.dispatchPendingMessages();
    EXPECT_TRUE(hasActed);
    EXPECT_FALSE(label.isVisible());
    model.messages().add({"three", false, {"Heal", [] {}}});
    model.report("four");
    EXPECT_EQ(model.messageText(), "four");
    model.report({});
    EXPECT_EQ(model.messageText(), "three") << "nobody has acted on it yet";
    model.report("five"); // "three" still waits for its button
    model.report({});
    model.report({});
    EXPECT_EQ(model.messageText(), "");
}

TEST_F(ShownMixer, WhatFailedGoesOnceSomebodyWasThereAndWhatStillHoldsStays) {
    view.errorShownMs = 100.0;
    const auto move = [&] {
        const auto source = juce::Desktop::getInstance().getMainMouseSource();
        const auto now = juce::Time::getCurrentTime();
        view.mouseMove(
            {source, {5.0f, 5.0f}, {}, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, &view, &view, now, {}, now, 0, false});
    };
    const auto shown = [&] {
        show();
        runFor(0.3);
        view.refresh();
        return model.messageText();
    };
    model.report("a past fault");
    EXPECT_EQ(shown(), "a past fault") << "nobody has seen it";
    move();
    EXPECT_EQ(shown(), "");
    model.messages().show({"a joint holds a body", false, {"Pause", [] {}}, attemptLabel});
    EXPECT_EQ(shown(), "a joint holds a body") << "a mouse that moved before has not seen it";
    move();
    EXPECT_EQ(shown(), "");
    model.messages().show({"the device is gone", false, {}, "device"});
    EXPECT_EQ(shown(), "the device is gone");
    move();
    EXPECT_EQ(shown(), "the device is gone") << "it still is";
    model.messages().withdraw("device");
    model.change("None", [](Mix& mix) { mix.strips[2].output = -1; });
    reportNoOutput(model, {2});
    EXPECT_EQ(shown(), "C has no output: another actuator has it");
    model.change("An output", [](Mix& mix) { mix.strips[2].output = 2; });
    EXPECT_EQ(shown(), "") << "it has one";
}

TEST(MixerView, WhatWasLostIsToldUntilItHasBeenFineForSomeSeconds) {
    MixerModel model{onlyNoDevice(), noDevice};
    TopBar bar{model}; // a window's own would be told of other moments by its timer
    bar.setPlayMode(true);
    bar.setSize(760, 60);
    MixerSnapshot moment;
    const auto isTold = [&] {
        for (int k = 0; k < 12; ++k) bar.refresh(moment);
        return the(bar, "Load").isVisible();
    };
    EXPECT_FALSE(isTold());
    moment.session.render.unsent = 1499;
    EXPECT_TRUE(isTold());
    runFor(1.0);
    EXPECT_TRUE(isTold());
    runFor(4.5);
    EXPECT_FALSE(isTold());
    ++moment.session.render.unsent;
    EXPECT_TRUE(isTold());
}

TEST_F(ShownMixer, AMessageCoversNoBadge) {
    view.setSize(1280, 800);
    model.report("session.json: expected 0.01 to 100, found 0");
    model.dispatchPendingMessages();
    const auto& banner = *find(view, "Trouble");
    ASSERT_TRUE(banner.isVisible());
    auto& world = view.world().view();
    for (const auto& badge : world.badges())
        EXPECT_FALSE(view.getLocalArea(&world, badge.toNearestInt()).intersects(banner.getBounds()));
}

TEST_F(ShownMixer, AMessageOfManyWordsHasRoomForThemBesideALongButton) {
    view.setMode(Mode::play);
    view.setPanels({true, false});
    view.setSize(1024, 700);
    const juce::String words = "2 of 4 actuators have no output: C, D. Level steps needs four of them, and "
                               "headphones have two";
    model.messages().show({words, false, {"Choose Model or sound instead", [] {}}});
    model.dispatchPendingMessages();
    const auto& banner = the<juce::Label>(view, "Trouble");
    const auto room = banner.getBorderSize().subtractedFrom(banner.getLocalBounds());
    EXPECT_GE(room.getWidth(), 200) << banner.getBounds().toString() << view.world().getBounds().toString();
    EXPECT_GE(room.getHeight(), text::heightInLines(banner.getFont(), banner.getText(), room.getWidth()));
    for (const char* name : {"Choose Model or sound instead", "Dismiss the message"})
        EXPECT_FALSE(the(view, name).getBounds().intersects(room + banner.getPosition())) << name;
    EXPECT_TRUE(view.world().getBounds().contains(banner.getBounds()));
}

TEST(MixerView, AMessageIsFoundByItsLabel) {
    MixerModel model{onlyNoDevice(), noDevice};
    auto& messages = model.messages();
    messages.show({"the device is gone", false, {}, "device"});
    messages.show({"the board is gone", false, {}, "board"});
    EXPECT_EQ(model.messageText(), "the board is gone");
    messages.show({"the board answers slowly", false, {}, "board"}); // of a label there is one
    messages.add({"the device is gone: searched for", false, {}, "device"});
    messages.withdraw("board");
    EXPECT_EQ(model.messageText(), "the device is gone: searched for") << "in place of what waited";
    messages.add({"saved", true});
    messages.withdraw("board");
    EXPECT_EQ(model.messageText(), "the device is gone: searched for");
    messages.withdraw("device");
    EXPECT_EQ(model.messageText(), "saved");
    EXPECT_EQ(model.device().error(), "") << "whatever is shown";
}

TEST(MixerView, AnOfferStaysUntilItIsAnsweredDismissedOrWithdrawn) {
    MixerModel model{onlyNoDevice(), noDevice};
    auto& messages = model.messages();
    messages.show({"an offer", true, {"Take it", [] {}}, "offer"});
    messages.show({"written", true, {"Show", [] {}}, savedLabel});
    messages.show({"a fault"});
    EXPECT_EQ(model.messageText(), "a fault");
    model.report({});
    EXPECT_EQ(model.messageText(), "an offer") << "what was written does not last";
    messages.show({"a later fault"});
    messages.withdraw("offer");
    model.report({});
    EXPECT_EQ(model.messageText(), "");
}

TEST_F(ShownMixer, NothingCoversTheButtonThatSilencesInAShow) {
    view.setVisible(true);
    view.setShowMode(true);
    model.messages().add(
        {juce::String::repeatedString("a long message ", 30), false, {"Do it", [] {}}, "long"});
    model.dispatchPendingMessages();
    auto* silence = dynamic_cast<juce::Button*>(find(view, "Silence"));
    ASSERT_NE(silence, nullptr);
    for (const auto& [width, height] :
         {std::pair{MixerView::minWidth, MixerView::minHeight}, {1280, 720}, {1440, 900}, {3840, 2160}})
        for (const bool hasCard : {false, true}) {
            view.setSize(width, height);
            view.setCard(
                hasCard ? std::make_unique<QuestionCard>("Save?", "It would be lost.",
                                                         std::vector<QuestionCard::Answer>{{"Yes", [] {}}})
                        : nullptr);
            const auto at = view.getLocalArea(silence, silence->getLocalBounds());
            for (const auto& corner : {at.getTopLeft(), at.getBottomRight() - juce::Point<int>{1, 1}})
                EXPECT_EQ(view.getComponentAt(corner), silence) << width << corner.toString();
            EXPECT_FALSE(the(view, "Trouble").getBounds().intersects(at)) << width;
        }
    juce::Component cover; // a card as large as the window
    view.addAndMakeVisible(cover);
    cover.setBounds(view.getLocalBounds());
    EXPECT_EQ(view.getComponentAt(view.getLocalArea(silence, silence->getLocalBounds()).getCentre()),
              silence);
    silence->onClick();
    model.dispatchPendingMessages();
    EXPECT_TRUE(model.isSilent());
    EXPECT_EQ(silence->getButtonText(), "SILENT: press to feel");
}

TEST_F(ShownMixer, NoToolIsChosenWhereNoneIsShown) {
    auto& pane = view.world().drawing();
    view.setShowMode(true);
    view.keyPressed(KeyPress{'B', {}, 'b'});
    EXPECT_EQ(pane.tool(), DrawTool::hand);
    view.keyPressed(KeyPress{'G', {}, 'g'});
    EXPECT_FALSE(pane.isSnapping());
    pane.setTool(DrawTool::ball); // as a new scene does
    EXPECT_EQ(pane.tool(), DrawTool::hand);
    view.setShowMode(false);
    view.keyPressed(KeyPress{'B', {}, 'b'});
    EXPECT_EQ(pane.tool(), DrawTool::ball);
}

TEST_F(ShownMixer, TheStatesOfDeviceAndBoardAreShownAtEverySize) {
    for (const int width : {MixerView::minWidth, 1280, 1359, 1360, 1395, 1439, 1440, 1920, 3840}) {
        view.setSize(width, std::max(MixerView::minHeight, width * 9 / 16));
        int right = 0;
        for (const char* title : {"Device state", "Board state", "Load"}) {
            const auto& state = the(view, title);
            EXPECT_TRUE(state.isVisible() || (width > 1260 && width < 1400)) << title << " at " << width;
            if (!state.isVisible()) continue; // it has nothing to say
            EXPECT_GE(state.getWidth(), 100) << title << " at " << width;
            EXPECT_GE(state.getX(), right) << title << " at " << width;
            right = state.getRight();
        }
    }
}

TEST(MixerView, IsDrawnWhileStripsGo) { // the window is told a moment later; its timer may come first
    MixerModel model{onlyNoDevice(), noDevice};
    model.change("Groups", [](Mix& mix) { mix.strips[3].group = addGroup(mix, "Left hand"); });
    MixerView view{model};
    model.dispatchPendingMessages();
    model.change("Fewer", [](Mix& mix) {
        mix.layout = presetLayout("phone2", mix.layout.actuators);
        mix.resizeStrips();
        mix.groups.clear();
    });
    for (const char* tab : {"Played now", "Gain lanes", "Events", "Telemetry"}) {
        view.scope().choose(tab);
        view.refresh();
        view.createComponentSnapshot(view.getLocalBounds());
    }
    model.dispatchPendingMessages();
    EXPECT_EQ(find(view, "Strip C"), nullptr);
    EXPECT_EQ(find(view, "Group Left hand"), nullptr);
}

TEST_F(ShownMixer, ACeilingIsDraggedOrMovedByKeysAndNothingElseMovesIt) {
    auto* ceiling = dynamic_cast<juce::Slider*>(find(view, "Ceiling of B"));
    ASSERT_NE(ceiling, nullptr);
    ceiling->setValue(-20.0, juce::sendNotificationSync);
    model.dispatchPendingMessages();
    EXPECT_EQ(model.mix().strips[1].ceilingDb, -20.0);
    EXPECT_EQ(ceiling->getTextFromValue(-20.0), "at most " + number(-20.0, 1) + " dB, 0.03 g")
        << "behind a master at -12 dB";
    const auto& shown = the<juce::Label>(view, "Ceiling of B in g");
    EXPECT_EQ(shown.getText(), "/ 0.03 g");
    EXPECT_FALSE(ceiling->isDoubleClickReturnEnabled());
    ceiling->mouseWheelMove(mouseAt(*ceiling, {15.0f, 15.0f}), {0.0f, 1.0f, false, false, false});
    EXPECT_EQ(model.mix().strips[1].ceilingDb, -20.0);
    EXPECT_TRUE(ceiling->keyPressed(KeyPress{KeyPress::downKey}));
    EXPECT_LT(model.mix().strips[1].ceilingDb, -20.0);
    model.undoManager().undo();
    EXPECT_EQ(model.mix().strips[1].ceilingDb, -20.0);
    model.attach(0.5, 0.5);
    model.dispatchPendingMessages();
    const auto& next = the(view, "Ceiling of E in g");
    EXPECT_EQ(next.findColour(juce::Label::textColourId), shade(view, Shade::text)) << "as its neighbours";
}

TEST_F(ShownMixer, AnUndoDuringADragDetachesNoOtherActuator) {
    model.detach(0);
    show();
    auto& world = view.world().view();
    const auto at = [&world](juce::Point<float> place) { return mouseAt(world, place); };
    world.mouseDown(at(world.badgeAt(1).getCentre()));
    ASSERT_TRUE(world.isDragging()) << "C";
    model.undoManager().undo();
    show();
    for (const auto outside = at({-50.0f, -50.0f});
         const auto event : {&WorldView::mouseDrag, &WorldView::mouseUp})
        (world.*event)(outside);
    ASSERT_EQ(model.mix().count(), 4);
    EXPECT_EQ(labelOf(model.mix(), 1), "B");
}

TEST_F(ShownMixer, ADragPushesByItsStrengthWhateverItPulls) {
    auto& strength = the<juce::Slider>(view, "Drag strength");
    EXPECT_EQ(strength.getValue(), 32'000.0);
    strength.setValue(8'000.0, juce::sendNotificationSync);
    model.dispatchPendingMessages();
    auto& world = view.world().view();
    EXPECT_EQ(world.flingText(0.02), "drag 0.16 " + juce::String::fromUTF8("kN\xc2\xb7s"));
    world.onFling("large rubber ball", {0.02, 0.0}, {});
    const auto& inputs = model.savedSession().log.runs.back().inputs;
    ASSERT_EQ(inputs.size(), 1u);
    EXPECT_EQ(std::get<ImpulseAction>(inputs[0].action).impulseNewtonSeconds, (Vector{160.0, 0.0}));
    world.onFling("small rubber ball", {0.0, 0.5}, {});
    EXPECT_EQ(
        std::get<ImpulseAction>(model.savedSession().log.runs.back().inputs[1].action).impulseNewtonSeconds,
        (Vector{0.0, 4000.0}));
    model.undoManager().undo();
    model.dispatchPendingMessages();
    EXPECT_EQ(strength.getValue(), 32'000.0);
}

TEST_F(ShownMixer, AStripIsTestedAndSweptByButtonAndByKey) {
    const auto strikes = [&] { return model.savedSession().log.strikes.size(); };
    auto *strip = find(view, "Strip C"), *sweep = find(view, "Sweep on C");
    ASSERT_TRUE(strip != nullptr && sweep != nullptr);
    ASSERT_TRUE(strip->keyPressed(KeyPress{'t'}));
    EXPECT_EQ(strikes(), 1u);
    ASSERT_TRUE(strip->keyPressed(KeyPress{'t', juce::ModifierKeys::shiftModifier, 0}));
    EXPECT_EQ(strikes(), 41u);
    dynamic_cast<juce::Button&>(*sweep).onClick();
    EXPECT_EQ(strikes(), 81u);
    EXPECT_NEAR(model.savedSession().log.strikes.back().frequencyHz, 400.0, 1e-6);
}

TEST_F(ShownMixer, AnActuatorGetsWhatIsTypedOrIsToldWhatIsExpected) {
    view.tabs().choose("Actuators");
    the<juce::ListBox>(view, "List of actuators").selectRow(1);
    for (const auto& [label, g, told] : {std::tuple{"A", "1", "Label: "},
                                         {"", "1", "Label: "},
                                         {"thumb", "0", "Full scale: "},
                                         {"thumb", "100,5", "Full scale: "},
                                         {"thumb", "1,5", ""}}) {
        model.report({});
        button("Name, profile and full scale of the chosen actuator (Return)").onClick();
        ASSERT_NE(view.question(), nullptr);
        chooseIn(*view.question(), "Actuator", "none");
        view.question()->setValue("Label", label);
        view.question()->setValue("Full scale in g", g);
        view.question()->answer("Take");
        EXPECT_TRUE(runUntil([&] { return view.question() == nullptr; }));
        EXPECT_TRUE(model.messageText().startsWith(told)) << g << model.messageText();
        EXPECT_EQ(model.mix().layout.actuators[1].label, told[0] == 0 ? "thumb" : "B") << g;
    }
    EXPECT_EQ(model.mix().layout.actuators[1].actuator, "none");
    EXPECT_EQ(model.mix().layout.actuators[1].fullScaleG, 1.5);
}

TEST(MixerView, APresetIsKnownByItsPlaces) {
    Mix mix = MixerModel::defaultMix();
    mix.layout.name = "own"; // as a session that `physvib play` saved
    MixerModel model{onlyNoDevice(), noDevice, mix};
    MixerView view{model};
    const auto& preset = the<juce::ComboBox>(view, "Preset");
    EXPECT_EQ(preset.getText(), "PHONE4");
    model.change("Move A",
                 [](Mix& m) { m.layout.geometry.places[0].xMetres = 0.01, m.layout.name = "phone4"; });
    model.dispatchPendingMessages();
    EXPECT_EQ(preset.getSelectedItemIndex(), -1);
}

} // namespace physvib::mixer_view_test
