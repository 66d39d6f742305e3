// SPDX-License-Identifier: MIT
// Writes receipts into the ring, and sums up those of a span.
#include "Live/Devices/Receipts.h"
#include "Core/ClockLaw.h"
#include <algorithm>
#include <utility>

namespace physvib {

namespace {

std::uint64_t measure(const float* const* outputs, std::size_t count, std::size_t first, std::size_t frames,
                      MeasuredLanes* lanes) {
    std::uint64_t missingOutputs = 0;
    for (std::size_t j = 0; j < count; ++j) {
        if (outputs[j] == nullptr)
            missingOutputs |= std::uint64_t{1} << j;
        else
            for (std::size_t n = first; n < first + frames; ++n) lanes[j].add(outputs[j][n]);
    }
    return missingOutputs;
}
void join(MeasuredLanes* lanes, std::size_t count, Measured* sums) {
    for (std::size_t j = 0; j < count; ++j) {
        sums[j] = {lanes[j].peaks[0], lanes[j].squares[0]};
        lanes[j] = {};
    }
}
static_assert(limits::maxActuators <= 64, "a bit for each");

} // namespace

Receipts::Receipts(int actuators)
    : count_{static_cast<std::size_t>(actuators)}
    , bins_{std::make_unique<Bin[]>(static_cast<std::size_t>(maxBins))}
    , levels_{std::make_unique<Level[]>(static_cast<std::size_t>(maxBins) * count_)}
    , totals_{std::make_unique<SharedTotal[]>(count_)} {
    const TileKernel* const kernel = tileKernel(InstructionSet::best);
    measureLanes_ = kernel != nullptr ? kernel->measure : measure;
    joinLanes_ = kernel != nullptr ? kernel->join : join;
}

void Receipts::alignBinsTo(std::int64_t fromNs, std::int64_t untilNs) noexcept {
    newFromNs_.store(std::clamp<std::int64_t>(fromNs, 0, limits::maxTimeNs), std::memory_order_relaxed);
    newUntilNs_.store(std::clamp<std::int64_t>(untilNs, 0, limits::maxTimeNs), std::memory_order_relaxed);
}

// Sets the end of the open bin: the next multiple of 10 ms, or an expected time before it.
void Receipts::setBinEnd() noexcept {
    const std::int64_t bin = std::max(1, currentBin_.rateHz / binsPerSecond), frame = currentBin_.end(),
                       excess = frame % bin;
    if (hasNewAlignment() || currentBin_.rateHz != alignedRateHz_) {
        alignedFromNs_ = newFromNs_.load(std::memory_order_relaxed);
        alignedUntilNs_ = newUntilNs_.load(std::memory_order_relaxed);
        alignedRateHz_ = currentBin_.rateHz;
        const FrameClock clock{currentBin_.rateHz};
        alignedFrames_ = {clock.at(alignedFromNs_).frame, clock.at(alignedUntilNs_).frame};
    }
    binEndFrame_ = frame - excess + (excess < 0 ? 0 : bin);
    for (const std::int64_t aligned : alignedFrames_)
        if (aligned > frame) binEndFrame_ = std::min(binEndFrame_, aligned);
}

void Receipts::addBlock(std::uint32_t session, std::int64_t startFrame, int sampleRateHz,
                        const float* const* outputs, int frames) noexcept PHYSVIB_NONBLOCKING {
    const bool continuesBin = currentBin_.session == session && currentBin_.rateHz == sampleRateHz &&
                              currentBin_.opening == opening_ && currentBin_.end() == startFrame;
    if (!continuesBin) {
        publish();
        currentBin_ = {startFrame, 0, sampleRateHz, session, opening_};
        setBinEnd();
    } else if (hasNewAlignment()) {
        setBinEnd();
    }
    for (int done = 0; done < frames;) {
        const auto partFrames =
            static_cast<int>(std::min<std::int64_t>(binEndFrame_ - currentBin_.end(), frames - done));
        missingOutputBits_ |= measureLanes_(outputs, count_, static_cast<std::size_t>(done),
                                            static_cast<std::size_t>(partFrames), currentLevels_.data());
        currentBin_.frames += partFrames;
        done += partFrames;
        if (currentBin_.end() == binEndFrame_) publish();
    }
}

// Publishes the open bin to readers, and begins the next one at its end.
void Receipts::publish() noexcept {
    if (currentBin_.frames == 0) return;
    const std::int64_t number = binsWritten_.load(std::memory_order_relaxed);
    Bin& bin = bins_[static_cast<std::size_t>(number % maxBins)];
    bin.start.store(currentBin_.start, std::memory_order_release);
    bin.frames.store(currentBin_.frames, std::memory_order_release);
    bin.rateHz.store(currentBin_.rateHz, std::memory_order_release);
    bin.session.store(currentBin_.session, std::memory_order_release);
    bin.opening.store(currentBin_.opening, std::memory_order_release);
    const double seconds = static_cast<double>(currentBin_.frames) / currentBin_.rateHz;
    joinLanes_(currentLevels_.data(), count_, binLevels_.data());
    Level* level = &this->level(number, 0);
    for (std::size_t j = 0; j < count_; ++j, ++level) {
        const auto [peak, squares] = binLevels_[j];
        const bool hasOutput = (missingOutputBits_ >> j & 1) == 0;
        level->peak.store(hasOutput ? peak : -1.0f, std::memory_order_release);
        level->squares.store(squares, std::memory_order_release);
        if (hasOutput) { // R is the only one that writes these
            SharedTotal& total = totals_[j];
            total.seconds.store(total.seconds.load(std::memory_order_relaxed) + seconds,
                                std::memory_order_relaxed);
            if (total.peak.load(std::memory_order_relaxed) < peak)
                total.peak.store(peak, std::memory_order_relaxed);
        }
    }
    missingOutputBits_ = 0;
    binsWritten_.store(number + 1, std::memory_order_release);
    currentBin_.start = currentBin_.end();
    currentBin_.frames = 0;
    setBinEnd();
}

Receipts::Total Receipts::total(int actuator) const noexcept {
    if (actuator < 0 || std::cmp_greater_equal(actuator, count_)) return {};
    const SharedTotal& total = totals_[static_cast<std::size_t>(actuator)];
    return {total.seconds.load(std::memory_order_relaxed),
            static_cast<double>(total.peak.load(std::memory_order_relaxed))};
}

// False if the bin has been overwritten meanwhile.
bool Receipts::read(std::int64_t number, BinRange& range) const noexcept {
    const Bin& bin = bins_[static_cast<std::size_t>(number % maxBins)];
    range = {bin.start.load(std::memory_order_acquire), bin.frames.load(std::memory_order_acquire),
             bin.rateHz.load(std::memory_order_acquire), bin.session.load(std::memory_order_acquire),
             bin.opening.load(std::memory_order_acquire)};
    return binsWritten_.load(std::memory_order_acquire) < number + maxBins;
}

bool Receipts::read(std::int64_t number, int actuator, Measured& sum) const noexcept {
    const Level& stored = level(number, actuator);
    sum = {stored.peak.load(std::memory_order_acquire), stored.squares.load(std::memory_order_acquire)};
    return binsWritten_.load(std::memory_order_acquire) < number + maxBins;
}

// Sums up bins from the newest one back to the one in which the span begins.
Receipt Receipts::receiptFor(std::int64_t fromNs, std::int64_t untilNs, int actuator,
                             std::uint32_t session) const noexcept {
    Receipt receipt;
    fromNs = std::clamp<std::int64_t>(fromNs, 0, limits::maxTimeNs);
    untilNs = std::clamp<std::int64_t>(untilNs, 0, limits::maxTimeNs);
    if (actuator < 0 || std::cmp_greater_equal(actuator, count_)) return receipt;
    const std::int64_t written = binsWritten_.load(std::memory_order_acquire);
    double squares = 0.0;
    bool isWhole = true, hasStart = false;
    BinRange range, later;
    std::int64_t laterNumber = -1, number = written - 1;
    for (; number >= 0 && !hasStart; --number) {
        if (number <= written - maxBins || !read(number, range)) break;
        if (range.session != session) continue;
        const FrameClock clock{range.rateHz};
        const std::int64_t firstFrame = clock.at(fromNs).frame, endFrame = clock.at(untilNs).frame;
        receipt.hasEnded = receipt.hasEnded || range.end() >= endFrame;
        hasStart = range.start <= firstFrame;
        if (range.start >= endFrame || range.end() <= firstFrame) continue;
        Measured sum;
        if (!read(number, actuator, sum)) break;
        const bool isNewest = laterNumber < 0;
        isWhole = isWhole && sum.peak >= 0.0f &&
                  (isNewest ? range.end() >= endFrame
                            : laterNumber == number + 1 && later.opening == range.opening &&
                                  later.start == range.end());
        if (isNewest) {
            receipt.opening = range.opening;
            receipt.endNs = FrameClock{range.rateHz}.timeNs(range.end());
        }
        if (sum.peak >= 0.0f) {
            receipt.frames += range.frames;
            receipt.peak = std::max(receipt.peak, static_cast<double>(sum.peak));
            squares += static_cast<double>(sum.squares);
        }
        later = range;
        laterNumber = number;
    }
    receipt.isInMemory = hasStart || number < 0;
    receipt.isRunning =
        isWhole && hasStart && laterNumber >= 0 && later.start <= FrameClock{later.rateHz}.at(fromNs).frame;
    if (receipt.frames > 0) receipt.meanSquare = squares / static_cast<double>(receipt.frames);
    return receipt;
}

} // namespace physvib
