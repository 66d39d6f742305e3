// SPDX-License-Identifier: GPL-3.0-or-later
// A participant with a mouse and a keyboard at the mixer's window, and a folder for the rows.
#pragma once
#include "Host/MessageLoop.h"
#include "Io/Text/CsvTable.h"
#include "Mixer/OnlyNoDevice.h"
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/Window/MixerView.h"
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <string>

namespace physvib::test {

/// The trial file that the protocol "short" has left in that folder.
inline CsvTable shortTrials(const juce::File& folder) {
    std::ifstream file{folder.getChildFile("short-P01.csv").getFullPathName().toStdString()};
    const std::string text{std::istreambuf_iterator<char>{file}, {}};
    auto table = readCsvTable(text, "short-P01.csv");
    EXPECT_TRUE(table) << table.error;
    return table.value;
}

/// The mixer in a window of its own.
class Participant {
public:
    explicit Participant(AudioDrivers drivers = onlyNoDevice(),
                         const std::string& device = std::string{noDeviceType} + ":" + noDeviceName)
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

    /// A click in the middle of what has that title, once it may be clicked.
    void click(const juce::String& title) {
        ASSERT_TRUE(canUse(title)) << title;
        auto* target = find(title);
        clickAt(view.getLocalPoint(target, target->getLocalBounds().toFloat().getCentre()));
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
        EXPECT_TRUE(runUntil([&] { return plays() > before && !isFeeling(); })) << "nothing was felt";
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
    bool isFeeling() { return screen() != nullptr && screen()->isFeeling(); }
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

} // namespace physvib::test
