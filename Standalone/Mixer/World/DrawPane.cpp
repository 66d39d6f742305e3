// SPDX-License-Identifier: GPL-3.0-or-later
// Mouse and keys become edits of the world's drawing.
#include "Mixer/World/DrawPane.h"
#include "Mixer/Window/Parts.h"
#include "Scene/Drawing/DrawnBodies.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr float handlePixels = 9.0f;
constexpr double gridsPerField = 40.0, turnStep = juce::MathConstants<double>::pi / 12.0;

bool isStroke(DrawTool tool) { return tool == DrawTool::ball || tool == DrawTool::box || tool == DrawTool::line || tool == DrawTool::wall; }
bool isJoint(DrawTool tool) { return tool == DrawTool::pin || tool == DrawTool::rope || tool == DrawTool::slider || tool == DrawTool::motor; }

double angleOf(const Vector& from, const Vector& to) { return std::atan2(to.y - from.y, to.x - from.x); }
double between(const Vector& a, const Vector& b) { return std::hypot(b.x - a.x, b.y - a.y); }

} // namespace

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
    setMouseCursor(tool == DrawTool::choose ? juce::MouseCursor::NormalCursor : juce::MouseCursor::CrosshairCursor);
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

void DrawPane::choose(std::vector<std::string> names) {
    chosen_ = std::move(names);
    if (onChange) onChange();
    repaint();
}

void DrawPane::takeMix() {
    const auto& drawing = desk_.world().drawing();
    const auto before = chosen_.size();
    std::erase_if(chosen_, [&](const std::string& name) { return drawing.find(name) == nullptr; });
    const auto& materials = drawing.drawn().materials;
    if (material_ < 0) material_ = static_cast<int>(std::ranges::find_if(materials, [](const Material& m) { return m.frequencyHz > 0.0; }) - materials.begin());
    if (material_ >= static_cast<int>(materials.size())) material_ = 0;
    if (before != chosen_.size() && onChange) onChange();
    repaint();
}

void DrawPane::changeChosen(const juce::String& name, const std::function<void(const Scene&, BodyDescription&)>& change, bool goesOn) {
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
    if (const auto fault = desk_.world().edit(name, std::move(actions), goesOn); !fault.empty()) desk_.report(name + ": " + utf8(fault));
}

double DrawPane::grid() const { return snaps_ ? desk_.world().scene().fieldHeightMetres / gridsPerField : 0.0; }
Vector DrawPane::at(const juce::MouseEvent& e) const { return snapped(view_.metresAt(e.position), grid()); }

std::optional<BodyPlace> DrawPane::placeNow(const std::string& name) const {
    const auto pose = view_.poseOfBody(name);
    return pose ? std::optional{BodyPlace{{pose->xMetres, pose->yMetres}, pose->angleRadians}} : std::nullopt;
}

// ---- what a gesture makes of what is chosen

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
    return Handles{{on(reach.least.x, reach.least.y), on(reach.most.x, reach.least.y), on(reach.most.x, reach.most.y), on(reach.least.x, reach.most.y)},
                   on(0.5 * (reach.least.x + reach.most.x), above), on(0.0, 0.0)};
}

void DrawPane::grip(const juce::MouseEvent& e) {
    if (const auto marks = handles()) {
        if (marks->turn.getDistanceFrom(e.position) < handlePixels) return void(grip_ = Grip::turn);
        for (const auto& corner : marks->corners)
            if (corner.getDistanceFrom(e.position) < handlePixels) return void(grip_ = Grip::size);
    }
    const auto under = view_.bodiesAt(e.position);
    const auto known = std::ranges::find_if(under, [&](const std::string& name) { return desk_.world().drawing().find(name) != nullptr; });
    if (known == under.end()) {
        if (!e.mods.isShiftDown()) choose({});
        return void(grip_ = Grip::around);
    }
    auto next = chosen_;
    const auto place = std::ranges::find(next, *known);
    if (e.mods.isShiftDown()) place == next.end() ? next.push_back(*known) : void(next.erase(place));
    else if (place == next.end()) next = {*known};
    choose(next);
    grip_ = Grip::move;
}

