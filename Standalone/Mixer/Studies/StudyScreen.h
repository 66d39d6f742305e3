// SPDX-License-Identifier: GPL-3.0-or-later
// Screen of a study for the participant: breaks, stimuli, answers, end. It is only the user interface;
// StudyInProgress selects trials and stores answers. For a study it borrows the mixer's session: its world is
// paused, its channels are the stimulus' actuators, and only the trial's stimuli play. Master level,
// ceilings, outputs and the silence button stay unchanged.
#pragma once
#include "Host/Views/WorldView.h"
#include "Lab/Study/StudyRun.h"
#include "Live/Rig/Rig.h"
#include "Live/Session/SessionJournal.h"
#include "Mixer/Studies/StudyParts.h"
#include "Studies/StudyCalls.h"
#include <filesystem>

namespace physvib {

/// Empty, or that the mixer has fewer actuators than a layout wants. Any thread.
std::string tooFew(const std::string& layout, int wanted, int there);

/// Status of the last playback, by the receipts of the output.
enum class Course {
    none,   ///< nothing was played yet, or it was stopped
    plays,  ///< it is playing
    left,   ///< every actuator got all of it, in one piece and within 1 dB of the plan
    lost,   ///< it was cut off, silenced, or missed an actuator
    unlike, ///< it was played whole, at another level than planned
};

/// Plays stimuli in the mixer's session, which must not be edited during its lifetime. Message thread.
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
    /// Reads the receipts; only this changes isPlaying(). Call it at every refresh.
    void update();
    Course course() const noexcept { return course_; }
    bool isPlaying() const noexcept { return course_ == Course::plays; }
    /// Level of the strongest actuator in the last stimulus that is over.
    const FeltLevel& felt() const noexcept { return felt_; }
    double feltSeconds() const; ///< duration of the last stimulus so far
    /// Time until the last stimulus is felt; negative afterwards.
    double startsInSeconds() const { return 1e-3 * (beganAtMs_ - nowMs()); }
    /// Fades out sounding modes and mutes pending events until the next stimulus or the mixer's return.
    void stop();

private:
    void useRecordings(const std::vector<ContactRecording>& recordings);
    void post(RenderControl::Kind kind, int channel, float value, const PhantomPanner* panner = nullptr);

    std::vector<double> plannedPeaks(const FeltStimulus& stimulus) const;
    Course judged();

    MixerModel& model_;
    int slowness_;
    double beganAtMs_ = 0.0, ranAtMs_ = 0.0, seconds_ = 0.0, heldSeconds_ = 0.0; // held: when it was over
    std::vector<float> gains_;                                                   // last posted values
    Course course_ = Course::none;
    bool isMuted_ = false;                  // by stop()
    bool wasSilent_ = false;                // at any time of the stimulus
    std::int64_t fromNs_ = 0, untilNs_ = 0; // of the last stimulus, in session time
    std::uint32_t session_ = 0;
    std::vector<EnchanterDescription> actuators_; // of its layout
    FeltLevel felt_;
    std::vector<double> planned_; // peak of each actuator at its output; empty: not known
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
    FeltLevel felt() const; ///< of the strongest actuator by receipts, over the set or else the felt time

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

    void paint(juce::Graphics& g) override { drawPanel(g, *this); }
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

/// The participant's screen. Keys: Space plays, Esc silences; the answer component has more.
class StudyScreen final : public FullScreen {
public:
    /// With `answersElsewhere`, answers are given in a separate window, on another display if there is one.
    StudyScreen(MixerModel& model, std::unique_ptr<StudyInProgress> study, Words words = {},
                bool answersElsewhere = false, std::vector<MaterialPicture> pictures = {});

    const StudyInProgress& study() const noexcept { return *study_; }
    const StudyWords& words() const noexcept { return say_; }
    enum class Page { pause, trial, comment, done, exposed, fault, paused };
    Page page() const noexcept { return page_; }
    int plays() const noexcept { return progress_ ? progress_->plays() : 0; } ///< of the current trial
    bool isFeeling() const { return sound_.isPlaying() || pane_.isPlaying(); }
    StudyWorldPane& world() noexcept { return pane_; }
    StudyAnswerPane& answers() noexcept { return answers_; }

    /// The window is to be closed: a running study pauses and says so; then, and at its end, it closes.
    void closeRequested();

