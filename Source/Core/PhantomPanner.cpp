// SPDX-License-Identifier: MIT
// Gains of a panning law for each arrangement of actuators: single, line, rectangle, triangle, scattered.
// The panning rule, at the end, decides which of them, or which cells, an event uses.
#include "Core/PhantomPanner.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace physvib {
PhantomPanner::PhantomPanner(const ActuatorLayout& layout, PanningLaw law, double exponent,
                             double fieldWidthMetres, double fieldHeightMetres, bool seeksTriangles) noexcept
    : layout_{layout}
    , isFlat_{isFlat(layout)}
    , rule_{law, exponent}
    , requestedLaw_{law}
    , fieldWidthMetres_{fieldWidthMetres}
    , fieldHeightMetres_{fieldHeightMetres}
    , scaleX_{layout.extentWidthMetres / fieldWidthMetres}
    , scaleY_{layout.extentHeightMetres / fieldHeightMetres}
    , arrangement_{classify()}
    , cells_{isFlat_ ? NeighbourCells{layout, {lineDirection_.x, lineDirection_.y}} : NeighbourCells{layout}}
    , triangles_{seeksTriangles ? TriangleCells{layout} : TriangleCells{}} {
    if (rule_.law == PanningLaw::automatic) resolveAutomatic();
}

PhantomPanner::Vector PhantomPanner::place(int actuator) const noexcept {
    const auto& p = layout_.places[static_cast<std::size_t>(actuator)];
    return {p.xMetres, p.yMetres, isFlat_ ? 0.0 : p.zMetres};
}

PhantomPanner::Arrangement PhantomPanner::classify() noexcept {
    if (layout_.count == 1) return Arrangement::single;
    if (!isFlat_) return Arrangement::scattered;
    if (findLine()) return Arrangement::line;
    if (layout_.count == 3) return Arrangement::triangle;
    return isRectangle() ? Arrangement::rectangle : Arrangement::scattered;
}

double PhantomPanner::placeTolerance() const noexcept {
    return 1e-9 * (layout_.extentWidthMetres + layout_.extentHeightMetres);
}

bool PhantomPanner::findLine() noexcept {
    const Vector origin = place(0);
    Vector reach;
    for (int j = 1; j < layout_.count; ++j) {
        const Vector d{place(j).x - origin.x, place(j).y - origin.y};
        if (portable::hypot(d.x, d.y) > portable::hypot(reach.x, reach.y)) reach = d;
    }
    const double length = portable::hypot(reach.x, reach.y);
    if (length > 0.0) lineDirection_ = {reach.x / length, reach.y / length};
    // The layout's extent along the line: its width for a horizontal line, its height for a vertical one.
    lineExtent_ = std::abs(lineDirection_.x) * layout_.extentWidthMetres +
                  std::abs(lineDirection_.y) * layout_.extentHeightMetres;
    const double tolerance = placeTolerance();
    for (int j = 1; j < layout_.count; ++j) {
        const double distance =
            (place(j).x - origin.x) * lineDirection_.y - (place(j).y - origin.y) * lineDirection_.x;
        if (std::abs(distance) > tolerance) return false;
    }
    return true;
}

bool PhantomPanner::isRectangle() const noexcept {
    if (layout_.count != 4) return false;
    const auto [left, right] = std::minmax({place(0).x, place(1).x, place(2).x, place(3).x});
    const auto [low, high] = std::minmax({place(0).y, place(1).y, place(2).y, place(3).y});
    const double tolerance = placeTolerance();
    const auto isNear = [tolerance](double a, double b) { return std::abs(a - b) <= tolerance; };
    int corners = 0; // one bit per corner: four places fill four corners only if no two share one
    for (int j = 0; j < 4; ++j) {
        const Vector p = place(j);
        const bool isRight = isNear(p.x, right), isHigh = isNear(p.y, high);
        if ((!isRight && !isNear(p.x, left)) || (!isHigh && !isNear(p.y, low))) return false;
        corners |= 1 << ((isRight ? 1 : 0) + (isHigh ? 2 : 0));
    }
    return corners == 15;
}

