// SPDX-License-Identifier: GPL-3.0-or-later
// The message thread's part: settings, buses, rates, latency.
#include "PluginProcessor.h"
#include <stdexcept>

namespace physvib {

PluginProcessor::PluginProcessor(juce::String name, const BusPlan& plan)
    : AudioProcessor{outputsOf(plan)}
    , name_{std::move(name)}
    , plan_{plan} {
    for (std::size_t i = 0; i < parameterCount; ++i) addParameter(parameters_[i] = new HostParameter{allParameters()[i]});
    apply({});
    startTimerHz(20);
}

juce::AudioProcessor::BusesProperties PluginProcessor::outputsOf(const BusPlan& plan) {
    BusesProperties properties;
    for (const auto& bus : busesOf(plan, juce::PluginHostType::getPluginLoadedAs())) properties.addBus(false, bus.name, bus.channels, bus.isOn);
    return properties;
}

PluginProcessor::~PluginProcessor() {
    stopTimer();
    takes_.release();
}

bool PluginProcessor::apply(PluginSettings settings) {
    try {
        takes_.set(settings.session());
    } catch (const std::invalid_argument& error) {
        const std::lock_guard lock{mutex_};
        trouble_ = error.what();
        return false;
    }
    takes_.setQuickStarts(settings.transport == TransportMode::restartOnPlay);
    tailSeconds_ = settings.longestRingSeconds();
    {
        const std::lock_guard lock{mutex_};
        trouble_.clear();
        settings_ = std::move(settings);
        renderSettings_.write({settings_.transport, settings_.layout.geometry, {settings_.midi, settings_.scene}});
    }
    publish();
    return true;
}

PluginSettings PluginProcessor::settings() const {
    const std::lock_guard lock{mutex_};
    return settings_;
}

juce::String PluginProcessor::trouble() const {
    const std::lock_guard lock{mutex_};
    return trouble_;
}

// Tells the host what it may have to know anew.
void PluginProcessor::publish() {
    if (const auto frames = static_cast<int>(takes_.playOutFrames()); frames > 0) setLatencySamples(frames);
}

void PluginProcessor::prepareToPlay(double sampleRateHz, int blockFrames) {
    sampleRateHz_ = sampleRateHz;
    blockFrames_ = juce::jlimit(1, limits::maxBlockFrames, blockFrames);
    const int rate = juce::jlimit(limits::minSampleRateHz, limits::maxSampleRateHz, juce::roundToInt(sampleRateHz));
    outputs_ = OutputMap{*this};
    open_.prepare(rate, limits::channelRampSeconds, value(Parameter::bypass) > 0.5 ? 0.0f : 1.0f);
    transport_.reset();
    measured_ = {};
    bend_.fill(0.0f);
    slide_.fill(0.0f);
    takes_.prepare(rate, blockFrames_);
    publish();
}

void PluginProcessor::releaseResources() {
    takes_.release();
    blockFrames_ = 0;
}

void PluginProcessor::timerCallback() {
    for (auto* p : parameters_) p->tellHost();
}

void PluginProcessor::setCurrentProgram(int index) {
    if (index < 0 || index >= getNumPrograms() || index == program_) return;
    auto changed = settings();
    changed.scene = builtInScenes()[static_cast<std::size_t>(index)];
    if (apply(std::move(changed))) program_ = index;
}

const juce::String PluginProcessor::getProgramName(int index) {
    const auto& scenes = builtInScenes();
    return index >= 0 && index < static_cast<int>(scenes.size()) ? juce::String{scenes[static_cast<std::size_t>(index)].name} : juce::String{};
}

void PluginProcessor::getStateInformation(juce::MemoryBlock&) {}
void PluginProcessor::setStateInformation(const void*, int) {}

} // namespace physvib
