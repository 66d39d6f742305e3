// SPDX-License-Identifier: GPL-3.0-or-later
// What the mixer's window shows and changes: a live session on a device, the mix that is set on it, and the way back of
// every change.
#pragma once
#include "Files/Mix.h"
#include "Host/Devices/AudioOutput.h"
#include "Host/Devices/ChannelMeters.h"
#include "Host/Recordings/Recording.h"
#include "Host/Devices/SimulationDriver.h"
#include "Files/SessionFile.h"
#include "Session/BoardOutput.h"
#include "Mixer/Strips/ScopeTrace.h"
#include "Mixer/Strips/SpectrumTrace.h"
#include <juce_data_structures/juce_data_structures.h>
#include <deque>
#include <memory>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// What has happened since the last look.
struct DeskMoment {
    std::vector<BodyPose> poses;
    std::int64_t sessionNs = 0; ///< of the poses
    std::int64_t aheadNs = 0;   ///< they are felt so much later
    std::vector<CollisionEvent> hits;
    ChannelMeters meters;
    std::array<float, limits::maxEnchanters> holds{}; ///< highest peaks of the last moments
    float masterPeak = 0.0f;                          ///< behind the master level
    SessionStatus session;
    AudioOutputStatus device;
};

/// The device that is wanted.
struct DeviceChoice {
    std::string name;     ///< type:name
    int sampleRateHz = 0; ///< 0: as it stands
    int blockFrames = 0;
    std::string board{};  ///< serial port of a four-channel board beside it, anyBoard; empty: none
};

/// The first board that answers.
inline constexpr const char* anyBoard = "auto";

/// M only. Listeners are told when the mix, the device or the trouble changes.
class Desk final : public juce::ChangeBroadcaster {
public:
    /// Channels of the session: whatever is attached while it plays finds one.
    static constexpr int channels = limits::maxEnchanters;

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
    void restart(std::uint32_t seed);
    void setSlowness(int slowness);
    int slowness() const noexcept { return session_.slowness(); }
    void stepOnce() { session_.stepOnce(); }
    /// A pulse of one enchanter, or a sweep of its range.
    void testPulse(int enchanter);
    void testSweep(int enchanter);
    Session& session() noexcept { return session_; }
    const Session& session() const noexcept { return session_; }

    // ---- the recording
    /// WAV of the enchanters that are attached now, and the events beside it; empty, or why not.
    std::string startRecording(const juce::File& file);
    void stopRecording(); ///< the files are in their places a moment later: recorded() says so
    bool isRecording() const noexcept { return recording_ != nullptr && !isEnding_; }
    double recordedSeconds() const noexcept;
    std::int64_t recordedFrom() const noexcept { return recordedFrom_; } ///< session frame of the last recording's first one
    std::function<void(const juce::File&, const juce::String& error)> onRecorded;

    // ---- the output
    std::string open(const DeviceChoice& device);
    const DeviceChoice& device() const noexcept { return device_; }
    const AudioDeviceTypes& deviceTypes() const noexcept { return types_; }
    AudioOutput& output() noexcept { return output_; }
    const AudioOutput& output() const noexcept { return output_; }
    int outputs() const { return output_.deviceOutputs(); } ///< that the device offers
    /// On outputs that are no strip's, e.g. noise on headphones; empty, or why not, and all is as before.
    std::string hear(const ListeningSettings& listening);
    const ListeningSettings& listening() const noexcept { return listening_; }
    void setSilent(bool silent);
    bool isSilent() const noexcept { return isSilent_; }
    double playOutSeconds() const noexcept;

    /// What the four-channel board says, if one is wanted. It plays the first four enchanters.
    std::optional<BoardLinkStatus> board() const { return link_ ? std::optional{link_->status()} : std::nullopt; }
    /// The choice asks for a board, or for none: L is another then, so the session has to begin anew.
    std::function<void(const DeviceChoice&)> onBoardWanted;

    // ---- looking
    /// What is new; at most about 30 times a second.
    DeskMoment look();
    const ScopeTrace& scope() const noexcept { return scope_; }
    const SpectrumTrace& spectrum() const noexcept { return spectrum_; }
    /// The last that were played, the newest first.
    static constexpr std::size_t mostRecent = 100;
    const std::deque<CollisionEvent>& recent() const noexcept { return recent_; }
    std::uint64_t scopeFramesLost() const noexcept { return tap_.framesLost(); }
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
    juce::String boardTrouble();
    void finishRecording();
    juce::String closeRecording();
    void showEdit(const Action& action);
    void takeScene(bool keepsSounds);
    void apply(const Mix& next);
    void tellSession();
    std::vector<int> outputMap() const;
    void measure(const float* const* block, int frames);
    void strike(int enchanter, std::vector<CollisionEvent> strikes);

    AudioDeviceTypes types_;
    Mix mix_;
    Session session_;
    SignalTap tap_;
    AudioOutput output_;
    std::unique_ptr<BoardLink> link_;
    std::unique_ptr<BoardOutput> onBoard_;
    std::unique_ptr<SimulationDriver> driver_;
    juce::UndoManager undo_;
    Scene sceneNow_;
    DeviceChoice device_;
    ListeningSettings listening_;
    juce::String trouble_, deviceTrouble_, outputTrouble_; // shown; of the device; with the board's
    bool isSilent_ = false, isNews_ = false, wasBoardReady_ = false;
    std::uint64_t edits_ = 0, worldEdits_ = 0;
    struct Told { // what the session has taken
        PhantomPanner panner;
        std::array<ToldStrip, limits::maxEnchanters> strips;
    };
    Told told_;
    SavedSession saved_;
    int mostEnchanters_ = 0, added_ = 0;
    std::unique_ptr<Recording> recording_;
    juce::File recordingFile_;
    bool isEnding_ = false;
    std::int64_t recordedFrom_ = 0;
    std::uint64_t endsAfterBlock_ = 0;

    ScopeTrace scope_;
    SpectrumTrace spectrum_;
    std::deque<CollisionEvent> recent_;
    DeskMoment now_;
    std::array<double, limits::maxEnchanters> heldAtMs_{};
    double lookedAtMs_ = 0.0, maintainedAtMs_ = 0.0, boardWantedAtMs_ = 0.0;
};

/// Names of built-in scenes as people write them: "shake-the-box" as "Shake the box".
juce::String titleOf(const std::string& name);

} // namespace physvib
