// SPDX-License-Identifier: GPL-3.0-or-later
// StudyScreen, the participant's screen, and what it plays: StimulusPlayer, StudyWorld with its pane, and
// StudyMarkers. StudyInProgress selects the trials and stores the answers. A study borrows the mixer's
// session: its world is paused, its channels are the stimulus' actuators, and only the trial's stimuli play.
// Master level, ceilings, outputs and the silence button stay unchanged.
#pragma once
#include "Host/Views/WorldView.h"
#include "Lab/Study/StudyRun.h"
#include "Live/Rig/Rig.h"
#include "Live/Session/SessionJournal.h"
#include "Mixer/Studies/StudyParts.h"
#include "Studies/StudyCalls.h"
#include <filesystem>

namespace physvib {

/// An error line if the mixer has fewer actuators than the layout needs; else empty. Any thread.
std::string actuatorCountError(const std::string& layout, int needed, int available);

/// Status of the last playback, by the level history that the output keeps (its receipts).
enum class PlaybackStatus {
    none,       ///< nothing was played yet, or it was stopped
    playing,    ///< it is playing
    complete,   ///< every actuator played all of it without a gap, within 1 dB of the plan
    incomplete, ///< it was cut off, silenced, or missed an actuator
    wrongLevel, ///< it was played whole, at another level than planned
};

/// Plays stimuli in the mixer's session, which must not be edited during its lifetime. Message thread.
class StimulusPlayer {
public:
    explicit StimulusPlayer(MixerModel& model);
    ~StimulusPlayer(); ///< restores mixer state and world speed
    StimulusPlayer(const StimulusPlayer&) = delete;
    StimulusPlayer& operator=(const StimulusPlayer&) = delete;

    /// Empty, or why the stimulus cannot be played in that mixer.
    static std::string playbackError(const MixerModel& model, const PlayableStimulus& stimulus);
    /// Renders a trial's stimulus at the mixer's sample rate, or returns why it cannot be played.
    static Result<PlayableStimulus> prepare(MixerModel& model, const TrialJob& job,
                                            const std::string& folder = {});

    /// Plays it; empty, or an error. Not to be called while another plays: stimuli play to their end, as in
    /// the rendered file.
    std::string play(const PlayableStimulus& stimulus);
    /// Reads the receipts; only this changes isPlaying(). Call it at every refresh.
    void update();
    PlaybackStatus status() const noexcept { return status_; }
    bool isPlaying() const noexcept { return status_ == PlaybackStatus::playing; }
    /// Level of the strongest actuator in the last stimulus that is over.
    const PlayedLevel& level() const noexcept { return level_; }
    double playedSeconds() const; ///< duration of the last stimulus so far
    /// Time until the last stimulus is felt; negative afterwards.
    double secondsToStart() const { return 1e-3 * (outputStartMs_ - nowMs()); }
    /// Fades out sounding modes and mutes pending events until the next stimulus or the mixer's return.
    void stop();

private:
    void useRecordings(const std::vector<ContactRecording>& recordings);
    void send(RenderControl::Kind kind, int channel, float value, const PhantomPanner* panner = nullptr);

    std::vector<double> plannedPeaks(const PlayableStimulus& stimulus) const;
    PlaybackStatus statusFromReceipts();

