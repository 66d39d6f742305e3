// SPDX-License-Identifier: GPL-3.0-or-later
// Walks a window as a curious person does: presses, double-presses, right-presses and drags whatever it
// shows, takes every item of every menu and every button of every dialog that opens, and tries the emergency
// stop in every state that it comes into. Nothing is listed: what a window has tomorrow is found tomorrow. On
// a display.
#pragma once
#include "Host/MessageLoop.h"
#include "Host/Views/Look.h"
#include <cxxabi.h>
#include <functional>
#include <gtest/gtest.h>
#include <iostream>
#include <map>
#include <set>
#include <vector>

namespace physvib::test {

/// A file chooser of the system, first on the path: it tells that it was called. Such a one has the keyboard,
/// and we get no keys.
class SystemChooser {
public:
    explicit SystemChooser(const juce::File& folder)
        : called_{folder.getChildFile("called")} {
        const auto program = folder.getChildFile("zenity");
        program.replaceWithText("#!/bin/sh\ntouch " + called_.getFullPathName().quoted() + "\n");
        program.setExecutePermission(true);
        const auto path =
            folder.getFullPathName() + ":" + juce::SystemStats::getEnvironmentVariable("PATH", {});
        setenv("PATH", path.toRawUTF8(), 1);
    }
    bool wasCalled() const { return called_.exists(); }

private:
    juce::File called_;
};

class StopWalk {
public:
    struct Program {
        std::function<void()> open;    ///< anew, as it starts
        std::function<void()> prepare; ///< before each step, as a change that closing would lose
        std::function<bool()> isSilent;
        std::function<void()> lift;
        std::function<bool(const juce::StringArray& steps)> isTheEnd; ///< these steps would end the test
                                                                      ///< itself
        int presses = 1; ///< of Esc until it is silent: one for what is open, and one
    };
    explicit StopWalk(Program program)
        : program_{std::move(program)} {}

    /// What is called before silence is asked for in a menu, list or dialog, and without words after it.
    void setMeasure(std::function<void(const juce::String& what)> measure) { measure_ = std::move(measure); }

    /// Until nothing is left, or so many steps have been taken: a busy machine takes the same ones, later.
    /// `seconds` end a walk that would not end.
    void run(int mostSteps, double seconds) {
        mostSteps_ = mostSteps;
        endMs_ = now() + 1e3 * seconds;
        open({});
        while (!isEnough()) {
            bool isAny = false;
            for (const char* how : {"press ", "menu ", "twice ", "drag "}) { // what opens most comes first
                const auto next = nextHere(how);
                if (next.isNotEmpty()) take(next);
                isAny = next.isNotEmpty() || goWhereSomethingIsLeft(how);
                if (isAny) break;
            }
            if (!isAny) return;
        }
        std::cout << "the walk was ended after " << (steps() < mostSteps ? seconds : 1.0 * steps())
                  << (steps() < mostSteps ? " s" : " steps") << std::endl;
    }

    /// Of what is modal: menus, lists, dialogs.
    int states() const { return static_cast<int>(modal_.size()); }
    int steps() const { return static_cast<int>(done_.size()); }
    const std::set<juce::String>& modal() const { return modal_; }
    juce::StringArray faults;

private:
    struct Action {
        juce::String key;
        std::function<void()> act;
    };

    bool isEnough() const { return steps() >= mostSteps_ || now() >= endMs_; }
    static double now() { return juce::Time::getMillisecondCounterHiRes(); }
    static juce::Component* modalNow() { return juce::Component::getCurrentlyModalComponent(); }
    static void settle() { runFor(0.04); }

    // ---- names

