// SPDX-License-Identifier: GPL-3.0-or-later
// A participant with a mouse and a keyboard at the mixer's window, and a folder for the rows.
#pragma once
#include "Host/MessageLoop.h"
#include "Io/Text/CsvTable.h"
#include "Mixer/OnlyNoDevice.h"
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/Window/MixerView.h"
#include "TestPlaces.h"
#include <cstdlib>
#include <functional>
#include <gtest/gtest.h>
#include <string>

namespace physvib::test {

/// The mixer in a window of its own.
class Participant {
public:
    explicit Participant(AudioDrivers drivers = onlyNoDevice(),
                         const std::string& device = std::string{nullDeviceType} + ":" + nullDeviceName)
        : model{std::move(drivers), {device, 48000, 128}} {
        view.setSize(1440, 900);
        view.addToDesktop(juce::ComponentPeer::windowHasTitleBar);
        view.setVisible(true);
        view.tabs().choose("Studies");
        view.grabKeyboardFocus();
        pump();
    }
    MixerModel model;
    MixerView view{model};

    /// Those on the screen only; null if there is none.
    juce::Component* find(const juce::String& title) { return findIn(view, title); }
    StudiesTab& tab() {
        return *dynamic_cast<StudiesTab*>(findIn(view, "Studies", false, [](juce::Component& c) {
            return dynamic_cast<StudiesTab*>(&c) != nullptr;
        }));
    }
    StudyScreen* screen() { return tab().screen(); }
    const Experiment& experiment() { return screen()->study().experiment(); }

    WorldView& world() { return *dynamic_cast<WorldView*>(find("World")); }
    /// What the study's screen says.
    juce::String words() { return screen()->getDescription(); }

    /// A click in the middle of what has that title, or beside that, once it may be clicked.
    void click(const juce::String& title, float toTheRight = 0.0f) {
        ASSERT_TRUE(canUse(title)) << title;
        auto* target = find(title);
        clickAt(view.getLocalPoint(
            target, target->getLocalBounds().toFloat().getCentre().translated(toTheRight, 0.0f)));
    }
    /// The screen goes, by itself or since it was left.
    bool isGone() {
        return runUntil([this] { return screen() == nullptr; });
    }
    bool leave() { return click("Leave the study; what was answered is kept"), isGone(); }
    bool hasTaken(int trials) {
        return runUntil([&] { return experiment().answeredTrials() == trials; });
    }
    void clickAt(juce::Point<float> at) {
        for (const int buttons : {0, int{juce::ModifierKeys::leftButtonModifier}, 0}) mouse(at, buttons);
        pump();
    }
    /// In whichever window it is.
    juce::Component* findBelow(juce::Component& root, const juce::String& title) {
        return findIn(root, title);
    }
    void clickOn(juce::Component& c) {
        auto* peer = c.getPeer();
        const auto at = peer->getComponent().getLocalPoint(&c, c.getLocalBounds().toFloat().getCentre());
        for (const int buttons : {0, int{juce::ModifierKeys::leftButtonModifier}, 0})
            mouse(at, buttons, peer);
        pump();
    }
    /// From one point of the window to another.
    void drag(juce::Point<float> from, juce::Point<float> to) {
        mouse(from, 0);
        mouse(from, juce::ModifierKeys::leftButtonModifier);
        for (const float share : {0.2f, 0.6f, 1.0f})
            mouse(from + (to - from) * share, juce::ModifierKeys::leftButtonModifier);
        mouse(to, 0);
        pump();
    }
    /// A key, once the window has the focus: a busy display gives it late and may take it for a moment.
    void key(int code, int modifiers = 0, juce::juce_wchar character = 0) {
        EXPECT_TRUE(runUntil([this] { return view.refresh(), view.hasKeyboardFocus(true); }));
        view.getPeer()->handleKeyPress(juce::KeyPress{code, modifiers, character});
        pump();
    }
    void type(const juce::String& words) {
        for (const auto character : words)
            key(static_cast<int>(juce::CharacterFunctions::toUpperCase(character)), 0, character);
    }
    void space() { key(juce::KeyPress::spaceKey, 0, ' '); }
    void enter() { key(juce::KeyPress::returnKey, 0, '\r'); }

