// SPDX-License-Identifier: GPL-3.0-or-later
// What the mixer's window shows and changes: a live session on a device, the mix that is set on it, and the way back of
// every change.
#pragma once
#include "Files/Mix.h"
#include "Files/SessionFile.h"
#include "Host/Devices/AudioOutput.h"
#include "Host/Devices/SimulationDriver.h"
#include "Mixer/Desk/DeskBoard.h"
#include "Mixer/Desk/DeskClips.h"
#include "Mixer/Desk/DeskExposure.h"
#include "Mixer/Desk/DeskMoment.h"
#include "Mixer/Desk/DeskOsc.h"
#include "Mixer/Desk/DeskRecording.h"
#include "Mixer/Desk/DeskSignals.h"
#include "Mixer/Desk/RecentContacts.h"
#include "Mixer/Desk/ToldMix.h"
#include <juce_data_structures/juce_data_structures.h>
#include <memory>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// M only. Listeners are told when the mix, the device or the trouble changes.
class Desk final : public juce::ChangeBroadcaster {
public:
    /// Channels of the session: whatever is attached while it plays finds one.
    static constexpr int channels = limits::maxEnchanters;
    static constexpr double gapSeconds = 0.005; ///< the driver's thread shares the machine with painting

    /// Plays `mix` on `device`, one of `types`; trouble() if it does not open. Its rate and block hold until another is opened.
    Desk(AudioDeviceTypes types, const DeviceChoice& device, Mix mix = firstMix());
    /// *Shake the box* on PHONE4, at a safe level.
    static Mix firstMix();
    ~Desk() override;

    // ---- the mix
    const Mix& mix() const noexcept { return mix_; }
    /// Takes up another mix, which can be undone. `name` is what the menu says; of edits that follow each other with
    /// `goesOn`, as those of a fader that is held, only the first starts something to undo.
    void edit(const juce::String& name, const Mix& next, bool goesOn = false);
    template <class Change>
    void change(const juce::String& name, Change change, bool goesOn = false) {
        Mix next = mix_;
        change(next);
        edit(name, next, goesOn);
    }
    juce::UndoManager& undoManager() noexcept { return undo_; }
    /// Attaches an enchanter at a place of the field (shares of its width and height), quietly; false: no room.
    bool attach(double shareX, double shareY);
    void detach(int enchanter); ///< one always stays
    /// Grows with every edit and every input: what a document has to be saved for.
    std::uint64_t edits() const noexcept { return edits_; }
    /// The session until now, to be saved: rendered again it is what was played.
    const SavedSession& saved();

    // ---- the world
    const Scene& sceneNow() const noexcept { return sceneNow_; } ///< with what was spawned since it began
    std::uint64_t worldEdits() const noexcept { return worldEdits_; } ///< grows when sceneNow() changes
    std::string act(const Action& action);                       ///< empty, or what is wrong with it
    /// An edit of the world that can be undone: adds a body, takes one away, makes it of another material, changes a
    /// sound. `goesOn` as of edit(). Empty, or what is wrong with it.
    std::string editWorld(const juce::String& name, const Action& action, bool goesOn = false);
    /// A hit of that material of sceneNow() at a place of the field, as strong as a test pulse. Empty, or why not.
    std::string audition(int material, double shareX, double shareY);
    /// A clip that is dropped, at a place of the field or on one enchanter alone: felt when it has been read, or reported why not.
    void feelAt(const juce::StringArray& files, double shareX, double shareY);
    void feelOn(const juce::StringArray& files, int enchanter);
    void restart(std::uint32_t seed);
    void setSlowness(int slowness);
    int slowness() const noexcept { return session_.slowness(); }
    void stepOnce() { session_.stepOnce(); }
    /// A pulse of one enchanter, or a sweep of its range.
    void testPulse(int enchanter);
    void testSweep(int enchanter);
    Session& session() noexcept { return session_; }
    const Session& session() const noexcept { return session_; }

    DeskRecording& recording() noexcept { return recording_; }
    const DeskRecording& recording() const noexcept { return recording_; }

    DeskExposure& exposure() noexcept { return exposure_; }

    // ---- the output
    std::string open(const DeviceChoice& device);
    const DeviceChoice& device() const noexcept { return device_; }
    const AudioDeviceTypes& deviceTypes() const noexcept { return types_; }
    AudioOutput& output() noexcept { return output_; }
    const AudioOutput& output() const noexcept { return output_; }
    int outputs() const { return output_.deviceOutputs(); } ///< that the device offers
    /// Left and right, contacts are heard as they are felt; and the output of marks. Where enchanters are, neither is. Empty, or why not, and all
    /// is as before.
    std::string monitor(std::vector<int> outputs, double db);
    std::string mark(int output);
    /// The same, and enchanters that have these outputs have none then, which can be undone.
    std::string monitorInstead(std::vector<int> outputs, double db);
    /// A study begins: noise on headphones, and no monitor, which would tell the ears what hands are asked. As monitor().
    std::string hear(const ListeningSettings& ofStudy);
    void endStudy();
    const ListeningSettings& listening() const noexcept { return heard_; }
    void setSilent(bool silent);                         ///< as a person at the machine wishes
    bool isSilent() const noexcept { return isSilent_; } ///< as it is shown: what is pressed then means that
    double playOutSeconds() const noexcept;

