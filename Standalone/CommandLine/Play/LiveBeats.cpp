// SPDX-License-Identifier: GPL-3.0-or-later
// Feeds audio input to the beat detector, and converts its frames to session time.
#include "CommandLine/Play/LiveBeats.h"
#include <chrono>
#include <cstdlib>
#include <vector>

namespace physvib {
namespace {

constexpr std::chrono::milliseconds pause{1};
constexpr std::int64_t nsPerSecond = 1'000'000'000;

std::int64_t nsOf(std::int64_t frames, int rateHz) {
    return frames / rateHz * nsPerSecond + frames % rateHz * nsPerSecond / rateHz;
}

} // namespace

LiveBeats::LiveBeats(Session& session, InputTap& inputs, const BeatVoices& voices, double sensitivity)
    : session_{session}
    , inputs_{inputs}
    , voices_{voices}
    , sensitivity_{sensitivity}
    , thread_{[this] { run(); }} {}

LiveBeats::~LiveBeats() {
    stop_ = true;
    thread_.join();
}

void LiveBeats::run() {
    HeardPiece piece;
    while (!stop_) {
        while (inputs_.next(piece)) take(piece);
        std::this_thread::sleep_for(pause);
    }
}

// Restarts the detector if session time jumps, because input was lost or the device returned.
void LiveBeats::take(const HeardPiece& piece) {
    const std::int64_t expectedNs = beginNs_ + (detector_ ? nsOf(heardFrames_, rateHz_) : 0);
    if (!detector_ || piece.rateHz != rateHz_ ||
        std::abs(piece.sessionNs - expectedNs) > nsPerSecond / piece.rateHz)
        begin(piece);
    heardFrames_ += piece.count;
    detector_->take(piece.sound(), [this](const BandOnset& onset) { strike(onset); });
}

void LiveBeats::begin(const HeardPiece& piece) {
    if (!detector_ || piece.rateHz != rateHz_)
        detector_ = std::make_unique<BeatDetector>(piece.rateHz, sensitivity_);
    else
        detector_->reset();
    rateHz_ = piece.rateHz;
    beginNs_ = piece.sessionNs;
    heardFrames_ = 0;
}

void LiveBeats::strike(const BandOnset& onset) {
    const PhantomPanner panner = session_.panner();
    std::vector<CollisionEvent> strikes;
    strikeBeat(onset, beginNs_ + nsOf(onset.frame, rateHz_), voices_, panner.layout(),
               panner.fieldWidthMetres(), panner.fieldHeightMetres(),
               [&](const CollisionEvent& e) { strikes.push_back(e); });
    if (session_.take({Strikes{strikes}, 0})) ++beats_;
}

} // namespace physvib
