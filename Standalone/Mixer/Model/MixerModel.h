// SPDX-License-Identifier: GPL-3.0-or-later
// Model of the mixer's window: a live session on a device, the mixer state, and the undo history. Its parts
// are in the other files of this folder. Views read and change it; it does not depend on them.
#pragma once
#include "Live/Documents/SessionFile.h"
#include "Mixer/Model/MixerDevice.h"
#include "Mixer/Model/MixerInputs.h"
#include "Mixer/Model/MixerRecording.h"

namespace physvib {

class SentMix;

/// A live session with its device, mixer state and undo steps. Listeners are notified when the mixer state,
/// the device or the message changes. Message thread.
class MixerModel final : public juce::ChangeBroadcaster {
public:
    static constexpr int channels = limits::maxActuators; ///< of the session: the maximum of actuators

    /// Plays `mix` on `device`, one of `drivers`; messageText() reports a failure. Sample rate and block size
    /// stay until another device is opened.
    MixerModel(AudioDrivers drivers, const DeviceChoice& device, Mix mix = defaultMix(),
               MixerStart start = {});
    static Mix defaultMix(); ///< *Shake the box* on PHONE4 at a safe level
    ~MixerModel() override;

    const Mix& mix() const noexcept { return mix_; }
    /// Applies another mixer state as an undoable edit named `name`. In a series of edits with
    /// `continuesEdit`, such as those of a held fader, only the first starts a new undo step. An actuator
    /// whose output another one has gets none, which is reported. Undo moves bodies to their drawn poses, or
    /// with `restoresPoses` to those before the edit.
    void edit(const juce::String& name, const Mix& newMix, bool continuesEdit = false,
              bool restoresPoses = false);
    template <class Change>
    void change(const juce::String& name, bool continuesEdit, Change change) {
        Mix newMix = mix_;
        change(newMix);
        edit(name, newMix, continuesEdit);
    }
    void change(const juce::String& name, auto modify) { change(name, false, modify); }
    /// A change by a message, as an edit that continues those of messages before. While a mouse button is
    /// held it belongs to no step: undoing whatever the hand did keeps it.
    void changeByMessage(const std::function<void(Mix&)>& change);
    juce::UndoManager& undoManager() noexcept { return history_->undo; }
    /// The undo steps, which another model with the same mix and drawing can take over.
    std::shared_ptr<MixerHistory> history() const { return history_; }
    bool attach(double shareX, double shareY); ///< at shares of the field, at a low level; false: none free
    void detach(int actuator);                 ///< the last actuator cannot be detached

    std::uint64_t editCount() const noexcept { return editCount_; } ///< edits and inputs since the start
    const SavedSession& savedSession(); ///< the session until now; rendering it reproduces what was played
    void restart(std::uint32_t seed);
    void setSlowness(int slowness); ///< see WorldRunner
    Rig& rig() noexcept { return rig_; }
    Session& session() noexcept { return rig_.session(); }
    const Session& session() const noexcept { return rig_.session(); }
    MixerWorld& world() noexcept { return world_; }
    const MixerWorld& world() const noexcept { return world_; }
    MixerEventPlayer& eventPlayer() noexcept { return eventPlayer_; }
    MixerDevice& device() noexcept { return device_; }
    const MixerDevice& device() const noexcept { return device_; }
    AudioOutput& output() noexcept { return rig_.output(); }
    const AudioOutput& output() const noexcept { return rig_.output(); }
    MixerInputs& inputs() noexcept { return inputs_; }
    MixerRecording& recording() noexcept { return recording_; }
    const MixerRecording& recording() const noexcept { return recording_; }
    MixerExposure& exposure() noexcept { return exposure_; }
    MixerScript& script() noexcept { return script_; }
    const MixerSignals& signals() const noexcept { return signals_; }
    const RecentContacts& recentContacts() const noexcept { return recentContacts_; }
    std::string open(const DeviceChoice& choice);
    /// As MixerListening::monitor. Actuators on these outputs lose them, which can be undone.
    std::string moveOutputsToMonitor(std::vector<int> outputs, double levelDb);
    void setSilent(bool silent);                         ///< mutes the output at once, or lifts that
    bool isSilent() const noexcept { return isSilent_; } ///< as displayed, which is what keys toggle
    bool isVisualOnly() const;                           ///< no device, sink or OSC receiver plays

    void setDisplayWidth(double metres); ///< of the display, to scale drags; 0: as the system reports
    double displayWidthMetres() const noexcept { return displayWidthMetres_; }
    MixerSnapshot poll(); ///< changes since the last call; at most about 30 times a second
    MixerMessages& messages() noexcept { return messages_; }
    const juce::String& messageText() const noexcept { return messages_.current().text; }
    bool isInfo() const noexcept { return messages_.current().isInfo; }
    void report(const juce::String& error) { messages_.show({error}); }
    bool reportIfError(const std::string& error); ///< true if there is one; else nothing changes
    void announce(const juce::String& news) { messages_.show({news, true}); } ///< a success

private:
    class MixEdit;
    friend class MixerInputs; // calls showSilence(), and collectPlayed() at its own rate
    void countEdit(bool changesDisplay = true);

    void checkOutput();
    bool apply(const Mix& newMix); // false: it was rejected, and nothing has changed
    void showSilence();
    void collectPlayed();
    void onClipRead(const Result<std::string>& note);

    Mix mix_;
    Rig rig_;
    MixerSignals signals_;
    MixerDevice device_;
    MixerExposure exposure_{rig_.output()};
    MixerRecording recording_;
    std::shared_ptr<MixerHistory> history_;
    MixerWorld world_;
    MixerMessages messages_{[this] { sendChangeMessage(); }};
    std::vector<RigError> rigErrors_; // as shown
    double displayWidthMetres_ = 0.0;
    bool isSilent_ = false;
    std::uint64_t editCount_ = 0;
    std::unique_ptr<SentMix> sentMix_;
    SavedSession savedSession_;
    int maxActuators_ = 0;
    RecentContacts recentContacts_;
    MixerSnapshot snapshot_;
    MixerScript script_{*this};
    MixerLanes lanes_{*this};
    std::vector<CollisionEvent> hits_; // played since the last poll()
    MixerEventPlayer eventPlayer_;     // destroyed before the members above, because its threads use them
    MixerInputs inputs_{*this};
};

} // namespace physvib