    static juce::String typeOf(const juce::Component& c) {
        int failed = 0;
        const std::unique_ptr<char, decltype(&std::free)> name{
            abi::__cxa_demangle(typeid(c).name(), nullptr, nullptr, &failed), &std::free};
        return juce::String{name ? name.get() : "?"}.fromLastOccurrenceOf("::", false, false);
    }
    static juce::String nameOf(const juce::Component& c) {
        juce::String name = c.getTitle();
        if (const auto* button = dynamic_cast<const juce::Button*>(&c); button && name.isEmpty())
            name = button->getButtonText();
        if (name.isEmpty()) name = c.getName();
        return (name + "|" + typeOf(c)).removeCharacters("0123456789"); // a strip is as another
    }
    static juce::String pathOf(const juce::Component& c) {
        const auto* parent = c.getParentComponent();
        return (parent ? pathOf(*parent) + "/" : juce::String{}) + nameOf(c);
    }
    static juce::String itemName(juce::Component& item) {
        auto* const handler = item.getAccessibilityHandler();
        return handler ? handler->getTitle().removeCharacters("0123456789") : juce::String{};
    }
    static bool isMenu(const juce::Component& c) { return typeOf(c) == "MenuWindow"; }
    static juce::String signatureOf(juce::Component& modal) {
        juce::StringArray words{nameOf(modal)};
        if (isMenu(modal))
            for (auto* item : modal.getChildren()) words.add(itemName(*item));
        return words.joinIntoString(" ").substring(0, 300);
    }

    // ---- the mouse

    static void send(juce::Component& window, juce::Point<float> at, int buttons) {
        static juce::int64 timeMs = 0;
        auto* const peer = window.getPeer();
        if (peer == nullptr) return;
        timeMs = std::max(timeMs + 600, juce::Time::currentTimeMillis()); // no press is the second of two
        peer->handleMouseEvent(juce::MouseInputSource::InputSourceType::mouse,
                               at * window.getDesktopScaleFactor(), // of a zoom that the walk has chosen
                               juce::ModifierKeys{buttons}, 0.0f, 0.0f, timeMs);
    }
    static void press(juce::Component& c, int buttons, int times = 1) {
        auto& window = *c.getTopLevelComponent();
        const juce::Component::SafePointer<juce::Component> safe{&window}, safeC{&c};
        const auto at = window.getLocalPoint(&c, c.getLocalBounds().toFloat().getCentre());
        send(window, at, 0);
        for (int k = 0; k < times && safe != nullptr && safeC != nullptr; ++k) {
            send(window, at, buttons);
            if (safe != nullptr) send(window, at, 0);
        }
    }
    static void doublePress(juce::Component& c) {
        const juce::MouseEvent e(juce::Desktop::getInstance().getMainMouseSource(),
                                 c.getLocalBounds().toFloat().getCentre(),
                                 juce::ModifierKeys::leftButtonModifier, 0, 0, 0, 0, 0, &c, &c,
                                 juce::Time::getCurrentTime(), {}, juce::Time::getCurrentTime(), 2, false);
        c.mouseDoubleClick(e);
    }
    void holdAndMove(juce::Component& c) {
        held_ = c.getTopLevelComponent();
        const auto at = held_->getLocalPoint(&c, c.getLocalBounds().toFloat().getCentre());
        for (const float by : {0.0f, 0.0f, 6.0f, 12.0f, 24.0f})
            if (held_ != nullptr)
                send(*held_, at + juce::Point<float>{by, by},
                     by == 0.0f && !isPressed_ ? (isPressed_ = true, 0)
                                               : static_cast<int>(juce::ModifierKeys::leftButtonModifier));
    }
    void letGo() {
        if (isPressed_ && held_ != nullptr) send(*held_, {1.0f, 1.0f}, 0);
        isPressed_ = false;
    }

    // ---- what can be done now

