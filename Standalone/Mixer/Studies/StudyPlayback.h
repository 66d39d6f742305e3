// SPDX-License-Identifier: GPL-3.0-or-later
// Borrows the mixer's session for a study: its world is paused, its channels are the stimulus' actuators, and
// only the trial's stimuli play. Master level, ceilings, outputs and the silence button stay unchanged.
#pragma once
#include "Host/Views/WorldView.h"
#include "Live/Rig/Rig.h"
#include "Live/Session/SessionJournal.h"
#include "Mixer/Model/MixerModel.h"
#include "Mixer/Widgets/Parts.h"
#include "Studies/StudyCalls.h"
#include <filesystem>
#include <juce_core/juce_core.h>
#include <memory>
#include <string>

namespace physvib {

/// The mixer has fewer actuators than a layout. Any thread.
std::string tooFew(const std::string& layout, int wanted, int there);

/// How what was played last fared, by the receipts of the output.
enum class Course {
    none,   ///< nothing was played yet, or it was stopped
    plays,  ///< it is not over
    left,   ///< every actuator got all of it, in one piece and within 1 dB of the plan
    lost,   ///< it was cut off, silenced, or missed an actuator
    unlike, ///< it left as a whole, at another level than planned
};

/// Message thread. The mixer state must not be edited during its lifetime.
class StudySound {
public:
    explicit StudySound(MixerModel& model);
    ~StudySound(); ///< restores mixer state and world speed
    StudySound(const StudySound&) = delete;
    StudySound& operator=(const StudySound&) = delete;

    /// Empty, or why the stimulus cannot be played in that mixer.
    static std::string refusal(const MixerModel& model, const FeltStimulus& stimulus);
    /// Renders a trial's stimulus at the mixer's sample rate, or returns why it cannot be played.
    static Result<FeltStimulus> make(MixerModel& model, const TrialJob& job, const std::string& folder = {});

    /// Plays it; empty, or an error. Not while another plays: stimuli play to their end, as in the rendered
    /// file.
    std::string play(const FeltStimulus& stimulus);
    /// Looks at the receipts. To be called often; isPlaying() changes here alone.
    void update();
    Course course() const noexcept { return course_; }
    bool isPlaying() const noexcept { return course_ == Course::plays; }
    /// Of the strongest actuator, of the last stimulus that is over.
    const FeltLevel& felt() const noexcept { return felt_; }
    double feltSeconds() const;     ///< of the last stimulus, so far
    double startsInSeconds() const; ///< time until the last stimulus is felt; negative afterwards
    /// Fades out sounding modes and mutes pending events until the next stimulus or the mixer's return.
    void stop();

private:
    void useRecordings(const std::vector<ContactRecording>& recordings);
    void post(RenderControl::Kind kind, int channel, float value, const PhantomPanner* panner = nullptr);

    std::vector<double> plannedPeaks(const FeltStimulus& stimulus) const;
    Course judged();

    MixerModel& model_;
    int slowness_;
    double beganAtMs_ = 0.0, ranAtMs_ = 0.0, seconds_ = 0.0, heldSeconds_ = 0.0; // held: felt when it was
                                                                                 // over
    std::vector<float> gains_;                                                   // last posted values
    Course course_ = Course::none;
    bool isMuted_ = false;                  // by stop()
    bool wasSilent_ = false;                // at any time of it
    std::int64_t fromNs_ = 0, untilNs_ = 0; // of the last stimulus, in session time
    std::uint32_t session_ = 0;
    std::vector<EnchanterDescription> actuators_; // of its layout
    FeltLevel felt_;
    std::vector<double> planned_; // peak of each actuator at its output; empty: not known
};

/// Sends study events as markers of the Lab Streaming Layer, to synchronise recordings of EEG, force or gaze.
/// liblsl is optional and looked up when a study starts; without it no markers are sent.
/// One stream: name "physvib-PROTOCOL", type "Markers", one text channel with irregular rate. Message thread
/// only.
class StudyMarkers {
public:
    explicit StudyMarkers(const std::string& protocol);
    ~StudyMarkers();
    StudyMarkers(const StudyMarkers&) = delete;
    StudyMarkers& operator=(const StudyMarkers&) = delete;

    bool isOpen() const noexcept; ///< liblsl was found and the stream was created

