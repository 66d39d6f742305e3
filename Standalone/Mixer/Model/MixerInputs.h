// SPDX-License-Identifier: GPL-3.0-or-later
// What reaches the mixer beside its window's controls: messages by OSC, test events, dropped clips.
#pragma once
#include "Host/Osc/OscPort.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "Mixer/Model/MixerMessages.h"
#include "Mixer/Model/MixerWorld.h"
#include <juce_core/juce_core.h>
#include <juce_events/juce_events.h>
#include <mutex>

namespace physvib {

class MixerModel;

/// Whose messages are accepted.
enum class OscUse { off, thisComputer, anyComputer };

/// Addresses at which others reach this computer, "192.168.1.5"; empty without a network. Any thread.
std::vector<std::string> ownAddresses();

struct OscChoice {
    OscUse use = OscUse::off;
    std::string receiver{};   ///< HOST:PORT that receives impacts and status; empty: none
    double turnDegrees = 0.0; ///< counter-clockwise rotation of a phone from upright
    bool operator==(const OscChoice&) const = default;
};

/// The mixer's OSC port. Events go to the session at once; changes of strips and world are applied by the
/// mixer itself. With a receiver, played events are collected often, to be reported. Message thread.
class MixerInputs final : private juce::AsyncUpdater, private juce::Timer {
public:
    /// `model` outlives it.
    explicit MixerInputs(MixerModel& model)
        : model_{model} {}
    ~MixerInputs() override { close(); }

    /// Sets the OSC port. Empty, or an error, and then the old port stays.
    std::string use(const OscChoice& choice);
    const OscChoice& choice() const noexcept { return choice_; }
    std::optional<OscStatus> status() const; ///< of the open port

    bool haveCome(); ///< true if messages have come since the last call

    void close(); ///< stops all input

private:
    struct Waiting {
        LineInput input;
        OscOrigin origin;
    };
    std::string open();
    std::string receive(const LineInput& input, const OscOrigin& origin);
    void handleAsyncUpdate() override;
    void timerCallback() override;
    std::string apply(const LineInput& input);
    std::string apply(const RenderControl& control);

    MixerModel& model_;
    OscChoice choice_;
    std::mutex mutex_; // guards the next member
    std::vector<Waiting> waiting_;
    // message thread, of the open port:
    std::uint64_t come_ = 0, refused_ = 0; // messages as of the last haveCome(); refused by the mixer
    std::string fault_;                    // last error of the mixer
    std::optional<MessageRouter> messages_;
    std::unique_ptr<OscPort> port_; // destroyed first, because its thread uses the other members
};

/// True if the dragged files may be dropped as clips; the window handles documents. Message thread.
bool isClipDrag(const juce::StringArray& files);

/// Events that the mixer plays apart from the world: test pulses and sweeps of one actuator, auditions of
/// materials, and clips, which a background thread reads and posts like messages. Message thread.
class MixerStrikes final : private juce::AsyncUpdater {
public:
    /// All references outlive it. `onStrike` is called for each event; `onClip` for each clip: with a note or
    /// an empty text if it plays, or with the reason if it was rejected.
    MixerStrikes(Session& session, const AudioOutput& output, const Mix& mix, const MixerWorld& world,
                 std::function<void()> onStrike, std::function<void(const Result<std::string>&)> onClip);
    ~MixerStrikes() override;

    /// A pulse of one actuator, or a sweep over its range.
    void testPulse(int enchanter);
    void testSweep(int enchanter);

    /// An impact of that material of the scene at a place of the field, at the level of a test pulse. Empty,
    /// or an error.
    std::string audition(int material, double shareX, double shareY);

    /// Plays a dropped clip at a place of the field, or on one actuator only, when it has been read: one
    /// after the other.
    void feelAt(const juce::StringArray& files, double shareX, double shareY) {
        feel(files, onField(shareX, shareY), false);
    }
    void feelOn(const juce::StringArray& files, int enchanter) { feel(files, placeOf(enchanter), true); }
    /// Plays a recording, each channel on the actuator of its number, when it has been read.
    void playTake(const juce::File& file) {
        read({"clip", {{"file", pathOf(file)}}}, "Playing " + file.getFileName().toStdString());
    }

private:
    bool strike(std::vector<CollisionEvent> strikes, const EnchanterPlace& at);
    EnchanterPlace onField(double shareX, double shareY) const;
    EnchanterPlace placeOf(int enchanter) const;
    void feel(const juce::StringArray& files, const EnchanterPlace& at, bool isAlone);
    void read(PlainMessage clip, std::string said = {});
    Result<std::string> strike(const PlainMessage& clip);
    void handleAsyncUpdate() override;

    Session& session_;
    const AudioOutput& output_;
    const Mix& mix_;
    const MixerWorld& world_;
    std::function<void()> onStrike_;
    std::function<void(const Result<std::string>&)> onClip_;
    MessageRouter messages_;
    std::mutex mutex_; // guards the members below
    std::vector<Result<std::string>> results_;
    juce::ThreadPool reader_{1}; // destroyed first, because its thread uses the other members
};

} // namespace physvib