    static bool isReached(juce::Component& c) {
        auto& window = *c.getTopLevelComponent();
        return c.isShowing() && c.isEnabled() && !c.getBounds().isEmpty() &&
               window.getComponentAt(window.getLocalPoint(&c, c.getLocalBounds().getCentre())) == &c;
    }
    void addActions(juce::Component& c, std::vector<Action>& to, bool isModal) {
        if (c.isShowing() && isReached(c) && !c.getProperties()[stopProperty]) {
            const juce::Component::SafePointer<juce::Component> safe{&c};
            const auto add = [&](const char* how, auto act) {
                to.push_back({how + (" " + pathOf(c)), [safe, act] {
                                  if (safe != nullptr) act(*safe);
                              }});
            };
            add("press", [](juce::Component& it) { press(it, juce::ModifierKeys::leftButtonModifier); });
            add("menu", [](juce::Component& it) { press(it, juce::ModifierKeys::rightButtonModifier); });
            if (!isModal) add("twice", [](juce::Component& it) { doublePress(it); });
            if (!isModal) add("drag", [this](juce::Component& it) { holdAndMove(it); });
        }
        for (auto* child : c.getChildren()) addActions(*child, to, isModal);
    }
    std::vector<Action> actions() {
        std::vector<Action> all;
        if (auto* const modal = modalNow()) {
            if (!isMenu(*modal)) return addActions(*modal, all, true), all;
            for (auto* item : modal->getChildren()) {
                auto* const handler = item->getAccessibilityHandler();
                if (handler == nullptr ||
                    !handler->getActions().contains(juce::AccessibilityActionType::press))
                    continue;
                const juce::Component::SafePointer<juce::Component> safe{item};
                all.push_back({"item " + itemName(*item), [safe] {
                                   if (safe != nullptr)
                                       safe->getAccessibilityHandler()->getActions().invoke(
                                           juce::AccessibilityActionType::press);
                               }});
            }
            return all;
        }
        auto& desktop = juce::Desktop::getInstance();
        for (int i = 0; i < desktop.getNumComponents(); ++i) addActions(*desktop.getComponent(i), all, false);
        return all;
    }
    bool act(const juce::String& key) {
        for (const auto& action : actions())
            if (action.key == key) return action.act(), settle(), true;
        return false;
    }
    bool reach(const juce::StringArray& steps) {
        dismiss();
        program_.prepare();
        for (const auto& step : steps)
            if (!act(step)) return false;
        return true;
    }
    void dismiss() {
        letGo();
        settle(); // a list that has been closed is told so later
        for (int k = 0; k < 20 && modalNow() != nullptr; ++k) {
            juce::ModalComponentManager::getInstance()->cancelAllModalComponents();
            settle();
        }
    }

    // ---- the walk

    void open(const juce::StringArray& revealing) {
        dismiss();
        program_.open();
        runFor(0.3);
        revealing_.clear();
        for (const auto& step : revealing)
            if (act(step)) revealing_.add(step);
        dismiss();
        note();
    }
    void note() {
        for (const auto& action : actions()) whereSeen_.try_emplace(action.key, revealing_);
    }
    juce::String nextHere(const juce::String& how) {
        for (const auto& action : actions())
            if (action.key.startsWith(how) && !done_.contains(action.key)) return action.key;
        return {};
    }
    bool goWhereSomethingIsLeft(const juce::String& how) {
        for (const auto& [key, revealing] : whereSeen_) {
            if (!key.startsWith(how) || done_.contains(key) || lost_.contains(key)) continue;
            const juce::String wanted = key;
            open(juce::StringArray{revealing});
            if (nextHere(how).isEmpty()) lost_.insert(wanted); // it came and went
            return true;
        }
        return false;
    }
    void take(const juce::String& key) {
        done_.insert(key);
        const auto seen = whereSeen_.size();
        const juce::StringArray steps{key};
        if (program_.isTheEnd(steps) || !reach(steps)) return;
        examine(steps);
        dismiss();
        note();
        if (whereSeen_.size() > seen) revealing_.add(key);
    }
    void examine(const juce::StringArray& steps) {
        auto* const modal = modalNow();
        if (modal == nullptr) return tryStop(steps, false);
        if (!modal_.insert(signatureOf(*modal)).second) return;
        tryStop(steps, true);
        if (steps.size() > 5) return;
        juce::StringArray keys;
        if (reach(steps))
            for (const auto& action : actions()) keys.addIfNotAlreadyThere(action.key);
        for (const auto& key : keys) {
            if (isEnough()) return;
            auto deeper = steps;
            deeper.add(key);
            if (program_.isTheEnd(deeper) || !reach(deeper)) continue;
            done_.insert(deeper.joinIntoString(" > "));
            examine(deeper);
        }
    }

