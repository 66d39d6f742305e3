// SPDX-License-Identifier: MIT
// Phantom sensations: from the place of an impact to one gain per actuator (thesis Eq. 4.2, 4.3, 6.2), for a
// whole layout (PhantomPanner) and for parts of the body (PartPanners).
#pragma once
#include "Core/ActuatorCells.h"
#include "Core/CollisionEvent.h"
#include "Core/EnchanterLayout.h"
#include "Core/PanningLaws.h"
#include "Core/Storage.h"
#include <algorithm>
#include <array>
#include <cstddef>

namespace physvib {
/// Panner of one layout. Docs/panning.md has the formulas of every arrangement.
class PhantomPanner {
public:
    using Gains = std::array<double, limits::maxActuators>; ///< One per actuator.

    PhantomPanner() = default;

    /// `layout` valid; field sizes in metres > 0, mapped onto the layout's extent; exponent > 0 (gamma of
    /// Eq. 4.2). PanningLaw::automatic is resolved for each part of the body on its own:
    /// - `linear` with an exponent other than 1;
    /// - in space `triangles` if the actuators enclose their centre, else `neighbours` if they are a row, a
    ///   grid or a belt in some plane, else `distance`;
    /// - on a flat layout `neighbours` for a row of three or more, a grid or a belt, else `linear` with
    ///   grainSpread for grains.
    PhantomPanner(const ActuatorLayout& layout, PanningLaw law, double exponent, double fieldWidthMetres,
                  double fieldHeightMetres) noexcept
        : PhantomPanner{layout, law, exponent, fieldWidthMetres, fieldHeightMetres, true} {}

    /// One gain per channel for an impact at (x, y) metres of the field, z = 0; the rest of `gains` stays
    /// unchanged. Any thread.
    void gainsAt(double x, double y, Gains& gains) const noexcept;

    /// Gains at (x, y) by another spread than the layout's. Any thread.
    void gainsAt(double x, double y, Spread spread, Gains& gains) const noexcept;

    /// Gains of an event at its place, by its own spread. Grains without one use grains(). If the event is
    /// bound to a part of the body, actuators of other parts have gain 0; if no actuator is on that
    /// part (lacksPartOf), only the place counts. Makes the part's panner on each call; PartPanners keeps
    /// them. Any thread.
    void gainsAt(const CollisionEvent& event, Gains& gains) const noexcept;

    /// Gains of an event by another spread than its own. Any thread.
    void gainsOf(const CollisionEvent& event, Spread spread, Gains& gains) const noexcept;

    /// True if this part needs a panner of its own: some actuators are on it, but not all. Any thread.
    bool needsPanner(PartNumber part) const noexcept;

    /// Panner of a part for which needsPanner() is true. Its actuators form a layout whose extent is the area
    /// that they span. Takes up to 10 us. Any thread.
    PhantomPanner pannerOf(PartNumber part) const noexcept;

    /// Gains of an event that is bound to a part; `partPanner`: this panner's pannerOf() of it. Any thread.
    void gainsAt(const CollisionEvent& event, const PhantomPanner& partPanner, Gains& gains) const noexcept;

    /// True if the event is bound to a part of the body that no actuator of the layout has. Any thread.
    bool lacksPartOf(const CollisionEvent& event) const noexcept {
        return event.source.part != 0 && actuatorsOn(event.source.part) == 0;
    }

    /// Spread of grains, i.e. of roughness elements that a moving contact passes. Another spread than the
    /// layout's lets the centroid of intensity follow the contact. Initially Spread::layout.
    void setGrains(Spread spread) noexcept { grains_ = spread; }
    Spread grains() const noexcept { return grains_; } ///< Spread of grains. Any thread.

    /// Default spread of a moving tone: keeps its energy constant, and the centroid of its intensity at its
    /// place. Any thread.
    Spread travelSpread() const noexcept {
        if (triangles_.isUsable()) return spreadBy(PanningLaw::triangles);
        return hasCells() ? spreadBy(PanningLaw::neighbours) : Spread::equal;
    }

    int channels() const noexcept { return layout_.count; } ///< Number of actuators.

