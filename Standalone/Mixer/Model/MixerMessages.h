// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of the mixer: numbers and names, what an impact is, the line above the world with errors and news,
// and hints why nothing would be felt.
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
template <class All>
decltype(auto) nth(All&& all, auto number) {
    return std::forward<All>(all)[static_cast<std::size_t>(number)];
}

/// Any thread.
inline juce::String utf8(const std::string& words) { return juce::String::fromUTF8(words.c_str()); }

/// Any thread.
inline std::string pathOf(const juce::File& file) { return file.getFullPathName().toStdString(); }

/// Displayed names of built-in scenes: "shake-the-box" as "Shake the box". Any thread.
inline juce::String titleOf(const std::string& name) {
    const auto words = utf8(name).replaceCharacter('-', ' ');
    return words.substring(0, 1).toUpperCase() + words.substring(1);
}

/// The name of an actuator. Any thread.
inline juce::String labelOf(const Mix& mix, std::integral auto actuator) {
    return utf8(nth(mix.layout.enchanters, actuator).label);
}

/// "1 hit", "2 hits". Any thread.
inline juce::String countOf(std::integral auto number, const char* what) {
    return utf8(counted(static_cast<std::size_t>(number), what));
}

/// Fixed notation with a real minus sign. Any thread.
inline juce::String number(double value, int decimals) { return utf8(readable::number(value, decimals)); }

/// Clock for display animation; rendered output does not depend on it.
inline double nowMs() { return juce::Time::getMillisecondCounterHiRes(); }

/// A button beside a message; without a name there is none.
struct MixerAct {
    juce::String name;
    std::function<void()> run;
};

constexpr const char* savedLabel = "saved"; ///< of messages that a file was written; they do not persist
constexpr const char* triedLabel = "tried"; ///< of failed attempts with a button; they do not persist

struct MixerMessage {
    juce::String words;  ///< one line; empty: none
    bool isNews = false; ///< a success; else an error
    MixerAct act{};
    juce::String label{}; ///< its subject, of which there is one message at a time; empty: none

    /// It stays until it is answered, dismissed or withdrawn: an error that still stands, an offer.
    bool lasts() const {
        return act.run ? label != savedLabel && label != triedLabel : !isNews && label.isNotEmpty();
    }
};

/// The line above the world: one message at a time, each with a button for what can be done about it. They
/// wait for each other, so that none is lost and no two share a line. Message thread.
class MixerMessages {
public:
    /// `onChange` is called when another message is shown.
    explicit MixerMessages(std::function<void()> onChange)
        : onChange_{std::move(onChange)} {}

    const MixerMessage& shown() const noexcept { return shown_; }
    int told() const noexcept { return told_; } ///< number of messages shown so far, repeated ones included

    /// Replaces the message, which waits if it lasts. Without words the next one that waits is shown.
    void show(MixerMessage message);

    /// Shows the message after those that are there, or in the place of the one of its label.
    void add(MixerMessage message);

    /// Removes the message of this label, since it is no longer true.
    void withdraw(const juce::String& label);

private:
    void put(MixerMessage message);

    std::function<void()> onChange_;
    MixerMessage shown_;
    int told_ = 0;
    std::deque<MixerMessage> waiting_;
};

/// Texts about an impact. Any thread.
/// Index of the material that the impact sounds like; -1: none.
int materialOf(const Scene& scene, const CollisionEvent& hit);
/// The material's name, or "hit".
juce::String materialName(const Scene& scene, const CollisionEvent& hit);

struct StrongestActuator {
    int enchanter = 0;
    double levelG = 0.0; ///< there, by full scale and master level; before strip and limiter
};
StrongestActuator strongestOf(const MixerModel& model, const CollisionEvent& hit);
/// Why a hit is not felt: what the actuator with the largest gain lacks, such as "A is muted".
juce::String whyOnlySeen(const MixerModel& model, const CollisionEvent& hit);

/// "at the bottom left"
juce::String placeText(const Scene& scene, const CollisionEvent& hit);

/// Says of a material or a new body that it would not be felt at usual impacts, with a button that changes
/// this; takes the message away if it would be. Message thread.
void hintOnMaterial(MixerModel& model, int material);
void hintOnBody(MixerModel& model, const std::string& body);

/// A message on what a session was played with and the mixer lacks; empty: nothing. Any thread.
juce::String lackingOf(const SavedSession& session);

/// Why the levels, mutes and outputs let nothing be felt; empty: something can be. Any thread.
juce::String whySilent(const MixerModel& model);
void hintOnLevels(MixerModel& model, const juce::String& why);

} // namespace physvib