    // ---- the stop

    static juce::Component* stopIn(juce::Component& c) {
        if (c.getProperties()[stopProperty] && isReached(c)) return &c;
        for (auto* child : c.getChildren())
            if (auto* found = stopIn(*child)) return found;
        return nullptr;
    }
    static juce::Component* stopButton() {
        auto& desktop = juce::Desktop::getInstance();
        for (int i = 0; i < desktop.getNumComponents(); ++i)
            if (auto* found = stopIn(*desktop.getComponent(i))) return found;
        return nullptr;
    }
    void escape() const {
        for (int press = 0; press < program_.presses && !program_.isSilent(); ++press) {
            if (press > 0) runFor(0.1); // what closes is gone a moment later
            pressEscape();
        }
    }
    static void pressEscape() {
        auto* c = juce::Component::getCurrentlyFocusedComponent();
        if (c == nullptr) c = stopButton();
        if (c != nullptr && c->getPeer() != nullptr)
            c->getPeer()->handleKeyPress(juce::KeyPress{juce::KeyPress::escapeKey});
    }
    void expect(bool isTrue, const char* what, const juce::StringArray& steps) {
        if (!isTrue) faults.add(juce::String{what} + ": " + steps.joinIntoString(" > "));
    }
    void measure(const char* how, const juce::StringArray& steps) {
        if (measure_) measure_(how + (" " + steps.joinIntoString(" > ")));
    }
    void rest() {
        if (!measure_) return;
        runFor(0.15);
        measure_({});
    }
    void tryStop(const juce::StringArray& steps, bool isModal) {
        if (program_.isSilent()) program_.lift(), settle();
        if (isModal) measure("Esc", steps);
        escape();
        expect(program_.isSilent(), "Esc", steps);
        rest();
        if (isModal && reach(steps) && modalNow() != nullptr) {
            escape();
            expect(program_.isSilent(), "Esc of what is silent", steps);
        }
        program_.lift();
        if (isPressed_ || (isModal && !reach(steps))) return; // the mouse is elsewhere
        auto* const button = stopButton();
        if (button == nullptr) return expect(false, "no button in sight", steps);
        expect(!isCovered(*button), "a window over the button", steps);
        if (isModal) measure("press", steps);
        press(*button, juce::ModifierKeys::leftButtonModifier);
        expect(program_.isSilent(), "a press", steps);
        rest();
        program_.lift();
    }
    static bool isCovered(juce::Component& button) {
        const auto at = button.localPointToGlobal(button.getLocalBounds().getCentre());
        auto& desktop = juce::Desktop::getInstance();
        for (int i = 0; i < desktop.getNumComponents(); ++i) {
            auto& other = *desktop.getComponent(i);
            if (&other != button.getTopLevelComponent() && other.isShowing() &&
                other.contains(other.getLocalPoint(nullptr, at)))
                return true;
        }
        return false;
    }

    Program program_;
    std::function<void(const juce::String&)> measure_;
    std::set<juce::String> done_, lost_, modal_;
    std::map<juce::String, juce::StringArray> whereSeen_; // and what had to be done before
    juce::StringArray revealing_;
    int mostSteps_ = 0;
    double endMs_ = 0.0;
    juce::Component::SafePointer<juce::Component> held_;
    bool isPressed_ = false;
};

} // namespace physvib::test
