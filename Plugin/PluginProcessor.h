// SPDX-License-Identifier: GPL-3.0-or-later
// PhysVib as an instrument of a host: takes of a session, parameters, MIDI strikes, the host's transport.
//
// Threads as in Live/Session/Session.h: processBlock is R, all else M or any thread but R. What the host
// calls non-realtime is rendered with RenderMode::offline, so that a bounce is the live take at any speed.
#pragma once
#include "BusPlan.h"
#include "Core/Actuators/OutputGuard.h"
#include "FeltExport.h"
#include "HostInputs.h"
#include "HostParameter.h"
#include "Live/Devices/DeviceMeters.h"
#include "Live/Documents/PluginState.h"
#include "MidiMap.h"
#include "MusicInput.h"
#include "Parameters.h"
#include "PluginSettings.h"
#include "Takes.h"
#include <bitset>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

namespace physvib {

/// The parameters that an edit changed. Others keep the value that they have when it is undone: automation, a
/// controller or the host may have moved them since.
using TouchedParameters = std::bitset<parameterCount>;

/// One thread at a time. A and B have their own steps: whole scenes, so only the newest are kept.
class EditHistory {
public:
    static constexpr std::size_t most = 30;
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds oneStep{500}; ///< edits that follow sooner are one: a drag

    struct Step {
        PluginState state;
        TouchedParameters touched{};
    };
    enum class Edit {
        part, ///< of what may come many times in a row
        whole ///< a step of its own
    };
    enum class Way { undo, redo, exchange };

    /// Records the state before an edit.
    void add(PluginState before, TouchedParameters touched, Edit edit = Edit::part,
             Clock::time_point now = Clock::now()) {
        here_.redo.clear();
        touched_ |= touched;
        const bool isSameStep = edit == Edit::part && !here_.undo.empty() && now - last_ < oneStep;
        last_ = edit == Edit::part ? now : Clock::time_point{};
        if (isSameStep) {
            here_.undo.back().touched |= touched;
            return;
        }
        here_.undo.push_back({std::move(before), touched});
        if (here_.undo.size() > most) here_.undo.erase(here_.undo.begin());
    }

    bool can(Way way) const noexcept {
        return way == Way::exchange || !(way == Way::undo ? here_.undo : here_.redo).empty();
    }
    bool isAtB() const noexcept { return isAtB_; }

