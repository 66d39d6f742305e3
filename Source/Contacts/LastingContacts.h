// SPDX-License-Identifier: MIT
// Rolling and sliding contacts: each grain of a rough surface that a contact point passes gives a small
// impact.
#pragma once
#include "Contacts/FixtureTable.h"
#include "Contacts/Grains.h"
#include "Contacts/Impact.h"
#include "Contacts/IndexMaps.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

// Matches the records that an engine reports in each step with those of the step before.

/// Engines report contacts in nearly the same order in each step, so a record is first looked for behind the
/// last one found; the lookup by key is needed only for records that are new, gone or reordered (100 rolling
/// balls: saves 2.5 us of a step of 80). A `Record` is made from a key, not 0, and has it as `key`. Allocates when a step has
/// more records than any before. One thread at a time.
template <class Record>
class StepMemory {
public:
    static constexpr std::int32_t none = IntegerMap::none;
    struct Told {
        std::int32_t place;  ///< index of the record in this step
        std::int32_t before; ///< index of the same record in the last step, or `none`
        bool isFirst;        ///< first report in this step: the record is new
    };

    /// `what`: what a new record is made from, beside the key.
    template <class... What>
    Told tell(std::uint64_t key, const What&... what) {
        const std::int32_t before = placeBefore(key);
        if (before != none) {
            std::int32_t& at = placeNow_[static_cast<std::size_t>(before)];
            const bool isFirst = at == none;
            if (isFirst) at = add(key, what...);
            return {at, before, isFirst};
        }
        if (const std::int32_t at = new_.find(key); at != none) return {at, none, false};
        const std::int32_t at = add(key, what...);
        new_.set(key, at);
        return {at, none, true};
    }

    Record& operator[](std::int32_t place) noexcept { return now_[static_cast<std::size_t>(place)]; }
    const Record& operator[](std::int32_t place) const noexcept {
        return now_[static_cast<std::size_t>(place)];
    }
    const Record& before(std::int32_t place) const noexcept {
        return before_[static_cast<std::size_t>(place)];
    }
    std::vector<Record>& now() noexcept { return now_; }
    const std::vector<Record>& now() const noexcept { return now_; }

    /// Ends the step: this step's records become those of the last.
    void endStep() {
        before_.swap(now_);
        placeNow_.assign(before_.size(), none);
        forgetStep();
    }

    /// Drops this step's records.
    void forgetStep() noexcept {
        now_.clear();
        new_.clear();
        isMapped_ = false;
        next_ = 0;
        for (std::int32_t& place : placeNow_) place = none;
    }

    template <class Change>
    void changeAll(Change&& change) noexcept {
        for (Record& record : before_) change(record);
        for (Record& record : now_) change(record);
    }

    void reset() noexcept {
        before_.clear();
        placeNow_.clear();
        forgetStep();
    }

private:
    template <class... What>
    std::int32_t add(std::uint64_t key, const What&... what) {
        now_.emplace_back(key, what...);
        return static_cast<std::int32_t>(now_.size()) - 1;
    }

    std::int32_t placeBefore(std::uint64_t key) {
        if (next_ < before_.size() && before_[next_].key == key) return static_cast<std::int32_t>(next_++);
        // reported again
        if (next_ > 0 && before_[next_ - 1].key == key) return static_cast<std::int32_t>(next_ - 1);
        if (!isMapped_) map();
        const std::int32_t place = placeOf_.find(key);
        if (place != none) next_ = static_cast<std::size_t>(place) + 1;
        return place;
    }
    void map() {
        placeOf_.clear();
        for (std::size_t i = 0; i < before_.size(); ++i)
            placeOf_.set(before_[i].key, static_cast<std::int32_t>(i));
        isMapped_ = true;
    }

    std::vector<Record> before_, now_;
    std::vector<std::int32_t> placeNow_; // by index in before_
    std::size_t next_ = 0;               // in before_
    IntegerMap placeOf_;                 // keys of before_, built at the first lookup
    bool isMapped_ = false;
    IntegerMap new_; // records of now_ that did not exist in the last step
};

/// Position of a contact point on a surface at the end of a step, in the surface's own frame, and its speed
/// along the surface. A corner that slides keeps its position on its own surface.
struct SurfacePath {
    double metres = 0.0;
    double metresPerSecond = 0.0;
};

/// A contact point of two fixtures that continued to touch in a step, as an engine reports it after its
/// solver. Fixtures are slots of the FixtureTable.
struct LastingPoint {
    std::int32_t a = 0, b = 0;
    std::uint64_t feature = 0; ///< identifies the point within the pair; the same from step to step
    double normalNewtonSeconds = 0.0;
    double slipMetresPerSecond = 0.0; ///< of one surface relative to the other
    Vector3 point;                    ///< world, at the end of the step
    Vector3 metresPerSecond;          ///< of the contact point itself
    SurfacePath onA, onB;
};