    /// Sends a line at a time relative to now (negative: in the past), on LSL's clock.
    void push(const std::string& words, double secondsFromNow = 0.0);

private:
    struct Outlet;
    std::unique_ptr<Outlet> outlet_; // null without liblsl
};

/// A world that a participant sees, feels and can act in: a session of its own on the mixer's output, saved
/// as a file that renders exactly what was felt. One at a time, and the mixer state must not be edited
/// meanwhile. Strips give polarity, delay and ceiling; the study sets levels. Message thread.
class StudyWorld {
public:
    explicit StudyWorld(MixerModel& model)
        : model_{model} {}
    ~StudyWorld() { finish(); }
    StudyWorld(const StudyWorld&) = delete;
    StudyWorld& operator=(const StudyWorld&) = delete;

    /// Empty, or why the world cannot be played in that mixer.
    static std::string refusal(const MixerModel& model, const FeltWorld& world);

    /// Starts the world. With `hasHands`, scripted user input is disabled and the world runs until end();
    /// otherwise it ends after the call's seconds. The session is saved to `file` (.json). Empty, or an
    /// error.
    std::string begin(FeltWorld world, bool hasHands, const std::filesystem::path& file);

    /// Of the current or last world; a world has no planned level, so it is never `unlike`.
    Course course() const noexcept { return course_; }
    bool isPlaying() const noexcept { return session_ != nullptr; } ///< it runs or fades out
    bool isMoving() const noexcept { return isPlaying() && stoppedNs_ < 0; }
    /// Duration of the current or last world, without silences.
    double feltSeconds() const noexcept { return 1e-9 * static_cast<double>(feltNs_); }
    FeltLevel felt() const; ///< of the strongest actuator, by receipts: over the set length, or what was felt

    /// Stops the world; sounding modes fade out.
    void end();
    /// Applies user input if the world runs. Empty, or an error.
    std::string act(const Action& action);

    /// Advances time and returns the changes to draw. To be called about 30 times a second.
    WorldMoment look();

    const Scene& scene() const noexcept { return setup_.scene; }
    const std::string& fault() const noexcept { return fault_; } ///< why the last one was not saved

private:
    void sendStrips();
    void askReceipts(std::int64_t untilNs);
    void finish();

    MixerModel& model_;
    SessionSetup setup_;
    std::unique_ptr<Session> session_;
    std::unique_ptr<SessionJournal> journal_;
    std::unique_ptr<ThreadDriver> driver_;
    std::string fault_;
    double seconds_ = 0.0; // of a world without user input
    Course course_ = Course::none;
    std::uint32_t number_ = 0; // of the session, for receipts
    struct Left {
        double fullScaleG = 0.0, peak = 0.0, squareSeconds = 0.0;
    };
    std::vector<Left> left_;                                // by actuator of its layout, up to checkedNs_
    std::int64_t checkedNs_ = 0;                            // receipts were asked for up to there
    std::int64_t feltNs_ = 0, seenNs_ = 0, stoppedNs_ = -1; // stoppedNs_: session time of the stop
};

/// View of a trial's world with user input. It shows neither actuators nor impact flashes, which would reveal
/// the stimulus.
/// Message thread.
class StudyWorldPane final : public juce::Component {
public:
    explicit StudyWorldPane(MixerModel& model);

    std::function<void(const std::string& fault)> onFault; ///< reports invalid user input

    /// See StudyWorld::begin.
    std::string begin(FeltWorld world, bool hasHands, const std::filesystem::path& file);
    /// Pictures of materials, and the display scale of the next worlds: see WorldView.
    void show(std::vector<MaterialPicture> pictures) { view_.showPictures(std::move(pictures)); }
    void setWorldScale(double metresPerMetre) {
        worldScale_ = metresPerMetre, view_.setWorldScale(metresPerMetre);
    }
    /// Shows a scene at its start, before it is played.
    void preview(const Scene& scene);
    StudyWorld& world() noexcept { return world_; }
    const StudyWorld& world() const noexcept { return world_; }
    WorldView& view() noexcept { return view_; }
    bool isPlaying() const noexcept { return world_.isPlaying(); }
    void refresh();
    /// Arrow keys tilt an interactive world while it runs.
    bool handleKey(const juce::KeyPress& key) {
        return hasHands_ && world_.isMoving() && tilt_.handleKey(key);
    }

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void act(const Action& action);
    MixerModel& model_;
    StudyWorld world_;
    WorldView view_;
    TiltKnob tilt_;
    bool hasHands_ = false;
    double worldScale_ = 0.0;
};

} // namespace physvib
