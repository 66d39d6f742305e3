// SPDX-License-Identifier: GPL-3.0-or-later
// The plug-in processor on the message thread: settings, buses, sample rates, latency.
#include "PluginProcessor.h"
#include "PluginEditor.h"
#include <algorithm>
#include <stdexcept>

namespace physvib {

namespace {

/// A message may quote bytes of a broken chunk, and JUCE writes beyond its memory where a text is no UTF-8.
juce::String asString(std::string text) {
    if (!juce::CharPointer_UTF8::isValidString(text.data(), static_cast<int>(text.size())))
        for (char& c : text)
            if (static_cast<unsigned char>(c) >= 0x80) c = '?';
    return juce::String::fromUTF8(text.data(), static_cast<int>(text.size()));
}

} // namespace

PluginProcessor::PluginProcessor(juce::String name, const BusPlan& plan)
    : AudioProcessor{propertiesOf(plan)}
    , name_{std::move(name)}
    , plan_{plan} {
    addParameters();
    const auto state = newPluginState(outputs());
    apply(state);
    setParameters(state);
    followsWidth_ = true;
    startTimer(sleepsMs);
}

juce::AudioProcessor::BusesProperties PluginProcessor::propertiesOf(const BusPlan& plan) {
    const auto format = juce::PluginHostType::getPluginLoadedAs();
    BusesProperties properties;
    for (const auto& bus : busesOf(plan, format)) properties.addBus(false, bus.name, bus.channels, bus.isOn);
    if (hasSideChain(plan, format))
        properties.addBus(true, "Music", juce::AudioChannelSet::stereo(), plan.hasMusicPorts);
    return properties;
}

// Hosts number them as the table does.
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
    takes_.release();
}

bool PluginProcessor::apply(PluginState state) {
    {
        const std::lock_guard one{applyMutex_};
        if (!exchangeFor(std::move(state), false)) return false;
    }
    publish();
    return true;
}

// applyMutex_ is held.
bool PluginProcessor::exchangeFor(PluginState state, bool followsWidth) {
    fitToLayout(state);
    try {
        takes_.set(sessionSetupOf(state), {state.transport, state.layout.geometry, MidiTable{state}},
                   state.strips);
    } catch (const std::invalid_argument& error) {
        return refuse(asString(error.what()));
    }
    followsWidth_ = followsWidth;
    tailSeconds_ = tailSeconds(state, noteKnobs());
    program_ = presetOf(state);
    take(std::move(state));
    return true;
}

// A state that comes meanwhile on another thread is kept: it is there and not fitted, or comes after.
void PluginProcessor::fitToWidth() {
    const std::lock_guard one{applyMutex_};
    auto fitting = state();
    if (!followsWidth_ || outputs() == enchantersOf(fitting)) return;
    rearrange(fitting, outputs());
    exchangeFor(std::move(fitting), true);
}

int PluginProcessor::outputs() const {
    const int there = BusMap{*this}.leading();
    return plan_.kind == BusPlan::Kind::oneBus ? there : std::min(there, std::max(4, enchantersOf(state())));
}

void PluginProcessor::take(PluginState state) {
    {
        const std::lock_guard lock{mutex_};
        trouble_.clear();
        refused_.reset();
        state_ = std::move(state);
    }
    ++stateCount_;
}

bool PluginProcessor::edit(PluginState state) {
    auto before = this->state();
    if (!change(std::move(state))) return false;
    const std::lock_guard lock{mutex_};
    history_.add(std::move(before), {});
    return true;
}

// A step of its own, about the parameters that are others now.
void PluginProcessor::remember(PluginState before) {
    const auto now = state();
    TouchedParameters touched;
    for (std::size_t p = 0; p < parameterCount; ++p) touched[p] = before.parameters[p] != now.parameters[p];
    const std::lock_guard lock{mutex_};
    history_.add(std::move(before), touched, EditHistory::Edit::whole);
}

void PluginProcessor::go(Step step) {
    std::optional<EditHistory::Step> there;
    {
        auto now = state();
        const std::lock_guard lock{mutex_};
        there = history_.go(step, std::move(now));
    }
    if (!there) return;
    // SILENCE is no edit: only a hand on its button lifts it
    there->touched.reset(static_cast<std::size_t>(Parameter::bypass));
    if (change(there->state)) setParameters(there->state, there->touched);
}

bool PluginProcessor::can(Step step) const {
    const std::lock_guard lock{mutex_};
    return history_.can(step);
}

bool PluginProcessor::isAtB() const {
    const std::lock_guard lock{mutex_};
    return history_.isAtB();
}

bool PluginProcessor::change(PluginState state) {
    fitToLayout(state);
    const int before = program_;
    const auto now = this->state();
    const bool follows = followsWidth_ && isSame(now.layout.geometry, state.layout.geometry);
    if (isSameTake(now, state)) {
        takes_.mix(state.strips);
        take(std::move(state));
    } else if (!apply(std::move(state))) {
        return false;
    }
    followsWidth_ = follows;
    updateHostDisplay(
        ChangeDetails{}.withNonParameterStateChanged(true).withProgramChanged(program_ != before));
    return true;
}

