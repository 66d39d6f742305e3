// SPDX-License-Identifier: MIT
// Surface roughness as grains: their places and strengths along a surface, the same at each pass.
#pragma once
#include "Contacts/GrainRuns.h"
#include "Core/Units.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace physvib {

/// Arrangement of a surface's roughness elements. random: like cloth, stone or wood. regular: ridges, felt
/// as a tone of frequency speed / spacing.
enum class GrainPattern { random, regular };

/// Grains of a surface. Passing a grain gives both bodies a small impact.
struct Texture {
    static constexpr double finestMetres = 1.0e-5; ///< between grains
    static constexpr double coarsestMetres = 10.0; ///< between grains
    static constexpr double maxRoughness = 1000.0; ///< of `roughness`

    double grainMetres = 0.0; ///< mean spacing; 0, or finer than finestMetres: smooth, and silent
    double roughness = 1.0;   ///< strength factor, see grainImpulse()
    GrainPattern pattern = GrainPattern::random; ///< spacing of the grains
    double rolling = 0.2;                        ///< strength of rolling relative to sliding, 0 to 1

    /// True if the texture gives impacts.
    bool isRough() const noexcept { return grainMetres >= finestMetres && roughness > 0.0; }
};

/// Impulse of one grain in N s, for a load in N and the speed in m/s at which it is passed. The pressing mass
/// (load / g) is lifted along a slope of 10 % of the roughness, so the impulse is proportional to both. Any
/// thread.
constexpr double grainSlope = 0.1;
constexpr double grainImpulse(double roughness, double loadNewtons, double metresPerSecond) noexcept {
    return grainSlope * roughness * loadNewtons / standardGravity * metresPerSecond;
}

/// The error of a value, with what was expected; empty if all are valid. Any thread.
inline std::string_view errorOf(const Texture& texture) noexcept {
    if (!(texture.grainMetres >= 0.0 && texture.grainMetres <= Texture::coarsestMetres))
        return "grain: expected 0 (smooth) to 10 m";
    if (!(texture.roughness >= 0.0 && texture.roughness <= Texture::maxRoughness))
        return "roughness: expected 0 to 1000";
    if (!(texture.rolling >= 0.0 && texture.rolling <= 1.0)) return "rolling: expected 0 to 1";
    return {};
}

/// Motion of a point along a surface during a step: s(t) = start + speed t + acceleration t^2 / 2, t from 0
/// to `seconds`.
struct SurfaceMotion {
    double startMetres = 0.0;      ///< s at t = 0
    double metresPerSecond = 0.0;  ///< speed at t = 0
    double metresPerSecond2 = 0.0; ///< acceleration
    double seconds = 0.0;          ///< how long it lasts

    /// s(t).
    double metresAt(double t) const noexcept {
        return startMetres + (metresPerSecond + 0.5 * metresPerSecond2 * t) * t;
    }
    /// ds/dt.
    double speedAt(double t) const noexcept { return metresPerSecond + metresPerSecond2 * t; }
    /// Time at which it reverses; `seconds` if it does not.
    double turn() const noexcept {
        const double t = metresPerSecond2 == 0.0 ? seconds : -metresPerSecond / metresPerSecond2;
        return t > 0.0 && t < seconds ? t : seconds;
    }
};

/// Ranges of random grains: position within the spacing, and strength, both uniformly distributed.
struct GrainChance {
    static constexpr double spacingRange = 0.9;  ///< of the spacing
    static constexpr double minStrength = 0.2;   ///< the weakest
    static constexpr double strengthRange = 1.6; ///< from the weakest to the strongest
};

/// A stretch of a surface within which there is no grain.
struct GrainGap {
    double fromMetres = 0.0; ///< along the path, as SurfaceMotion's metres
    double toMetres = 0.0;   ///< its other end
    std::int64_t next = 0;   ///< index of the grain at that end to which the point moved
    bool isUp = true;        ///< it moved upwards, so that end is `toMetres`

    /// True if a motion that does not reverse certainly stays within.
    bool contains(const SurfaceMotion& motion) const noexcept {
        constexpr double rounding = 1.0e-14; // relative; a hundred times what is lost
        const double start = motion.startMetres, end = motion.metresAt(motion.seconds);
        const double margin = rounding * (std::abs(start) + std::abs(end));
        return motion.metresPerSecond * motion.speedAt(motion.seconds) > 0.0 &&
               std::min(start, end) - margin > fromMetres && std::max(start, end) + margin < toMetres;
    }
};

/// Grains of one surface. Grain `index` lies at (index + 1/2) spacings, +-45 % if random, with a strength of
/// 0.2 to 1.8 that depends on surface and index alone: moving back passes the same grains, and every run is
/// the same. Any thread.
class Grains {
public:
    /// `texture` is rough.
    Grains(std::uint64_t surface, const Texture& texture) noexcept
        : seed_{2 * surface * seedFactor}
        , grainMetres_{texture.grainMetres}
        , perMetre_{1.0 / texture.grainMetres}
        , isRandom_{texture.pattern == GrainPattern::random} {}

