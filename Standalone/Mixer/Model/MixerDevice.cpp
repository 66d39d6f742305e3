// SPDX-License-Identifier: GPL-3.0-or-later
// Opens the device and headphones, assigns outputs, applies monitor and markers, and sums the exposure.
// Computes falling peaks, held peaks, and the decimated samples of the spectrum.
#include "Mixer/Model/MixerDevice.h"
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Model/MixerModel.h"
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {

namespace {

constexpr double maintainIntervalMs = 1000.0;

bool hasNoOutput(const Mix& mix, std::size_t strip) {
    return strip < mix.strips.size() && mix.strips[strip].output < 0;
}

juce::String joinLabels(const MixerModel& model, const std::vector<std::size_t>& strips) {
    juce::StringArray labels;
    for (const std::size_t j : strips) labels.add(labelOf(model.mix(), j));
    return labels.joinIntoString(", ");
}

void assignFreeOutputs(MixerModel& model, const std::vector<std::size_t>& strips) {
    const auto reserved = model.device().choice().reservedOutputs();
    const int outputCount = model.device().outputCount() > 0 ? model.device().outputCount() : maxStripOutputs;
    model.change("Free outputs", [&](Mix& mix) {
        for (const std::size_t j : strips)
            if (hasNoOutput(mix, j)) mix.strips[j].output = freeOutput(mix.strips, reserved, outputCount);
    });
    if (std::ranges::any_of(strips, [&](std::size_t j) { return hasNoOutput(model.mix(), j); }))
        model.report("The device has no other free output");
}

int headphoneOutput(std::size_t strip) {
    return strip < DeviceChoice::earCount ? static_cast<int>(strip) : -1;
}

constexpr double peakHoldMs = 1500.0;

} // namespace

std::string MixerDevice::open(const DeviceChoice& choice) {
    AudioOutputSettings settings{choice.name,
                                 outputMap(),
                                 choice.sampleRateHz,
                                 choice.blockFrames,
                                 masterGain(mix_),
                                 mix_.count(),
                                 true,
                                 listening_.resetToStudySettings()};
    const auto error = rig_.openDevice(settings);
    choice_ = choice;
    listening_.applyRequested();
    return error;
}

bool MixerDevice::hasNoDevice() const { return rig_.output().device().starts_with(nullDeviceType); }

bool MixerDevice::isPlayed(std::size_t actuator) const {
    if (!choice_.sinks.empty() || hasNoDevice()) return true;
    const int output = mix_.strips[actuator].output;
    return output >= 0 && (output < outputCount() || outputCount() == 0); // a lost device may return
}

std::vector<int> MixerDevice::outputMap() const {
    std::vector<int> map;
    for (const Strip& strip : mix_.strips) map.push_back(strip.output);
    return map;
}

std::string MixerDevice::assignOutputs() {
    rig_.output().setListening(listening_.resetToStudySettings()); // frees the monitor's outputs
    auto error = rig_.output().assign(outputMap(), mix_.count());
    listening_.applyRequested();
    return error;
}

juce::String MixerDevice::sinkWithoutClips() const {
    for (const SinkState& sink : rig_.sinkStates())
        if (!sink.playsClips) return utf8(sink.name);
    return {};
}

void MixerDevice::maintain() {
    const double now = nowMs();
    if (now - maintainedAtMs_ <= maintainIntervalMs && coversSinks(rig_.session())) return;
    maintainedAtMs_ = now;
    listening_.applyRequested(); // the device may have disappeared or returned
    rig_.maintain();
}

juce::String MixerDevice::error() const {
    const auto all = rig_.errors();
    return all.empty() ? juce::String{} : utf8(all.front().text);
}

bool MixerListening::isFree(int output) const {
    return output >= 0 && output < output_.deviceOutputs() &&
           std::ranges::find(mix_.strips, output, &Strip::output) == mix_.strips.end();
}

// Audio outputs must never prevent the haptic output: outputs that the device lacks are not requested.
ListeningSettings MixerListening::requestedSettings() const {
    ListeningSettings requested = studySettings_.value_or(ListeningSettings{});
    if (!studySettings_ &&
        std::ranges::all_of(choice_.monitorOutputs, [this](int output) { return isFree(output); }))
        requested.contacts = choice_.monitorOutputs;
    requested.contactDb = choice_.monitorDb;
    const auto hasMarker = [&](const std::vector<int>& outputs) {
        return std::ranges::find(outputs, choice_.markerOutput) != outputs.end();
    };
    if (isFree(choice_.markerOutput) && !hasMarker(requested.noise) && !hasMarker(requested.contacts))
        requested.marks = {choice_.markerOutput};
    return requested;
}

std::string MixerListening::applyRequested() {
    const auto requested = this->requestedSettings();
    if (requested == appliedSettings_) return {};
    auto error = output_.setListening(requested);
    if (error.empty()) appliedSettings_ = requested;
    return error;
}

std::string MixerListening::beginStudy(const ListeningSettings& studySettings) {
    const auto oldSettings = std::exchange(studySettings_, studySettings);
    auto error = applyRequested();
    if (!error.empty()) studySettings_ = oldSettings;
    return error;
}

void MixerListening::endStudy() {
    studySettings_.reset();
    applyRequested();
}

std::string MixerListening::applyAndStore(const ListeningSettings& requested, const DeviceChoice& choice) {
    if (auto error = output_.setListening(requested); !error.empty()) return error;
    appliedSettings_ = requested;
    choice_ = choice;
    onChange_();
    return {};
}

std::string MixerListening::setMonitor(std::vector<int> outputs, double levelDb) {
    auto requested = appliedSettings_;
    auto choice = choice_;
    requested.contacts = choice.monitorOutputs = std::move(outputs);
    requested.contactDb = choice.monitorDb = levelDb;
    return applyAndStore(requested, choice);
}

std::string MixerListening::setMarker(int output) {
    auto requested = appliedSettings_;
    auto choice = choice_;
    choice.markerOutput = output;
    requested.marks = output < 0 ? std::vector<int>{} : std::vector{output};
    return applyAndStore(requested, choice);
}

void setStripOutputs(const std::vector<int>& outputs, std::span<Strip> strips) {
    for (std::size_t j = 0; j < strips.size(); ++j) strips[j].output = j < outputs.size() ? outputs[j] : -1;
}

std::vector<std::size_t> assignNewStrips(const DeviceChoice& choice, std::span<Strip> strips,
                                         std::size_t firstNew) {
    std::vector<std::size_t> withoutOutput;
    const auto reserved = choice.reservedOutputs();
    const int outputCount = choice.isHeadphones ? DeviceChoice::earCount : maxStripOutputs;
    for (std::size_t j = firstNew; j < strips.size(); ++j) {
        int& output = strips[j].output;
        if (output < 0 || (output < outputCount && std::ranges::find(reserved, output) == reserved.end()))
            continue;
        output = freeOutput(strips, reserved, outputCount);
        if (output < 0) withoutOutput.push_back(j);
    }
    return withoutOutput;
}

void fitLayoutTo(int outputCount, Mix& mix, std::string_view device) {
    const bool isDefault = mix.layout.name == MixerModel::defaultMix().layout.name; // not chosen by the user
    if (mix.count() <= outputCount && !(isPico(device) && isDefault)) return;
    mix.layout = presetLayout(layoutPresetFor(outputCount, device), mix.layout.actuators);
    mix.resizeStrips();
}

void reportNoHeadphoneOutput(MixerModel& model, const std::vector<std::size_t>& strips) {
    if (strips.empty()) return;
    model.messages().add(
        {joinLabels(model, strips) + (strips.size() == 1 ? " has no output: " : " have no output: ") +
             "headphones have two, L and R",
         false,
         {"Use two",
          [&model] {
              model.change("Two actuators", [](Mix& mix) { fitLayoutTo(DeviceChoice::earCount, mix); });
          }},
         noHeadphoneOutputLabel});
}

std::string openHeadphones(MixerModel& model, DeviceChoice choice,
                           std::optional<std::vector<int>> oldOutputs) {
    if (!model.device().choice().isHeadphones)
        choice.outputsBeforeHeadphones = oldOutputs ? std::move(*oldOutputs) : model.device().outputMap();
    choice.isHeadphones = true;
    choice.monitorOutputs.clear();
    if (choice.markerOutput < DeviceChoice::earCount) choice.markerOutput = -1;
    std::vector<std::size_t> withoutOutput;
    Mix mix = model.mix();
    for (std::size_t j = 0; j < mix.strips.size(); ++j) {
        mix.strips[j].output = headphoneOutput(j);
        if (headphoneOutput(j) < 0) withoutOutput.push_back(j);
    }
    mix.levelDb = std::min(mix.levelDb, defaultContactDb);
    if (mix.levelDb != model.mix().levelDb || // otherwise an undo step would change nothing
        !std::ranges::equal(mix.strips, model.mix().strips, {}, &Strip::output, &Strip::output))
        model.edit("Headphones", mix);
    auto error = model.open(choice);
    reportNoHeadphoneOutput(model, withoutOutput);
    return error;
}

void restoreOutputs(const DeviceChoice& choice, int outputCount, std::span<Strip> strips, std::size_t first) {
    const auto& oldOutputs = choice.outputsBeforeHeadphones;
    std::vector<std::size_t> headphoneStrips;
    for (std::size_t j = first; j < strips.size(); ++j)
        if (strips[j].output == headphoneOutput(j)) headphoneStrips.push_back(j), strips[j].output = -1;
    for (const std::size_t j : headphoneStrips)
        if (j >= oldOutputs.size()) // the strip was added meanwhile
            strips[j].output = freeOutput(strips, choice.reservedOutputs(), outputCount);
        else if (oldOutputs[j] < outputCount &&
                 std::ranges::find(strips, oldOutputs[j], &Strip::output) == strips.end())
            strips[j].output = std::max(-1, oldOutputs[j]);
}

void leaveHeadphones(MixerModel& model, const DeviceChoice& headphones) {
    const int outputCount = model.device().outputCount() > 0 ? model.device().outputCount() : maxStripOutputs;
    Mix mix = model.mix();
    restoreOutputs(headphones, outputCount, mix.strips);
    if (!std::ranges::equal(mix.strips, model.mix().strips, {}, &Strip::output, &Strip::output))
        model.edit("Outputs as before headphones", mix);
}

void reportNoOutput(MixerModel& model, const std::vector<std::size_t>& strips) {
    if (strips.empty()) return;
    const bool isSingle = strips.size() == 1;
    model.messages().add(
        {joinLabels(model, strips) + (isSingle ? " has no output: another actuator has it"
                                               : " have no outputs: other actuators have them"),
         false,
         {isSingle ? "Give a free output" : "Give free outputs",
          [&model, strips] { assignFreeOutputs(model, strips); }},
         noOutputLabel});
}

void MixerExposure::setLayout(const LayoutDescription& layout) {
    update();
    fullScaleG_.fill(0.0);
    std::ranges::transform(layout.actuators, fullScaleG_.begin(), &ActuatorDescription::fullScaleG);
}

void MixerExposure::update() {
    const ExposureSums& latest = output_.exposure();
    for (std::size_t j = 0; j < fullScaleG_.size(); ++j)
        squareGSeconds_ += (latest.weighted[j] - lastSums_.weighted[j]) * fullScaleG_[j] * fullScaleG_[j];
    lastSums_ = latest;
}

void MixerSignals::setRate(int sampleRateHz) {
    scope_.setRate(sampleRateHz);
    spectrum_.setRate(sampleRateHz);
    sampleRateHz_ = std::max(1, sampleRateHz);
}

// The time advances by frames; a larger difference, from lost frames, is corrected.
void MixerSignals::setSceneTime(std::size_t runNumber, double seconds, int slowness) {
    constexpr double maxDriftSeconds = 0.1;
    if (runNumber != run_.runNumber()) run_.begin(runNumber);
    sceneSecondsPerFrame_ = slowness > 0 && seconds >= 0.0 ? 1.0 / slowness / sampleRateHz_ : 0.0;
    if (std::abs(seconds - run_.seconds()) > maxDriftSeconds) run_.seek(seconds);
}

float MixerSignals::updatePeaks(MixerSnapshot& snapshot, int actuators, const PlayedFlags& isPlayed) {
    const double timeMs = nowMs(), passedMs = std::min(1000.0, timeMs - readAtMs_);
    readAtMs_ = timeMs;
    const auto decay = static_cast<float>(std::pow(10.0, -meterFallDbPerSecond * passedMs / 20'000.0));
    for (std::size_t j = 0; j < isPlayed.size(); ++j) {
        float& peak = snapshot.meters.peaks[j];
        peak = !isPlayed[j] || peak * decay < 1e-4f ? 0.0f : peak * decay;
        if (!isPlayed[j]) snapshot.heldPeaks[j] = 0.0f;
    }
    tap_.read([&](const float* const* block, int frames) {
        zeros_.resize(std::max(zeros_.size(), static_cast<std::size_t>(frames)));
        std::array<const float*, limits::maxActuators> channels{};
        for (std::size_t j = 0; j < static_cast<std::size_t>(actuators); ++j)
            channels[j] = isPlayed[j] ? block[j] : zeros_.data();
        addBlock(channels.data(), frames, snapshot, actuators);
    });
    float maxPeak = 0.0f;
    for (std::size_t j = 0; j < static_cast<std::size_t>(actuators); ++j) {
        const float peak = snapshot.meters.peaks[j];
        if (peak >= snapshot.heldPeaks[j] || timeMs - heldAtMs_[j] > peakHoldMs)
            snapshot.heldPeaks[j] = peak, heldAtMs_[j] = timeMs;
        maxPeak = std::max(maxPeak, peak);
    }
    return maxPeak;
}

// The samples precede the master gain, so the traces go on while the output is muted.
void MixerSignals::addBlock(const float* const* block, int frames, MixerSnapshot& snapshot, int actuators) {
    scope_.add(block, actuators, frames);
    spectrum_.add(block, actuators, frames);
    if (sceneSecondsPerFrame_ > 0.0) run_.add(block, actuators, frames, frames * sceneSecondsPerFrame_);
    for (int j = 0; j < actuators; ++j) {
        const auto range = juce::FloatVectorOperations::findMinAndMax(block[j], frames);
        auto& peak = nth(snapshot.meters.peaks, j);
        peak = std::max({peak, -range.getStart(), range.getEnd()});
    }
}

void SpectrumTrace::setRate(int sampleRateHz) {
    framesPerSample_ = std::max(1, sampleRateHz / minRateHz);
    rateHz_ = static_cast<double>(std::max(1, sampleRateHz)) / framesPerSample_;
    lanes_.assign(limits::maxActuators, {std::vector<float>(windowSize), 0.0f});
    writeIndex_ = framesSummed_ = 0;
}

// Decimates by averaging consecutive frames.
void SpectrumTrace::add(const float* const* channels, int channelCount, int frames) {
    for (int done = 0; done < frames;) {
        const int part = std::min(frames - done, framesPerSample_ - framesSummed_);
        const bool isFull = framesSummed_ + part == framesPerSample_;
        for (std::size_t j = 0; j < static_cast<std::size_t>(channelCount); ++j) {
            Lane& lane = lanes_[j];
            for (int k = done; k < done + part; ++k) lane.sum += channels[j][k];
            if (isFull)
                nth(lane.ring, writeIndex_) =
                    std::exchange(lane.sum, 0.0f) / static_cast<float>(framesPerSample_);
        }
        done += part;
        framesSummed_ = isFull ? 0 : framesSummed_ + part;
        if (isFull) writeIndex_ = (writeIndex_ + 1) % windowSize;
    }
}

std::vector<double> SpectrumTrace::windowSamples(int channel) const {
    const auto& ring = nth(lanes_, channel).ring;
    if (std::ranges::all_of(ring, [](float x) { return std::abs(x) < 1e-4f; })) return {};
    std::vector<double> samples(ring.begin() + writeIndex_, ring.end());
    samples.insert(samples.end(), ring.begin(), ring.begin() + writeIndex_);
    return samples;
}

} // namespace physvib