void PluginProcessor::open(PluginState state) {
    auto before = this->state();
    if (!change(state)) return;
    setParameters(state);
    remember(std::move(before));
}

PluginState PluginProcessor::withPreset(int preset) const {
    auto changed = state();
    useBuiltIn(changed, preset, outputs());
    return changed;
}

void PluginProcessor::choose(int preset) {
    open(withPreset(preset));
    followsWidth_ = true;
}

void PluginProcessor::useOutputs() {
    auto changed = state();
    rearrange(changed, outputs());
    if (edit(std::move(changed))) followsWidth_ = true;
}

void PluginProcessor::keepEditorSize(int width, int height) {
    const std::lock_guard lock{mutex_};
    state_.editorWidth = width;
    state_.editorHeight = height;
}

bool PluginProcessor::refuse(const juce::String& why) {
    const std::lock_guard lock{mutex_};
    trouble_ = why;
    return false;
}

PluginState PluginProcessor::state() const {
    const std::lock_guard lock{mutex_};
    PluginState now = state_;
    now.parameters.clear();
    for (const auto* p : parameters_)
        now.parameters.emplace_back(p->row().id, stateValue(p->row(), p->value()));
    return now;
}

juce::String PluginProcessor::trouble() const {
    const auto fault = takes_.fault();
    if (const int rate = preparedRateHz(); rate > 0 && !isSampleRate(rate))
        return "the host runs at " + juce::String{rate} + " Hz; expected " +
               juce::String{limits::minSampleRateHz} + " to " + juce::String{limits::maxSampleRateHz} +
               ": silent";
    const std::lock_guard lock{mutex_};
    return trouble_.isNotEmpty() ? trouble_ : asString(fault);
}

bool PluginProcessor::keepsRefused() const {
    const std::lock_guard lock{mutex_};
    return !refused_.isEmpty();
}

// Only a hand on our editor begins a gesture. Who silences what they did not expect edits nothing.
void PluginProcessor::parameterGestureChanged(int which, bool begins) {
    if (!begins || which == static_cast<int>(Parameter::bypass)) return;
    auto before = state();
    const std::lock_guard lock{mutex_};
    history_.add(std::move(before), TouchedParameters{}.set(static_cast<std::size_t>(which)));
    if (refused_.isEmpty()) return;
    refused_.reset();
    trouble_.clear();
}

// Tells the host what it may have to know anew.
void PluginProcessor::publish() {
    takes_.setTiming(parameter(Parameter::timing).value() > 0.5 ? TakeTiming::tight : TakeTiming::safe);
    // nothing is played
    if (const int rate = preparedRateHz(); rate > 0 && !isSampleRate(rate))
        setLatencySamples(0);
    else if (const auto frames = static_cast<int>(takes_.latencyFrames()); frames > 0)
        setLatencySamples(frames);
}

void PluginProcessor::prepareToPlay(double sampleRateHz, int blockFrames) {
    const int rate = juce::roundToInt(sampleRateHz), usual = usualBlockFrames_;
    sampleRateHz_ = sampleRateHz;
    if (!isSampleRate(rate)) { // silent, and trouble() says so
        releaseResources();
        return publish();
    }
    blockFrames_ =
        juce::jlimit(1, limits::maxBlockFrames, usual > 0 ? std::min(usual, blockFrames) : blockFrames);
    fitToWidth();
    outputs_ = BusMap{*this};
    open_.prepare(rate, limits::channelRampSeconds,
                  parameter(Parameter::bypass).value() > 0.5 || isStopped() ? 0.0f : 1.0f);
    prepareGuard(rate);
    transport_.reset();
    tempo_ = {};
    points_.reset();
    measured_ = {};
    expression_ = {};
    held_.forget();
    ++prepares_;
    const auto* sideChain = getBus(true, 0);
    const int musicChannels =
        sideChain != nullptr && sideChain->isEnabled() ? sideChain->getNumberOfChannels() : 0;
    beats_.prepare(rate, blockFrames_, musicChannels);
    music_.prepare(rate, blockFrames_, musicChannels);
    readParameters();
    takes_.setTiming(timing());
    takes_.prepare(rate, blockFrames_, beats_.delaySeconds(), musicChannels > 0);
    publish();
    startTimer(tellsEveryMs);
}

