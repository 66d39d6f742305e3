// SPDX-License-Identifier: MIT
// Rolling and sliding: an impact per grain that a point passes (LastingContacts); StepRecords matches steps.
#pragma once
#include "Contacts/FacePoints.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/GrainRuns.h"
#include "Contacts/Grains.h"
#include "Contacts/Impact.h"
#include "Contacts/IndexMaps.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace physvib {

/// Matches the records that an engine reports in each step with those of the step before. Engines report
/// contacts in nearly the same order in each step, so a record is first looked for behind the last one found;
/// the lookup by key is needed only for records that are new, gone or reordered. A `Record` has
/// `std::uint64_t key`, not 0, `std::int32_t now`, and `std::int32_t before`, its index in the last step, or
/// `none`. Records are reused without being cleared: the caller sets the other members of a new one.
/// Allocates when a step has more records than any before. One thread at a time.
template <class Record>
class StepRecords {
public:
    static constexpr std::int32_t none = IntegerMap::none;
    /// The index of the record in this step. At the first report in this step it is new: count() grows.
    [[gnu::always_inline]] std::int32_t findOrAdd(std::uint64_t key) {
        Record& before = before_[next_]; // behind the last one: without a key
        if (before.key != key || before.now != none) [[unlikely]]
            return search(key);
        return add(key, before.now, static_cast<std::int32_t>(next_++));
    }

    Record& operator[](std::int32_t index) noexcept { return now_[static_cast<std::size_t>(index)]; }
    const Record& operator[](std::int32_t index) const noexcept {
        return now_[static_cast<std::size_t>(index)];
    }
    const Record& before(std::int32_t index) const noexcept {
        return before_[static_cast<std::size_t>(index)];
    }
    std::span<Record> now() noexcept { return {now_.data(), count_}; }
    std::size_t count() const noexcept { return count_; } ///< records of this step

    /// Ends the step: this step's records become those of the last.
    void endStep() {
        now_[count_].key = 0;
        before_.swap(now_);
        capacity_ = now_.size() - 1;
        countBefore_ = count_;
        clear();
    }

    /// Drops this step's records.
    void dropStep() noexcept {
        for (std::size_t i = 0; i < countBefore_; ++i) before_[i].now = none;
        clear();
    }

    template <class Change>
    void changeAll(Change&& change) noexcept {
        for (Record& record : std::span{before_.data(), countBefore_}) change(record);
        for (Record& record : now()) change(record);
    }

    /// Reserves memory, so that steps with that many records do not allocate.
    void reserve(std::size_t records) {
        before_.resize(std::max(before_.size(), records + 1));
        now_.resize(std::max(now_.size(), records + 1));
        capacity_ = now_.size() - 1;
    }

    void reset() noexcept {
        countBefore_ = 0;
        before_.front().key = 0;
        clear();
    }

private:
    void clear() noexcept {
        count_ = next_ = 0;
        if (indexOfNew_.size() > 0) indexOfNew_.clear();
        isIndexed_ = false;
    }

    [[gnu::always_inline]] std::int32_t add(std::uint64_t key, std::int32_t& now, std::int32_t before) {
        if (count_ == capacity_) grow();
        Record& record = now_[count_];
        record.key = key;
        record.now = none;
        record.before = before;
        return now = static_cast<std::int32_t>(count_++);
    }
    [[gnu::noinline]] void grow() {
        capacity_ = 2 * count_ + 32;
        now_.resize(capacity_ + 1);
    }

    [[gnu::noinline]] std::int32_t search(std::uint64_t key) {
        const std::int32_t before = indexBefore(key);
        if (before != none) {
            std::int32_t& index = before_[static_cast<std::size_t>(before)].now;
            return index != none ? index : add(key, index, before);
        }
        std::int32_t index = indexOfNew_.find(key);
        if (index != none) return index;
        add(key, index, none);
        indexOfNew_.set(key, index);
        return index;
    }
    std::int32_t indexBefore(std::uint64_t key) {
        if (next_ < countBefore_ && before_[next_].key == key) return static_cast<std::int32_t>(next_++);
        // reported again
        if (next_ > 0 && before_[next_ - 1].key == key) return static_cast<std::int32_t>(next_ - 1);
        if (!isIndexed_) indexLast();
        const std::int32_t index = indexOf_.find(key);
        if (index != none) next_ = static_cast<std::size_t>(index) + 1;
        return index;
    }
    void indexLast() {
        indexOf_.clear();
        for (std::size_t i = 0; i < countBefore_; ++i)
            indexOf_.set(before_[i].key, static_cast<std::int32_t>(i));
        isIndexed_ = true;
    }