    bool canUse(const juce::String& title) {
        return runUntil([&] {
            auto* c = find(title);
            return c != nullptr && c->isEnabled();
        });
    }
    /// Feels the next part and waits for its end.
    void feel() {
        const int before = plays();
        space();
        EXPECT_TRUE(runUntil([&] { return plays() > before && !isStimulusPlaying(); })) << "nothing was felt";
        pump(); // the answer unlocks with the next picture
    }
    /// Writes into the editor of what has that title, if it is there.
    void write(const juce::String& title, const juce::String& words) {
        if (auto* const answer = find(title))
            for (auto* child : answer->getChildren())
                if (auto* const editor = dynamic_cast<juce::TextEditor*>(child)) editor->setText(words);
    }
    bool isAnswerOpen(const juce::String& title) {
        return find(title) != nullptr && find(title)->isEnabled();
    }
    void pump() {
        runFor(0.025);
        view.refresh();
    }

private:
    void mouse(juce::Point<float> at, int buttons, juce::ComponentPeer* peer = nullptr) {
        timeMs_ += 400; // never a double click
        (peer != nullptr ? peer : view.getPeer())
            ->handleMouseEvent(juce::MouseInputSource::InputSourceType::mouse, at,
                               juce::ModifierKeys{buttons}, 0.0f, 0.0f, timeMs_);
    }
    int plays() { return screen() != nullptr ? screen()->plays() : 0; }
    bool isStimulusPlaying() { return screen() != nullptr && screen()->isStimulusPlaying(); }
    static juce::Component* findIn(juce::Component& root, const juce::String& title, bool mustShow = true,
                                   const std::function<bool(juce::Component&)>& fits = {}) {
        if (root.getTitle() == title && (!mustShow || root.isShowing()) && (!fits || fits(root)))
            return &root;
        for (auto* child : root.getChildren())
            if (auto* found = findIn(*child, title, mustShow, fits)) return found;
        return nullptr;
    }
    juce::int64 timeMs_ = juce::Time::currentTimeMillis();
};

/// The protocol "short" of one condition.
inline std::string shortProtocol(const std::string& stimuli, const std::string& sessions,
                                 const std::string& more = {}) {
    return R"({"physvib_protocol": 1, "name": "short", "seed": 7, "conditions": [{"name": "c", )" + stimuli +
           "}], \"sessions\": [" + sessions + "]" + more + "}";
}

/// A test of the protocol "short" in a folder, which goes with it.
class StudyTest : public testing::Test {
protected:
    StudyTest() { folder.createDirectory(); }
    ~StudyTest() override { folder.deleteRecursively(); }

    /// Writes the protocol and chooses it: empty, or an error.
    std::string choose(Participant& p, const std::string& protocol) const {
        const auto file = folder.getChildFile("short.json");
        file.replaceWithText(utf8(protocol));
        p.tab().setFolder(folder);
        return p.tab().chooseProtocol(file.getFullPathName().toStdString());
    }
    /// What one writes and does first, up to the page before the first session.
    void begin(Participant& p, const std::string& protocol) const {
        ASSERT_EQ(choose(p, protocol), "");
        goOn(p);
    }
    static void goOn(Participant& p) {
        ASSERT_EQ(p.tab().begin(), "");
        p.pump();
        ASSERT_NE(p.screen(), nullptr);
    }
    /// The trial file.
    CsvTable rows() const {
        const auto text = folder.getChildFile("short-P01.csv").loadFileAsString().toStdString();
        auto table = readCsvTable(text, "short-P01.csv");
        EXPECT_TRUE(table) << table.error;
        return table.value;
    }
    /// Calls the program in the folder.
    void call(const std::string& words) const {
        const auto all =
            "cd '" + folder.getFullPathName().toStdString() + "' && '" PHYSVIB_PROGRAM "' " + words;
        EXPECT_EQ(std::system(all.c_str()), 0) << all;
    }

    const juce::File folder = juce::File::createTempFile("physvib-study");
};

} // namespace physvib::test
