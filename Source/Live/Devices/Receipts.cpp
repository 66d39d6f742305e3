// SPDX-License-Identifier: MIT
// Writes receipts into the ring, and sums up those of a span.
#include "Live/Devices/Receipts.h"
#include "Core/ClockLaw.h"
#include <algorithm>
#include <utility>

namespace physvib {

namespace {

std::uint64_t measure(const float* const* outputs, std::size_t count, std::size_t first, std::size_t frames,
                      MeasuredLanes* to) {
    std::uint64_t absent = 0;
    for (std::size_t j = 0; j < count; ++j) {
        if (outputs[j] == nullptr)
            absent |= std::uint64_t{1} << j;
        else
            for (std::size_t n = first; n < first + frames; ++n) to[j].take(outputs[j][n]);
    }
    return absent;
}
void join(MeasuredLanes* of, std::size_t count, Measured* all) {
    for (std::size_t j = 0; j < count; ++j) {
        all[j] = {of[j].peaks[0], of[j].squares[0]};
        of[j] = {};
    }
}
static_assert(limits::maxEnchanters <= 64, "a bit for each");

} // namespace

Receipts::Receipts(int actuators)
    : count_{static_cast<std::size_t>(actuators)}
    , bins_{std::make_unique<Bin[]>(static_cast<std::size_t>(mostBins))}
    , levels_{std::make_unique<Level[]>(static_cast<std::size_t>(mostBins) * count_)}
    , totals_{std::make_unique<SharedTotal[]>(count_)} {
    const TileKernel* const best = tileKernel(InstructionSet::best);
    measure_ = best != nullptr ? best->measure : measure;
    join_ = best != nullptr ? best->join : join;
}

void Receipts::expect(std::int64_t fromNs, std::int64_t untilNs) noexcept {
    fromNs_.store(std::clamp<std::int64_t>(fromNs, 0, limits::maxTimeNs), std::memory_order_relaxed);
    untilNs_.store(std::clamp<std::int64_t>(untilNs, 0, limits::maxTimeNs), std::memory_order_relaxed);
}

// Sets the end of the open bin: the next multiple of 10 ms, or an expected time before it.
void Receipts::setEdge() noexcept {
    const std::int64_t bin = std::max(1, open_.rate / binsPerSecond), at = open_.end(), over = at % bin;
    if (isExpectedAnew() || open_.rate != edgeRate_) {
        edgeFromNs_ = fromNs_.load(std::memory_order_relaxed);
        edgeUntilNs_ = untilNs_.load(std::memory_order_relaxed);
        edgeRate_ = open_.rate;
        const FrameClock clock{open_.rate};
        expected_ = {clock.at(edgeFromNs_).frame, clock.at(edgeUntilNs_).frame};
    }
    edge_ = at - over + (over < 0 ? 0 : bin);
    for (const std::int64_t frame : expected_)
        if (frame > at) edge_ = std::min(edge_, frame);
}

void Receipts::take(std::uint32_t session, std::int64_t place, int sampleRateHz, const float* const* outputs,
                    int frames) noexcept PHYSVIB_NONBLOCKING {
    const bool keepGoing = open_.session == session && open_.rate == sampleRateHz &&
                           open_.opening == opening_ && open_.end() == place;
    if (!keepGoing) {
        publish();
        open_ = {place, 0, sampleRateHz, session, opening_};
        setEdge();
    } else if (isExpectedAnew()) {
        setEdge();
    }
    for (int done = 0; done < frames;) {
        const auto part = static_cast<int>(std::min<std::int64_t>(edge_ - open_.end(), frames - done));
        absent_ |= measure_(outputs, count_, static_cast<std::size_t>(done), static_cast<std::size_t>(part),
                            growing_.data());
        open_.frames += part;
        done += part;
        if (open_.end() == edge_) publish();
    }
}

// Publishes the open bin to readers, and begins the next one at its end.
void Receipts::publish() noexcept {
    if (open_.frames == 0) return;
    const std::int64_t now = written_.load(std::memory_order_relaxed);
    Bin& bin = bins_[static_cast<std::size_t>(now % mostBins)];
    bin.start.store(open_.start, std::memory_order_release);
    bin.frames.store(open_.frames, std::memory_order_release);
    bin.rate.store(open_.rate, std::memory_order_release);
    bin.session.store(open_.session, std::memory_order_release);
    bin.opening.store(open_.opening, std::memory_order_release);
    const double seconds = static_cast<double>(open_.frames) / open_.rate;
    join_(growing_.data(), count_, joined_.data());
    Level* level = &this->level(now, 0);
    for (std::size_t j = 0; j < count_; ++j, ++level) {
        const auto [peak, squares] = joined_[j];
        const bool hasOutput = (absent_ >> j & 1) == 0;
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
    absent_ = 0;
    written_.store(now + 1, std::memory_order_release);
    open_.start = open_.end();
    open_.frames = 0;
    setEdge();
}

Receipts::Total Receipts::all(int actuator) const noexcept {
    if (actuator < 0 || std::cmp_greater_equal(actuator, count_)) return {};
    const SharedTotal& total = totals_[static_cast<std::size_t>(actuator)];
    return {total.seconds.load(std::memory_order_relaxed),
            static_cast<double>(total.peak.load(std::memory_order_relaxed))};
}

// False if the bin has been overwritten meanwhile.
bool Receipts::read(std::int64_t number, Place& place) const noexcept {
    const Bin& bin = bins_[static_cast<std::size_t>(number % mostBins)];
    place = {bin.start.load(std::memory_order_acquire), bin.frames.load(std::memory_order_acquire),
             bin.rate.load(std::memory_order_acquire), bin.session.load(std::memory_order_acquire),
             bin.opening.load(std::memory_order_acquire)};
    return written_.load(std::memory_order_acquire) < number + mostBins;
}

bool Receipts::read(std::int64_t number, int actuator, Measured& sum) const noexcept {
    const Level& at = level(number, actuator);
    sum = {at.peak.load(std::memory_order_acquire), at.squares.load(std::memory_order_acquire)};
    return written_.load(std::memory_order_acquire) < number + mostBins;
}

// Sums up bins from the newest one back to the one in which the span begins.
Receipt Receipts::left(std::int64_t fromNs, std::int64_t untilNs, int actuator,
                       std::uint32_t session) const noexcept {
    Receipt all;
    fromNs = std::clamp<std::int64_t>(fromNs, 0, limits::maxTimeNs);
    untilNs = std::clamp<std::int64_t>(untilNs, 0, limits::maxTimeNs);
    if (actuator < 0 || std::cmp_greater_equal(actuator, count_)) return all;
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
        Measured sum;
        if (!read(number, actuator, sum)) break;
        const bool isNewest = nextNumber < 0;
        isWhole = isWhole && sum.peak >= 0.0f &&
                  (isNewest ? place.end() >= last
                            : nextNumber == number + 1 && next.opening == place.opening &&
                                  next.start == place.end());
        if (isNewest) {
            all.opening = place.opening;
            all.endNs = place.end() / place.rate * 1'000'000'000 +
                        place.end() % place.rate * 1'000'000'000 / place.rate;
        }
        if (sum.peak >= 0.0f) {
            all.frames += place.frames;
            all.peak = std::max(all.peak, static_cast<double>(sum.peak));
            squares += static_cast<double>(sum.squares);
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