/// Tracks points from step to step and creates impacts of the grains that they pass, for any engine. A load
/// that is new in this step gives no grains, because it belongs to the collision. Engines move bodies by the
/// velocity at the step's end; under steady acceleration the true path is half a step's change of speed
/// behind that. This path is used, so times are accurate far below a step.
///
/// All methods: the world's thread (M). After its buffers have grown it does not allocate.
class LastingContacts {
public:
    /// Slower contacts count as resting.
    static constexpr double leastMetresPerSecond = 0.01;
    /// More grains per second than this are thinned to every second, fourth, eighth... grain, amplified by
    /// the square root: equal power at bounded cost.
    static constexpr double mostPerSecond = 2000.0;
    /// Limit for all points together, which are thinned alike, so that a rattling heap has bounded cost.
    static constexpr double mostTogetherPerSecond = 50'000.0;
    static constexpr double longestStepSeconds = 0.1; ///< longer steps are not tracked: the motion within is
                                                      ///< not known

    explicit LastingContacts(const FixtureTable& table);

    /// True if points of this pair are to be reported: a surface is rough, and one of the two is a haptic
    /// source.
    bool isRelevant(std::int32_t a, std::int32_t b) const noexcept {
        return (table_.isRough(a) || table_.isRough(b)) && (table_.isCamera(a) || table_.isCamera(b));
    }

    /// Only paths along rough surfaces are used.
    bool isRough(std::int32_t slot) const noexcept { return table_.isRough(slot); }

    /// Reports a point after the solver, once per step; repeated reports of a point are ignored.
    void touch(const LastingPoint& point);
    bool hasHeard() const noexcept { return !points_.now().empty(); }

    /// Appends the impacts of the grains that the step's points passed, by point.
    void collect(const StepSpan& span, std::vector<Impact>& impacts);
    /// The same for `makers.add(camera, other, timeNs, newtonSeconds, point, kind)`, without a list between.
    template <class Makers>
    void collectFor(const StepSpan& span, Makers& makers) {
        follow(span.seconds());
        for (const Passage& passage : passages_) pass(passage, span, makers);
    }
    void endStep();

    /// The slot is freed or reassigned.
    void forget(std::int32_t slot) noexcept;
    void reset() noexcept;

    /// Grains left out so far by thinning; the remaining ones carry their power.
    std::uint64_t thinned() const noexcept { return thinned_; }

private:
    struct Told {
        Told(std::uint64_t of, const LastingPoint& told)
            : key{of}
            , point{told} {}
        std::uint64_t key;
        LastingPoint point;
        std::int32_t pair = 0, before = 0; // indices into pairs_ and into the last step's points
    };
    struct Pair {
        explicit Pair(std::uint64_t of)
            : key{of} {}
        std::uint64_t key;
        std::int32_t before = 0;
        double newtonSeconds = 0.0, newtons = 0.0; // of all its points in the step
    };
    struct Passage { // the grains of one surface that one point passes in this step
        const LastingPoint* point;
        std::int32_t surface; // slot
        double loadNewtons;
        SurfaceMotion motion;
        std::int64_t every;
    };

    void follow(double seconds);
    double follow(const Told& told, std::int32_t surface, SurfacePath LastingPoint::*path, double seconds);
    double steadyShare(const Told& told) const noexcept;
    void forgetStep() noexcept;
    template <class Makers>
    void pass(const Passage& passage, const StepSpan& span, Makers& makers);

    const FixtureTable& table_;
    StepMemory<Told> points_;
    StepMemory<Pair> pairs_;
    std::vector<Passage> passages_;
    std::uint64_t thinned_ = 0;
};

template <class Makers>
void LastingContacts::pass(const Passage& passage, const StepSpan& span, Makers& makers) {
    const LastingPoint& point = *passage.point;
    const KnownFixture& surface = table_[passage.surface];
    const Texture& texture = surface.values.texture;
    const Grains grains{static_cast<std::uint64_t>(surface.id), texture};
    const SurfaceMotion motion = passage.motion;
    const double power = std::sqrt(static_cast<double>(passage.every)), perSecond = 1.0 / motion.seconds;
    const double backSeconds = 1.5 * motion.seconds, slipping = std::abs(point.slipMetresPerSecond);
    const double perSpeed = grainImpulse(texture.roughness, passage.loadNewtons, 1.0), rolling = texture.rolling;
    const bool isFeltByA = table_.isCamera(point.a), isFeltByB = table_.isCamera(point.b);
    const Vector3 from = point.point, velocity = point.metresPerSecond;
    std::uint64_t passed = 0;
    grains.along(motion, passage.every, [&](std::int64_t index, double t) {
        ++passed;
        const double speed = std::abs(motion.speedAt(t));
        if (speed < leastMetresPerSecond) return;
        const double slip = std::min(speed, slipping);
        const double felt = slip + rolling * (speed - slip);
        const std::int64_t timeNs = span.laterNs(t * perSecond);
        const double newtonSeconds = power * grains.strengthOf(index) * (perSpeed * felt);
        const Vector3 place = from + static_cast<float>(t - backSeconds) * velocity;
        const ContactKind kind = slip > 0.5 * speed ? ContactKind::slide : ContactKind::roll;
        if (isFeltByA) makers.add(point.a, point.b, timeNs, newtonSeconds, place, kind);
        if (isFeltByB) makers.add(point.b, point.a, timeNs, newtonSeconds, place, kind);
    });
    thinned_ += passed * static_cast<std::uint64_t>(passage.every - 1);
}

} // namespace physvib
