// SPDX-License-Identifier: MIT
// Writes receipts into the ring, and sums up those of a span.
#include "Live/Devices/Receipts.h"
#include "Core/ClockLaw.h"
#include "Core/Modes/TileKernels.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

void measure(const float* samples, std::size_t frames, float& peak, double& squares) {
    for (std::size_t n = 0; n < frames; ++n) {
        peak = std::max(peak, std::abs(samples[n]));
        squares += static_cast<double>(samples[n] * samples[n]);
    }
}

} // namespace

Receipts::Receipts(int actuators)
    : actuators_{actuators}
    , bins_{std::make_unique<Bin[]>(static_cast<std::size_t>(mostBins))}
    , levels_{std::make_unique<Level[]>(static_cast<std::size_t>(mostBins * actuators))}
    , totals_{std::make_unique<SharedTotal[]>(static_cast<std::size_t>(actuators))} {
    const TileKernel* const best = tileKernel(InstructionSet::best);
    measure_ = best != nullptr ? best->measure : measure;
}

void Receipts::expect(std::int64_t fromNs, std::int64_t untilNs) noexcept {
    fromNs_.store(std::clamp<std::int64_t>(fromNs, 0, limits::maxTimeNs), std::memory_order_relaxed);
    untilNs_.store(std::clamp<std::int64_t>(untilNs, 0, limits::maxTimeNs), std::memory_order_relaxed);
}

// Frames from `place` on that belong to one bin, at most `frames`.
int Receipts::untilEdge(std::int64_t place, int frames) const noexcept {
    const std::int64_t bin = std::max(1, open_.rate / binsPerSecond);
    std::int64_t edge = place - (place % bin + bin) % bin + bin;
    const FrameClock clock{open_.rate};
    for (const auto* const ns : {&fromNs_, &untilNs_})
        if (const auto at = clock.at(ns->load(std::memory_order_relaxed)).frame; at > place)
            edge = std::min(edge, at);
    return static_cast<int>(std::min<std::int64_t>(edge - place, frames));
}

void Receipts::take(std::uint32_t session, std::int64_t place, int sampleRateHz, const float* const* outputs,
                    int frames) noexcept PHYSVIB_NONBLOCKING {
    const bool keepGoing = open_.session == session && open_.rate == sampleRateHz &&
                           open_.opening == opening_ && open_.end() == place;
    if (!keepGoing) {
        publish();
        open_ = {place, 0, sampleRateHz, session, opening_};
    }
    for (int done = 0; done < frames;) {
        const int part = untilEdge(place + done, frames - done);
        for (int j = 0; j < actuators_; ++j) {
            Sum& sum = sums_[static_cast<std::size_t>(j)];
            if (outputs[j] == nullptr)
                sum.peak = -1.0f;
            else if (sum.peak >= 0.0f)
                measure_(outputs[j] + done, static_cast<std::size_t>(part), sum.peak, sum.squares);
        }
        open_.frames += part;
        done += part;
        if (done < frames || untilEdge(place + done - 1, 2) == 1) publish();
    }
}

// The open bin becomes readable, and the next one begins at its end.
void Receipts::publish() noexcept {
    if (open_.frames > 0) {
        const std::int64_t now = written_.load(std::memory_order_relaxed);
        Bin& bin = bins_[static_cast<std::size_t>(now % mostBins)];
        bin.start.store(open_.start, std::memory_order_release);
        bin.frames.store(open_.frames, std::memory_order_release);
        bin.rate.store(open_.rate, std::memory_order_release);
        bin.session.store(open_.session, std::memory_order_release);
        bin.opening.store(open_.opening, std::memory_order_release);
        for (int j = 0; j < actuators_; ++j) {
            const Sum& sum = sums_[static_cast<std::size_t>(j)];
            level(now, j).peak.store(sum.peak, std::memory_order_release);
            level(now, j).squares.store(static_cast<float>(sum.squares), std::memory_order_release);
            if (sum.peak < 0.0f) continue;
            SharedTotal& total = totals_[static_cast<std::size_t>(j)]; // R is the only one that writes
            total.seconds.store(total.seconds.load(std::memory_order_relaxed) +
                                    static_cast<double>(open_.frames) / open_.rate,
                                std::memory_order_relaxed);
            total.peak.store(
                std::max(total.peak.load(std::memory_order_relaxed), static_cast<double>(sum.peak)),
                std::memory_order_relaxed);
        }
        written_.store(now + 1, std::memory_order_release);
    }
    open_.start = open_.end();
    open_.frames = 0;
    std::fill_n(sums_.begin(), actuators_, Sum{});
}