double PhantomPanner::gainFor(Rule rule, double distanceRatio) noexcept {
    const double u = std::clamp(distanceRatio, 0.0, 1.0);
    const double value = describe(rule.law).gain(u);
    return rule.exponent == 1.0 ? value : portable::pow(value, rule.exponent);
}

void PhantomPanner::nearestGains(Vector p, Gains& gains) const noexcept {
    const auto distance = [&](int j) {
        return portable::hypot(portable::hypot(p.x - place(j).x, p.y - place(j).y), p.z - place(j).z);
    };
    int nearest = 0;
    for (int j = 1; j < layout_.count; ++j)
        if (distance(j) < distance(nearest)) nearest = j;
    std::fill_n(gains.begin(), layout_.count, 0.0);
    if (layout_.count > 0) gains[static_cast<std::size_t>(nearest)] = 1.0;
}

void PhantomPanner::lineGains(Rule rule, Vector p, Gains& gains) const noexcept {
    for (int j = 0; j < layout_.count; ++j) {
        const Vector d{p.x - place(j).x, p.y - place(j).y};
        const double along = std::abs(d.x * lineDirection_.x + d.y * lineDirection_.y);
        gains[static_cast<std::size_t>(j)] = lineExtent_ > 0.0 ? gainFor(rule, along / lineExtent_) : 1.0;
    }
}

void PhantomPanner::rectangleGains(Rule rule, Vector p, Gains& gains) const noexcept {
    for (int j = 0; j < 4; ++j) {
        const double u = std::abs(p.x - place(j).x) / layout_.extentWidthMetres;
        const double v = std::abs(p.y - place(j).y) / layout_.extentHeightMetres;
        gains[static_cast<std::size_t>(j)] = gainFor(rule, u) * gainFor(rule, v);
    }
}

void PhantomPanner::triangleGains(Rule rule, Vector p, Gains& gains) const noexcept {
    const Vector a = place(0), b = place(1), c = place(2);
    const auto cross = [](Vector o, Vector s, Vector t) {
        return (s.x - o.x) * (t.y - o.y) - (s.y - o.y) * (t.x - o.x);
    };
    const double area = cross(a, b, c);
    std::array<double, 3> weights{cross(b, c, p) / area, cross(c, a, p) / area, cross(a, b, p) / area};
    if (*std::min_element(weights.begin(), weights.end()) < 0.0) {
        // Outside the triangle the nearest point lies on an edge: the closest of all three.
        double nearest = -1.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const Vector s = place(static_cast<int>(k)), t = place(static_cast<int>(next));
            const Vector e{t.x - s.x, t.y - s.y};
            const double along = ((p.x - s.x) * e.x + (p.y - s.y) * e.y) / (e.x * e.x + e.y * e.y);
            const double share = std::clamp(along, 0.0, 1.0);
            const double distance = portable::hypot(s.x + share * e.x - p.x, s.y + share * e.y - p.y);
            if (nearest >= 0.0 && distance >= nearest) continue;
            nearest = distance;
            weights = {};
            weights[k] = 1.0 - share;
            weights[next] = share;
        }
    }
    for (std::size_t k = 0; k < 3; ++k) gains[k] = gainFor(rule, 1.0 - weights[k]);
}

