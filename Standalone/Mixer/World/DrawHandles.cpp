// SPDX-License-Identifier: GPL-3.0-or-later
// Applies mouse gestures on the selected bodies: handles, sizes, places.
#include "Mixer/World/DrawPane.h"
#include "Scene/Drawing/DrawnBodies.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr float handlePixels = 9.0f;

double angleOf(const Vector& from, const Vector& to) { return std::atan2(to.y - from.y, to.x - from.x); }

} // namespace

std::optional<DrawPane::Handles> DrawPane::handles() const {
    const auto* body = chosen_.size() == 1 ? desk_.world().drawing().find(chosen_[0]) : nullptr;
    const auto place = body ? placeNow(chosen_[0]) : std::nullopt;
    if (!place) return std::nullopt;
    const Reach reach = reachOf(*body);
    const auto on = [&](double x, double y) {
        const double c = std::cos(place->angleRadians), s = std::sin(place->angleRadians);
        return view_.placeOfMetres({place->metres.x + c * x - s * y, place->metres.y + s * x + c * y});
    };
    const double above = reach.most.y + 26.0 / static_cast<double>(view_.pixelsPerMetre());
    return Handles{{on(reach.least.x, reach.least.y), on(reach.most.x, reach.least.y),
                    on(reach.most.x, reach.most.y), on(reach.least.x, reach.most.y)},
                   on(0.5 * (reach.least.x + reach.most.x), above),
                   on(0.0, 0.0)};
}

juce::Rectangle<float> DrawPane::chosenArea() const {
    constexpr float withHandles = 34.0f;
    juce::Rectangle<float> area;
    for (const std::string& name : chosen_)
        if (const auto* body = desk_.world().drawing().find(name); body != nullptr && placeNow(name)) {
            const Reach reach = reachOf(*body);
            const auto radius =
                static_cast<float>(std::max({reach.most.x, reach.most.y, -reach.least.x, -reach.least.y})) *
                view_.pixelsPerMetre();
            const auto around = juce::Rectangle<float>{2.0f * radius, 2.0f * radius}.withCentre(
                view_.placeOfMetres(placeNow(name)->metres));
            area = area.isEmpty() ? around : area.getUnion(around);
        }
    return area.isEmpty() ? area : area.expanded(withHandles);
}

void DrawPane::grip(const juce::MouseEvent& e) {
    if (const auto marks = handles()) {
        if (marks->turn.getDistanceFrom(e.position) < handlePixels) return void(grip_ = Grip::turn);
        for (const auto& corner : marks->corners)
            if (corner.getDistanceFrom(e.position) < handlePixels) return void(grip_ = Grip::size);
    }
    const auto under = view_.bodiesAt(e.position);
    const auto known = std::ranges::find_if(
        under, [&](const std::string& name) { return desk_.world().drawing().find(name) != nullptr; });
    if (known == under.end()) {
        if (!e.mods.isShiftDown()) choose({});
        return void(grip_ = Grip::around);
    }
    auto next = chosen_;
    const auto place = std::ranges::find(next, *known);
    if (e.mods.isShiftDown())
        place == next.end() ? next.push_back(*known) : void(next.erase(place));
    else if (place == next.end())
        next = {*known};
    choose(next);
    grip_ = Grip::move;
}

BodyDescription DrawPane::sizedNow() const {
    const auto& body = *desk_.world().drawing().find(chosen_[0]);
    const auto place = placeNow(chosen_[0]);
    if (!place || stroke_.empty()) return body;
    const auto local = [&](const Vector& p) {
        const double c = std::cos(place->angleRadians), s = std::sin(place->angleRadians),
                     x = p.x - place->metres.x, y = p.y - place->metres.y;
        return Vector{std::abs(c * x + s * y), std::abs(-s * x + c * y)};
    };
    const Vector before = local(stroke_[0]), now = local(to_);
    const auto factor = [](double a, double b) { return a > 1e-6 ? std::clamp(b / a, 0.05, 20.0) : 1.0; };
    return scaledBody(body, factor(before.x, now.x), factor(before.y, now.y));
}

std::map<std::string, BodyPlace> DrawPane::movedNow() const {
    std::map<std::string, BodyPlace> places;
    if (stroke_.empty()) return places;
    for (const std::string& name : chosen_)
        if (auto place = placeNow(name)) {
            if (grip_ == Grip::turn) {
                const double turned =
                    place->angleRadians + angleOf(place->metres, to_) - angleOf(place->metres, stroke_[0]);
                place->angleRadians = snaps_ ? turnStep * std::round(turned / turnStep) : turned;
            } else
                place->metres = snapped(
                    {place->metres.x + to_.x - stroke_[0].x, place->metres.y + to_.y - stroke_[0].y}, grid());
            places.emplace(name, *place);
        }
    return places;
}

} // namespace physvib