    std::vector<Record> before_{1}, now_{1};                 // the records, and one without a key
    std::size_t countBefore_ = 0, count_ = 0, capacity_ = 0; // capacity_: of now_
    std::size_t next_ = 0;                                   // in before_
    IntegerMap indexOf_;                                     // keys of before_, built at the first lookup
    bool isIndexed_ = false;
    IntegerMap indexOfNew_; // records of now_ that did not exist in the last step
};

/// Position of a contact point on a surface at the end of a step, in the surface's own frame, and its speed
/// along the surface. A corner that slides keeps its position on its own surface.
struct SurfacePath {
    double metres = 0.0;
    double metresPerSecond = 0.0;
};

/// On the circumference of a disc: `towards` the point, in the disc's frame; that direction turns against the
/// disc at `radiansPerSecond`. Any thread.
inline SurfacePath discPath(float radiusMetres, Vector2 towards, float radiansPerSecond) noexcept {
    return {static_cast<double>(radiusMetres * portable::atan2(towards.y, towards.x)),
            static_cast<double>(radiusMetres * radiansPerSecond)};
}

/// A contact point of two fixtures that continued to touch in a step, as an engine reports it after its
/// solver. Fixtures are slots of the FixtureTable.
struct LastingPoint {
    std::int32_t a = 0, b = 0;
    std::uint64_t feature = 0; ///< identifies the point within the pair; the same from step to step
    double normalNewtonSeconds = 0.0;
    double slipMetresPerSecond = 0.0; ///< of one surface relative to the other
    Vector3 point;                    ///< world, at the end of the step
    Vector3 velocity;                 ///< of the contact point itself
    SurfacePath onA, onB;
};

/// Tracks points from step to step and creates impacts of the grains that they pass, for any engine. A load
/// that is new in this step gives no grains, because it belongs to the collision. Engines move bodies by the
/// velocity at the step's end; under steady acceleration the true path is half a step's change of speed
/// behind that. This path is used, so times are accurate far below a step.
///
/// All methods: world thread (M). After its buffers have grown it does not allocate.
class LastingContacts {
public:
    /// Slower contacts count as resting.
    static constexpr double minMetresPerSecond = 0.01;
    /// More grains per second than this are thinned to every second, fourth, eighth... grain, amplified by
    /// the square root: equal power at bounded cost.
    static constexpr double maxGrainsPerSecond = 2000.0;
    /// Limit for all points together, which are thinned alike, so that a rattling heap has bounded cost.
    static constexpr double maxTotalGrainsPerSecond = 50'000.0;
    static constexpr double longestStepSeconds = 0.1; ///< longer steps are not tracked: the motion within is
                                                      ///< not known

    explicit LastingContacts(const FixtureTable& table);

    /// True if points of this pair are to be reported: a surface is rough, and one is a haptic source.
    bool isRelevant(std::int32_t a, std::int32_t b) const noexcept {
        return isRelevant(table_.traits(a) | table_.traits(b));
    }

    /// isRelevant() from the traits of both fixtures.
    static constexpr bool isRelevant(unsigned traits) noexcept {
        return traits == (FixtureTable::source | FixtureTable::rough);
    }

    bool isRough(std::int32_t slot) const noexcept { return table_.isRough(slot); } ///< else paths are unused

