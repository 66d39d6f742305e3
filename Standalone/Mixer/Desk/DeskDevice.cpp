// SPDX-License-Identifier: GPL-3.0-or-later
// Opening, and looking after what may go and come back.
#include "Mixer/Desk/DeskDevice.h"
#include "Mixer/Desk/DeskWords.h"
#include <utility>

namespace physvib {

namespace {

constexpr double maintainMs = 1000.0, padPatienceMs = 3000.0; // by Bluetooth one takes a second to come

} // namespace

std::string DeskDevice::open(const DeviceChoice& choice) {
    AudioOutputSettings settings{
        choice.name,  outputMap(), choice.sampleRateHz, choice.blockFrames, masterGain(mix_),
        mix_.count(), true,        listening_.least()};
    const auto error = output_.open(settings);
    choice_ = choice;
    listening_.hearWanted();
    trouble_ = utf8(error);
    return error;
}

std::vector<int> DeskDevice::outputMap() const {
    std::vector<int> map;
    for (const Strip& strip : mix_.strips) map.push_back(strip.output);
    return map;
}

std::string DeskDevice::assign() {
    output_.hear(listening_.least()); // hands first: an enchanter may come where somebody listens
    auto error = output_.assign(outputMap(), mix_.count());
    listening_.hearWanted();
    return error;
}

void DeskDevice::connectBoard(const std::string& port) {
    if (port.empty()) return;
    board_ = std::make_unique<DeskBoard>(port, mix_.panner());
    session_.sinks().attach(board_->sink());
}

void DeskDevice::close() {
    session_.sinks().follow(nullptr);
    output_.close();
    if (board_) session_.sinks().detach(board_->sink());
    board_.reset();
    if (pad_) session_.sinks().detach(*pad_);
    pad_.reset();
}

void DeskDevice::connectPad(const std::string& name) {
    if (name.empty()) return;
    pad_ = std::make_unique<PadOutput>(name, mix_.panner());
    padWantedAtMs_ = nowMs();
    session_.sinks().attach(*pad_);
}

juce::String DeskDevice::padTrouble() const {
    if (!pad_ || nowMs() - padWantedAtMs_ < padPatienceMs) return {};
    return utf8(pad_->state().trouble);
}

void DeskDevice::maintain() {
    const double now = nowMs();
    if (now - maintainedAtMs_ <= maintainMs) return;
    maintainedAtMs_ = now;
    listening_.hearWanted(); // the device may have gone, or may be back
    trouble_ = utf8(output_.maintain());
}

juce::String DeskDevice::trouble() {
    juce::StringArray all{trouble_, board_ ? board_->trouble() : juce::String{}, padTrouble()};
    all.removeEmptyStrings();
    return all.joinIntoString("; ");
}

} // namespace physvib
