// SPDX-License-Identifier: GPL-3.0-or-later
// Inputs beside the window's controls: the OSC port (MixerInputs), test events and clips (MixerEventPlayer).
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

/// From whom OSC messages are accepted.
enum class OscAccess { off, thisComputer, anyComputer };

/// Addresses at which others reach this computer, "192.168.1.5"; empty without a network. Any thread.
std::vector<std::string> localAddresses();

struct OscChoice {
    OscAccess access = OscAccess::off;
    std::string receiver{};        ///< HOST:PORT that receives impacts and status; empty: none
    double phoneTurnDegrees = 0.0; ///< counter-clockwise rotation of a phone from upright
    bool operator==(const OscChoice&) const = default;
};

/// The mixer's OSC port. Events go to the session at once; changes of strips and world are applied by the
/// mixer itself. With a receiver, played events are collected every 10 ms and reported. Message thread.
class MixerInputs final : private juce::AsyncUpdater, private juce::Timer {
public:
    /// `model` outlives it.
    explicit MixerInputs(MixerModel& model)
        : model_{model} {}
    ~MixerInputs() override { close(); }

    /// Sets the OSC port. Empty, or an error, and then the old port stays.
    std::string configure(const OscChoice& choice);
    const OscChoice& choice() const noexcept { return choice_; }
    std::optional<OscStatus> status() const; ///< of the open port

    bool hasNewMessages(); ///< true if messages have come since the last call

    void close(); ///< stops all input

private:
    struct PendingInput {
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
    std::vector<PendingInput> pendingInputs_;
    // used by the message thread, counted since the port was opened:
    std::uint64_t lastMessageCount_ = 0, refusedCount_ = 0; // the first as of the last hasNewMessages()
    std::string lastError_;                                 // why the mixer refused the last message
    std::optional<MessageRouter> messages_;
    std::unique_ptr<OscPort> port_; // destroyed first, because its thread uses the other members
};

/// True if the dragged files may be dropped as clips; the window handles documents. Message thread.
bool isClipDrag(const juce::StringArray& files);

/// Events that the mixer plays apart from the world: test pulses and sweeps of one actuator, auditions of
/// materials, and clips, which a background thread reads and posts like messages. Message thread.
class MixerEventPlayer final : private juce::AsyncUpdater {
public:
    /// All references outlive it. `onEvent` is called for each event; `onClip` for each clip: with a note or
    /// an empty text if it plays, or with the reason if it was rejected.
    MixerEventPlayer(Session& session, const AudioOutput& output, const Mix& mix, const MixerWorld& world,
                     std::function<void()> onEvent, std::function<void(const Result<std::string>&)> onClip);
    ~MixerEventPlayer() override;

    /// A pulse of one actuator, or a sweep over its range.
    void testPulse(int actuator);
    void testSweep(int actuator);

    /// An impact of that material of the scene at a place of the field, at the level of a test pulse. Empty,
    /// or an error.
    std::string audition(int material, double shareX, double shareY);

    /// Plays a dropped clip at a place of the field, or on one actuator only, as soon as it has been read.
    /// Clips are read one after the other.
    void playClipAt(const juce::StringArray& files, double shareX, double shareY) {
        playClipFile(files, fieldPosition(shareX, shareY), false);
    }
    void playClipOn(const juce::StringArray& files, int actuator) {
        playClipFile(files, actuatorPosition(actuator), true);
    }
    /// Plays a recording, each channel on the actuator of its number, as soon as it has been read.
    void playRecording(const juce::File& file) {
        queueClip({"clip", {{"file", pathOf(file)}}}, "Playing " + file.getFileName().toStdString());
    }

private:
    bool playEvents(std::vector<CollisionEvent> events, const ActuatorPlace& place);
    ActuatorPlace fieldPosition(double shareX, double shareY) const;
    ActuatorPlace actuatorPosition(int actuator) const;
    void playClipFile(const juce::StringArray& files, const ActuatorPlace& place, bool isSingleActuator);
    void queueClip(PlainMessage clip, std::string note = {});
    Result<std::string> playClip(const PlainMessage& clip);
    void handleAsyncUpdate() override;

    Session& session_;
    const AudioOutput& output_;
    const Mix& mix_;
    const MixerWorld& world_;
    std::function<void()> onEvent_;
    std::function<void(const Result<std::string>&)> onClip_;
    MessageRouter messages_;
    std::mutex mutex_; // guards the members below
    std::vector<Result<std::string>> results_;
    juce::ThreadPool reader_{1}; // destroyed first, because its thread uses the other members
};

} // namespace physvib
