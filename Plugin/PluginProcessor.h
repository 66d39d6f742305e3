// SPDX-License-Identifier: GPL-3.0-or-later
// PluginProcessor: PhysVib as an instrument of a host, with runs of a session, parameters, MIDI strikes and
// the host's transport; EditHistory: undo, redo and the comparison of two states, A and B.
// Threads: processBlock() is on the host's audio thread, R; all else on the message thread, M, or any thread
// but R. Blocks that the host calls non-realtime are rendered offline, so that a bounce equals the live run.
#pragma once
#include "BusPlan.h"
#include "Core/Actuators/OutputGuard.h"
#include "HostInputs.h"
#include "HostParameter.h"
#include "Live/Devices/DeviceMeters.h"
#include "Live/Documents/PluginState.h"
#include "MidiMap.h"
#include "MusicInput.h"
#include "Parameters.h"
#include "PlayedExport.h"
#include "PluginRuns.h"
#include "PluginSettings.h"
#include <bitset>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

namespace physvib {

/// The parameters that an edit changed. Undoing it leaves the others as they are, because automation, a
/// controller or the host may have moved them since.
using TouchedParameters = std::bitset<parameterCount>;

/// Steps to undo and redo, separate for A and B. A step is a whole state, so only the newest `maxSteps` are
/// stored. One thread at a time.
class EditHistory {
public:
    static constexpr std::size_t maxSteps = 30;
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds mergeWindow{500}; ///< edits that follow sooner are one step

    struct Step {
        PluginState state;
        TouchedParameters touched{};
    };
    enum class Edit {
        merged,  ///< may join the step before, as the edits of a drag do
        separate ///< is always a step of its own
    };
    enum class Direction { undo, redo, exchange };

    /// Records the state before an edit.
    void add(PluginState before, TouchedParameters touched, Edit edit = Edit::merged,
             Clock::time_point now = Clock::now()) {
        side_.redo.clear();
        touchedInAnyStep_ |= touched;
        const bool isSameStep = edit == Edit::merged && !side_.undo.empty() && now - lastEdit_ < mergeWindow;
        lastEdit_ = edit == Edit::merged ? now : Clock::time_point{};
        if (isSameStep) {
            side_.undo.back().touched |= touched;
            return;
        }
        side_.undo.push_back({std::move(before), touched});
        if (side_.undo.size() > maxSteps) side_.undo.erase(side_.undo.begin());
    }

    bool canStep(Direction direction) const noexcept {
        return direction == Direction::exchange ||
               !(direction == Direction::undo ? side_.undo : side_.redo).empty();
    }
    bool isAtB() const noexcept { return isAtB_; }

