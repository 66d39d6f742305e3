// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of the mixer: numbers and names, descriptions of impacts, and hints why nothing would be felt.
// MixerMessages is the line above the world that shows errors and news.
#pragma once
#include "Core/CollisionEvent.h"
#include "Io/Text/NumberText.h"
#include "Io/Text/ReadableNumber.h"
#include "Live/Documents/Mix.h"
#include <concepts>
#include <deque>
#include <functional>
#include <juce_core/juce_core.h>
#include <string>
#include <utility>

namespace physvib {

class MixerModel;
struct SavedSession;

/// An element by a number of any type, or by an enumerator. Any thread.
template <class Container>
decltype(auto) nth(Container&& container, auto index) {
    return std::forward<Container>(container)[static_cast<std::size_t>(index)];
}

/// A JUCE string from UTF-8. Any thread.
inline juce::String utf8(const std::string& text) { return juce::String::fromUTF8(text.c_str()); }

/// The full path in UTF-8. Any thread.
inline std::string pathOf(const juce::File& file) { return file.getFullPathName().toStdString(); }

/// Displayed names of built-in scenes: "shake-the-box" as "Shake the box". Any thread.
inline juce::String displayTitle(const std::string& name) {
    const auto title = utf8(name).replaceCharacter('-', ' ');
    return title.substring(0, 1).toUpperCase() + title.substring(1);
}

/// The name of an actuator. Any thread.
inline juce::String labelOf(const Mix& mix, std::integral auto actuator) {
    return utf8(nth(mix.layout.actuators, actuator).label);
}

/// "1 hit", "2 hits". Any thread.
inline juce::String countText(std::integral auto number, const char* noun) {
    return utf8(plural(static_cast<std::size_t>(number), noun));
}

/// Fixed notation with a real minus sign. Any thread.
inline juce::String number(double value, int decimals) { return utf8(readable::number(value, decimals)); }

/// Clock for display animation; rendered output does not depend on it.
inline double nowMs() { return juce::Time::getMillisecondCounterHiRes(); }

/// A button beside a message; without a name there is none.
struct MessageAction {
    juce::String name;
    std::function<void()> run;
};

constexpr const char* savedLabel = "saved";   ///< of messages that a file was written; they do not persist
constexpr const char* attemptLabel = "tried"; ///< of failed attempts with a button; they do not persist

struct MixerMessage {
    juce::String text;   ///< one line; empty: none
    bool isInfo = false; ///< a success; else an error
    MessageAction action{};
    juce::String label{}; ///< its subject, of which there is one message at a time; empty: none

    /// True if it stays until it is answered, dismissed or withdrawn, as lasting errors and offers do.
    bool isPersistent() const {
        return action.run ? label != savedLabel && label != attemptLabel : !isInfo && label.isNotEmpty();
    }
};

/// The line above the world: one message at a time, each with a button for what can be done about it. The
/// others wait in a queue, so that none is lost. Message thread.
class MixerMessages {
public:
    /// `onChange` is called when another message is shown.
    explicit MixerMessages(std::function<void()> onChange)
        : onChange_{std::move(onChange)} {}

    const MixerMessage& current() const noexcept { return current_; }
    int shownCount() const noexcept { return shownCount_; } ///< messages so far, repeated ones included

    /// Displays the message; a persistent one that it replaces is queued. No text: displays the next queued.
    void show(MixerMessage message);

    /// Queues the message, or replaces the one with the same label; displays it if the line is empty.
    void add(MixerMessage message);

    /// Removes the message of this label, since it is no longer true.
    void withdraw(const juce::String& label);

private:
    void display(MixerMessage message);

    std::function<void()> onChange_;
    MixerMessage current_;
    int shownCount_ = 0;
    std::deque<MixerMessage> queue_;
};

/// Index of the scene's material with the sound of the impact; -1: none. Any thread, as all texts on impacts.
int findMaterialIndex(const Scene& scene, const CollisionEvent& hit);
/// The material's name, or "hit".
juce::String materialName(const Scene& scene, const CollisionEvent& hit);

struct StrongestActuator {
    int actuator = 0;
    double levelG = 0.0; ///< with full scale and master level, before strip and limiter
};
StrongestActuator strongestActuatorFor(const MixerModel& model, const CollisionEvent& hit);
/// Why a hit is not felt, by the actuator with the largest gain, such as "A is muted".
juce::String reasonNotPlayed(const MixerModel& model, const CollisionEvent& hit);

/// The place on the field in words, such as "at the bottom left".
juce::String placeText(const Scene& scene, const CollisionEvent& hit);

/// Reports that a material or a new body would not be felt at typical impacts, with a button that changes
/// this; withdraws the message if it would be felt. Message thread.
void hintOnMaterial(MixerModel& model, int material);
void hintOnBody(MixerModel& model, const std::string& body);

/// A message that names the features of a session that the mixer lacks; empty: none. Any thread.
juce::String unsupportedFeatures(const SavedSession& session);

/// Why levels, mutes or missing outputs prevent all vibration; empty: they do not. Any thread.
juce::String silenceReason(const MixerModel& model);
/// Shows that reason as a message; an empty reason withdraws the message. Message thread.
void hintOnLevels(MixerModel& model, const juce::String& reason);

} // namespace physvib