    /// What plays beside the device, as far as it says so.
    std::vector<SinkState> sinks() const { return session_.sinks().states(); }
    /// What the four-channel board says, if one is wanted.
    std::optional<BoardLinkStatus> board() const { return board_ ? std::optional{board_->status()} : std::nullopt; }
    /// The choice asks for a board, or for none: L is another then, so the session has to begin anew.
    std::function<void(const DeviceChoice&)> onBoardWanted;

    // ---- messages by OSC
    /// From now on; empty, or why not, and then as before.
    std::string useOsc(const OscChoice& choice);
    const OscChoice& oscChoice() const noexcept { return oscChoice_; }
    std::optional<OscStatus> osc() const { return osc_ ? std::optional{osc_->status()} : std::nullopt; }
    /// An input or a control as it comes from outside: the world's inputs, gains and mutes of strips, silence. Empty, or what is wrong with it.
    std::string take(const LineInput& input);

    // ---- the display
    /// How wide the display is that the world is seen on; 0: as the system says. A drag is measured by it.
    void setDisplayWidth(double metres);
    double displayWidthMetres() const noexcept { return displayWidthMetres_; }

    // ---- looking
    /// What is new; at most about 30 times a second.
    DeskMoment look();
    const ScopeTrace& scope() const noexcept { return signals_.scope(); }
    const SpectrumTrace& spectrum() const noexcept { return signals_.spectrum(); }
    const RecentContacts& recent() const noexcept { return recent_; } ///< the last that were played
    std::uint64_t scopeFramesLost() const noexcept { return signals_.framesLost(); }
    const juce::String& trouble() const noexcept { return trouble_; } ///< one line; empty while all is well
    void report(const juce::String& trouble);
    /// What went well, told in the same place.
    void tell(const juce::String& news);
    bool isNews() const noexcept { return isNews_; }

private:
    class MixEdit;
    class WorldEdit;
    std::vector<Action> undoOf(const Action& action) const;
    Action renamed(const Action& action);
    void watchOutput();
    void showEdit(const Action& action);
    void takeScene(bool keepsMaterials);
    void apply(const Mix& next);
    std::vector<int> outputMap() const;
    bool isFree(int output) const;
    ListeningSettings wantedListening() const;
    std::string hearWanted();
    std::string listen(const ListeningSettings& wanted, const DeviceChoice& choice);
    std::string takeControl(const RenderControl& control);
    void showSilence();
    std::string openOsc();
    void watchOsc();
    void takePlayed();
    void strike(int enchanter, std::vector<CollisionEvent> strikes);
    EnchanterPlace placeOf(int enchanter) const;
    void feel(const juce::StringArray& files, const EnchanterPlace& at, bool isAlone);
    void takeFelt(const Result<std::string>& note);

    AudioDeviceTypes types_;
    Mix mix_;
    std::unique_ptr<DeskBoard> board_;
    Session session_;
    DeskSignals signals_;
    AudioOutput output_;
    DeskExposure exposure_{output_};
    DeskRecording recording_;
    std::unique_ptr<SimulationDriver> driver_;
    juce::UndoManager undo_;
    Scene sceneNow_;
    DeviceChoice device_;
    std::optional<ListeningSettings> ofStudy_;
    ListeningSettings heard_; // what the output has been told
    juce::String trouble_, deviceTrouble_, outputTrouble_; // shown; of the device; with the board's
    double displayWidthMetres_ = 0.0, maintainedAtMs_ = 0.0;
    bool isSilent_ = false, isNews_ = false;
    std::uint64_t edits_ = 0, worldEdits_ = 0;
    ToldMix told_;
    SavedSession saved_;
    int mostEnchanters_ = 0, added_ = 0;
    RecentContacts recent_;
    DeskMoment now_;
    std::vector<CollisionEvent> hits_; // played since the last look
    OscChoice oscChoice_;
    std::uint64_t oscMessages_ = 0; // as of the last look
    DeskClips clips_;               // these last: their threads use the others
    std::unique_ptr<DeskOsc> osc_;
};

/// Names of built-in scenes as people write them: "shake-the-box" as "Shake the box".
juce::String titleOf(const std::string& name);

} // namespace physvib