    /// The constructor's arguments. Any thread.
    const ActuatorLayout& layout() const noexcept { return layout_; }
    PanningLaw law() const noexcept { return rule_.law; } ///< Panning law; not PanningLaw::automatic.
    /// The law that the constructor was given. May be PanningLaw::automatic, which each part of the body
    /// resolves for its own actuators. Any thread.
    PanningLaw requestedLaw() const noexcept { return requestedLaw_; }
    void setRequestedLaw(PanningLaw law) noexcept { requestedLaw_ = law; }   ///< For a saved session.
    double exponent() const noexcept { return rule_.exponent; }              ///< Exponent of the law.
    double fieldWidthMetres() const noexcept { return fieldWidthMetres_; }   ///< Field along x.
    double fieldHeightMetres() const noexcept { return fieldHeightMetres_; } ///< Field along y.

private:
    /// `seeksTriangles`: looks for triangles of actuators around the centre, which is slow if there are many.
    PhantomPanner(const ActuatorLayout& layout, PanningLaw law, double exponent, double fieldWidthMetres,
                  double fieldHeightMetres, bool seeksTriangles) noexcept;
    enum class Arrangement { single, line, rectangle, triangle, scattered };
    struct Vector {
        double x = 0.0, y = 0.0, z = 0.0; // z: 0 on a flat layout
    };
    struct Rule {
        PanningLaw law = PanningLaw::linear;
        double exponent = 1.0;
        // the most common rule, which needs no call per actuator
        bool isPlain() const noexcept { return law == PanningLaw::linear && exponent == 1.0; }
    };
    Arrangement classify() noexcept;
    bool findLine() noexcept;
    bool isRectangle() const noexcept;
    Vector place(int actuator) const noexcept;
    double placeTolerance() const noexcept; // for places that a layout file rounds
    /// True where PanningLaw::automatic is `neighbours`. On a flat layout, two actuators and the corners of
    /// a rectangle use the thesis' law instead.
    bool hasCells() const noexcept {
        return cells_.isUsable() &&
               (!isFlat_ || (layout_.count > 2 && arrangement_ != Arrangement::rectangle));
    }
    void resolveAutomatic() noexcept;
    Vector toLayout(Vector field) const noexcept;
    int actuatorsOn(PartNumber part) const noexcept;
    Spread spreadOf(const CollisionEvent& event) const noexcept {
        const bool isGrain = event.source.kind != ContactKind::hit && event.spread == Spread::layout;
        return isGrain ? grains_ : event.spread;
    }
    void gainsByPlace(const CollisionEvent& event, Spread spread, Gains& gains) const noexcept {
        gainsForSpread(spread, toLayout({event.x, event.y, event.z}), gains);
    }
    void copyPartGains(PartNumber part, const Gains& partGains, Gains& gains) const noexcept;
    void gainsForSpread(Spread spread, Vector p, Gains& gains) const noexcept;
    void gainsForRule(Rule rule, Vector p, Gains& gains) const noexcept;
    static double gainFor(Rule rule, double distanceRatio) noexcept;
    void lineGains(Rule rule, Vector p, Gains& gains) const noexcept;
    void rectangleGains(Rule rule, Vector p, Gains& gains) const noexcept;
    void triangleGains(Rule rule, Vector p, Gains& gains) const noexcept;
    void scatteredGains(Rule rule, Vector p, Gains& gains) const noexcept;
    void nearestGains(Vector p, Gains& gains) const noexcept;
    void applyRuleToShares(Rule rule, Gains& shares) const noexcept;

    ActuatorLayout layout_;
    bool isFlat_ = true; // all actuators have the same z, and z does not count
    Rule rule_;
    PanningLaw requestedLaw_ = PanningLaw::linear; // may be automatic
    Spread grains_ = Spread::layout;
    double fieldWidthMetres_ = 0.0, fieldHeightMetres_ = 0.0;
    double scaleX_ = 1.0, scaleY_ = 1.0; // field metres to layout metres; z by scaleX_
    Vector lineDirection_;
    double lineExtent_ = 0.0;
    Arrangement arrangement_ = Arrangement::single;
    NeighbourCells cells_;    // for a layout in one plane
    TriangleCells triangles_; // for a layout that encloses its centre
};

/// A panner and the panners of its parts. A part's panner is made when the part is first struck, which may
/// take 10 us, and kept until the whole panner changes. When all places (`maxPanners`, or as many as were
/// prepared) are taken, it replaces the oldest.
class PartPanners {
public:
    static constexpr std::size_t maxPanners = 16; ///< Core/EnchanterLayout.h has names for 15 parts

    /// Allocates places for a layout of at most that many actuators, which has at most as many parts. False:
    /// no memory. Message thread (M), not while rendering.
    bool prepare(int actuators) noexcept {
        const std::size_t count = std::min(maxPanners, static_cast<std::size_t>(actuators));
        parts_.fill(0);
        next_ = 0;
        capacity_ = panners_.resize(count) ? count : 0;
        return capacity_ == count;
    }

    /// Sets the whole panner, and discards the panners of its parts.
    PartPanners& operator=(const PhantomPanner& panner) noexcept {
        base_ = panner;
        parts_.fill(0);
        next_ = 0;
        return *this;
    }

    const PhantomPanner& base() const noexcept { return base_; } ///< The panner itself.

    /// Gains of an event, as PhantomPanner::gainsAt. Render thread (R); may compute a part's panner.
    void gainsAt(const CollisionEvent& event, PhantomPanner::Gains& gains) noexcept {
        if (capacity_ == 0 || !base_.needsPanner(event.source.part)) return base_.gainsAt(event, gains);
        base_.gainsAt(event, panners_[indexOf(event.source.part)], gains);
    }

private:
    std::size_t indexOf(PartNumber part) noexcept {
        for (std::size_t i = 0; i < capacity_; ++i)
            if (parts_[i] == part) return i;
        const std::size_t i = next_;
        next_ = (next_ + 1) % capacity_;
        parts_[i] = part;
        panners_[i] = base_.pannerOf(part);
        return i;
    }

    PhantomPanner base_;
    std::array<PartNumber, maxPanners> parts_{}; // 0: none
    Storage<PhantomPanner, maxPanners, true> panners_;
    std::size_t capacity_ = 0, next_ = 0; // next_: the one to be replaced
};

} // namespace physvib