    MixerModel& model_;
    int slowness_;
    double outputStartMs_ = 0.0, lastPlayingMs_ = 0.0, seconds_ = 0.0, playedSeconds_ = 0.0;
    std::vector<float> gains_; // last sent values
    PlaybackStatus status_ = PlaybackStatus::none;
    bool isMuted_ = false;                 // stop() has muted all actuators
    bool wasSilent_ = false;               // the mixer was silenced during the stimulus
    std::int64_t startNs_ = 0, endNs_ = 0; // of the last stimulus, in session time
    std::uint32_t sessionNumber_ = 0;
    std::vector<ActuatorDescription> actuators_; // of the last stimulus' layout
    PlayedLevel level_;
    std::vector<double> plannedPeaks_; // peak of each actuator at its output; empty: not known
};

/// Sends study events as markers of the Lab Streaming Layer, to synchronise recordings of EEG, force or gaze.
/// liblsl is optional and looked up when a study starts; without it no markers are sent.
/// One stream: name "physvib-PROTOCOL", type "Markers", a text channel of irregular rate. Message thread.
class StudyMarkers {
public:
    explicit StudyMarkers(const std::string& protocol);
    ~StudyMarkers();
    StudyMarkers(const StudyMarkers&) = delete;
    StudyMarkers& operator=(const StudyMarkers&) = delete;

    /// liblsl was found and the stream was created.
    bool isOpen() const noexcept { return outlet_ != nullptr; }

    /// Sends a line at a time relative to now (negative: in the past), on LSL's clock.
    void push(const std::string& marker, double secondsFromNow = 0.0);

private:
    struct Outlet;
    std::unique_ptr<Outlet> outlet_; // null without liblsl
};

/// A world that a participant sees, feels and can act in: a session of its own on the mixer's output, saved
/// as a file that renders exactly what was felt. One at a time, and the mixer state must not be edited
/// meanwhile. The mixer's strips give polarity, delay and ceiling; the study sets levels. Message thread.
class StudyWorld {
public:
    explicit StudyWorld(MixerModel& model)
        : model_{model} {}
    ~StudyWorld() { finish(); }
    StudyWorld(const StudyWorld&) = delete;
    StudyWorld& operator=(const StudyWorld&) = delete;

    /// Empty, or why the world cannot be played in that mixer.
    static std::string playbackError(const MixerModel& model, const PlayableWorld& world);

    /// Starts the world. With `isInteractive`, scripted user input is disabled and the world runs until
    /// stop(); otherwise it ends after the call's seconds. The session is saved to `file` (.json). Empty, or
    /// an error.
    std::string begin(PlayableWorld world, bool isInteractive, const std::filesystem::path& file);

    /// Of the current or last world; a world has no planned level, so it is never wrongLevel.
    PlaybackStatus status() const noexcept { return status_; }
    bool isPlaying() const noexcept { return session_ != nullptr; } ///< it runs or fades out
    bool isMoving() const noexcept { return isPlaying() && stoppedNs_ < 0; }
    /// Duration of the current or last world, without silences.
    double playedSeconds() const noexcept { return 1e-9 * static_cast<double>(playedNs_); }
    PlayedLevel level() const; ///< of the strongest actuator, over the nominal or else the played time

    /// Stops the world; sounding modes fade out.
    void stop();
    /// Applies user input if the world runs. Empty, or an error.
    std::string applyInput(const Action& action);

    /// Advances time and returns the changes to draw. To be called about 30 times a second.
    WorldFrame update();

    const Scene& scene() const noexcept { return setup_.scene; }
    const std::string& saveError() const noexcept { return saveError_; } ///< why the last one was not saved

private:
    void sendStrips();
    void readReceipts(std::int64_t untilNs);
    void finish();

    MixerModel& model_;
    SessionSetup setup_;
    std::unique_ptr<Session> session_;
    std::unique_ptr<SessionJournal> journal_;
    std::unique_ptr<ThreadDriver> driver_;
    std::string saveError_;
    double seconds_ = 0.0; // nominal duration; 0: with user input
    PlaybackStatus status_ = PlaybackStatus::none;
    std::uint32_t sessionNumber_ = 0; // of the session, for receipts
    struct OutputSums {
        double fullScaleG = 0.0, peak = 0.0, squareSeconds = 0.0;
    };
    std::vector<OutputSums> outputSums_; // by actuator of its layout, up to checkedNs_
    std::int64_t checkedNs_ = 0;         // session time up to which receipts were read
    std::int64_t playedNs_ = 0, lastUpdateNs_ = 0, stoppedNs_ = -1; // stoppedNs_: session time of the stop
};

/// View of a trial's world with user input. It shows neither actuators nor impact flashes, which would reveal
/// the stimulus. Message thread.
class StudyWorldPane final : public juce::Component {
public:
    explicit StudyWorldPane(MixerModel& model);

