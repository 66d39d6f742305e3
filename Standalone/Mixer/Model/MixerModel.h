// SPDX-License-Identifier: GPL-3.0-or-later
// Model of the mixer's window: a live session on a device, the mixer state, and the undo history. Its parts
// are the other files of this folder; views look at it and change it, it knows no view.
#pragma once
#include "Live/Documents/SessionFile.h"
#include "Mixer/Model/MixerDevice.h"
#include "Mixer/Model/MixerInputs.h"
#include "Mixer/Model/MixerRecording.h"

namespace physvib {

class SentMix;

/// Message thread. Listeners are notified when the mixer state, the device or the error message changes.
class MixerModel final : public juce::ChangeBroadcaster {
public:
    static constexpr int channels = limits::maxEnchanters; ///< of the session: the most actuators

    /// Plays `mix` on `device`, one of `types`; trouble() reports a failure. Sample rate and block size stay
    /// until another device is opened.
    MixerModel(AudioDrivers drivers, const DeviceChoice& device, Mix mix = firstMix(), MixerStart start = {});
    static Mix firstMix(); ///< *Shake the box* on PHONE4 at a safe level
    ~MixerModel() override;

    const Mix& mix() const noexcept { return mix_; }
    /// Applies another mixer state as an undoable edit named `name`. In a series of edits with
    /// `continuesEdit`, such as those of a held fader, only the first starts a new undo step. An actuator
    /// whose output another one has gets none, which is reported. Undo has bodies where they were drawn, or
    /// with `returns` where they were.
    void edit(const juce::String& name, const Mix& next, bool continuesEdit = false, bool returns = false);
    template <class Change>
    void change(const juce::String& name, Change change, bool continuesEdit = false) {
        Mix next = mix_;
        change(next);
        edit(name, next, continuesEdit);
    }
    juce::UndoManager& undoManager() noexcept { return history_->undo; }
    /// For a model that begins with this one's mix and drawing.
    std::shared_ptr<MixerHistory> history() const { return history_; }
    bool attach(double shareX, double shareY); ///< at shares of the field, quietly; false: no channel is left
    void detach(int enchanter);                ///< the last actuator cannot be detached

    std::uint64_t edits() const noexcept { return edits_; } ///< inputs included; for unsaved changes
    const SavedSession& saved(); ///< the session until now; rendering it reproduces what was played
    void restart(std::uint32_t seed);
    void setSlowness(int slowness); ///< see WorldRunner
    Rig& rig() noexcept { return rig_; }
    Session& session() noexcept { return rig_.session(); }
    const Session& session() const noexcept { return rig_.session(); }
    MixerWorld& world() noexcept { return world_; }
    const MixerWorld& world() const noexcept { return world_; }
    MixerStrikes& strikes() noexcept { return strikes_; }
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
    const RecentContacts& recent() const noexcept { return recent_; } ///< the last contacts that were played
    std::string open(const DeviceChoice& choice);
    /// As MixerListening::monitor. Actuators on these outputs lose them, which can be undone.
    std::string monitorInstead(std::vector<int> outputs, double db);
    void setSilent(bool silent);                         ///< set by the user at the machine
    bool isSilent() const noexcept { return isSilent_; } ///< as displayed: keys refer to what users see
    bool isOnlySeen() const; ///< there is neither a device nor a board or controller

    void setDisplayWidth(double metres); ///< of the display, to scale drags; 0: as the system reports
    double displayWidthMetres() const noexcept { return displayWidthMetres_; }
    MixerMoment look(); ///< changes since the last call; at most about 30 times a second
    MixerMessages& messages() noexcept { return messages_; }
    const juce::String& trouble() const noexcept { return messages_.shown().words; } ///< one line, or empty
    bool isNews() const noexcept { return messages_.shown().isNews; }
    void report(const juce::String& trouble) { messages_.show({trouble}); }
    bool reportFault(const std::string& fault); ///< empty: none, and false; nothing changes then
    void announce(const juce::String& news) { messages_.show({news, true}); } ///< a success

private:
    class MixEdit;
    friend class MixerInputs; // calls showSilence() and, often, collectPlayed()
    void edited(bool isShown = true);

    void watchOutput();
    bool apply(const Mix& next); // false: it was refused, and nothing has changed
    void showSilence();
    void collectPlayed();
    void clipWasRead(const Result<std::string>& note);

    Mix mix_;
    Rig rig_;
    MixerSignals signals_;
    MixerDevice device_;
    MixerExposure exposure_{rig_.output()};
    MixerRecording recording_;
    std::shared_ptr<MixerHistory> history_;
    MixerWorld world_;
    MixerMessages messages_{[this] { sendChangeMessage(); }};
    std::vector<RigTrouble> troubles_; // as shown
    double displayWidthMetres_ = 0.0;
    bool isSilent_ = false;
    std::uint64_t edits_ = 0;
    std::unique_ptr<SentMix> lastSent_;
    SavedSession saved_;
    int maxEnchanters_ = 0;
    RecentContacts recent_;
    MixerMoment now_;
    MixerScript script_{*this};
    MixerLanes lanes_{*this};
    std::vector<CollisionEvent> hits_; // played since the last look()
    MixerStrikes strikes_;             // destroyed before the members above, because its threads use them
    MixerInputs inputs_{*this};
};

} // namespace physvib