    /// The state one step back or forth from `now` (none: there is none), or the other one of A and B. At
    /// first both are the same; they differ in the parameters that any step was about.
    std::optional<Step> go(Way way, PluginState now) {
        if (way == Way::undo) return move(here_.undo, here_.redo, std::move(now));
        if (way == Way::redo) return move(here_.redo, here_.undo, std::move(now));
        isAtB_ = !isAtB_;
        last_ = {};
        std::swap(here_, there_);
        return Step{std::exchange(other_, now).value_or(now), touched_};
    }

private:
    using Steps = std::vector<Step>;
    std::optional<Step> move(Steps& from, Steps& to, PluginState now) {
        if (from.empty()) return {};
        last_ = {};
        Step step = std::move(from.back());
        from.pop_back();
        to.push_back({std::move(now), step.touched});
        return step;
    }
    struct Side {
        Steps undo, redo;
    } here_, there_;
    TouchedParameters touched_{};
    std::optional<PluginState> other_;
    bool isAtB_ = false;
    Clock::time_point last_{};
};

class PluginProcessor final : public juce::AudioProcessor,
                              public juce::VST3ClientExtensions,
                              private juce::Timer,
                              private juce::AudioProcessorParameter::Listener {
public:
    PluginProcessor(juce::String name, const BusPlan& plan);
    ~PluginProcessor() override;

    /// What plays from now on. False: it cannot, as `trouble()` says, and nothing changes. Any thread but R.
    bool apply(PluginState state);
    /// The same for an edit by hand: the host marks its session changed; what plays goes on if isSameTake. M.
    bool edit(PluginState state);
    /// An edit that sets the parameters as well. M.
    void open(PluginState state);
    /// A preset, chosen in the window. M.
    void choose(int preset);
    /// As many actuators as there are outputs, from now on. M.
    void useOutputs();
    /// What the parameters make of notes now. Any thread.
    NoteKnobs noteKnobs() const noexcept {
        return knobsBy(
            [this](Parameter which) { return parameters_[static_cast<std::size_t>(which)]->value(); });
    }
    /// Undo, redo, or the other state of A and B, with the parameters that the user changed. M.
    using Step = EditHistory::Way;
    void go(Step step);
    bool can(Step step) const;
    bool isAtB() const;
    /// Saved with the state, though no edit. M.
    void keepEditorSize(int width, int height);
    PluginState state() const;    ///< with the parameters as they are
    juce::String trouble() const; ///< empty while all is well
    /// the next save gives back the chunk that was refused, since nothing has been edited
    bool keepsRefused() const;
    /// grows with every state that was taken
    std::uint64_t stateCount() const noexcept { return stateCount_; }
    /// The host's; at one that no renderer takes all is silent, and trouble() says so.
    int preparedRateHz() const noexcept { return static_cast<int>(sampleRateHz_.load()); }

    /// Frames of a usual block if a host announces far more (LV2); 0: as announced. M, before prepareToPlay.
    void expectBlocksOf(int frames) noexcept { usualBlockFrames_ = frames; }

    /// What the host says of parameters in the coming block, which it outlives; without points they stay. R.
    void expectPoints(PointSource& source) noexcept { source_ = &source; }

    /// What the host says of notes within it, beside its messages of MIDI; it outlives that block. R.
    void expectNotes(NoteSource& source) noexcept { noteSource_ = &source; }

    /// What sounds ends with the next block. R.
    void silenceNext() noexcept { owesSilence_ = true; }

    /// A key of the window: with a velocity it is struck in the next block, 0 lets it go. M, one writer.
    void play(int note, int velocity) noexcept { keys_.push({note, velocity}); }

    /// Silence until it is lifted, by Esc in the window: no parameter, no session keeps it. Any thread.
    void stop(bool isStopped) noexcept { isStopped_.store(isStopped, std::memory_order_relaxed); }
    bool isStopped() const noexcept { return isStopped_.load(std::memory_order_relaxed); }

    /// The last controller that came in, with a count in the higher bits that grows with each, so that a
    /// person can show which one is meant; 0: none yet. Any thread.
    std::uint32_t lastController() const noexcept { return lastController_; }
    static int controllerOf(std::uint32_t last) noexcept { return static_cast<int>(last & 0xff); }

    /// What was played since the last call; it is kept for export as well. M.
    std::vector<TakeEvent> drainEvents();
    const FeltEvents& felt() const noexcept { return felt_; } ///< M, as far as drainEvents() was called

    /// How many actuators the host has outputs for. Where buses are pairs, no more than there are actuators:
    /// that a host turns all on is no wish. M.
    int outputs() const;

    HostParameter& parameter(Parameter which) noexcept {
        return *parameters_[static_cast<std::size_t>(which)];
    }
    Takes& takes() noexcept { return takes_; }
    ChannelMeters meters() noexcept { return meters_.read(); } ///< one reader
    /// Messages for frames behind their block, which were played at its last one. Any thread.
    std::uint64_t displacedMessages() const noexcept { return displaced_; }

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
    /// None for LV2: its wrapper writes `lv2:enabled` over it in every block, and tells the host so from the
    /// render call. Our entry makes that port bypass' own, by its changes (Lv2Parts.h).
    juce::AudioProcessorParameter* getBypassParameter() const override {
        return wrapperType == wrapperType_LV2 ? nullptr
                                              : parameters_[static_cast<std::size_t>(Parameter::bypass)];
    }
    double getTailLengthSeconds() const override { return tailSeconds_; } ///< with the knobs of tailKnobs_
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
    static BusesProperties propertiesOf(const BusPlan& plan);
    void addParameters();
    void prepareGuard(int rate);
    static constexpr int tellsEveryMs = 50, sleepsMs = 2000; ///< while blocks are rendered, and while none is
    void timerCallback() override;
    void parameterValueChanged(int, float) override {}
    void parameterGestureChanged(int which, bool begins) override;
    bool applyChunk(std::string_view text);
    bool refuse(const juce::String& why);
    void take(PluginState state);
    bool change(PluginState state);
    bool exchangeFor(PluginState state, bool followsWidth);
    void fitToWidth();
    void publish();
    void setParameters(const PluginState& state, TouchedParameters which = TouchedParameters{}.set());
    void remember(PluginState before);
    PluginState withPreset(int preset) const;

    // R
    TakeTiming timing() const noexcept {
        return value(Parameter::timing) > 0.5 ? TakeTiming::tight : TakeTiming::safe;
    }
    double value(Parameter which) const noexcept {
        return denormalised(rowOf(which), normals_[static_cast<std::size_t>(which)]);
    }
    NoteKnobs knobs() const noexcept;
    void render(juce::AudioBuffer<float>& buffer, const juce::MidiBuffer& midi, bool bypassed) noexcept;
    void readParameters() noexcept;
    void readPoints(int until) noexcept;
    int renderPart(juce::AudioBuffer<float>& buffer, juce::MidiBufferIterator& message,
                   const juce::MidiBuffer& midi, int first) noexcept;
    void followTransport(int frames) noexcept;
    void followTempo(double seconds) noexcept;
    void forgetControls() noexcept;
    template <class Send>
    void send(std::initializer_list<Parameter> those, Send what) noexcept;
    template <class Hold>
    bool sendAt(ControlPace& pace, int first, int end, Hold hold) noexcept;
    void sendPaced(int first, int end) noexcept;
    void sendControls(int frame) noexcept;
    void stopAll(int frame) noexcept;
    void silence(int frame) noexcept;
    void playKeys(int frame) noexcept;
    void readNote() noexcept;
    void takeNotes(int at, int first, int frames) noexcept;
    void express(const NoteEvent& event) noexcept;
    void receive(const juce::MidiMessageMetadata& message, int frame, const NoteTouch& touch = {}) noexcept;
    void press(int channel, int note, double pressure) noexcept;
    void strike(int channel, int note, int velocity, int frame, const NoteTouch& touch) noexcept;
    NoteSound soundOf(const HeldNotes::Note& note) const noexcept;
    CollisionEvent placed(CollisionEvent strike, int channel, const NoteTouch& touch) const noexcept;
    void sustain(int first, int end) noexcept;
    void hear(const juce::AudioBuffer<float>& buffer, int first, int from, int to) noexcept;
    void control(int channel, int controller, int value, int frame) noexcept;
    void measure(const juce::AudioBuffer<float>& buffer) noexcept;

    const juce::String name_;
    const BusPlan plan_;
    std::array<HostParameter*, parameterCount> parameters_{}; // owned by AudioProcessor

    mutable std::mutex mutex_; // guards what follows, up to the atomics; never held while the host is called
    PluginState state_;
    juce::String trouble_;
    EditHistory history_;
    juce::MemoryBlock refused_; // a chunk that is not ours to lose
    std::atomic<int> program_{0};
    std::mutex applyMutex_; // one exchange of states at a time; locked before mutex_, and likewise
    std::atomic<bool> followsWidth_{true}; // the layout is a preset's: an actuator for each output
    std::atomic<std::uint64_t> stateCount_{0};
    std::atomic<double> sampleRateHz_{0.0};
    std::atomic<double> tailSeconds_{0.0};

    struct Key {
        int note = 0, velocity = 0;
    };
    EventQueue<Key, 256> keys_;    // from M to R
    FeltEvents felt_;              // M
    std::uint64_t blocksTold_ = 0; // M
    NoteKnobs tailKnobs_;          // M: what the tail was told for
    std::atomic<std::uint64_t> prepares_{0};
    std::atomic<std::uint32_t> lastController_{0};
    std::atomic<int> wantedProgram_{-1}; // by MIDI
    LatestValue<ChannelMeters> meters_;
    Takes takes_;
    BusMap outputs_;
    int usualBlockFrames_ = 0;

    // R
    BeatInput beats_;
    MusicInput music_;
    Transport transport_;
    HostBeats tempo_;
    int blockFrames_ = 0;
    GainRamp open_;     // shut by bypass
    OutputGuard guard_; // limits the sum of takes while one follows another
    int guardRateHz_ = 0;
    double releasedMs_ = std::numeric_limits<double>::infinity(); // when guard_ came to rest
    bool isShut_ = false;
    std::atomic<bool> isStopped_{false};
    ChannelMeters measured_;
    PointSource* source_ = nullptr;
    NoteSource *noteSource_ = nullptr, *notes_ = nullptr; // of the coming block, of this one
    NoteEvent note_;                                      // the next, if there is one
    bool hasNote_ = false;
    ParameterPoints points_;
    std::array<float, parameterCount> normals_{}; // at the frame that is being made
    std::array<double, parameterCount> sent_{};   // what the playing take has taken
    ControlPace levelPace_, pannerPace_, holdPace_, materialPace_;
    std::atomic<std::uint64_t> displaced_{0};
    bool owesStop_ = false, owesSilence_ = false;
    HeldNotes held_;
    ChannelExpression expression_;
};

/// Passes values between a format's entry and the instance that its wrapper creates on the same thread.
struct Making {
    int usualBlockFrames = 0;            ///< if the entry was told, for the instance; 0: not told
    PluginProcessor* instance = nullptr; ///< the newest, for the entry
};
Making& making() noexcept; ///< of this thread

} // namespace physvib
