// SPDX-License-Identifier: GPL-3.0-or-later
// What the mixer's window shows and changes: a live session on a device, its mix, the way back of edits.
#pragma once
#include "Host/Rig/Rig.h"
#include "Live/Documents/SessionFile.h"
#include "Mixer/Desk/DeskDevice.h"
#include "Mixer/Desk/DeskExposure.h"
#include "Mixer/Desk/DeskInputs.h"
#include "Mixer/Desk/DeskLanes.h"
#include "Mixer/Desk/DeskRecording.h"
#include "Mixer/Desk/DeskScript.h"
#include "Mixer/Desk/DeskSignals.h"
#include "Mixer/Desk/DeskStrikes.h"
#include "Mixer/Desk/DeskWorld.h"
#include "Mixer/Desk/RecentContacts.h"
#include "Mixer/Desk/ToldMix.h"
#include <juce_data_structures/juce_data_structures.h>
#include <memory>
#include <string>
#include <vector>

namespace physvib {

/// M only. Listeners are told when the mix, the device or the trouble changes.
class Desk final : public juce::ChangeBroadcaster {
public:
    static constexpr int channels = limits::maxEnchanters; ///< of the session: room for all that is attached
    static constexpr double gapSeconds = 0.005; ///< the driver's thread shares the machine with painting

    /// Plays `mix` on `device`, one of `types`; trouble() if it does not open. Its rate and block hold until
    /// another is opened.
    Desk(AudioDeviceTypes types, const DeviceChoice& device, Mix mix = firstMix());
    static Mix firstMix(); ///< *Shake the box* on PHONE4, at a safe level
    ~Desk() override;

    const Mix& mix() const noexcept { return mix_; }
    /// Takes up another mix, which can be undone. `name` is what the menu says; of edits that follow each
    /// other with `goesOn`, as those of a fader that is held, only the first starts something to undo.
    void edit(const juce::String& name, const Mix& next, bool goesOn = false);
    template <class Change>
    void change(const juce::String& name, Change change, bool goesOn = false) {
        Mix next = mix_;
        change(next);
        edit(name, next, goesOn);
    }
    juce::UndoManager& undoManager() noexcept { return undo_; }
    bool attach(double shareX, double shareY); ///< at shares of the field, quietly; false: no room
    void detach(int enchanter);                ///< one always stays
    std::uint64_t edits() const noexcept { return edits_; } ///< with inputs: what a document is saved for
    const SavedSession& saved(); ///< the session until now: rendered again it is what was played
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
    const RecentContacts& recent() const noexcept { return recent_; } ///< the last that were played
    std::string open(const DeviceChoice& choice);
    /// As DeskListening::monitor; enchanters that have these outputs have none then, which can be undone.
    std::string monitorInstead(std::vector<int> outputs, double db);
    void setSilent(bool silent);                         ///< as a person at the machine wishes
    bool isSilent() const noexcept { return isSilent_; } ///< as it is shown: what is pressed then means that
    void stop();                                         ///< what Esc does first of all
    void takeEscape(); ///< of an Esc that nothing else took: lifts what was silent before it
    void setDisplayWidth(double metres); ///< of what the world is seen on, for drags; 0: as the system says
    double displayWidthMetres() const noexcept { return displayWidthMetres_; }
    DeskMoment look(); ///< what is new; at most about 30 times a second
    const juce::String& trouble() const noexcept { return trouble_; } ///< one line; empty while all is well
    void report(const juce::String& trouble);
    void tell(const juce::String& news); ///< what went well, in the same place
    bool isNews() const noexcept { return isNews_; }

private:
    class MixEdit;
    friend class DeskInputs; // it shows silence, and hears often of what was played
    void edited(bool isShown = true);
    void watchOutput();
    void beginWorld(bool isSameScene);
    void apply(const Mix& next);
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
    juce::String trouble_, deviceTrouble_; // shown; the device's of the last look
    double displayWidthMetres_ = 0.0;
    bool isSilent_ = false, hasStopped_ = false, isNews_ = false;
    std::uint64_t edits_ = 0;
    ToldMix told_;
    SavedSession saved_;
    int mostEnchanters_ = 0;
    RecentContacts recent_;
    DeskMoment now_;
    DeskScript script_{*this};
    DeskLanes lanes_{*this};
    std::vector<CollisionEvent> hits_; // played since the last look
    DeskStrikes strikes_;              // these last: their threads use the others
    DeskInputs inputs_{*this};
};

} // namespace physvib