    /// Reports a point after the solver, once per step; repeated reports of a point are ignored.
    void touch(const LastingPoint& point) { touch(point, pairKey(point.a, point.b)); }
    /// touch() for a caller that has the pair's key.
    void touch(const LastingPoint& point, std::uint64_t pairsKey) {
        computePending();
        if (isResolvable(point.onA) && isResolvable(point.onB)) add(point, pairsKey);
    }
    /// Reports a point on a face: the caller fills it in; its motion is computed later, four at once.
    [[gnu::always_inline]] FacePoint& touchFace() {
        if (faceCount_ == faces_.size()) [[unlikely]]
            computePending();
        computeFaces_ = &computeFaces; // a pointer, so that programs without faces do not link it
        return faces_[faceCount_++];
    }
    bool hasReports() const noexcept { return points_.count() > 0 || faceCount_ > 0; }

    /// Reserves memory for the usual number of points; call it when a surface becomes rough.
    void reserve() {
        points_.reserve(24);
        pairs_.reserve(24);
        passages_.resize(std::max<std::size_t>(passages_.size(), 32));
    }

    /// Appends the impacts of the grains that the step's points passed, by point.
    void collect(const StepSpan& span, std::vector<Impact>& impacts);
    /// As collect(), but passes impacts to `maker.add(impact)`, or runs of grains to `maker`, without a list.
    template <class Maker>
    void collectInto(const StepSpan& span, Maker& maker) {
        computePassages(span.seconds());
        if (passageCount_ == 0) return;
        Runs runs;
        runs.seconds = span.seconds();
        runs.backSeconds = 1.5 * runs.seconds;
        runs.perSecond = 1.0 / runs.seconds;
        runs.startNs = span.startNs;
        runs.lengthNs = static_cast<double>(span.endNs - span.startNs);
        for (const Passage& passage : std::span{passages_.data(), passageCount_})
            if (passage.every > 0) pass(passage, span, runs, maker);
        flush(runs, maker);
    }
    void endStep(); ///< After collect(): this step's points become those of the last.

    /// The slot is freed or reassigned: its points count as new.
    void forget(std::int32_t slot);
    void reset() noexcept; ///< Forgets all points.

    /// Grains left out so far by thinning; the remaining ones carry their power.
    std::uint64_t thinned() const noexcept { return thinned_; }

private:
    static constexpr std::size_t maxPoints = 4096; // per step; denser contacts are noise to the touch
    static constexpr double farMetres = 1.0e9;     // beyond it a double cannot resolve grains

    struct TrackedPoint {
        std::uint64_t key = 0;
        std::int32_t now = 0, before = 0, pair = 0; // as StepRecords needs them; index into pairs_
        LastingPoint point;
        std::int32_t gapSurface = 0; // slot of the surface of the gap; none: unknown
        std::uint32_t revision = 0;
        std::int64_t every = 0;
        GrainGap gap; // between two grains of that surface, as of that revision: where the point is
    };
    struct Pair {
        std::uint64_t key = 0;
        std::int32_t now = 0, before = 0;
        double newtonSeconds = 0.0, newtons = 0.0; // impulse and load of all its points in the step
        double steadyShare = 0.0;                  // share of its load that it had in the last step, 0 to 1
    };
    static std::uint64_t keyOf(std::uint64_t pairsKey, std::uint64_t feature) noexcept {
        std::uint64_t key = pairsKey * 0x9E3779B97F4A7C15U + feature;
        key = (key ^ (key >> 31U)) * 0xBF58476D1CE4E5B9U;
        return key != 0 ? key : 1; // IntegerMap excludes key 0
    }
    static bool isResolvable(const SurfacePath& path) noexcept { // false for NaN
        return std::abs(path.metres) < farMetres && std::abs(path.metresPerSecond) < farMetres;
    }
    /// How one point passes along one surface in this step; moveAlong() computes it.
    struct Passage {
        // Before moveAlong(): the paths of the last step (NaN: it is not known) and of this one
        double startMetres, metresPerSecond, metresPerSecond2, endMetres;
        double loadNewtons, grainMetres, grains; // grains: about so many
        double fastest;                          // m/s; below 0: it reverses
        TrackedPoint* tracked;
        std::int32_t surface; // slot
        std::int64_t every;   // 0: the point is at rest
        SurfaceMotion motion(double seconds) const noexcept {
            return {startMetres, metresPerSecond, metresPerSecond2, seconds};
        }
    };