Receipts::Total Receipts::all(int actuator) const noexcept {
    if (actuator < 0 || actuator >= actuators_) return {};
    const SharedTotal& total = totals_[static_cast<std::size_t>(actuator)];
    return {total.seconds.load(std::memory_order_relaxed), total.peak.load(std::memory_order_relaxed)};
}

// False if the bin has been overwritten meanwhile.
bool Receipts::read(std::int64_t number, Place& place) const noexcept {
    const Bin& bin = bins_[static_cast<std::size_t>(number % mostBins)];
    place = {bin.start.load(std::memory_order_acquire), bin.frames.load(std::memory_order_acquire),
             bin.rate.load(std::memory_order_acquire), bin.session.load(std::memory_order_acquire),
             bin.opening.load(std::memory_order_acquire)};
    return written_.load(std::memory_order_acquire) < number + mostBins;
}

bool Receipts::read(std::int64_t number, int actuator, Sum& sum) const noexcept {
    const Level& at = level(number, actuator);
    sum = {at.peak.load(std::memory_order_acquire),
           static_cast<double>(at.squares.load(std::memory_order_acquire))};
    return written_.load(std::memory_order_acquire) < number + mostBins;
}

// From the newest bin back to the one in which the span begins.
Receipt Receipts::left(std::int64_t fromNs, std::int64_t untilNs, int actuator,
                       std::uint32_t session) const noexcept {
    Receipt all;
    fromNs = std::clamp<std::int64_t>(fromNs, 0, limits::maxTimeNs);
    untilNs = std::clamp<std::int64_t>(untilNs, 0, limits::maxTimeNs);
    if (actuator < 0 || actuator >= actuators_) return all;
    const std::int64_t written = written_.load(std::memory_order_acquire);
    double squares = 0.0;
    bool isWhole = true, isBegun = false;
    Place place, next;
    std::int64_t nextNumber = -1, number = written - 1;
    for (; number >= 0 && !isBegun; --number) {
        if (number <= written - mostBins || !read(number, place)) break;
        if (place.session != session) continue;
        const FrameClock clock{place.rate};
        const std::int64_t first = clock.at(fromNs).frame, last = clock.at(untilNs).frame;
        all.isOver = all.isOver || place.end() >= last;
        isBegun = place.start <= first;
        if (place.start >= last || place.end() <= first) continue;
        Sum sum;
        if (!read(number, actuator, sum)) break;
        const bool isNewest = nextNumber < 0;
        isWhole = isWhole && sum.peak >= 0.0f &&
                  (isNewest ? place.end() >= last
                            : nextNumber == number + 1 && next.opening == place.opening &&
                                  next.start == place.end());
        if (isNewest) all.opening = place.opening;
        if (sum.peak >= 0.0f) {
            all.frames += place.frames;
            all.peak = std::max(all.peak, static_cast<double>(sum.peak));
            squares += sum.squares;
        }
        next = place;
        nextNumber = number;
    }
    all.isKept = isBegun || number < 0;
    all.isRunning =
        isWhole && isBegun && nextNumber >= 0 && next.start <= FrameClock{next.rate}.at(fromNs).frame;
    if (all.frames > 0) all.meanSquare = squares / static_cast<double>(all.frames);
    return all;
}

} // namespace physvib
