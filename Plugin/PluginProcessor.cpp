// SPDX-License-Identifier: GPL-3.0-or-later
// PluginProcessor on the message thread: its state, edits, programs, buses, sample rates and latency.
#include "PluginProcessor.h"
#include "PluginEditor.h"
#include <algorithm>
#include <stdexcept>

namespace physvib {

namespace {

/// What presets and undo set: somebody may have pressed SILENCE meanwhile.
const auto allButSilence = TouchedParameters{}.set().reset(static_cast<std::size_t>(Parameter::bypass));

/// An error may quote bytes of a broken chunk, and JUCE overruns its memory if a text is not valid UTF-8.
juce::String asString(std::string text) {
    if (!juce::CharPointer_UTF8::isValidString(text.data(), static_cast<int>(text.size())))
        for (char& c : text)
            if (static_cast<unsigned char>(c) >= 0x80) c = '?';
    return fromUtf8(text);
}

} // namespace

PluginProcessor::PluginProcessor(juce::String name, const BusPlan& plan)
    : AudioProcessor{makeBusProperties(plan)}
    , name_{std::move(name)}
    , plan_{plan} {
    addParameters();
    const auto state = newPluginState(outputCount());
    apply(state);
    setParameters(state);
    followsOutputs_ = true;
    startTimer(idleTimerMs);
}

juce::AudioProcessor::BusesProperties PluginProcessor::makeBusProperties(const BusPlan& plan) {
    const auto format = juce::PluginHostType::getPluginLoadedAs();
    BusesProperties properties;
    for (const auto& bus : newBuses(plan, format)) properties.addBus(false, bus.name, bus.channels, bus.isOn);
    if (hasSideChain(plan, format))
        properties.addBus(true, "Music", juce::AudioChannelSet::stereo(), plan.hasMusicPorts);
    return properties;
}

// Adds them in the table's order, by which hosts number them.
void PluginProcessor::addParameters() {
    for (std::size_t i = 0; i < parameterCount; ++i) {
        parameters_[i] = new HostParameter{allParameters()[i]};
        parameters_[i]->addListener(this);
    }
    const auto addGroups = [this](bool areAfterBypass) {
        for (const auto& group : parameterGroups()) {
            if ((group.parameters.front() > Parameter::bypass) != areAfterBypass) continue;
            auto shown = std::make_unique<juce::AudioProcessorParameterGroup>(
                juce::String{group.id.data()}, juce::String{group.name.data()}, "/");
            for (const auto which : group.parameters)
                shown->addChild(std::unique_ptr<HostParameter>{&parameter(which)});
            addParameterGroup(std::move(shown));
        }
    };
    addParameter(&parameter(Parameter::level));
    addGroups(false);
    addParameter(&parameter(Parameter::bypass));
    addGroups(true);
}

PluginProcessor::~PluginProcessor() {
    stopTimer();
    runs_.release();
}

bool PluginProcessor::apply(PluginState state) {
    {
        const std::lock_guard applyLock{applyMutex_};
        if (!replaceState(std::move(state), false)) return false;
    }
    reportToHost();
    return true;
}

// Called with applyMutex_ locked.
bool PluginProcessor::replaceState(PluginState state, bool followsOutputs) {
    fitToLayout(state);
    try {
        runs_.set(makeSessionSetup(state), {state.transport, state.layout.geometry, MidiTable{state}},
                  state.strips);
    } catch (const std::invalid_argument& error) {
        return refuse(asString(error.what()));
    }
    followsOutputs_ = followsOutputs;
    tailSeconds_ = tailSeconds(state, noteKnobs());
    program_ = findPresetIndex(state);
    storeState(std::move(state));
    return true;
}

// A state that another thread sets meanwhile is not lost: it comes before, and is not fitted, or comes after.
void PluginProcessor::fitLayoutToOutputs() {
    const std::lock_guard applyLock{applyMutex_};
    auto fitting = state();
    if (!followsOutputs_ || outputCount() == actuatorCount(fitting)) return;
    rearrange(fitting, outputCount());
    replaceState(std::move(fitting), true);
}

int PluginProcessor::outputCount() const {
    const int count = BusMap{*this}.leadingConnected();
    return plan_.kind == BusPlan::Kind::oneBus ? count : std::min(count, std::max(4, actuatorCount(state())));
}

void PluginProcessor::storeState(PluginState state) {
    {
        const std::lock_guard lock{mutex_};
        errorText_.clear();
        refusedChunk_.reset();
        state_ = std::move(state);
    }
    ++stateVersion_;
}

bool PluginProcessor::edit(PluginState state) {
    auto before = this->state();
    if (!applyEdit(std::move(state))) return false;
    const std::lock_guard lock{mutex_};
    history_.add(std::move(before), {});
    return true;
}

// Records a step of its own, with the parameters whose values now differ from `before`.
void PluginProcessor::recordEdit(PluginState before) {
    const auto now = state();
    TouchedParameters touched;
    for (std::size_t p = 0; p < parameterCount; ++p) touched[p] = before.parameters[p] != now.parameters[p];
    const std::lock_guard lock{mutex_};
    history_.add(std::move(before), touched, EditHistory::Edit::separate);
}

void PluginProcessor::stepHistory(Direction direction) {
    std::optional<EditHistory::Step> target;
    {
        auto now = state();
        const std::lock_guard lock{mutex_};
        target = history_.step(direction, std::move(now));
    }
    if (!target) return;
    // SILENCE is no edit: only its button lifts it
    target->touched &= allButSilence;
    if (applyEdit(target->state)) setParameters(target->state, target->touched);
}

bool PluginProcessor::canStep(Direction direction) const {
    const std::lock_guard lock{mutex_};
    return history_.canStep(direction);
}

bool PluginProcessor::isAtB() const {
    const std::lock_guard lock{mutex_};
    return history_.isAtB();
}

bool PluginProcessor::applyEdit(PluginState state) {
    fitToLayout(state);
    const int before = program_;
    const auto now = this->state();
    const bool follows = followsOutputs_ && isSame(now.layout.geometry, state.layout.geometry);
    if (canKeepPlaying(now, state)) {
        runs_.setStrips(state.strips);
        storeState(std::move(state));
    } else if (!apply(std::move(state))) {
        return false;
    }
    followsOutputs_ = follows;
    updateHostDisplay(
        ChangeDetails{}.withNonParameterStateChanged(true).withProgramChanged(program_ != before));
    return true;
}

void PluginProcessor::open(PluginState state) {
    auto before = this->state();
    if (!applyEdit(state)) return;
    setParameters(state, allButSilence);
    recordEdit(std::move(before));
}

PluginState PluginProcessor::withPreset(int preset) const {
    auto changed = state();
    applyBuiltInPreset(changed, preset, outputCount());
    return changed;
}

void PluginProcessor::choosePreset(int preset) {
    open(withPreset(preset));
    followsOutputs_ = true;
}

void PluginProcessor::arrangeForOutputs() {
    auto changed = state();
    rearrange(changed, outputCount());
    if (edit(std::move(changed))) followsOutputs_ = true;
}

void PluginProcessor::setEditorSize(int width, int height) {
    const std::lock_guard lock{mutex_};
    state_.editorWidth = width;
    state_.editorHeight = height;
}

bool PluginProcessor::refuse(const juce::String& reason) {
    const std::lock_guard lock{mutex_};
    errorText_ = reason;
    return false;
}

PluginState PluginProcessor::state() const {
    const std::lock_guard lock{mutex_};
    PluginState now = state_;
    now.parameters.clear();
    for (const auto* p : parameters_)
        now.parameters.emplace_back(p->row().id, toStateValue(p->row(), p->value()));
    return now;
}

juce::String PluginProcessor::errorText() const {
    const auto runError = runs_.errorText();
    if (const int rate = preparedRateHz(); rate > 0 && !isSampleRate(rate))
        return "the host runs at " + juce::String{rate} + " Hz; expected " +
               juce::String{limits::minSampleRateHz} + " to " + juce::String{limits::maxSampleRateHz} +
               ": silent";
    const std::lock_guard lock{mutex_};
    return errorText_.isNotEmpty() ? errorText_ : asString(runError);
}

bool PluginProcessor::hasRefusedChunk() const {
    const std::lock_guard lock{mutex_};
    return !refusedChunk_.isEmpty();
}

// Only the controls of our window begin gestures. Pressing SILENCE is no edit.
void PluginProcessor::parameterGestureChanged(int which, bool begins) {
    if (!begins || which == static_cast<int>(Parameter::bypass)) return;
    auto before = state();
    const std::lock_guard lock{mutex_};
    history_.add(std::move(before), TouchedParameters{}.set(static_cast<std::size_t>(which)));
    if (refusedChunk_.isEmpty()) return;
    refusedChunk_.reset();
    errorText_.clear();
}

// Reports the latency to the host, which may have changed with the timing or the settings.
void PluginProcessor::reportToHost() {
    runs_.setTiming(parameter(Parameter::timing).value() > 0.5 ? StepTiming::tight : StepTiming::safe);
    if (const int rate = preparedRateHz(); rate > 0 && !isSampleRate(rate))
        setLatencySamples(0);
    else if (const auto frames = static_cast<int>(runs_.latencyFrames()); frames > 0)
        setLatencySamples(frames);
}

void PluginProcessor::prepareToPlay(double sampleRateHz, int blockFrames) {
    const int rate = juce::roundToInt(sampleRateHz), nominal = nominalBlockFrames_;
    sampleRateHz_ = sampleRateHz;
    if (!isSampleRate(rate)) { // silent, and errorText() says so
        releaseResources();
        return reportToHost();
    }
    blockFrames_ =
        juce::jlimit(1, limits::maxBlockFrames, nominal > 0 ? std::min(nominal, blockFrames) : blockFrames);
    fitLayoutToOutputs();
    outputMap_ = BusMap{*this};
    outputGate_.prepare(rate, limits::channelRampSeconds,
                        parameter(Parameter::bypass).value() > 0.5 || isStopped() ? 0.0f : 1.0f);
    prepareGuard(rate);
    transport_ = {};
    hostBeats_ = {};
    parameterPoints_ = {};
    channelMeters_ = {};
    expression_ = {};
    heldNotes_ = {};
    ++prepareCount_;
    const auto* sideChain = getBus(true, 0);
    const int musicChannels =
        sideChain != nullptr && sideChain->isEnabled() ? sideChain->getNumberOfChannels() : 0;
    beats_.prepare(rate, blockFrames_, musicChannels);
    music_.prepare(rate, blockFrames_, musicChannels);
    readParameters();
    runs_.setTiming(timing());
    runs_.prepare(rate, blockFrames_, beats_.delaySeconds(), musicChannels > 0);
    reportToHost();
    startTimer(activeTimerMs);
}

// Preparing again must not reset the guard's memory: the outputs have it as after silence since the release.
// A non-realtime export begins without it, so that each is the same.
void PluginProcessor::prepareGuard(int rate) {
    std::array<GuardSums, limits::maxActuators> previousSums{};
    if (!isNonRealtime()) {
        const double idleSeconds = 1e-3 * (juce::Time::getMillisecondCounterHiRes() - releasedMs_);
        guard_.process(nullptr, juce::roundToInt(std::clamp(idleSeconds, 0.0, 9.0) * guardRateHz_), true);
        for (std::size_t j = 0; j < guard_.channels(); ++j) previousSums[j] = guard_.sums(j);
    }
    guard_.prepare(guardRateHz_ = rate, std::min(getTotalNumOutputChannels(), limits::maxActuators),
                   GuardPlace::last);
    releasedMs_ = std::numeric_limits<double>::infinity();
    if (std::ranges::any_of(previousSums, [](const GuardSums& m) { return m.load > 0.0f; }))
        guard_.restore(previousSums.data());
}

void PluginProcessor::releaseResources() {
    runs_.release();
    if (blockFrames_ > 0) releasedMs_ = juce::Time::getMillisecondCounterHiRes();
    blockFrames_ = 0;
}

std::vector<RunEvent> PluginProcessor::drainEvents() {
    auto newEvents = runs_.drainLog();
    playedEvents_.add(prepareCount_, newEvents);
    return newEvents;
}

void PluginProcessor::timerCallback() {
    for (auto* p : parameters_) p->notifyHost();
    if (const auto now = noteKnobs(); now != tailKnobs_)
        tailSeconds_ = tailSeconds(state(), tailKnobs_ = now);
    if (const int requested = requestedProgram_.exchange(-1), before = program_;
        requested >= 0 && requested != before) { // a song may say it at each start: knobs stay
        setCurrentProgram(requested);
        if (program_ != before)
            updateHostDisplay(ChangeDetails{}.withNonParameterStateChanged(true).withProgramChanged(true));
    }
    reportToHost(); // the timing may have changed
    const bool plays = std::exchange(lastBlockCount_, runs_.blocks()) != lastBlockCount_;
    if (const int intervalMs = plays ? activeTimerMs : idleTimerMs; intervalMs != getTimerInterval())
        startTimer(intervalMs);
}

juce::AudioProcessorEditor* PluginProcessor::createEditor() { return new PluginEditor{*this}; }

int PluginProcessor::getNumPrograms() { return static_cast<int>(presetNames().size()); }

void PluginProcessor::setCurrentProgram(int index) {
    if (index < 0 || index >= getNumPrograms()) return;
    auto before = state();
    const auto changed = withPreset(index);
    const bool keepsPlaying = canKeepPlaying(before, changed);
    if (!keepsPlaying && !apply(changed)) return;
    setParameters(changed, allButSilence);
    if (keepsPlaying && state().parameters == before.parameters) return; // hosts repeat calls
    followsOutputs_ = true;
    recordEdit(std::move(before));
}

const juce::String PluginProcessor::getProgramName(int index) {
    const auto& names = presetNames();
    return index >= 0 && index < static_cast<int>(names.size())
               ? juce::String{displayName(names[static_cast<std::size_t>(index)])}
               : juce::String{};
}

void PluginProcessor::getStateInformation(juce::MemoryBlock& chunk) {
    {
        const std::lock_guard lock{mutex_};
        chunk = refusedChunk_;
    }
    if (!chunk.isEmpty()) return;
    const std::string text = pluginStateJson(state());
    chunk.replaceAll(text.data(), text.size());
}

// A chunk that cannot be read changes nothing, and the next save returns it, so that a host's session loses
// nothing when an older PhysVib opens it.
void PluginProcessor::setStateInformation(const void* data, int size) {
    const std::string_view text{static_cast<const char*>(data), static_cast<std::size_t>(std::max(0, size))};
    if (applyChunk(text.substr(0, text.find_last_not_of('\0') + 1))) return; // a host may end it with NULs
    followsOutputs_ = false;
    const std::lock_guard lock{mutex_};
    refusedChunk_ = juce::MemoryBlock{text.data(), text.size()};
}

bool PluginProcessor::applyChunk(std::string_view text) {
    const auto read = readPluginState(text, "state");
    if (!read) return refuse(asString(read.error));
    if (const auto error = parameterError(read.value); !error.empty())
        return refuse(asString("state: " + error));
    if (!apply(read.value)) return false;
    setParameters(read.value);
    const std::lock_guard lock{mutex_};
    history_ = {};
    return true;
}

// Sets the parameters in `which`, to their defaults if the state lacks them. The host is notified only of
// changes, because each notification may mark its session as changed.
void PluginProcessor::setParameters(const PluginState& state, TouchedParameters which) {
    std::array<float, parameterCount> normals;
    for (std::size_t i = 0; i < parameterCount; ++i) normals[i] = parameters_[i]->getDefaultValue();
    for (const auto& [id, value] : state.parameters) {
        const auto index = static_cast<std::size_t>(findParameter(id));
        normals[index] = static_cast<float>(
            normalised(parameters_[index]->row(), *fromStateValue(parameters_[index]->row(), value)));
    }
    for (std::size_t i = 0; i < parameterCount; ++i)
        if (which[i] && parameters_[i]->getValue() != normals[i])
            parameters_[i]->setValueNotifyingHost(normals[i]);
    tailSeconds_ = tailSeconds(state, noteKnobs()); // now, as a host may ask before the timer's next call
    reportToHost();
}

} // namespace physvib