    void computePending() {
        if (faceCount_ > 0) computeFaces_(*this);
    }
    static void computeFaces(LastingContacts& contacts);
    [[gnu::always_inline]] void add(const LastingPoint& point, std::uint64_t pairsKey) {
        if (points_.count() == maxPoints || !(point.normalNewtonSeconds >= 0.0)) return;
        const std::size_t countBefore = points_.count();
        const std::int32_t pointIndex = points_.findOrAdd(keyOf(pairsKey, point.feature));
        if (points_.count() == countBefore) return;
        const std::size_t pairs = pairs_.count();
        const std::int32_t pairIndex = pairs_.findOrAdd(pairsKey);
        Pair& pair = pairs_[pairIndex];
        if (pairs_.count() != pairs) pair.newtonSeconds = 0.0;
        pair.newtonSeconds += point.normalNewtonSeconds;
        TrackedPoint& tracked = points_[pointIndex];
        tracked.pair = pairIndex;
        tracked.point = point;
        tracked.gapSurface = FixtureTable::none;
    }
    void computePassages(double seconds);
    template <SurfacePath LastingPoint::*path>
    [[gnu::always_inline]] void addPassage(TrackedPoint& tracked, std::int32_t surface, double seconds);
    void updateLoad(Pair& pair, double seconds) const noexcept;
    void dropStep() noexcept;
    /// Where the passage's point was between grains of this surface at the end of the last step, if that is
    /// known.
    [[gnu::always_inline]] const GrainGap* gapBefore(const Passage& passage) const noexcept {
        if (passage.tracked->before == StepRecords<TrackedPoint>::none) return nullptr;
        const TrackedPoint& before = points_.before(passage.tracked->before);
        return before.gapSurface == passage.surface && before.every == passage.every &&
                       before.revision == table_.revision()
                   ? &before.gap
                   : nullptr;
    }
    struct Runs : GrainRuns {
        std::int32_t surface = FixtureTable::none, source = FixtureTable::none;
        bool isUsed = false; // the maker accepts these as runs
        Grains grains{0, Texture{1.0}};
    };
    template <class Maker>
    [[gnu::noinline]] static void flush(Runs& runs, Maker& maker);
    template <class Maker>
    [[gnu::noinline]] void begin(const Passage& passage, std::int32_t source, std::int32_t other, Runs& runs,
                                 Maker& maker);
    /// True if the passage ends between the grains where it begins; else that gap, or null.
    [[gnu::always_inline]] bool staysInGap(const Passage& passage, double seconds,
                                           const GrainGap*& gap) noexcept;
    template <class Maker>
    [[gnu::always_inline]] void pass(const Passage& passage, const StepSpan& span, Runs& runs, Maker& maker);
    struct ImpactSink {
        void (*add)(void* dest, const Impact& impact);
        void* dest;
    };
    [[gnu::noinline]] void addGrainImpacts(const Passage& passage, const StepSpan& span, const GrainGap* gap,
                                           ImpactSink sink);

    const FixtureTable& table_;
    std::array<FacePoint, 32> faces_; // reported, not yet computed; so many stay in the first-level cache
    std::size_t faceCount_ = 0;
    void (*computeFaces_)(LastingContacts&) = nullptr;
    StepRecords<TrackedPoint> points_;
    StepRecords<Pair> pairs_;
    std::vector<Passage> passages_; // the first passageCount_ are in use
    std::size_t passageCount_ = 0;
    std::uint64_t thinned_ = 0;
};

template <class Maker>
void LastingContacts::flush(Runs& runs, Maker& maker) {
    if (runs.count > 0) {
        runs.compute();
        maker.addGrains(runs);
    }
    runs.count = runs.runCount = 0;
}

template <class Maker>
void LastingContacts::begin(const Passage& passage, std::int32_t source, std::int32_t other, Runs& runs,
                            Maker& maker) {
    flush(runs, maker);
    const FixtureEntry& surface = table_[passage.surface];
    const Texture& texture = surface.values.texture;
    runs.surface = passage.surface;
    runs.source = source;
    runs.isUsed = maker.prepare(source, other, runs);
    runs.grains = Grains{static_cast<std::uint64_t>(surface.id), texture};
    runs.grains.configure(runs);
    runs.steepness = grainSlope * texture.roughness;
    runs.rolling = texture.rolling;
}