    std::function<void(const std::string& error)> onError; ///< reports invalid user input

    /// See StudyWorld::begin.
    std::string begin(PlayableWorld world, bool isInteractive, const std::filesystem::path& file);
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
        return isInteractive_ && world_.isMoving() && tilt_.handleKey(key);
    }

    void paint(juce::Graphics& g) override { drawPanel(g, *this); }
    void resized() override;

private:
    void applyInput(const Action& action);
    MixerModel& model_;
    StudyWorld world_;
    WorldView view_;
    TiltKnob tilt_;
    bool isInteractive_ = false;
    double worldScale_ = 0.0;
};

/// The participant's screen. Keys: Space plays, Esc silences; the answer component has more.
class StudyScreen final : public FullScreen {
public:
    /// With `hasAnswerWindow`, answers are given in a separate window, on another display if there is one.
    StudyScreen(MixerModel& model, std::unique_ptr<StudyInProgress> study, Translation translation = {},
                bool hasAnswerWindow = false, std::vector<MaterialPicture> pictures = {});

    const StudyInProgress& study() const noexcept { return *study_; }
    const StudyTexts& texts() const noexcept { return translate_; }
    enum class Page { ready, trial, comment, done, exposureLimit, error, paused };
    Page page() const noexcept { return page_; }
    int plays() const noexcept { return progress_ ? progress_->plays() : 0; } ///< of the current trial
    bool isStimulusPlaying() const { return player_.isPlaying() || worldPane_.isPlaying(); }
    StudyWorldPane& world() noexcept { return worldPane_; }
    StudyAnswerPane& answers() noexcept { return answers_; }

    /// Called when the window shall close: pauses a running study; closes a paused or finished one.
    void requestClose();

    /// Updates breaks, playback and the answer. To be called about 30 times a second.
    void refresh() override;

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void showNext(); ///< the next trial, break or closing page
    void showPage(Page page);
    void showTrial();
    void showParts();                          ///< makes the buttons of the trial's parts
    void showError(const std::string& reason); ///< stops playback and shows the error page
    void logEvent(std::string_view event) {
        model_.reportIfError(study_->logEvent(event));
    }                     ///< writes it to the study's log with the time
    void continueStudy(); ///< leaves the current page, as its button and Enter do
    void leave();         ///< closes the screen, unless a stimulus plays
    void play(std::size_t part);
    std::string startPart(std::size_t part); ///< starts the playback; empty, or an error
    void playSequence();
    void pause();          ///< ends an interactive world, so that it can be answered
    void handleResponse(); ///< a response was chosen
    void confirm();
    void submit(Answer answer); ///< stores it and shows what follows
    void submitComment();
    void countPlay(PlaybackStatus status); ///< counts the finished play, or requests its repetition
    void sendStartMarker();                ///< sends the marker of a started part once its time is known
    std::string markerText(const char* event) const;
    double exposure() const; ///< A(8) of the participant today, m/s^2
    bool isExposureLimitReached() const { return exposure() >= study_->protocol().exposureLimit; }
    bool isExploring() const { return experiment().session().answerKind() == AnswerKind::request; }
    bool canAnswer() const { return progress_->canAnswer() && !isStimulusPlaying(); }
    bool updateTimeLimit();
    const WorldSet* worldSet() const {
        return page_ == Page::trial && !experiment().session().isQuestionnaire
                   ? std::get_if<WorldSet>(&experiment().condition().stimuli)
                   : nullptr;
    }
    bool isInteractive() const { return worldSet() != nullptr && worldSet()->isInteractive; }
    bool isAnswerShown() const;
    PlaybackStatus status() const {
        return worldSet() != nullptr ? worldPane_.world().status() : player_.status();
    }
    /// The device is stopped: what is sent now would be played all at once when it runs again.
    bool isDeviceStopped() const { return !model_.output().isPlaying(); }
    /// Time for which the current or last part has been felt.
    double playedSeconds() const {
        return worldSet() != nullptr ? worldPane_.world().playedSeconds() : player_.playedSeconds();
    }
    double remainingBreakSeconds() const { return std::max(0.0, 1e-3 * (breakEndMs_ - nowMs())); }
    std::size_t nextPart() const;
    void updateTrial();
    void updateParts();
    void placeTrial(juce::Rectangle<int> area);
    void drawMaterials(juce::Graphics& g) const;
    /// Materials of the session's worlds, by the names of stimuli and objects.
    std::vector<MaterialLegend> visibleMaterials() const;
    juce::String titleText() const, bodyText() const, problemText() const, progressText() const,
        feedbackText() const;
    const Experiment& experiment() const noexcept { return study_->experiment(); }

