// SPDX-License-Identifier: GPL-3.0-or-later
// One key listener for all windows of the process. JUCE gives a key to the focused or the modal component,
// and asks the listeners of that component before the component itself.
#include "Host/Views/EmergencyStop.h"
#include "Host/Views/Look.h"
#include <algorithm>
#include <utility>
#include <vector>
#if JUCE_LINUX || JUCE_BSD
#if __has_include(<juce_events/native/juce_linux_EventLoopInternal.h>) // of JUCE 7
#include <juce_events/native/juce_linux_EventLoopInternal.h>
#else
#include <juce_events/native/juce_EventLoopInternal_linux.h>
#endif
#endif

namespace physvib {

namespace {

/// Dispatches the pending events of every source. A call that waits for the display's answer, such as for the
/// mouse position, also reads earlier clicks and keys, which JUCE finds only when more arrives: a press acted
/// 0.2 to 0.4 s late. A nested call, which an event may cause, does nothing. M.
void dispatchPendingEvents() {
#if JUCE_LINUX || JUCE_BSD
    static bool isDispatching = false;
    if (std::exchange(isDispatching, true)) return;
    for (const int source : juce::LinuxEventLoopInternal::getRegisteredFds())
        juce::LinuxEventLoopInternal::invokeEventLoopCallbackForFd(source);
    isDispatching = false;
#endif
}

} // namespace

class StopKeys final : juce::KeyListener, juce::MouseListener, juce::FocusChangeListener, juce::Timer {
public:
    StopKeys() {
        juce::Desktop::getInstance().addGlobalMouseListener(this);
        juce::Desktop::getInstance().addFocusChangeListener(this);
        startTimer(pollMs);
    }
    ~StopKeys() override {
        juce::Desktop::getInstance().removeGlobalMouseListener(this);
        juce::Desktop::getInstance().removeFocusChangeListener(this);
        for (auto& component : listenedComponents_)
            if (component != nullptr) component->removeKeyListener(this);
    }
    std::vector<EmergencyStop*> stops;

    // Polls with each frame of the display, for which JUCE wakes this thread anyway. The timer polls only
    // while there are no frames.
    void pollWithFrame() {
        const auto now = juce::Time::getMillisecondCounter();
        if (now - polledAtMs_ < minPollMs) return; // frames may come more often
        polledAtMs_ = now;
        if (getTimerInterval() != idlePollMs) startTimer(idlePollMs);
        poll();
    }

private:
    static constexpr int pollMs = 20, idlePollMs = 250; // pollMs: shorter than a key press
    static constexpr juce::uint32 minPollMs = 12;

    void timerCallback() override {
        if (juce::Time::getMillisecondCounter() - polledAtMs_ < pollMs) return;
        if (getTimerInterval() != pollMs) startTimer(pollMs);
        poll();
    }
    // Listens to components that opened since the last call. An Esc that was pressed before they opened is
    // still down.
    void poll() {
        listen();
        const auto* target = keyTarget(nullptr);
        const bool isDown = juce::Desktop::getInstance().getNumComponents() > 0 && isEscapeDown();
        if (isDown && !wasEscapeDown_ && target != nullptr) silence(*target);
        wasEscapeDown_ = isDown;
        juce::MessageManager::callAsync(&dispatchPendingEvents); // later, outside lists of listeners
    }
    void globalFocusChanged(juce::Component*) override { listen(); }
    void mouseUp(const juce::MouseEvent&) override { listen(); }
    void mouseDown(const juce::MouseEvent& e) override {
        listen();
        auto& pressed = *e.eventComponent;
        if (!pressed.getProperties()[stopProperty] || !pressed.isCurrentlyBlockedByAnotherModalComponent())
            return;
        for (EmergencyStop* stop : stops)
            if (stop->window_.isParentOf(&pressed)) stop->silence_();
    }
    bool keyPressed(const juce::KeyPress& key, juce::Component* at) override {
        if (!key.isKeyCode(juce::KeyPress::escapeKey)) return false;
        const auto* target = keyTarget(at);
        if (at != target && isListenedTo(target)) return false; // a parent's listener: already handled
        silence(*at);
        return std::exchange(wasEscapeDown_, isEscapeDown()); // a repeated key silences again and does
                                                              // nothing else
    }

    static bool isEscapeDown() { return juce::KeyPress::isKeyCurrentlyDown(juce::KeyPress::escapeKey); }
    /// The component that gets a key now, as juce::ComponentPeer determines it. `at`: a component of the
    /// window with keyboard focus.
    static juce::Component* keyTarget(juce::Component* at) {
        auto* const focused = juce::Component::getCurrentlyFocusedComponent();
        auto* const target = focused != nullptr || at == nullptr ? focused : at->getTopLevelComponent();
        auto* const modal = juce::Component::getCurrentlyModalComponent();
        const bool isBlocked = target == nullptr || target->isCurrentlyBlockedByAnotherModalComponent();
        return isBlocked && modal != nullptr ? modal : target;
    }
    bool isListenedTo(const juce::Component* c) const {
        return std::ranges::any_of(listenedComponents_, [c](const auto& other) { return other.get() == c; });
    }
    void listen() {
        std::erase_if(listenedComponents_, [](const auto& component) { return component == nullptr; });
        const auto& desktop = juce::Desktop::getInstance();
        for (int i = 0; i < desktop.getNumComponents(); ++i)
            listenTo(desktop.getComponent(i)); // without a focus, these get the keys
        listenTo(keyTarget(nullptr));
    }
    void listenTo(juce::Component* component) {
        if (component == nullptr) return;
        component->removeKeyListener(this);
        component->addKeyListener(this); // the newest listener is asked first
        if (!isListenedTo(component)) listenedComponents_.emplace_back(component);
    }
    void silence(const juce::Component& at) {
        const auto isHere = [&at](const EmergencyStop* s) {
            return s->window_.getTopLevelComponent() == at.getTopLevelComponent();
        };
        const bool isAny = std::ranges::any_of(stops, isHere);
        for (const EmergencyStop* stop : stops)
            if ((!isAny || isHere(stop)) && !(stop->closesFirst_ && stop->closesFirst_())) stop->silence_();
    }

    std::vector<juce::WeakReference<juce::Component>> listenedComponents_;
    bool wasEscapeDown_ = false; // state of the Esc key at the last check
    juce::uint32 polledAtMs_ = 0;
};

EmergencyStop::EmergencyStop(juce::Component& window, std::function<void()> silence,
                             std::function<bool()> closesFirst)
    : window_{window}
    , silence_{std::move(silence)}
    , closesFirst_{std::move(closesFirst)}
    , frames_{&window, [this] { keys_->pollWithFrame(); }} {
    keys_->stops.push_back(this);
}

EmergencyStop::~EmergencyStop() { std::erase(keys_->stops, this); }

} // namespace physvib