// Preparing anew is no way around the guard: outputs keep what they had, as after silence since the release.
// An export begins at rest, so that it is the same each time.
void PluginProcessor::prepareGuard(int rate) {
    std::array<GuardSums, limits::maxEnchanters> had{};
    if (!isNonRealtime()) {
        const double rest = 1e-3 * (juce::Time::getMillisecondCounterHiRes() - releasedMs_);
        guard_.process(nullptr, juce::roundToInt(std::clamp(rest, 0.0, 9.0) * guardRateHz_), true);
        for (std::size_t j = 0; j < guard_.channels(); ++j) had[j] = guard_.sums(j);
    }
    guard_.prepare(guardRateHz_ = rate, std::min(getTotalNumOutputChannels(), limits::maxEnchanters),
                   GuardPlace::last);
    releasedMs_ = std::numeric_limits<double>::infinity();
    if (std::ranges::any_of(had, [](const GuardSums& m) { return m.load > 0.0f; })) guard_.recall(had.data());
}

void PluginProcessor::releaseResources() {
    takes_.release();
    if (blockFrames_ > 0) releasedMs_ = juce::Time::getMillisecondCounterHiRes();
    blockFrames_ = 0;
}

std::vector<TakeEvent> PluginProcessor::drainEvents() {
    auto fresh = takes_.drainLog();
    felt_.add(prepares_, fresh);
    return fresh;
}

void PluginProcessor::timerCallback() {
    for (auto* p : parameters_) p->notifyHost();
    if (const auto now = noteKnobs(); now != tailKnobs_)
        tailSeconds_ = tailSeconds(state(), tailKnobs_ = now);
    if (const int wanted = wantedProgram_.exchange(-1), before = program_; wanted >= 0) {
        setCurrentProgram(wanted);
        if (program_ != before)
            updateHostDisplay(ChangeDetails{}.withNonParameterStateChanged(true).withProgramChanged(true));
    }
    publish(); // the timing may have changed
    const bool plays = std::exchange(blocksTold_, takes_.blocks()) != blocksTold_;
    if (const int wanted = plays ? tellsEveryMs : sleepsMs; wanted != getTimerInterval()) startTimer(wanted);
}

juce::AudioProcessorEditor* PluginProcessor::createEditor() { return new PluginEditor{*this}; }

int PluginProcessor::getNumPrograms() { return static_cast<int>(presetNames().size()); }

void PluginProcessor::setCurrentProgram(int index) {
    if (index < 0 || index >= getNumPrograms()) return;
    auto before = state();
    const auto changed = withPreset(index);
    if (isSameTake(before, changed)) return; // hosts repeat themselves, and the world would start anew
    if (!apply(changed)) return;
    followsWidth_ = true;
    setParameters(changed);
    remember(std::move(before));
}

const juce::String PluginProcessor::getProgramName(int index) {
    const auto& names = presetNames();
    return index >= 0 && index < static_cast<int>(names.size())
               ? juce::String{shownName(names[static_cast<std::size_t>(index)])}
               : juce::String{};
}

void PluginProcessor::getStateInformation(juce::MemoryBlock& chunk) {
    {
        const std::lock_guard lock{mutex_};
        chunk = refused_;
    }
    if (!chunk.isEmpty()) return;
    const std::string text = pluginStateJson(state());
    chunk.replaceAll(text.data(), text.size());
}

// A chunk that cannot be read leaves everything as it was, and is what the next save gives back: a host's
// session that was opened with an older PhysVib loses nothing.
void PluginProcessor::setStateInformation(const void* data, int size) {
    const std::string_view text{static_cast<const char*>(data), static_cast<std::size_t>(std::max(0, size))};
    if (applyChunk(text.substr(0, text.find_last_not_of('\0') + 1))) return; // a host may end it with NULs
    followsWidth_ = false;
    const std::lock_guard lock{mutex_};
    refused_ = juce::MemoryBlock{text.data(), text.size()};
}

bool PluginProcessor::applyChunk(std::string_view text) {
    const auto read = readPluginState(text, "state");
    if (!read) return refuse(asString(read.error));
    if (const auto fault = faultOfParameters(read.value); !fault.empty())
        return refuse(asString("state: " + fault));
    if (!apply(read.value)) return false;
    setParameters(read.value);
    const std::lock_guard lock{mutex_};
    history_ = {};
    return true;
}

// Those that the state does not name get their defaults. The host is told of what it does not know: each
// telling may mark its session as changed.
void PluginProcessor::setParameters(const PluginState& state, TouchedParameters which) {
    std::array<float, parameterCount> normals;
    for (std::size_t i = 0; i < parameterCount; ++i) normals[i] = parameters_[i]->getDefaultValue();
    for (const auto& [id, value] : state.parameters) {
        const auto one = static_cast<std::size_t>(parameterOfId(id));
        normals[one] = static_cast<float>(
            normalised(parameters_[one]->row(), *valueOfState(parameters_[one]->row(), value)));
    }
    for (std::size_t i = 0; i < parameterCount; ++i)
        if (which[i] && parameters_[i]->getValue() != normals[i])
            parameters_[i]->setValueNotifyingHost(normals[i]);
}

} // namespace physvib