BodyDescription DrawPane::sizedNow() const {
    const auto& body = *desk_.world().drawing().find(chosen_[0]);
    const auto place = placeNow(chosen_[0]);
    if (!place || stroke_.empty()) return body;
    const auto local = [&](const Vector& p) {
        const double c = std::cos(place->angleRadians), s = std::sin(place->angleRadians), x = p.x - place->metres.x, y = p.y - place->metres.y;
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
                const double turned = place->angleRadians + angleOf(place->metres, to_) - angleOf(place->metres, stroke_[0]);
                place->angleRadians = snaps_ ? turnStep * std::round(turned / turnStep) : turned;
            } else place->metres = snapped({place->metres.x + to_.x - stroke_[0].x, place->metres.y + to_.y - stroke_[0].y}, grid());
            places.emplace(name, *place);
        }
    return places;
}

// ---- the mouse

void DrawPane::mouseDown(const juce::MouseEvent& e) {
    if (e.mods.isPopupMenu()) return;
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
    if (isStroke(tool_)) add(drawnNow());
    else if (isJoint(tool_)) join();
    else if (tool_ == DrawTool::choose && hasMoved) {
        if (grip_ == Grip::size) edit("Size", {changed(sizedNow())});
        else if (grip_ == Grip::move || grip_ == Grip::turn) edit(grip_ == Grip::turn ? "Turn" : "Move", movedTo(desk_.world().drawing(), movedNow()));
        else if (grip_ == Grip::around && !stroke_.empty()) {
            std::vector<std::string> inside = e.mods.isShiftDown() ? chosen_ : std::vector<std::string>{};
            for (const auto& body : desk_.world().drawing().drawn().bodies)
                if (const auto place = placeNow(body.name); place && (place->metres.x - stroke_[0].x) * (place->metres.x - to_.x) < 0.0 && (place->metres.y - stroke_[0].y) * (place->metres.y - to_.y) < 0.0)
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

// ---- new bodies

Result<BodyDescription> DrawPane::drawnNow() const {
    const double height = desk_.world().scene().fieldHeightMetres, size = 0.06 * height;
    const Vector from = stroke_.empty() ? to_ : stroke_[0];
    const bool isClick = between(from, to_) * static_cast<double>(view_.pixelsPerMetre()) < 4.0;
    switch (tool_) {
    case DrawTool::ball: return drawnBall(from, isClick ? Vector{from.x + size, from.y} : to_);
    case DrawTool::box: return isClick ? drawnBox({from.x - 1.1 * size, from.y - 0.8 * size}, {from.x + 1.1 * size, from.y + 0.8 * size}) : drawnBox(from, to_);
    case DrawTool::line: return drawnLine(stroke_, 0.004 * height);
    case DrawTool::wall: return drawnWall(isClick ? Vector{from.x - 2.0 * size, from.y} : from, isClick ? Vector{from.x + 2.0 * size, from.y} : to_, 0.03 * height);
    default: return drawnPolygon(stroke_);
    }
}

void DrawPane::add(Result<BodyDescription> body) {
    if (!body) return desk_.report(utf8(body.error));
    const auto& drawing = desk_.world().drawing();
    if (drawing.drawn().materials.empty()) return desk_.report("The scene has no materials to draw with");
    const auto& words = wordsOf(tool_);
    body.value.name = drawing.freeName(juce::String{words.name}.toLowerCase().toStdString());
    for (auto& fixture : body.value.fixtures) fixture.material = material_;
    const bool sounds = drawing.drawn().materials[static_cast<std::size_t>(material_)].frequencyHz > 0.0;
    if (sounds && startsAsSource(drawing.drawn(), body.value)) setSource(drawing.drawn(), body.value, true);
    edit("Draw a " + juce::String{words.name}.toLowerCase(), {SpawnAction{body.value, {}}});
}

void DrawPane::closePolygon() {
    const auto body = drawnPolygon(stroke_);
    stroke_.clear();
    isDrawing_ = false;
    add(body);
    repaint();
}

void DrawPane::addInTheMiddle() {
    const auto& scene = desk_.world().scene();
    const double size = 0.06 * scene.fieldHeightMetres;
    to_ = {0.5 * scene.fieldWidthMetres, 0.5 * scene.fieldHeightMetres};
    stroke_ = {to_};
    if (tool_ == DrawTool::line) stroke_ = {{to_.x - 2.0 * size, to_.y}, to_, {to_.x + 2.0 * size, to_.y}};
    if (tool_ == DrawTool::polygon) stroke_ = {{to_.x - size, to_.y - size}, {to_.x + size, to_.y - size}, {to_.x, to_.y + size}};
    const auto names = [&] {
        std::vector<std::string> all;
        for (const auto& body : desk_.world().drawing().drawn().bodies) all.push_back(body.name);
        return all;
    };
    const auto before = names().size();
    add(drawnNow());
    stroke_.clear();
    const auto after = names();
    if (after.size() == before) return;
    use(DrawTool::choose); // to be moved by the arrow keys
    choose({after.back()});
}

// ---- joints

// The field holds nothing: what is pinned to it is pinned to something static, or to a small disc that is put there.
std::string DrawPane::fieldBody(std::vector<Action>& actions, const Vector& place) {
    for (const auto& body : desk_.world().drawing().drawn().bodies)
        if (body.type == BodyType::staticBody) return body.name;
    const double size = std::max(0.011, 0.01 * desk_.world().scene().fieldHeightMetres);
    auto disc = drawnBall(place, {place.x + size, place.y}).value;
    disc.type = BodyType::staticBody;
    disc.name = desk_.world().drawing().freeName("pin");
    disc.fixtures[0].material = material_;
    actions.push_back(SpawnAction{disc, {}});
    return disc.name;
}

void DrawPane::join() {
    const Vector from = stroke_.empty() ? to_ : stroke_[0];
    const bool isPoint = tool_ == DrawTool::pin || tool_ == DrawTool::motor;
    const auto known = [&](const Vector& place) {
        auto names = view_.bodiesAt(view_.placeOfMetres(place));
        std::erase_if(names, [&](const std::string& name) { return desk_.world().drawing().find(name) == nullptr; });
        return names;
    };
    const auto first = known(from), second = isPoint ? first : known(to_);
    const std::size_t other = isPoint ? 1 : 0;
    if (first.empty() && (second.empty() || tool_ == DrawTool::slider)) return desk_.report("A joint: expected a body there");
    std::vector<Action> actions;
    std::string b = first.empty() ? std::string{} : first[0], a = second.size() > other && second[other] != b ? second[other] : std::string{};
    if (tool_ == DrawTool::slider) a.clear(); // its way is on the field
    if (b.empty()) b = fieldBody(actions, from);
    if (a.empty()) a = fieldBody(actions, isPoint ? from : to_);
    SceneDrawing trial = desk_.world().drawing();
    for (const Action& action : actions) trial.take(action);
    const auto place = [&](const std::string& name) {
        const auto now = placeNow(name);
        const auto* body = trial.find(name);
        return std::pair{name, now ? *now : body ? BodyPlace{body->positionMetres, body->angleRadians} : BodyPlace{}};
    };
    const auto kind = tool_ == DrawTool::pin ? JointKind::pin : tool_ == DrawTool::motor ? JointKind::motor : tool_ == DrawTool::rope ? JointKind::rope : JointKind::slider;
    const bool isTurnedRound = tool_ == DrawTool::rope; // the first place is on b
    auto made = joined(trial, kind, place(a), place(b), isTurnedRound ? to_ : from, isTurnedRound ? from : to_);
    if (!made) return desk_.report(utf8(made.error));
    actions.insert(actions.end(), made.value.begin(), made.value.end());
    edit(wordsOf(tool_).name, std::move(actions));
}

void DrawPane::erase(const juce::MouseEvent& e) {
    const auto& drawing = desk_.world().drawing();
    if (const auto joint = jointAt(e.position); !joint.empty()) return edit("Erase", {UnjoinAction{joint}}, e.getDistanceFromDragStart() > 2);
    for (const auto& name : view_.bodiesAt(e.position))
        if (drawing.find(name) != nullptr) return edit("Erase", erased(drawing, {name}), e.getDistanceFromDragStart() > 2);
}

// ---- keys

void DrawPane::nudge(Vector byMetres, double byRadians) {
    std::map<std::string, BodyPlace> places;
    for (const std::string& name : chosen_)
        if (auto place = placeNow(name)) places.emplace(name, BodyPlace{{place->metres.x + byMetres.x, place->metres.y + byMetres.y}, place->angleRadians + byRadians});
    edit(byRadians != 0.0 ? "Turn" : "Move", movedTo(desk_.world().drawing(), places));
}

void DrawPane::scaleChosen(double factor) {
    changeChosen("Size", [factor](const Scene&, BodyDescription& body) { body = scaledBody(body, factor, factor); });
}

void DrawPane::paste(const Copied& copy) {
    const double step = desk_.world().scene().fieldHeightMetres / 20.0;
    std::vector<std::string> names;
    edit("Paste", pasted(desk_.world().drawing(), copy, {step, step}, names));
    use(DrawTool::choose);
    choose(names);
}

bool DrawPane::takeToolKey(const juce::KeyPress& key) {
    if (key.getModifiers().isAnyModifierKeyDown()) return false;
    for (const auto& words : drawTools)
        if (key.getKeyCode() == juce::CharacterFunctions::toUpperCase(static_cast<juce::juce_wchar>(words.key)) || key.getTextCharacter() == static_cast<juce::juce_wchar>(words.key)) return use(words.tool), true;
    if (key.getTextCharacter() == 'g') return setSnapping(!snaps_), true;
    return false;
}

bool DrawPane::takeKey(const juce::KeyPress& key) {
    using juce::KeyPress;
    const auto command = juce::ModifierKeys::commandModifier;
    if (takeToolKey(key)) return true;
    if (tool_ == DrawTool::hand) return false;
    if (key == KeyPress::returnKey && tool_ == DrawTool::polygon && !stroke_.empty()) return closePolygon(), true;
    if (key == KeyPress::returnKey && (isStroke(tool_) || tool_ == DrawTool::polygon)) return addInTheMiddle(), true;
    if (key == KeyPress{'a', command, 0}) {
        std::vector<std::string> all;
        for (const auto& body : desk_.world().drawing().drawn().bodies) all.push_back(body.name);
        return use(DrawTool::choose), choose(all), true;
    }
    if (key == KeyPress{'v', command, 0} && !copied_.bodies.empty()) return paste(copied_), true;
    if (key == KeyPress::tabKey || chosen_.empty()) return false;
    const double step = desk_.world().scene().fieldHeightMetres / gridsPerField;
    if (key == KeyPress::deleteKey || key == KeyPress::backspaceKey) return edit("Erase", erased(desk_.world().drawing(), chosen_)), true;
    if (key == KeyPress{'c', command, 0}) return copied_ = copied(desk_.world().drawing(), chosen_), true;
    if (key == KeyPress{'d', command, 0}) return paste(copied(desk_.world().drawing(), chosen_)), true;
    if (key == KeyPress::leftKey) return nudge({-step, 0.0}, 0.0), true;
    if (key == KeyPress::rightKey) return nudge({step, 0.0}, 0.0), true;
    if (key == KeyPress::upKey) return nudge({0.0, step}, 0.0), true;
    if (key == KeyPress::downKey) return nudge({0.0, -step}, 0.0), true;
    if (key.getTextCharacter() == '[') return nudge({}, turnStep), true;
    if (key.getTextCharacter() == ']') return nudge({}, -turnStep), true;
    if (key.getTextCharacter() == '+') return scaleChosen(1.1), true;
    if (key.getTextCharacter() == '-') return scaleChosen(1.0 / 1.1), true;
    return false;
}

} // namespace physvib
