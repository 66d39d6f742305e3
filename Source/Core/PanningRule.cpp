// SPDX-License-Identifier: MIT
// Decides how an event is panned: by which law, by which arrangement or cells, and on which part of the body.
#include "Core/PhantomPanner.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace physvib {

void PhantomPanner::resolveAutomatic() noexcept {
    rule_.law = PanningLaw::linear;
    if (rule_.exponent != 1.0) return;
    if (!isFlat_)
        rule_.law = triangles_.areFound() ? PanningLaw::triangles : PanningLaw::distance;
    else if (hasCells())
        rule_.law = PanningLaw::neighbours;
    else
        grains_ = grainSpread;
}

PhantomPanner::Vector PhantomPanner::onLayout(Vector field) const noexcept {
    return {field.x * scaleX_, field.y * scaleY_, isFlat_ ? 0.0 : field.z * scaleX_};
}

void PhantomPanner::gainsAt(double x, double y, Gains& gains) const noexcept {
    gainsBy(rule_, onLayout({x, y}), gains);
}

void PhantomPanner::gainsAt(double x, double y, Spread spread, Gains& gains) const noexcept {
    gainsBy(spread, onLayout({x, y}), gains);
}

int PhantomPanner::actuatorsOn(PartNumber part) const noexcept {
    const auto begin = layout_.places.begin();
    return static_cast<int>(std::count_if(begin, begin + layout_.count,
                                          [part](const ActuatorPlace& p) { return p.part == part; }));
}

void PhantomPanner::gainsOn(PartNumber part, Vector field, Spread spread, Gains& gains) const noexcept {
    const int bound = part == 0 ? 0 : actuatorsOn(part);
    if (bound == 0 || bound == layout_.count) return gainsBy(spread, onLayout(field), gains);
    Gains own;
    const PhantomPanner panner = partPanner(part);
    panner.gainsBy(spread, panner.onLayout(field), own);
    std::size_t next = 0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(layout_.count); ++j)
        gains[j] = layout_.places[j].part == part ? own[next++] : 0.0;
}

// The actuators of the part are a layout of their own, whose extent they span. Places stay where they are.
// This is called when an event begins: the triangles of 16 take 10 us to find, those of 63 would take 2 ms.
PhantomPanner PhantomPanner::partPanner(PartNumber part) const noexcept {
    constexpr int mostWithTriangles = 16;
    ActuatorLayout own = layout_;
    const auto end =
        std::copy_if(layout_.places.begin(), layout_.places.begin() + layout_.count, own.places.begin(),
                     [part](const ActuatorPlace& p) { return p.part == part; });
    own.count = static_cast<int>(end - own.places.begin());
    const auto span = [&](double ActuatorPlace::*axis, double whole) {
        const auto [least, most] = std::minmax_element(
            own.places.begin(), end,
            [axis](const ActuatorPlace& a, const ActuatorPlace& b) { return a.*axis < b.*axis; });
        const double length = (*most).*axis - (*least).*axis;
        return length > 0.0 ? length : whole;
    };
    own.extentWidthMetres = span(&ActuatorPlace::xMetres, layout_.extentWidthMetres);
    own.extentHeightMetres = span(&ActuatorPlace::yMetres, layout_.extentHeightMetres);
    return {own,
            rule_.law,
            rule_.exponent,
            own.extentWidthMetres / scaleX_,
            own.extentHeightMetres / scaleY_,
            own.count <= mostWithTriangles};
}

void PhantomPanner::gainsBy(Spread spread, Vector p, Gains& gains) const noexcept {
    if (spread == Spread::layout) return gainsBy(rule_, p, gains);
    if (spread == spreadBy(PanningLaw::automatic)) spread = travelSpread();
    if (spread == Spread::alone) return nearestGains(p, gains);
    Rule rule{rule_.law, 1.0};
    if (spread == Spread::equal) rule.law = PanningLaw::energy;
    for (const auto& one : panningLaws)
        if (spread == spreadBy(one.law)) rule.law = one.law;
    gainsBy(rule, p, gains);
    if (spread != Spread::equal) return;
    const auto end = gains.begin() + layout_.count;
    const double energy =
        std::accumulate(gains.begin(), end, 0.0, [](double sum, double g) { return sum + g * g; });
    if (energy > 0.0)
        std::for_each(gains.begin(), end, [scale = 1.0 / std::sqrt(energy)](double& g) { g *= scale; });
}

// On a flat layout the triangles are the cells of a row, grid or belt.
void PhantomPanner::gainsBy(Rule rule, Vector p, Gains& gains) const noexcept {
    const bool hasTriangles = rule.law == PanningLaw::triangles && triangles_.areFound(),
               hasOwnCells = (rule.law == PanningLaw::triangles || rule.law == PanningLaw::neighbours) &&
                             cells_.areFound();
    if (hasTriangles) triangles_.sharesAt(layout_, {p.x, p.y, p.z}, gains);
    if (hasOwnCells) cells_.sharesAt(layout_, p.x, p.y, gains);
    if (hasTriangles || hasOwnCells) return sharedGains(rule, gains);
    const bool isByDistance = rule.law == PanningLaw::distance && arrangement_ != Arrangement::single;
    switch (isByDistance ? Arrangement::scattered : arrangement_) {
    case Arrangement::single: gains[0] = 1.0; break;
    case Arrangement::line: lineGains(rule, p, gains); break;
    case Arrangement::rectangle: rectangleGains(rule, p, gains); break;
    case Arrangement::triangle: triangleGains(rule, p, gains); break;
    case Arrangement::scattered: scatteredGains(rule, p, gains); break;
    }
}

void PhantomPanner::sharedGains(Rule rule, Gains& shares) const noexcept {
    for (auto gain = shares.begin(); gain != shares.begin() + layout_.count; ++gain)
        *gain = factor(rule, 1.0 - *gain);
}

} // namespace physvib