    std::unique_ptr<StudyInProgress> study_;
    const StudyTexts translate_;
    const std::vector<MaterialPicture> pictures_;
    StimulusPlayer player_;
    StudyWorldPane worldPane_;
    const double squareGSecondsBefore_; // today's dose before this session
    StudyAnswerPane answers_;
    StudyMarkers markers_;
    const juce::String initialMessage_;             // shown before the study
    bool isStartMarkerPending_ = false;             ///< a part was started, and its marker is not sent yet
    std::unique_ptr<juce::Component> answerWindow_; // the separate window for answers
    Page page_ = Page::ready;
    std::string error_;

    // current trial:
    LayoutDescription layout_;
    std::optional<TrialProgress> progress_;
    std::optional<Answer> exploredAnswer_; // chosen while exploring; recorded when its stimulus has played
    std::vector<std::unique_ptr<BigButton>> partButtons_;
    std::optional<std::size_t> queuedPart_;  // a world that starts when the previous one has faded out
    std::vector<std::string> savedSessions_; // files of the worlds played in this trial
    std::vector<PlayedLevel> playedLevels_;  // by part
    std::size_t part_ = 0;                   // the part that plays or was played last
    double partEndMs_ = 0.0;                 // when that part ended
    std::optional<bool> wasRight_;           // whether the previous answer was right; empty: no feedback
    bool hasTimedOut_ = false;               // the previous trial ended by its time limit
    std::optional<double> acceptedSeconds_;  // time for which answers were accepted; empty: not yet
    double lastUpdateMs_ = 0.0;
    std::vector<int> wrongLevelPlays_; // by part: plays at another level than planned
    bool isPlayIncomplete_ = false;    // the last play was incomplete and must be repeated
    double maxReductionDb_ = 0.0;      // maximum gain reduction observed in this trial
    double countedSeconds_ = 0.0, firstPlayMs_ = 0.0, breakEndMs_ = 0.0; // first: added to progress_

    BigButton next_{"Next", "Next"}, pause_{"Pause", "Pause"};
    juce::TextEditor comment_;
    std::unique_ptr<juce::TextButton> leave_;
    juce::String displayedText_;
    juce::Rectangle<int> progressArea_, questionArea_, bodyArea_;
};

/// Current device, levels and outputs, as trial files record them. Message thread.
Apparatus currentApparatus(MixerModel& model);

/// Empty, or why the study cannot be played in this mixer, checked with the first stimulus of each condition.
/// Message thread.
std::string findPlaybackError(const Protocol& protocol, MixerModel& model);

/// Empty, or why the current outputs cannot play the study's layouts. Renders nothing. Message thread.
std::string outputsError(const Protocol& protocol, const MixerModel& model);

} // namespace physvib