void PhantomPanner::scatteredGains(Rule rule, Vector p, Gains& gains) const noexcept {
    // Shepard's weights 1/d^2. An impact at an actuator's place drives that actuator alone. Loops without
    // branches are vectorised.
    constexpr double minSquare = 1e-18;               // a nanometre squared: avoids division by zero
    std::array<double, limits::maxActuators> weights; // only `count` are used: not worth clearing
    const auto count = static_cast<std::size_t>(layout_.count);
    const double depth = isFlat_ ? 0.0 : 1.0;
    for (std::size_t j = 0; j < count; ++j) {
        const double dx = p.x - layout_.places[j].xMetres, dy = p.y - layout_.places[j].yMetres,
                     dz = p.z - depth * layout_.places[j].zMetres;
        const double square = dx * dx + dy * dy + dz * dz;
        weights[j] = square < minSquare ? minSquare : square;
    }
    for (std::size_t j = 0; j < count; ++j) weights[j] = 1.0 / weights[j];
    double sum = 0.0;
    for (std::size_t j = 0; j < count; ++j) sum += weights[j];
    if (rule.isPlain())
        // rounded as factor() rounds it, within 0 and 1
        for (std::size_t j = 0; j < count; ++j) gains[j] = 1.0 - (1.0 - weights[j] / sum);
    else
        for (std::size_t j = 0; j < count; ++j) gains[j] = gainFor(rule, 1.0 - weights[j] / sum);
}

void PhantomPanner::resolveAutomatic() noexcept {
    rule_.law = PanningLaw::linear;
    if (rule_.exponent != 1.0) return;
    if (triangles_.isUsable())
        rule_.law = PanningLaw::triangles;
    else if (hasCells())
        rule_.law = PanningLaw::neighbours;
    else if (!isFlat_)
        rule_.law = PanningLaw::distance;
    else
        grains_ = grainSpread;
}

PhantomPanner::Vector PhantomPanner::toLayout(Vector field) const noexcept {
    return {field.x * scaleX_, field.y * scaleY_, isFlat_ ? 0.0 : field.z * scaleX_};
}

void PhantomPanner::gainsAt(double x, double y, Gains& gains) const noexcept {
    gainsForRule(rule_, toLayout({x, y}), gains);
}

void PhantomPanner::gainsAt(double x, double y, Spread spread, Gains& gains) const noexcept {
    gainsForSpread(spread, toLayout({x, y}), gains);
}

int PhantomPanner::actuatorsOn(PartNumber part) const noexcept {
    const auto begin = layout_.places.begin();
    return static_cast<int>(std::count_if(begin, begin + layout_.count,
                                          [part](const ActuatorPlace& p) { return p.part == part; }));
}

bool PhantomPanner::needsPanner(PartNumber part) const noexcept {
    const int bound = part == 0 ? 0 : actuatorsOn(part);
    return bound > 0 && bound < layout_.count;
}

void PhantomPanner::gainsAt(const CollisionEvent& event, Gains& gains) const noexcept {
    if (needsPanner(event.source.part)) return gainsAt(event, pannerOf(event.source.part), gains);
    gainsByPlace(event, spreadOf(event), gains);
}

void PhantomPanner::gainsOf(const CollisionEvent& event, Spread spread, Gains& gains) const noexcept {
    if (!needsPanner(event.source.part)) return gainsByPlace(event, spread, gains);
    Gains partGains;
    pannerOf(event.source.part).gainsByPlace(event, spread, partGains);
    copyPartGains(event.source.part, partGains, gains);
}

void PhantomPanner::gainsAt(const CollisionEvent& event, const PhantomPanner& partPanner,
                            Gains& gains) const noexcept {
    Gains partGains;
    partPanner.gainsByPlace(event, partPanner.spreadOf(event), partGains);
    copyPartGains(event.source.part, partGains, gains);
}

void PhantomPanner::copyPartGains(PartNumber part, const Gains& partGains, Gains& gains) const noexcept {
    std::size_t next = 0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(layout_.count); ++j)
        gains[j] = layout_.places[j].part == part ? partGains[next++] : 0.0;
}