    /// Updates breaks, playback and the answer. To be called about 30 times a second.
    void refresh() override;

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void showNext(); ///< the next trial, break or closing page
    void showPage(Page page);
    void showTrial();
    void showParts();                     ///< makes the buttons of the trial's parts
    void fail(const std::string& reason); ///< stops playback and shows the error page
    void note(std::string_view event) { model_.reportFault(study_->note(event)); } ///< to the file of times
    void goOn();  ///< leaves the current page, as its button and Enter do
    void leave(); ///< closes the screen, unless a stimulus plays
    void play(std::size_t part);
    std::string begin(std::size_t part); ///< starts the playback; empty, or an error
    void playSequence();
    void pause(); ///< ends an interactive world, so that it can be answered
    void asked(); ///< a response was chosen
    void confirm();
    void submit(Answer answer); ///< stores it and shows what follows
    void submitComment();
    void settle(Course course); ///< counts the play that is over, or has it repeated
    void markFelt();            ///< sends the marker of a started part once its time is known
    std::string markerWords(const char* what) const;
    double exposure() const;
    bool isExposed() const { return exposure() >= study_->protocol().exposureLimit; }
    bool isExploring() const { return experiment().session().answer() == AnswerKind::wish; }
    bool canAnswer() const { return progress_->canAnswer() && !isFeeling(); }
    bool isTimeOver();
    const WorldSet* worldSet() const {
        return page_ == Page::trial && !experiment().session().isOnce
                   ? std::get_if<WorldSet>(&experiment().condition().stimuli)
                   : nullptr;
    }
    bool hasHands() const { return worldSet() != nullptr && worldSet()->hasHands; }
    bool isAnswerSeen() const;
    Course course() const { return worldSet() != nullptr ? pane_.world().course() : sound_.course(); }
    /// The device is stopped: what is posted now would be played all at once when it runs again.
    bool isWaiting() const { return !model_.output().isPlaying(); }
    /// Duration felt of the current or last part.
    double feltSeconds() const {
        return worldSet() != nullptr ? pane_.world().feltSeconds() : sound_.feltSeconds();
    }
    double restLeft() const { return std::max(0.0, 1e-3 * (restEndsMs_ - nowMs())); }
    std::size_t nextPart() const;
    void updateTrial();
    void updateParts();
    void placeTrial(juce::Rectangle<int> area);
    void drawMaterials(juce::Graphics& g) const;
    /// Materials of the session's worlds, by the names of stimuli and objects.
    std::vector<MaterialLegend> materialsSeen() const;
    juce::String headline() const, body() const, wrong() const, progressWords() const, feedback() const;
    const Experiment& experiment() const noexcept { return study_->experiment(); }

    std::unique_ptr<StudyInProgress> study_;
    const StudyWords say_;
    const std::vector<MaterialPicture> pictures_;
    StudySound sound_;
    StudyWorldPane pane_;
    const double squaresBefore_; // of the participant's day in g^2 s, before what is measured from now on
    StudyAnswerPane answers_;
    StudyMarkers markers_;
    const juce::String troubleBefore_;           // which the experimenter knows
    bool isToBeMarked_ = false;                  ///< a part was started, and its marker is not sent yet
    std::unique_ptr<juce::Component> elsewhere_; // the separate window for answers
    Page page_ = Page::pause;
    std::string fault_;

    // current trial:
    LayoutDescription layout_;
    std::optional<TrialProgress> progress_;
    std::optional<Answer> exploring_; // its stimulus plays, then it is recorded
    std::vector<std::unique_ptr<BigButton>> parts_;
    std::optional<std::size_t> wanted_; // a world that starts when the previous one has faded out
    std::vector<std::string> sessions_; // sessions felt in this trial
    std::vector<FeltLevel> felt_;       // by part
    std::size_t part_ = 0;
    double endedMs_ = 0.0;              // when that part ended
    std::optional<bool> wasRight_;      // the previous answer, if the session gives feedback
    bool ranOut_ = false;               // time of the previous trial
    std::optional<double> openSeconds_; // for which an answer has been accepted
    double updatedMs_ = 0.0;
    std::vector<int> unlike_; // by part: plays at another level than planned
    bool isLost_ = false;     // the last play was incomplete and must be repeated
    double limiterDb_ = 0.0;  // maximum gain reduction observed in this trial
    double counted_ = 0.0, firstFeltMs_ = 0.0, restEndsMs_ = 0.0;

    BigButton next_{"Next", "Next"}, pause_{"Pause", "Pause"};
    juce::TextEditor comment_;
    std::unique_ptr<juce::TextButton> leave_;
    juce::String shown_;
    juce::Rectangle<int> headArea_, questionArea_, bodyArea_, keysArea_;
};

/// Current device, levels and outputs, as trial files record them. Message thread.
Apparatus apparatusOf(MixerModel& model);

/// Empty, or why the study cannot be played in this mixer, checked with the first stimulus of each condition.
/// Message thread.
std::string feltFault(const Protocol& protocol, MixerModel& model);

/// Empty, or why the current outputs cannot play the study's layouts. Renders nothing. Message thread.
std::string outputsFault(const Protocol& protocol, const MixerModel& model);

} // namespace physvib