inline bool LastingContacts::staysInGap(const Passage& passage, double seconds,
                                        const GrainGap*& gap) noexcept {
    TrackedPoint& tracked = *passage.tracked;
    tracked.gapSurface = passage.surface;
    tracked.revision = table_.revision();
    tracked.every = passage.every;
    gap = gapBefore(passage);
    if (gap == nullptr || passage.grains >= 0.75 || !gap->contains(passage.motion(seconds))) return false;
    tracked.gap = *gap; // the usual case of slow points
    return true;
}

/// Adds the grains between the ends of a passage to `runs`, as one run; flushes the runs when they are full.
template <class Maker>
inline void LastingContacts::pass(const Passage& passage, const StepSpan& span, Runs& runs, Maker& maker) {
    const GrainGap* gap = nullptr;
    if (staysInGap(passage, runs.seconds, gap)) return;
    const auto addOneByOne = [&] {
        flush(runs, maker);
        runs.surface = FixtureTable::none; // the maker's source or partner may change
        addGrainImpacts(
            passage, span, gap,
            {[](void* dest, const Impact& impact) { static_cast<Maker*>(dest)->add(impact); }, &maker});
    };
    TrackedPoint& tracked = *passage.tracked;
    const LastingPoint& point = tracked.point;
    const bool isSourceA = table_.isSource(point.a);
    const std::int32_t source = isSourceA ? point.a : point.b, other = isSourceA ? point.b : point.a;
    if (isSourceA == table_.isSource(point.b) || passage.fastest < 0.0) [[unlikely]]
        return addOneByOne();
    if (runs.surface != passage.surface || runs.source != source) [[unlikely]]
        begin(passage, source, other, runs, maker);
    if (!runs.isUsed) [[unlikely]]
        return addOneByOne();
    const double end = passage.endMetres;
    const bool isUp = end > passage.startMetres;
    const double sign = isUp ? 1.0 : -1.0;
    const std::int64_t step = isUp ? passage.every : -passage.every;
    double behind = 0.0, ahead = 0.0;
    std::int64_t index = runs.grains.findFirst(passage.startMetres, isUp, passage.every, gap, behind, ahead);
    if (sign * (end - ahead) >= 0.0) {
        if (runs.runCount == GrainRuns::maxRuns) [[unlikely]]
            flush(runs, maker);
        GrainRuns::Run* run = &runs.runs[runs.runCount++];
        run->start = passage.startMetres;
        run->metresPerSecond = passage.metresPerSecond;
        run->metresPerSecond2 = passage.metresPerSecond2;
        run->sign = sign;
        run->slip = point.slipMetresPerSecond;
        run->newtons = passage.loadNewtons;
        run->every = static_cast<double>(passage.every);
        run->point = {point.point.x, point.point.y, point.point.z};
        run->velocity = {point.velocity.x, point.velocity.y, point.velocity.z};
        run->otherId = maker.idOf(other);
        const std::int64_t first = index;
        std::size_t count = runs.count;
        do {
            if (count == GrainRuns::maxGrains) [[unlikely]] {
                const GrainRuns::Run copy = *run;
                runs.count = count;
                flush(runs, maker);
                count = 0;
                run = &runs.runs[runs.runCount++];
                *run = copy;
            }
            behind = ahead;
            runs.metres[count] = ahead;
            runs.keys[count] = runs.grains.keyOf(index);
            runs.runOffsets[count++] = static_cast<std::uint32_t>(
                reinterpret_cast<const char*>(run) - reinterpret_cast<const char*>(runs.runs.data()));
            index += step;
            ahead = runs.grains.metresOf(index);
        } while (sign * (end - ahead) >= 0.0);
        runs.count = count;
        if (passage.every > 1)
            thinned_ += static_cast<std::uint64_t>((index - first) / step) *
                        static_cast<std::uint64_t>(passage.every - 1);
    }
    tracked.gap = {isUp ? behind : ahead, isUp ? ahead : behind, index, isUp};
}

} // namespace physvib