// Places stay where they are. The triangles of 16 take 10 us to find, those of 63 would take 2 ms.
PhantomPanner PhantomPanner::pannerOf(PartNumber part) const noexcept {
    constexpr int maxWithTriangles = 16;
    ActuatorLayout subLayout = layout_;
    const auto end =
        std::copy_if(layout_.places.begin(), layout_.places.begin() + layout_.count, subLayout.places.begin(),
                     [part](const ActuatorPlace& p) { return p.part == part; });
    subLayout.count = static_cast<int>(end - subLayout.places.begin());
    const auto span = [&](double ActuatorPlace::*axis, double fallbackMetres) {
        const auto [lowest, highest] = std::minmax_element(
            subLayout.places.begin(), end,
            [axis](const ActuatorPlace& a, const ActuatorPlace& b) { return a.*axis < b.*axis; });
        const double length = (*highest).*axis - (*lowest).*axis;
        return length > 0.0 ? length : fallbackMetres;
    };
    subLayout.extentWidthMetres = span(&ActuatorPlace::xMetres, layout_.extentWidthMetres);
    subLayout.extentHeightMetres = span(&ActuatorPlace::yMetres, layout_.extentHeightMetres);
    PhantomPanner partPanner{subLayout,
                             requestedLaw_,
                             rule_.exponent,
                             subLayout.extentWidthMetres / scaleX_,
                             subLayout.extentHeightMetres / scaleY_,
                             subLayout.count <= maxWithTriangles};
    if (requestedLaw_ != PanningLaw::automatic) partPanner.grains_ = grains_;
    return partPanner;
}

// Gains by another spread than the layout's. Those of Spread::equal are scaled: their squares sum to one.
void PhantomPanner::gainsForSpread(Spread spread, Vector p, Gains& gains) const noexcept {
    if (spread == Spread::layout) return gainsForRule(rule_, p, gains);
    if (spread == spreadBy(PanningLaw::automatic)) spread = travelSpread();
    if (spread == Spread::nearest) return nearestGains(p, gains);
    Rule rule{rule_.law, 1.0};
    if (spread == Spread::equal) rule.law = PanningLaw::energy;
    for (const auto& entry : panningLaws)
        if (spread == spreadBy(entry.law)) rule.law = entry.law;
    gainsForRule(rule, p, gains);
    if (spread != Spread::equal) return;
    const auto end = gains.begin() + layout_.count;
    const double energy =
        std::accumulate(gains.begin(), end, 0.0, [](double sum, double g) { return sum + g * g; });
    if (energy > 0.0)
        std::for_each(gains.begin(), end, [scale = 1.0 / std::sqrt(energy)](double& g) { g *= scale; });
}

// In one plane the triangles are the cells of a row, grid or belt.
void PhantomPanner::gainsForRule(Rule rule, Vector p, Gains& gains) const noexcept {
    const bool hasTriangles = rule.law == PanningLaw::triangles && triangles_.isUsable(),
               hasOwnCells = (rule.law == PanningLaw::triangles || rule.law == PanningLaw::neighbours) &&
                             cells_.isUsable();
    if (hasTriangles) triangles_.sharesAt(layout_, {p.x, p.y, p.z}, gains);
    if (hasOwnCells) cells_.sharesAt(layout_, {p.x, p.y, p.z}, gains);
    if (hasTriangles || hasOwnCells) return applyRuleToShares(rule, gains);
    const bool isByDistance = rule.law == PanningLaw::distance && arrangement_ != Arrangement::single;
    switch (isByDistance ? Arrangement::scattered : arrangement_) {
    case Arrangement::single: gains[0] = 1.0; break;
    case Arrangement::line: lineGains(rule, p, gains); break;
    case Arrangement::rectangle: rectangleGains(rule, p, gains); break;
    case Arrangement::triangle: triangleGains(rule, p, gains); break;
    case Arrangement::scattered: scatteredGains(rule, p, gains); break;
    }
}

void PhantomPanner::applyRuleToShares(Rule rule, Gains& shares) const noexcept {
    for (auto gain = shares.begin(); gain != shares.begin() + layout_.count; ++gain)
        *gain = gainFor(rule, 1.0 - *gain);
}

} // namespace physvib
