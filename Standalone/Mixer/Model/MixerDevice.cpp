// SPDX-License-Identifier: GPL-3.0-or-later
// Opens the device, checks devices that may disappear and return, and reports strips without an output.
// Computes falling peaks, held peaks, and the decimated samples of the spectrum.
#include "Mixer/Model/MixerDevice.h"
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Model/MixerModel.h"
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {

namespace {

constexpr double maintainMs = 1000.0;

bool isWithout(const Mix& mix, std::size_t strip) {
    return strip < mix.strips.size() && mix.strips[strip].output < 0;
}

juce::String labelsOf(const MixerModel& model, const std::vector<std::size_t>& strips) {
    juce::StringArray labels;
    for (const std::size_t j : strips) labels.add(labelOf(model.mix(), j));
    return labels.joinIntoString(", ");
}

void giveFreeOutputs(MixerModel& model, const std::vector<std::size_t>& strips) {
    const auto inUse = model.device().choice().inUse();
    const int outputs = model.device().outputs() > 0 ? model.device().outputs() : mostStripOutputs;
    model.change("Free outputs", [&](Mix& mix) {
        for (const std::size_t j : strips)
            if (isWithout(mix, j)) mix.strips[j].output = freeOutput(mix.strips, inUse, outputs);
    });
    if (std::ranges::any_of(strips, [&](std::size_t j) { return isWithout(model.mix(), j); }))
        model.report("The device has no other free output");
}

int earOf(std::size_t strip) { return strip < DeviceChoice::ears ? static_cast<int>(strip) : -1; }

constexpr double holdMs = 1500.0;

} // namespace

std::string MixerDevice::open(const DeviceChoice& choice) {
    AudioOutputSettings settings{
        choice.name,  outputMap(), choice.sampleRateHz,     choice.blockFrames, masterGain(mix_),
        mix_.count(), true,        listening_.ofStudyOnly()};
    const auto error = rig_.openDevice(settings);
    choice_ = choice;
    listening_.hearWanted();
    return error;
}

bool MixerDevice::isNone() const { return rig_.output().device().starts_with(noDeviceType); }

bool MixerDevice::isPlayed(std::size_t actuator) const {
    if (!choice_.sinks.empty() || isNone()) return true;
    const int output = mix_.strips[actuator].output;
    return output >= 0 && (output < outputs() || outputs() == 0); // a device that is gone may come back
}

std::vector<int> MixerDevice::outputMap() const {
    std::vector<int> map;
    for (const Strip& strip : mix_.strips) map.push_back(strip.output);
    return map;
}

std::string MixerDevice::assign() {
    rig_.output().hear(listening_.ofStudyOnly()); // first, as an actuator may get a monitor output
    auto error = rig_.output().assign(outputMap(), mix_.count());
    listening_.hearWanted();
    return error;
}

juce::String MixerDevice::withoutClips() const {
    for (const SinkState& sink : rig_.sinkStates())
        if (!sink.playsClips) return utf8(sink.name);
    return {};
}

void MixerDevice::maintain() {
    const double now = nowMs();
    if (now - maintainedAtMs_ <= maintainMs && coversSinks(rig_.session())) return;
    maintainedAtMs_ = now;
    listening_.hearWanted(); // the device may have disappeared or returned
    rig_.maintain();
}

juce::String MixerDevice::trouble() const {
    const auto all = rig_.troubles();
    return all.empty() ? juce::String{} : utf8(all.front().words);
}

bool MixerListening::isFree(int output) const {
    return output >= 0 && output < output_.deviceOutputs() &&
           std::ranges::find(mix_.strips, output, &Strip::output) == mix_.strips.end();
}

// Audio outputs must never prevent the haptic output: outputs that the device lacks are not requested.
ListeningSettings MixerListening::wanted() const {
    ListeningSettings wanted = ofStudy_.value_or(ListeningSettings{});
    if (!ofStudy_ && std::ranges::all_of(choice_.monitor, [this](int output) { return isFree(output); }))
        wanted.contacts = choice_.monitor;
    wanted.contactDb = choice_.monitorDb;
    const auto has = [&](const std::vector<int>& those) {
        return std::ranges::find(those, choice_.marker) != those.end();
    };
    if (isFree(choice_.marker) && !has(wanted.noise) && !has(wanted.contacts))
        wanted.marks = {choice_.marker};
    return wanted;
}

std::string MixerListening::hearWanted() {
    const auto wanted = this->wanted();
    if (wanted == sent_) return {};
    auto error = output_.hear(wanted);
    if (error.empty()) sent_ = wanted;
    return error;
}

std::string MixerListening::hear(const ListeningSettings& ofStudy) {
    const auto before = std::exchange(ofStudy_, ofStudy);
    auto error = hearWanted();
    if (!error.empty()) ofStudy_ = before;
    return error;
}

void MixerListening::endStudy() {
    ofStudy_.reset();
    hearWanted();
}

std::string MixerListening::listen(const ListeningSettings& wanted, const DeviceChoice& choice) {
    if (auto error = output_.hear(wanted); !error.empty()) return error;
    sent_ = wanted;
    choice_ = choice;
    onChange_();
    return {};
}

std::string MixerListening::monitor(std::vector<int> outputs, double db) {
    auto wanted = sent_;
    auto choice = choice_;
    wanted.contacts = choice.monitor = std::move(outputs);
    wanted.contactDb = choice.monitorDb = db;
    return listen(wanted, choice);
}

std::string MixerListening::mark(int output) {
    auto wanted = sent_;
    auto choice = choice_;
    choice.marker = output;
    wanted.marks = output < 0 ? std::vector<int>{} : std::vector{output};
    return listen(wanted, choice);
}

void showPlayedOutputs(const std::vector<int>& played, std::span<Strip> strips) {
    for (std::size_t j = 0; j < strips.size(); ++j) strips[j].output = j < played.size() ? played[j] : -1;
}

std::vector<std::size_t> placeNew(const DeviceChoice& choice, std::span<Strip> strips, std::size_t first) {
    std::vector<std::size_t> without;
    const auto inUse = choice.inUse();
    const int outputs = choice.isHeadphones ? DeviceChoice::ears : mostStripOutputs;
    for (std::size_t j = first; j < strips.size(); ++j) {
        int& output = strips[j].output;
        if (output < 0 || (output < outputs && std::ranges::find(inUse, output) == inUse.end())) continue;
        output = freeOutput(strips, inUse, outputs);
        if (output < 0) without.push_back(j);
    }
    return without;
}

void fitLayoutTo(int outputs, Mix& mix, std::string_view device) {
    const bool isFirst = mix.layout.name == MixerModel::firstMix().layout.name; // nobody has chosen it
    if (mix.count() <= outputs && !(isPico(device) && isFirst)) return;
    mix.layout = presetLayout(layoutFor(outputs, device), mix.layout.enchanters);
    mix.resizeStrips();
}

void reportNoEar(MixerModel& model, const std::vector<std::size_t>& strips) {
    if (strips.empty()) return;
    model.messages().add(
        {labelsOf(model, strips) + (strips.size() == 1 ? " has no output: " : " have no output: ") +
             "headphones have two, L and R",
         false,
         {"Use two",
          [&model] {
              model.change("Two actuators", [](Mix& mix) { fitLayoutTo(DeviceChoice::ears, mix); });
          }},
         noEarLabel});
}

std::string useHeadphones(MixerModel& model, DeviceChoice choice, std::optional<std::vector<int>> before) {
    if (!model.device().choice().isHeadphones)
        choice.beforeEars = before ? std::move(*before) : model.device().outputMap();
    choice.isHeadphones = true;
    choice.monitor.clear();
    if (choice.marker < DeviceChoice::ears) choice.marker = -1;
    std::vector<std::size_t> others;
    Mix mix = model.mix();
    for (std::size_t j = 0; j < mix.strips.size(); ++j) {
        mix.strips[j].output = earOf(j);
        if (earOf(j) < 0) others.push_back(j);
    }
    mix.levelDb = std::min(mix.levelDb, safeContactDb);
    if (mix.levelDb != model.mix().levelDb || // else a step of undo would show nothing
        !std::ranges::equal(mix.strips, model.mix().strips, {}, &Strip::output, &Strip::output))
        model.edit("Headphones", mix);
    auto error = model.open(choice);
    reportNoEar(model, others);
    return error;
}

void takeOffHeadphones(const DeviceChoice& choice, int outputs, std::span<Strip> strips, std::size_t first) {
    const auto& before = choice.beforeEars;
    std::vector<std::size_t> as;
    for (std::size_t j = first; j < strips.size(); ++j)
        if (strips[j].output == earOf(j)) as.push_back(j), strips[j].output = -1;
    for (const std::size_t j : as)
        if (j >= before.size()) // it has come meanwhile
            strips[j].output = freeOutput(strips, choice.inUse(), outputs);
        else if (before[j] < outputs && std::ranges::find(strips, before[j], &Strip::output) == strips.end())
            strips[j].output = std::max(-1, before[j]);
}

void leaveHeadphones(MixerModel& model, const DeviceChoice& ears) {
    const int there = model.device().outputs() > 0 ? model.device().outputs() : mostStripOutputs;
    Mix mix = model.mix();
    takeOffHeadphones(ears, there, mix.strips);
    if (!std::ranges::equal(mix.strips, model.mix().strips, {}, &Strip::output, &Strip::output))
        model.edit("Outputs as before headphones", mix);
}

void reportWithout(MixerModel& model, const std::vector<std::size_t>& strips) {
    if (strips.empty()) return;
    const bool isOne = strips.size() == 1;
    model.messages().add({labelsOf(model, strips) + (isOne ? " has no output: another actuator has it"
                                                           : " have no outputs: other actuators have them"),
                          false,
                          {isOne ? "Give a free output" : "Give free outputs",
                           [&model, strips] { giveFreeOutputs(model, strips); }},
                          noOutputLabel});
}

void MixerExposure::use(const LayoutDescription& layout) {
    update();
    fullScaleG_.fill(0.0);
    std::ranges::transform(layout.enchanters, fullScaleG_.begin(), &EnchanterDescription::fullScaleG);
}

void MixerExposure::update() {
    const ExposureSums& now = output_.exposure();
    for (std::size_t j = 0; j < fullScaleG_.size(); ++j)
        squareGSeconds_ += (now.weighted[j] - sums_.weighted[j]) * fullScaleG_[j] * fullScaleG_[j];
    sums_ = now;
}

void MixerSignals::setRate(int sampleRateHz) {
    scope_.setRate(sampleRateHz);
    spectrum_.setRate(sampleRateHz);
    sampleRateHz_ = std::max(1, sampleRateHz);
}

// Time advances by frames; differences from lost frames are corrected.
void MixerSignals::follow(std::size_t run, double seconds, int slowness) {
    constexpr double maxOffSeconds = 0.1;
    if (run != run_.run()) run_.begin(run);
    scenePerFrame_ = slowness > 0 && seconds >= 0.0 ? 1.0 / slowness / sampleRateHz_ : 0.0;
    if (std::abs(seconds - run_.seconds()) > maxOffSeconds) run_.moveTo(seconds);
}

float MixerSignals::read(MixerMoment& moment, int enchanters, const Played& played) {
    const double now = nowMs(), passed = std::min(1000.0, now - readAtMs_);
    readAtMs_ = now;
    const auto fall = static_cast<float>(std::pow(10.0, -meterFallDbPerSecond * passed / 20'000.0));
    for (std::size_t j = 0; j < played.size(); ++j) {
        float& peak = moment.meters.peaks[j];
        peak = !played[j] || peak * fall < 1e-4f ? 0.0f : peak * fall;
        if (!played[j]) moment.holds[j] = 0.0f;
    }
    tap_.read([&](const float* const* block, int frames) {
        zeros_.resize(std::max(zeros_.size(), static_cast<std::size_t>(frames)));
        std::array<const float*, limits::maxEnchanters> shown{};
        for (std::size_t j = 0; j < static_cast<std::size_t>(enchanters); ++j)
            shown[j] = played[j] ? block[j] : zeros_.data();
        measure(shown.data(), frames, moment, enchanters);
    });
    float loudest = 0.0f;
    for (std::size_t j = 0; j < static_cast<std::size_t>(enchanters); ++j) {
        const float peak = moment.meters.peaks[j];
        if (peak >= moment.holds[j] || now - heldAtMs_[j] > holdMs)
            moment.holds[j] = peak, heldAtMs_[j] = now;
        loudest = std::max(loudest, peak);
    }
    return loudest;
}

// The samples are those before the master gain, so they are there while the output is silenced.
void MixerSignals::measure(const float* const* block, int frames, MixerMoment& moment, int enchanters) {
    scope_.add(block, enchanters, frames);
    spectrum_.add(block, enchanters, frames);
    if (scenePerFrame_ > 0.0) run_.add(block, enchanters, frames, frames * scenePerFrame_);
    for (int j = 0; j < enchanters; ++j) {
        const auto range = juce::FloatVectorOperations::findMinAndMax(block[j], frames);
        auto& peak = nth(moment.meters.peaks, j);
        peak = std::max({peak, -range.getStart(), range.getEnd()});
    }
}

void SpectrumTrace::setRate(int sampleRateHz) {
    framesPerSample_ = std::max(1, sampleRateHz / keptRateHz);
    keptRateHz_ = static_cast<double>(std::max(1, sampleRateHz)) / framesPerSample_;
    lanes_.assign(limits::maxEnchanters, {std::vector<float>(window), 0.0f});
    newest_ = summed_ = 0;
}

// Decimates by averaging consecutive frames.
void SpectrumTrace::add(const float* const* channels, int count, int frames) {
    for (int done = 0; done < frames;) {
        const int part = std::min(frames - done, framesPerSample_ - summed_);
        const bool isFull = summed_ + part == framesPerSample_;
        for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
            Lane& lane = lanes_[j];
            for (int k = done; k < done + part; ++k) lane.sum += channels[j][k];
            if (isFull)
                nth(lane.kept, newest_) =
                    std::exchange(lane.sum, 0.0f) / static_cast<float>(framesPerSample_);
        }
        done += part;
        summed_ = isFull ? 0 : summed_ + part;
        if (isFull) newest_ = (newest_ + 1) % window;
    }
}

std::vector<double> SpectrumTrace::recent(int channel) const {
    const auto& kept = nth(lanes_, channel).kept;
    if (std::ranges::all_of(kept, [](float x) { return std::abs(x) < 1e-4f; })) return {};
    std::vector<double> samples(kept.begin() + newest_, kept.end());
    samples.insert(samples.end(), kept.begin(), kept.begin() + newest_);
    return samples;
}

} // namespace physvib