    /// Place of a grain along the surface.
    double metresOf(std::int64_t index) const noexcept {
        const double jitter = isRandom_ ? GrainChance::spacingRange * (chance(index, 0) - 0.5) : 0.0;
        return (static_cast<double>(index) + 0.5 + jitter) * grainMetres_;
    }
    /// Strength of a grain; 1 if the pattern is regular.
    double strengthOf(std::int64_t index) const noexcept {
        return isRandom_ ? GrainChance::minStrength + GrainChance::strengthRange * chance(index, 1) : 1.0;
    }

    /// Calls `onGrain(index, t)` for each grain whose index is a multiple of `every`, in the order in which
    /// they are passed. Returns the gap in which the point is then. `gap`: that of the step before, for the
    /// same grains and `every`, which saves a search; or null.
    template <class OnGrain>
    [[gnu::always_inline]] GrainGap visit(const SurfaceMotion& motion, std::int64_t every,
                                          const GrainGap* gap, OnGrain&& onGrain) const {
        double from = 0.0, to = motion.turn();
        GrainGap lastGap;
        for (;;) { // there, and back
            lastGap = walk(motion, from, to, every, gap, onGrain);
            if (!(to < motion.seconds)) return lastGap;
            from = to;
            to = motion.seconds;
            gap = &lastGap;
        }
    }

    /// Sets the range of strengths in `runs`.
    void configure(GrainRuns& runs) const noexcept {
        runs.minStrength = isRandom_ ? GrainChance::minStrength : 1.0;
        runs.strengthRange = isRandom_ ? GrainChance::strengthRange : 0.0;
    }
    /// The hash key from which a grain's strength is drawn, see GrainRuns.
    std::uint64_t keyOf(std::int64_t index) const noexcept { return keyOf(index, 1); }

    /// Index of the first grain that a point from `start` (m) reaches. `behind` and `ahead` become the places
    /// of the grains between which it starts, m.
    std::int64_t findFirst(double start, bool isUp, std::int64_t every, const GrainGap* gap, double& behind,
                           double& ahead) const noexcept {
        if (gap != nullptr && gap->isUp == isUp && gap->fromMetres < start && start < gap->toMetres) {
            behind = isUp ? gap->fromMetres : gap->toMetres;
            ahead = isUp ? gap->toMetres : gap->fromMetres;
            return gap->next;
        }
        behind = start;
        const Grain grain = next(start, isUp, every, behind);
        ahead = grain.metres;
        return grain.index;
    }

private:
    std::uint64_t keyOf(std::int64_t index, std::uint64_t stream) const noexcept {
        return (static_cast<std::uint64_t>(index) + 1U) * 0x9E3779B97F4A7C15U + (seed_ + stream * seedFactor);
    }
    /// 0 to 1 (SplitMix64's finaliser; Steele, Lea, Flood 2014).
    double chance(std::int64_t index, std::uint64_t stream) const noexcept {
        std::uint64_t z = keyOf(index, stream);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        z ^= z >> 31U;
        return static_cast<double>(static_cast<std::int64_t>(z >> 11U)) * 0x1p-53; // via signed: one
                                                                                   // instruction
    }

    struct Grain {
        std::int64_t index;
        double metres;
    };
    Grain grainAt(std::int64_t index) const noexcept { return {index, metresOf(index)}; }
    /// The first grain beyond `metres`, upwards or downwards, whose index is a multiple of `every`. `behind`
    /// becomes the one before it, where that is known.
    Grain next(double metres, bool isUp, std::int64_t every, double& behind) const noexcept {
        const double cell = metres * perMetre_ / static_cast<double>(every);
        auto i = static_cast<std::int64_t>(cell); // rounds towards 0
        if (isUp && cell < static_cast<double>(i)) --i;
        if (!isUp && cell > static_cast<double>(i)) ++i;
        Grain grain = grainAt(i * every); // at most one step before the result
        const std::int64_t step = isUp ? every : -every;
        while (isUp ? grain.metres <= metres : grain.metres >= metres) {
            behind = grain.metres;
            grain = grainAt(grain.index + step);
        }
        return grain;
    }

    template <class OnGrain>
    [[gnu::always_inline]] GrainGap walk(const SurfaceMotion& motion, double from, double to,
                                         std::int64_t every, const GrainGap* gap, OnGrain& onGrain) const {
        const double start = motion.metresAt(from), end = motion.metresAt(to), speed = motion.speedAt(from);
        const bool isUp = end > start;
        const double sign = isUp ? 1.0 : -1.0;
        double behind = 0.0;
        Grain grain;
        grain.index = findFirst(start, isUp, every, gap, behind, grain.metres);
        for (; sign * (end - grain.metres) >= 0.0; grain = grainAt(grain.index + (isUp ? every : -every))) {
            behind = grain.metres;
            const double far = grain.metres - start;
            // The root of the parabola that begins at `from`, in the form without cancellation.
            const double root = std::sqrt(std::max(0.0, speed * speed + 2.0 * motion.metresPerSecond2 * far));
            const double denominator = speed + sign * root;
            const double t = denominator == 0.0 ? to : from + 2.0 * far / denominator;
            onGrain(grain.index, std::min(std::max(from, t), to));
        }
        return isUp ? GrainGap{behind, grain.metres, grain.index, true}
                    : GrainGap{grain.metres, behind, grain.index, false};
    }

    static constexpr std::uint64_t seedFactor = 0xD1342543DE82EF95U;

    std::uint64_t seed_; // by surface
    double grainMetres_, perMetre_;
    bool isRandom_;
};

} // namespace physvib
