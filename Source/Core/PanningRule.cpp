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
    if (triangles_.areFound())
        rule_.law = PanningLaw::triangles;
    else if (hasCells())
        rule_.law = PanningLaw::neighbours;
    else if (!isFlat_)
        rule_.law = PanningLaw::distance;
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

bool PhantomPanner::divides(PartNumber part) const noexcept {
    const int bound = part == 0 ? 0 : actuatorsOn(part);
    return bound > 0 && bound < layout_.count;
}

void PhantomPanner::gainsAt(const CollisionEvent& event, Gains& gains) const noexcept {
    if (divides(event.source.part)) return gainsAt(event, onPart(event.source.part), gains);
    gainsHere(event, spreadOf(event), gains);
}

void PhantomPanner::gainsOf(const CollisionEvent& event, Spread spread, Gains& gains) const noexcept {
    if (!divides(event.source.part)) return gainsHere(event, spread, gains);
    Gains own;
    onPart(event.source.part).gainsHere(event, spread, own);
    spreadPart(event.source.part, own, gains);
}

void PhantomPanner::gainsAt(const CollisionEvent& event, const PhantomPanner& onPart,
                            Gains& gains) const noexcept {
    Gains own;
    onPart.gainsHere(event, onPart.spreadOf(event), own);
    spreadPart(event.source.part, own, gains);
}

void PhantomPanner::spreadPart(PartNumber part, const Gains& own, Gains& gains) const noexcept {
    std::size_t next = 0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(layout_.count); ++j)
        gains[j] = layout_.places[j].part == part ? own[next++] : 0.0;
}

// Places stay where they are. The triangles of 16 take 10 us to find, those of 63 would take 2 ms.
PhantomPanner PhantomPanner::onPart(PartNumber part) const noexcept {
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
    PhantomPanner made{own,
                       partLaw_,
                       rule_.exponent,
                       own.extentWidthMetres / scaleX_,
                       own.extentHeightMetres / scaleY_,
                       own.count <= mostWithTriangles};
    if (partLaw_ != PanningLaw::automatic) made.grains_ = grains_;
    return made;
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

// In one plane the triangles are the cells of a row, grid or belt.
void PhantomPanner::gainsBy(Rule rule, Vector p, Gains& gains) const noexcept {
    const bool hasTriangles = rule.law == PanningLaw::triangles && triangles_.areFound(),
               hasOwnCells = (rule.law == PanningLaw::triangles || rule.law == PanningLaw::neighbours) &&
                             cells_.areFound();
    if (hasTriangles) triangles_.sharesAt(layout_, {p.x, p.y, p.z}, gains);
    if (hasOwnCells) cells_.sharesAt(layout_, {p.x, p.y, p.z}, gains);
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
