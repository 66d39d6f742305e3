// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing tools, selection and mouse input.
#include "Mixer/World/DrawPane.h"
#include "Mixer/Window/Parts.h"
#include "Scene/Drawing/DrawnBodies.h"
#include <algorithm>

namespace physvib {

DrawPane::DrawPane(Desk& desk, WorldView& view)
    : desk_{desk}
    , view_{view} {
    setTitle("Drawing");
    setInterceptsMouseClicks(false, false);
}

void DrawPane::use(DrawTool tool) {
    tool_ = tool;
    stroke_.clear();
    isDrawing_ = false;
    setInterceptsMouseClicks(tool != DrawTool::hand, false);
    setMouseCursor(tool == DrawTool::choose ? juce::MouseCursor::NormalCursor
                                            : juce::MouseCursor::CrosshairCursor);
    if (tool != DrawTool::choose) chosen_.clear();
    if (onChange) onChange();
    repaint();
}

void DrawPane::setMaterial(int material) {
    material_ = material;
    changeChosen("Material", [material](const Scene&, BodyDescription& body) {
        for (auto& fixture : body.fixtures) fixture.material = material;
    });
    if (onChange) onChange();
}

void DrawPane::setSnapping(bool snaps) {
    snaps_ = snaps;
    if (onChange) onChange();
}

void DrawPane::setRainCount(int count) {
    rainCount_ = count;
    if (onChange) onChange();
}

void DrawPane::choose(std::vector<std::string> names) {
    chosen_ = std::move(names);
    // the palette shows what the selection is made of
    if (const auto* body = chosen_.empty() ? nullptr : desk_.world().drawing().find(chosen_[0]))
        material_ = body->fixtures[0].material;
    if (onChange) onChange();
    repaint();
}

void DrawPane::takeMix() {
    const auto& drawing = desk_.world().drawing();
    const auto before = chosen_.size();
    std::erase_if(chosen_, [&](const std::string& name) { return drawing.find(name) == nullptr; });
    const auto& materials = drawing.drawn().materials;
    if (material_ < 0)
        material_ = static_cast<int>(
            std::ranges::find_if(materials, [](const Material& m) { return m.frequencyHz > 0.0; }) -
            materials.begin());
    if (material_ >= static_cast<int>(materials.size())) material_ = 0;
    if (before != chosen_.size() && onChange) onChange();
    repaint();
}

void DrawPane::changeChosen(const juce::String& name,
                            const std::function<void(const Scene&, BodyDescription&)>& change, bool goesOn) {
    std::vector<Action> actions;
    for (const std::string& chosen : chosen_)
        if (const auto* body = desk_.world().drawing().find(chosen)) {
            BodyDescription next = *body;
            change(desk_.world().drawing().drawn(), next);
            if (next != *body) actions.push_back(changed(std::move(next)));
        }
    edit(name, std::move(actions), goesOn);
}

void DrawPane::edit(const juce::String& name, std::vector<Action> actions, bool goesOn) {
    if (const auto fault = desk_.world().edit(name, std::move(actions), goesOn); !fault.empty())
        desk_.report(name + ": " + utf8(fault));
}

double DrawPane::grid() const {
    return snaps_ ? desk_.world().scene().fieldHeightMetres / gridsPerField : 0.0;
}
Vector DrawPane::at(const juce::MouseEvent& e) const { return snapped(view_.metresAt(e.position), grid()); }

std::optional<BodyPlace> DrawPane::placeNow(const std::string& name) const {
    const auto pose = view_.poseOfBody(name);
    return pose ? std::optional{BodyPlace{{pose->xMetres, pose->yMetres}, pose->angleRadians}} : std::nullopt;
}

// ---- the mouse

void DrawPane::mouseDown(const juce::MouseEvent& e) {
    if (e.mods.isPopupMenu()) return onMenu ? onMenu(e.position) : void();
    to_ = at(e);
    if (tool_ == DrawTool::polygon) {
        stroke_.push_back(to_);
        isDrawing_ = true;
        return repaint();
    }
    isDrawing_ = true;
    if (tool_ == DrawTool::eraser) return erase(e);
    if (tool_ == DrawTool::choose) grip(e);
    stroke_ = {tool_ == DrawTool::choose ? view_.metresAt(e.position) : to_};
    repaint();
}

void DrawPane::mouseMove(const juce::MouseEvent& e) {
    to_ = at(e);
    if (tool_ == DrawTool::polygon && !stroke_.empty()) repaint();
}

void DrawPane::mouseDrag(const juce::MouseEvent& e) {
    if (tool_ == DrawTool::eraser) return erase(e);
    to_ = tool_ == DrawTool::choose ? view_.metresAt(e.position) : at(e);
    if (tool_ == DrawTool::line) stroke_.push_back(to_);
    repaint();
}

void DrawPane::mouseUp(const juce::MouseEvent& e) {
    if (!isDrawing_ || tool_ == DrawTool::polygon) return;
    isDrawing_ = false;
    const bool hasMoved = e.getDistanceFromDragStart() > 2;
    if (isStroke(tool_))
        addStroke();
    else if (isJoint(tool_))
        join();
    else if (tool_ == DrawTool::choose && hasMoved) {
        if (grip_ == Grip::size)
            edit("Size", {changed(sizedNow())});
        else if (grip_ == Grip::move || grip_ == Grip::turn)
            edit(grip_ == Grip::turn ? "Turn" : "Move", movedTo(desk_.world().drawing(), movedNow()));
        else if (grip_ == Grip::around && !stroke_.empty()) {
            std::vector<std::string> inside = e.mods.isShiftDown() ? chosen_ : std::vector<std::string>{};
            for (const auto& body : desk_.world().drawing().drawn().bodies)
                if (const auto place = placeNow(body.name);
                    place && (place->metres.x - stroke_[0].x) * (place->metres.x - to_.x) < 0.0 &&
                    (place->metres.y - stroke_[0].y) * (place->metres.y - to_.y) < 0.0)
                    if (std::ranges::find(inside, body.name) == inside.end()) inside.push_back(body.name);
            choose(inside);
        }
    }
    grip_ = Grip::none;
    stroke_.clear();
    repaint();
}

void DrawPane::mouseDoubleClick(const juce::MouseEvent&) {
    if (tool_ == DrawTool::polygon) closePolygon();
}

} // namespace physvib
