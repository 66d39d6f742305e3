// SPDX-License-Identifier: GPL-3.0-or-later
// Model of the mixer's window: a live session on a device, the mixer state, and the undo history.
#pragma once
#include "Live/Documents/SessionFile.h"
#include "Live/Rig/Rig.h"
#include "Mixer/Desk/DeskDevice.h"
#include "Mixer/Desk/DeskExposure.h"
#include "Mixer/Desk/DeskInputs.h"
#include "Mixer/Desk/DeskLanes.h"
#include "Mixer/Desk/DeskMessages.h"
#include "Mixer/Desk/DeskRecording.h"
#include "Mixer/Desk/DeskScript.h"
#include "Mixer/Desk/DeskSignals.h"
#include "Mixer/Desk/DeskStrikes.h"
#include "Mixer/Desk/DeskWorld.h"
#include "Mixer/Desk/RecentContacts.h"
#include "Mixer/Desk/ToldMix.h"
#include <juce_data_structures/juce_data_structures.h>

#include <string>
#include <vector>

namespace physvib {

/// Message thread only. Listeners are notified when the mixer state, the device or the error message changes.
class Desk final : public juce::ChangeBroadcaster {
public:
    static constexpr int channels = limits::maxEnchanters; ///< of the session: the maximum number of
                                                           ///< actuators
    static constexpr double gapSeconds = 0.005; ///< the simulation thread shares the processor with painting

    /// Plays `mix` on `device`, one of `types`; trouble() reports a failure. Sample rate and block size stay
    /// until another device is opened.
    Desk(AudioDrivers drivers, const DeviceChoice& device, Mix mix = firstMix(), DeskStart start = {});
    static Mix firstMix(); ///< *Shake the box* on PHONE4 at a safe level
    ~Desk() override;

    const Mix& mix() const noexcept { return mix_; }
    /// Applies another mixer state as an undoable edit named `name`. In a series of edits with `goesOn`, such
    /// as those of a held fader, only the first starts a new undo step.
    /// An actuator whose output another one has gets none, which is reported.
    void edit(const juce::String& name, const Mix& next, bool goesOn = false);
    template <class Change>
    void change(const juce::String& name, Change change, bool goesOn = false) {
        Mix next = mix_;
        change(next);
        edit(name, next, goesOn);
    }
    juce::UndoManager& undoManager() noexcept { return undo_; }
    bool attach(double shareX, double shareY); ///< at shares of the field, at a low level; false if there is
                                               ///< no channel left
    void detach(int enchanter);                ///< the last actuator cannot be detached

    std::uint64_t edits() const noexcept { return edits_; } ///< inputs included; for unsaved changes
    const SavedSession& saved(); ///< the session until now; rendering it reproduces what was played
    void restart(std::uint32_t seed);
    void setSlowness(int slowness); ///< see WorldRunner
    Rig& rig() noexcept { return rig_; }
    Session& session() noexcept { return rig_.session(); }
    const Session& session() const noexcept { return rig_.session(); }
    DeskWorld& world() noexcept { return world_; }
    const DeskWorld& world() const noexcept { return world_; }
    DeskStrikes& strikes() noexcept { return strikes_; }
    DeskDevice& device() noexcept { return device_; }
    const DeskDevice& device() const noexcept { return device_; }
    AudioOutput& output() noexcept { return rig_.output(); }
    const AudioOutput& output() const noexcept { return rig_.output(); }
    DeskInputs& inputs() noexcept { return inputs_; }
    DeskRecording& recording() noexcept { return recording_; }
    const DeskRecording& recording() const noexcept { return recording_; }
    DeskExposure& exposure() noexcept { return exposure_; }
    DeskScript& script() noexcept { return script_; }
    const DeskSignals& signals() const noexcept { return signals_; }
    const RecentContacts& recent() const noexcept { return recent_; } ///< the last contacts that were played
    std::string open(const DeviceChoice& choice);
    /// As DeskListening::monitor. Actuators on these outputs lose them, which can be undone.
    std::string monitorInstead(std::vector<int> outputs, double db);
    void setSilent(bool silent);                         ///< set by the user at the machine
    bool isSilent() const noexcept { return isSilent_; } ///< as displayed: keys refer to what users see

    void setDisplayWidth(double metres); ///< of the display, to scale drags; 0: as the system reports
    double displayWidthMetres() const noexcept { return displayWidthMetres_; }
    DeskMoment look(); ///< changes since the last call; at most about 30 times a second
    DeskMessages& messages() noexcept { return messages_; }
    const juce::String& trouble() const noexcept { return messages_.shown().words; } ///< one line, or empty
    bool isNews() const noexcept { return messages_.shown().isNews; }
    void report(const juce::String& trouble) { messages_.show({trouble}); }
    void tell(const juce::String& news) { messages_.show({news, true}); } ///< reports a success there

private:
    class MixEdit;
    friend class DeskInputs; // calls showSilence() and, often, takePlayed()
    void edited(bool isShown = true);

    void watchOutput();
    void beginWorld(bool isSameScene);
    bool apply(const Mix& next); // false: it was refused, and nothing has changed
    void showSilence();
    void takePlayed();
    void takeFelt(const Result<std::string>& note);

    Mix mix_;
    Rig rig_;
    DeskSignals signals_;
    DeskDevice device_;
    DeskExposure exposure_{rig_.output()};
    DeskRecording recording_;
    juce::UndoManager undo_;
    DeskWorld world_;
    DeskMessages messages_{[this] { sendChangeMessage(); }};
    std::vector<RigTrouble> troubles_; // as shown
    double displayWidthMetres_ = 0.0;
    bool isSilent_ = false;
    std::uint64_t edits_ = 0;
    ToldMix told_;
    SavedSession saved_;
    int mostEnchanters_ = 0;
    RecentContacts recent_;
    DeskMoment now_;
    DeskScript script_{*this};
    DeskLanes lanes_{*this};
    std::vector<CollisionEvent> hits_; // played since the last look()
    DeskStrikes strikes_;              // destroyed before the members above, because its threads use them
    DeskInputs inputs_{*this};
};

} // namespace physvib
