// SPDX-License-Identifier: MIT
// Phantom sensations: from the place of an impact to one gain per actuator (thesis Eq. 4.2, 4.3, 6.2).
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/EnchanterLayout.h"
#include "Core/NeighbourCells.h"
#include "Core/PanningLaws.h"
#include "Core/Spread.h"
#include <array>

namespace physvib {

/// Panner of one layout. Docs/panning.md has the formulas of every arrangement.
class PhantomPanner {
public:
    using Gains = std::array<double, limits::maxEnchanters>; ///< One per actuator.

    PhantomPanner() = default;

    /// `layout` valid; field sizes in metres > 0, mapped onto the layout's extent; exponent > 0 (gamma of
    /// Eq. 4.2). PanningLaw::automatic becomes `neighbours` on a row of three or more, a grid and a belt.
    /// Elsewhere, and with an exponent other than 1, it becomes `linear`; grains then go by grainSpread if
    /// the exponent is 1.
    PhantomPanner(const EnchanterLayout& layout, PanningLaw law, double exponent, double fieldWidthMetres,
                  double fieldHeightMetres) noexcept;

    /// One gain per channel for an impact at (x, y) metres of the field; the rest of `gains` stays unchanged.
    /// Any thread.
    void gainsAt(double x, double y, Gains& gains) const noexcept;

    /// The same with another spread. Any thread.
    void gainsAt(double x, double y, Spread spread, Gains& gains) const noexcept;

    /// Gains of an event that is now at (x, y), by the event's own spread. Grains without one use grains().
    /// Any thread.
    void gainsAt(const CollisionEvent& event, double x, double y, Gains& gains) const noexcept {
        const bool isGrain = event.source.kind != ContactKind::hit && event.spread == Spread::layout;
        gainsAt(x, y, isGrain ? grains_ : event.spread, gains);
    }

    /// Spread of grains, i.e. of roughness elements that a moving contact passes. Another spread than the
    /// layout's lets the centroid of intensity follow the contact. Initially Spread::layout.
    void setGrains(Spread spread) noexcept { grains_ = spread; }
    Spread grains() const noexcept { return grains_; } ///< Spread of grains. Any thread.

    /// Spread of a tone that travels, if none is named: its energy is constant, and the centroid of its
    /// intensity is at its place. Any thread.
    Spread travelSpread() const noexcept {
        return hasCells() ? spreadBy(PanningLaw::neighbours) : Spread::equal;
    }

    int channels() const noexcept { return layout_.count; } ///< Number of actuators.

    /// The constructor's arguments. Any thread.
    const EnchanterLayout& layout() const noexcept { return layout_; }
    PanningLaw law() const noexcept { return law_; }       ///< Panning law; not PanningLaw::automatic.
    double exponent() const noexcept { return exponent_; } ///< Exponent of the law.
    double fieldWidthMetres() const noexcept { return fieldWidthMetres_; }   ///< Field along x.
    double fieldHeightMetres() const noexcept { return fieldHeightMetres_; } ///< Field along y.

private:
    enum class Arrangement { single, line, rectangle, triangle, scattered };
    struct Vector {
        double x = 0.0, y = 0.0;
    };
    Arrangement classify() noexcept;
    bool findLine() noexcept;
    bool isRectangle() const noexcept;
    Vector place(int enchanter) const noexcept;
    double placeTolerance() const noexcept; // rounding in a layout file must not make a line a triangle
    /// True where PanningLaw::automatic is `neighbours`. Two actuators and the corners of a rectangle keep
    /// the thesis' law.
    bool hasCells() const noexcept {
        return cells_.areFound() && layout_.count > 2 && arrangement_ != Arrangement::rectangle;
    }
    void resolveAutomatic() noexcept;
    bool isPlain() const noexcept { return law_ == PanningLaw::linear && exponent_ == 1.0; } // the usual case
    double factor(double distanceRatio) const noexcept;
    void lineGains(Vector p, Gains& gains) const noexcept;
    void rectangleGains(Vector p, Gains& gains) const noexcept;
    void triangleGains(Vector p, Gains& gains) const noexcept;
    void scatteredGains(Vector p, Gains& gains) const noexcept;
    void nearestGains(Vector p, Gains& gains) const noexcept;
    void cellGains(Vector p, Gains& gains) const noexcept;

    EnchanterLayout layout_;
    PanningLaw law_ = PanningLaw::linear;
    Spread grains_ = Spread::layout;
    double exponent_ = 1.0;
    double fieldWidthMetres_ = 0.0, fieldHeightMetres_ = 0.0;
    double scaleX_ = 1.0, scaleY_ = 1.0; // field metres to layout metres
    Vector lineDirection_;
    double lineExtent_ = 0.0;
    Arrangement arrangement_ = Arrangement::single;
    NeighbourCells cells_;
};

} // namespace physvib