    /// Returns the state one step back or forth from `now`, if there is one, or the other one of A and B,
    /// which are equal at first. `touched` of the result has the parameters to be set.
    std::optional<Step> step(Direction direction, PluginState now) {
        if (direction == Direction::undo) return move(side_.undo, side_.redo, std::move(now));
        if (direction == Direction::redo) return move(side_.redo, side_.undo, std::move(now));
        isAtB_ = !isAtB_;
        lastEdit_ = {};
        std::swap(side_, otherSide_);
        return Step{std::exchange(otherState_, now).value_or(now), touchedInAnyStep_};
    }

private:
    using Steps = std::vector<Step>;
    std::optional<Step> move(Steps& from, Steps& to, PluginState now) {
        if (from.empty()) return {};
        lastEdit_ = {};
        Step step = std::move(from.back());
        from.pop_back();
        to.push_back({std::move(now), step.touched});
        return step;
    }
    struct Side {
        Steps undo, redo;
    } side_, otherSide_;
    TouchedParameters touchedInAnyStep_{};
    std::optional<PluginState> otherState_;
    bool isAtB_ = false;
    Clock::time_point lastEdit_{};
};

class PluginProcessor final : public juce::AudioProcessor,
                              public juce::VST3ClientExtensions,
                              private juce::Timer,
                              private juce::AudioProcessorParameter::Listener {
public:
    PluginProcessor(juce::String name, const BusPlan& plan);
    ~PluginProcessor() override;

    /// Plays `state` from now on, in a new run. False if it is not valid: errorText() says why, and nothing
    /// changes. Any thread but R.
    bool apply(PluginState state);
    /// apply() as an edit by the user: the host is told, and it can be undone; the run plays on if
    /// canKeepPlaying(). M.
    bool edit(PluginState state);
    /// An edit that sets the parameters as well. M.
    void open(PluginState state);
    /// Opens a preset by its index in presetNames(). M.
    void choosePreset(int preset);
    /// Arranges as many actuators as there are outputs, also when that number changes later. M.
    void arrangeForOutputs();
    /// The present values of the parameters of notes. Any thread.
    NoteKnobs noteKnobs() const noexcept {
        return noteKnobsFrom(
            [this](Parameter which) { return parameters_[static_cast<std::size_t>(which)]->value(); });
    }
    /// Undoes or redoes an edit, or exchanges A and B, with the parameters that the user changed. M.
    using Direction = EditHistory::Direction;
    void stepHistory(Direction direction);
    bool canStep(Direction direction) const;
    bool isAtB() const;
    /// Sets the window's size in pixels, which is saved with the state but is no edit. M.
    void setEditorSize(int width, int height);
    PluginState state() const;      ///< with the present values of the parameters. Any thread but R
    juce::String errorText() const; ///< what the user has to know; empty: no error. Any thread but R
    /// True if a chunk of the host was refused and nothing was edited since: the next save returns it.
    bool hasRefusedChunk() const;
    /// increases with every accepted state. Any thread
    std::uint64_t stateVersion() const noexcept { return stateVersion_; }
    /// The host's sample rate. At an unsupported one nothing plays, and errorText() says so. Any thread.
    int preparedRateHz() const noexcept { return static_cast<int>(sampleRateHz_.load()); }

    /// Sets the frames of a typical block if a host announces far more (LV2); 0: as announced. M, unprepared.
    void setNominalBlockFrames(int frames) noexcept { nominalBlockFrames_ = frames; }

    /// Sets the parameter changes within the next block. `source` must outlive that block. R.
    void setPointSource(PointSource& source) noexcept { pointSource_ = &source; }

    /// Sets the note events within the next block, beside its MIDI. `source` must outlive that block. R.
    void setNoteSource(NoteSource& source) noexcept { noteSource_ = &source; }

    /// Silences at the next block's start all that vibrates. R.
    void silenceNextBlock() noexcept { isSilencePending_ = true; }

    /// Strikes a key of the window's keyboard in the next block, or releases it (velocity 0). M, one writer.
    void playKey(int note, int velocity) noexcept { keys_.push({note, velocity}); }

    /// The emergency stop: mutes the output until it is lifted. It is not saved. Any thread.
    void setStopped(bool isStopped) noexcept { isStopped_.store(isStopped, std::memory_order_relaxed); }
    bool isStopped() const noexcept { return isStopped_.load(std::memory_order_relaxed); }

    /// The number of the last controller received in the low 8 bits, and above them a count of all received,
    /// so that MIDI learn notices each; 0: none yet. Any thread.
    std::uint32_t lastController() const noexcept { return lastController_; }
    static int controllerOf(std::uint32_t last) noexcept { return static_cast<int>(last & 0xff); }

    /// Events played since the last call; they are stored for export as well. M.
    std::vector<RunEvent> drainEvents();
    /// Those that drainEvents() returned, if they were played with the present settings. M.
    const PlayedEvents& playedEvents() {
        playedEvents_.keepOnly(runs_.generation());
        return playedEvents_;
    }

    /// How many actuators the host has outputs for. Where buses are pairs, at most the number of actuators or
    /// four, because some hosts turn on all buses whether or not the user needs them. M.
    int outputCount() const;

    HostParameter& parameter(Parameter which) noexcept {
        return *parameters_[static_cast<std::size_t>(which)];
    }
    PluginRuns& runs() noexcept { return runs_; }
    ChannelMeters meters() noexcept { return meters_.read(); } ///< one reader
    /// MIDI messages whose frame was beyond their block and which acted at its last frame. Any thread.
    std::uint64_t displacedMessages() const noexcept { return displacedMessages_; }

    const juce::String getName() const override { return name_; }
    bool isBusesLayoutSupported(const BusesLayout& layout) const override {
        return isAccepted(plan_, wrapperType, layout);
    }
    void prepareToPlay(double sampleRateHz, int blockFrames) override;
    void releaseResources() override;
    void processBlock(juce::AudioBuffer<float>& buffer, juce::MidiBuffer& midi) override {
        render(buffer, midi, false);
        midi.clear();
    }
    void processBlockBypassed(juce::AudioBuffer<float>& buffer, juce::MidiBuffer& midi) override {
        render(buffer, midi, true);
        midi.clear();
    }
    using juce::AudioProcessor::processBlock;
    using juce::AudioProcessor::processBlockBypassed;
    /// Null for LV2: its wrapper would overwrite it with `lv2:enabled` in every block and notify the host
    /// from the render call. Our LV2 entry forwards changes of that port instead (Lv2Parts.h).
    juce::AudioProcessorParameter* getBypassParameter() const override {
        return wrapperType == wrapperType_LV2 ? nullptr
                                              : parameters_[static_cast<std::size_t>(Parameter::bypass)];
    }
    double getTailLengthSeconds() const override { return tailSeconds_; } ///< as of the last timer call
    bool acceptsMidi() const override { return true; }
    bool producesMidi() const override { return false; }
    bool supportsMPE() const override { return true; }
    bool getPluginHasMainInput() const override { return plan_.hasMusicPorts; } ///< else a side chain

    int getNumPrograms() override;
    int getCurrentProgram() override { return program_; }
    void setCurrentProgram(int index) override;
    const juce::String getProgramName(int index) override;
    void changeProgramName(int, const juce::String&) override {}
    void getStateInformation(juce::MemoryBlock& chunk) override;
    void setStateInformation(const void* data, int size) override;

    bool hasEditor() const override { return true; }
    juce::AudioProcessorEditor* createEditor() override;

private:
    static BusesProperties makeBusProperties(const BusPlan& plan);
    void addParameters();
    void prepareGuard(int rate);
    static constexpr int programChange = 0xc0;                   // of MIDI
    static constexpr int activeTimerMs = 50, idleTimerMs = 2000; ///< while blocks are rendered, or not
    void timerCallback() override;
    void parameterValueChanged(int, float) override {}
    void parameterGestureChanged(int which, bool begins) override;
    bool applyChunk(std::string_view text);
    bool refuse(const juce::String& reason);
    void storeState(PluginState state);
    bool applyEdit(PluginState state);
    bool replaceState(PluginState state, bool followsOutputs);
    void fitLayoutToOutputs();
    void reportToHost();
    void setParameters(const PluginState& state, TouchedParameters which = TouchedParameters{}.set());
    void recordEdit(PluginState before);
    PluginState withPreset(int preset) const;

    // R
    StepTiming timing() const noexcept {
        return value(Parameter::timing) > 0.5 ? StepTiming::tight : StepTiming::safe;
    }
    double value(Parameter which) const noexcept {
        return denormalised(rowOf(which), normalisedValues_[static_cast<std::size_t>(which)]);
    }
    NoteKnobs knobs() const noexcept;
    RenderMode renderMode() const noexcept {
        return isNonRealtime() ? RenderMode::offline : RenderMode::realtime;
    }
    /// In a bounce a program acts at its own frame, where a part of the block begins.
    bool needsPart(int status, int frame) const noexcept {
        return frame > 0 && (status & 0xf0) == programChange && isNonRealtime();
    }
    void render(juce::AudioBuffer<float>& buffer, const juce::MidiBuffer& midi, bool bypassed) noexcept;
    void readParameters() noexcept;
    void applyPoints(int until) noexcept;
    int renderPart(juce::AudioBuffer<float>& buffer, juce::MidiBufferIterator& message,
                   const juce::MidiBuffer& midi, int first) noexcept;
    void followTransport(int frames) noexcept;
    void beginRun() noexcept;
    void resetControls() noexcept;
    template <class Send>
    void sendIfChanged(std::initializer_list<Parameter> watched, Send submit) noexcept;
    template <class Submit>
    bool sendWhenAllowed(ControlPace& pace, int first, int end, Submit submit) noexcept;
    void sendPacedControls(int first, int end) noexcept;
    void sendControls(int frame) noexcept;
    void stopAll(int frame) noexcept;
    void silence(int frame) noexcept;
    void playWindowKeys(int frame) noexcept;
    void readNextNote() noexcept;
    void handleNotes(int until, int first, int frames) noexcept;
    void applyExpression(const NoteEvent& event) noexcept;
    void handleMidi(const juce::MidiMessageMetadata& message, int frame,
                    const NoteExpression& expression = {}) noexcept;
    void chooseProgram(int program, int frame) noexcept;
    void applyPressure(int channel, int note, double pressure) noexcept;
    void strike(int channel, int note, int velocity, int frame, const NoteExpression& expression) noexcept;
    CollisionEvent heldNoteSound(const HeldNotes::Note& note) const noexcept;
    CollisionEvent strikeAtPlace(CollisionEvent strike, int channel,
                                 const NoteExpression& expression) const noexcept;
    void playHeldNotes(int first, int end) noexcept;
    void processSideChain(const juce::AudioBuffer<float>& buffer, int first, int from, int to) noexcept;
    /// True if controllers but pedal and slide come without their channel (decision 93).
    bool isOfAnyChannel() const noexcept { return wrapperType == wrapperType_VST3; }
    void handleController(int channel, int controller, int value, int frame) noexcept;
    void updateMeters(const juce::AudioBuffer<float>& buffer) noexcept;

    const juce::String name_;
    const BusPlan plan_;
    std::array<HostParameter*, parameterCount> parameters_{}; // owned by AudioProcessor

    mutable std::mutex mutex_; // guards what follows, up to the atomics; never held while the host is called
    PluginState state_;
    juce::String errorText_;
    EditHistory history_;
    juce::MemoryBlock refusedChunk_; // the host's data that could not be read
    std::atomic<int> program_{0};
    std::mutex applyMutex_;                  // one change of the state at a time; locked before mutex_
    std::atomic<bool> followsOutputs_{true}; // the layout is a preset's: an actuator for each output
    std::atomic<std::uint64_t> stateVersion_{0};
    std::atomic<double> sampleRateHz_{0.0};
    std::atomic<double> tailSeconds_{0.0};

    struct Key {
        int note = 0, velocity = 0;
    };
    EventQueue<Key, 256> keys_;        // from M to R
    PlayedEvents playedEvents_;        // M
    std::uint64_t lastBlockCount_ = 0; // M
    NoteKnobs tailKnobs_;              // M: the knobs that tailSeconds_ is of
    std::atomic<std::uint64_t> prepareCount_{0};
    std::atomic<std::uint32_t> lastController_{0};
    std::atomic<int> requestedProgram_{-1}; // by MIDI
    LatestValue<ChannelMeters> meters_;
    PluginRuns runs_;
    BusMap outputMap_;
    int nominalBlockFrames_ = 0;

    // R
    BeatInput beats_;
    MusicInput music_;
    Transport transport_;
    HostBeats hostBeats_;
    double partSeconds_ = 0.0; // from the block's start to the part's
    int blockFrames_ = 0;
    GainRamp outputGate_; // closed by bypass and stop()
    OutputGuard guard_;   // limits the sum of runs while one follows another
    int guardRateHz_ = 0;
    double releasedMs_ = std::numeric_limits<double>::infinity(); // time of the last releaseResources()
    bool isMuted_ = false;
    std::atomic<bool> isStopped_{false};
    ChannelMeters channelMeters_;
    PointSource* pointSource_ = nullptr;
    NoteSource *noteSource_ = nullptr, *blockNotes_ = nullptr; // of the next block; of the present one
    NoteEvent nextNote_;                                       // read but not yet handled, if hasNextNote_
    bool hasNextNote_ = false;
    ParameterPoints parameterPoints_;
    std::array<float, parameterCount> normalisedValues_{}; // at the frame that is being rendered
    std::array<double, parameterCount> lastSentValues_{};  // as the playing run has them
    ControlPace levelPace_, pannerPace_, gravityPace_, materialPace_;
    std::atomic<std::uint64_t> displacedMessages_{0};
    bool isStopPending_ = false, isSilencePending_ = false;
    HeldNotes heldNotes_;
    ChannelExpression expression_;
};

/// Passes values between a format's entry and the instance that its wrapper creates on the same thread.
struct InstanceCreation {
    int nominalBlockFrames = 0;          ///< from the entry to the instance; 0: unknown
    PluginProcessor* instance = nullptr; ///< the newest instance, from the wrapper to the entry
};
InstanceCreation& instanceCreation() noexcept; ///< of this thread

} // namespace physvib
