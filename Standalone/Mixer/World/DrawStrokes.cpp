// SPDX-License-Identifier: GPL-3.0-or-later
// Converts mouse strokes to new bodies, and erases bodies and joints.
#include "Mixer/Desk/DeskWords.h"
#include "Mixer/World/DrawPane.h"
#include "Mixer/World/FeltHint.h"
#include "Scene/Drawing/DrawnBodies.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

double between(const Vector& a, const Vector& b) { return std::hypot(b.x - a.x, b.y - a.y); }

} // namespace

Result<BodyDescription> DrawPane::drawnNow() const {
    const double height = desk_.world().scene().fieldHeightMetres, size = 0.06 * height;
    const Vector from = stroke_.empty() ? to_ : stroke_[0];
    const bool isClick = between(from, to_) * static_cast<double>(view_.pixelsPerMetre()) < 4.0;
    switch (tool_) {
    case DrawTool::ball: return drawnBall(from, isClick ? Vector{from.x + size, from.y} : to_);
    case DrawTool::box:
        return isClick ? drawnBox({from.x - 1.1 * size, from.y - 0.8 * size},
                                  {from.x + 1.1 * size, from.y + 0.8 * size})
                       : drawnBox(from, to_);
    case DrawTool::line: return drawnLine(stroke_, 0.004 * height);
    case DrawTool::wall:
        return drawnWall(isClick ? Vector{from.x - 2.0 * size, from.y} : from,
                         isClick ? Vector{from.x + 2.0 * size, from.y} : to_, 0.03 * height);
    default: return drawnPolygon(stroke_);
    }
}

// A click gives a rain of the usual size, all of it within the field.
Result<std::vector<BodyDescription>> DrawPane::rainNow() const {
    const auto& scene = desk_.world().scene();
    const Vector from = stroke_.empty() ? to_ : stroke_[0];
    const bool isClick = between(from, to_) * static_cast<double>(view_.pixelsPerMetre()) < 4.0;
    const double x = 0.15 * scene.fieldWidthMetres, y = 0.15 * scene.fieldHeightMetres;
    if (!isClick) return drawnRain(from, to_, rainCount_);
    const Vector at{std::clamp(from.x, x, scene.fieldWidthMetres - x),
                    std::clamp(from.y, y, scene.fieldHeightMetres - y)};
    return drawnRain({at.x - x, at.y - y}, {at.x + x, at.y + y}, rainCount_);
}

void DrawPane::addStroke() {
    if (tool_ == DrawTool::rain) return rainWay_.perSecond > 0 ? beginRain(rainNow()) : add(rainNow());
    auto body = drawnNow();
    if (!body) return add(Failure{body.error});
    add(std::vector{std::move(body.value)});
}

/// Names, material and whether they are felt; false: there is nothing to draw with.
bool DrawPane::prepare(std::vector<BodyDescription>& bodies) {
    const auto& drawing = desk_.world().drawing();
    if (drawing.drawn().materials.empty())
        return desk_.report("The scene has no materials to draw with"), false;
    const auto names =
        drawing.freeNames(juce::String{wordsOf(tool_).name}.toLowerCase().toStdString(), bodies.size());
    const bool sounds = drawing.drawn().materials[static_cast<std::size_t>(material_)].frequencyHz > 0.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        bodies[k].name = names[k];
        for (auto& fixture : bodies[k].fixtures) fixture.material = material_;
        if (sounds && startsAsSource(drawing.drawn(), bodies[k])) setSource(drawing.drawn(), bodies[k], true);
    }
    return true;
}

// One edit.
void DrawPane::add(Result<std::vector<BodyDescription>> bodies) {
    if (!bodies) return desk_.report(utf8(bodies.error));
    if (!prepare(bodies.value)) return;
    std::vector<Action> actions;
    const std::string first = bodies.value.front().name;
    for (auto& body : bodies.value) actions.push_back(SpawnAction{std::move(body), {}});
    edit("Draw a " + juce::String{wordsOf(tool_).name}.toLowerCase(), std::move(actions));
    hintOnBody(desk_, first);
}

void DrawPane::closePolygon() {
    addStroke();
    stroke_.clear();
    isDrawing_ = false;
    repaint();
}

void DrawPane::addAt(DrawTool tool, Vector place) {
    const DrawTool before = tool_;
    use(tool);
    to_ = place;
    stroke_ = {place};
    addStroke();
    use(before);
}

void DrawPane::addInTheMiddle() {
    const auto& scene = desk_.world().scene();
    const double size = 0.06 * scene.fieldHeightMetres;
    to_ = {0.5 * scene.fieldWidthMetres, 0.5 * scene.fieldHeightMetres};
    stroke_ = {to_};
    if (tool_ == DrawTool::line) stroke_ = {{to_.x - 2.0 * size, to_.y}, to_, {to_.x + 2.0 * size, to_.y}};
    if (tool_ == DrawTool::polygon)
        stroke_ = {{to_.x - size, to_.y - size}, {to_.x + size, to_.y - size}, {to_.x, to_.y + size}};
    const auto names = [&] {
        std::vector<std::string> all;
        for (const auto& body : desk_.world().drawing().drawn().bodies) all.push_back(body.name);
        return all;
    };
    const auto before = names().size();
    addStroke();
    stroke_.clear();
    const auto after = names();
    if (after.size() == before) return;
    use(DrawTool::choose); // so that arrow keys move it
    choose({after.back()});
}

void DrawPane::erase(const juce::MouseEvent& e) {
    const auto& drawing = desk_.world().drawing();
    if (const auto joint = jointAt(e.position); !joint.empty())
        return edit("Erase", {UnjoinAction{joint}}, e.getDistanceFromDragStart() > 2);
    for (const auto& name : view_.bodiesAt(e.position))
        if (drawing.find(name) != nullptr)
            return edit("Erase", erased(drawing, {name}), e.getDistanceFromDragStart() > 2);
}

} // namespace physvib
