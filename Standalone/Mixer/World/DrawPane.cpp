// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing tools, selection and mouse input.
#include "Mixer/World/DrawPane.h"
#include "Mixer/Widgets/Parts.h"
#include "Pictures/ShapeOutline.h"
#include "Scene/Drawing/BodyEdits.h"

namespace physvib {

namespace {

/// Of a new body: if it moves, that of the last moving body that vibrates; else the first that vibrates.
int usualMaterial(const Scene& scene, DrawTool tool) {
    const auto sounds = [](const Material& m) { return m.frequencyHz > 0.0; };
    if (tool != DrawTool::wall && tool != DrawTool::line && tool != DrawTool::conveyor)
        for (auto body = scene.bodies.rbegin(); body != scene.bodies.rend(); ++body) {
            const int material = body->fixtures[0].material;
            if (body->type == BodyType::dynamicBody && sounds(nth(scene.materials, material)))
                return material;
        }
    return static_cast<int>(std::ranges::find_if(scene.materials, sounds) - scene.materials.begin());
}

double between(const Vector& a, const Vector& b) { return std::hypot(b.x - a.x, b.y - a.y); }

constexpr float handlePixels = 9.0f;

double angleOf(const Vector& from, const Vector& to) { return std::atan2(to.y - from.y, to.x - from.x); }

} // namespace

DrawPane::DrawPane(MixerModel& model, WorldView& view)
    : model_{model}
    , view_{view}
    , rain_{model} {
    setTitle("Drawing");
    setInterceptsMouseClicks(false, false);
}

void DrawPane::use(DrawTool tool) {
    tool_ = tool;
    cancelStroke();
    setInterceptsMouseClicks(tool != DrawTool::hand, false);
    setMouseCursor(tool == DrawTool::choose ? juce::MouseCursor::NormalCursor
                                            : juce::MouseCursor::CrosshairCursor);
    if (tool != DrawTool::choose) chosen_.clear();
    if (!isPicked_) material_ = usualMaterial(drawing().drawn(), tool);
    if (onChange) onChange();
}

void DrawPane::cancelStroke() {
    stroke_.clear();
    isDrawing_ = false;
    grip_ = Grip::none;
    repaint();
}

// A body that has just been drawn keeps its material; the next one gets this.
void DrawPane::setMaterial(int material) {
    material_ = material;
    isPicked_ = true;
    if (tool_ == DrawTool::choose) giveMaterial(material);
    if (onChange) onChange();
}

void DrawPane::giveMaterial(int material) {
    changeChosen("Material", [material](const Scene& scene, BodyDescription& body) {
        const auto vibrates = [&scene](int m) { return nth(scene.materials, m).frequencyHz > 0.0; };
        if (!vibrates(material)) // which is not felt
            setSource(scene, body, false);
        else if (!vibrates(body.fixtures[0].material) && startsAsSource(body)) // as if it were drawn now
            setSource(scene, body, true);
        for (auto& fixture : body.fixtures) fixture.material = material;
    });
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
    if (const auto* body = chosen_.empty() ? nullptr : drawing().find(chosen_[0]))
        material_ = body->fixtures[0].material;
    if (onChange) onChange();
    repaint();
}

void DrawPane::chooseAll() {
    std::vector<std::string> all;
    for (const auto& body : drawing().drawn().bodies) all.push_back(body.name);
    use(DrawTool::choose);
    choose(std::move(all));
}

void DrawPane::mixChanged() {
    const auto before = chosen_.size();
    std::erase_if(chosen_, [&](const std::string& name) { return drawing().find(name) == nullptr; });
    const auto& materials = drawing().drawn().materials;
    if (scene_ != model_.mix().scene) {
        scene_ = model_.mix().scene;
        isPicked_ = false;
        material_ = usualMaterial(drawing().drawn(), tool_);
    }
    if (material_ >= static_cast<int>(materials.size())) material_ = 0;
    if (before != chosen_.size() && onChange) onChange();
    repaint();
}

void DrawPane::changeChosen(const juce::String& name,
                            const std::function<void(const Scene&, BodyDescription&)>& change,
                            bool continuesEdit) {
    std::vector<Action> actions;
    for (const std::string& chosen : chosen_)
        if (const auto* body = drawing().find(chosen)) {
            BodyDescription next = *body;
            change(drawing().drawn(), next);
            if (next != *body) actions.push_back(changed(std::move(next)));
        }
    edit(name, std::move(actions), continuesEdit);
}

void DrawPane::edit(const juce::String& name, std::vector<Action> actions, bool continuesEdit) {
    if (const auto fault = model_.world().edit(name, std::move(actions), continuesEdit); !fault.empty())
        model_.report(name + ": " + utf8(fault));
}

std::optional<BodyPlace> DrawPane::placeNow(const std::string& name) const {
    const auto seen = view_.poseOfBody(name);
    const auto pose = seen ? drawable(*seen) : std::nullopt;
    return pose ? std::optional{BodyPlace{{pose->xMetres, pose->yMetres}, pose->angleRadians}} : std::nullopt;
}

/// Whether the current shape cannot start there: beyond the edge of the field.
bool DrawPane::isBeside(juce::Point<float> place) const {
    constexpr float edge = 10.0f;
    return (isStroke(tool_) || tool_ == DrawTool::polygon) &&
           !juce::Rectangle<float>{view_.placeOfShare({0.0, 1.0}), view_.placeOfShare({1.0, 0.0})}
                .expanded(edge)
                .contains(place);
}

void DrawPane::mouseDown(const juce::MouseEvent& e) {
    if (e.mods.isPopupMenu()) return onMenu ? onMenu(e.position) : void();
    model_.messages().withdraw(triedLabel); // the last attempt is over
    to_ = at(e);
    if (tool_ != DrawTool::choose) choose({});
    if (isBeside(e.position)) return;
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
    if (tool_ != DrawTool::choose)
        setMouseCursor(isBeside(e.position) ? juce::MouseCursor::NormalCursor
                                            : juce::MouseCursor::CrosshairCursor);
    if (tool_ == DrawTool::polygon && !stroke_.empty()) repaint();
}

void DrawPane::mouseDrag(const juce::MouseEvent& e) {
    if (!isDrawing_) return;
    if (tool_ == DrawTool::eraser) return erase(e);
    to_ = tool_ == DrawTool::choose ? view_.metresAt(e.position) : at(e);
    if (tool_ == DrawTool::line) stroke_.push_back(to_);
    repaint();
}

void DrawPane::mouseUp(const juce::MouseEvent& e) {
    if (!isDrawing_ || tool_ == DrawTool::polygon) return;
    const bool hasMoved = e.getDistanceFromDragStart() > 2;
    if (isStroke(tool_))
        addStroke();
    else if (isJoint(tool_))
        join();
    else if (tool_ == DrawTool::choose && hasMoved) {
        if (grip_ == Grip::size)
            edit("Size", {changed(sizedNow())});
        else if (grip_ == Grip::move || grip_ == Grip::turn)
            edit(grip_ == Grip::turn ? "Turn" : "Move", movedTo(drawing(), movedNow()));
        else if (grip_ == Grip::around && !stroke_.empty()) {
            std::vector<std::string> inside = e.mods.isShiftDown() ? chosen_ : std::vector<std::string>{};
            for (const auto& body : drawing().drawn().bodies)
                if (const auto place = placeNow(body.name);
                    place && (place->metres.x - stroke_[0].x) * (place->metres.x - to_.x) < 0.0 &&
                    (place->metres.y - stroke_[0].y) * (place->metres.y - to_.y) < 0.0)
                    if (std::ranges::find(inside, body.name) == inside.end()) inside.push_back(body.name);
            choose(inside);
        }
    }
    cancelStroke();
}

void DrawPane::mouseDoubleClick(const juce::MouseEvent&) {
    if (tool_ == DrawTool::polygon) closePolygon();
}

Result<BodyDescription> DrawPane::drawnNow() const {
    const double height = model_.world().scene().fieldHeightMetres, size = 0.06 * height;
    const Vector from = stroke_.empty() ? to_ : stroke_[0];
    const bool isClick = between(from, to_) * static_cast<double>(view_.pixelsPerMetre()) < 4.0;
    switch (tool_) {
    case DrawTool::ball: return drawnBall(from, isClick ? Vector{from.x + size, from.y} : to_);
    case DrawTool::box:
        return isClick ? drawnBox({from.x - 1.1 * size, from.y - 0.8 * size},
                                  {from.x + 1.1 * size, from.y + 0.8 * size})
                       : drawnBox(from, to_);
    case DrawTool::line: return drawnLine(stroke_, 0.004 * height);
    case DrawTool::conveyor: return beltNow();
    case DrawTool::wall:
        return drawnWall(isClick ? Vector{from.x - 2.0 * size, from.y} : from,
                         isClick ? Vector{from.x + 2.0 * size, from.y} : to_, 0.03 * height);
    default: return drawnPolygon(stroke_);
    }
}

// A click gives a rain of the default size within the field. After a drag no side is shorter than half of
// that, because the balls of a flat rain would be too small.
Result<std::vector<BodyDescription>> DrawPane::rainNow() const {
    const auto& scene = model_.world().scene();
    const Vector from = stroke_.empty() ? to_ : stroke_[0];
    const bool isClick = between(from, to_) * static_cast<double>(view_.pixelsPerMetre()) < 4.0;
    const auto side = [isClick](double a, double b, double field) { // centre and half length
        const double half = 0.5 * std::abs(b - a), least = (isClick ? 0.15 : 0.075) * field;
        return half < least ? std::pair{std::clamp(0.5 * (a + b), least, field - least), least}
                            : std::pair{0.5 * (a + b), half};
    };
    const auto [x, wide] = side(from.x, to_.x, scene.fieldWidthMetres);
    const auto [y, high] = side(from.y, to_.y, scene.fieldHeightMetres);
    return drawnRain({x - wide, y - high}, {x + wide, y + high}, rainCount_);
}

// A wall whose surface moves in the direction of the drag; after a click, to the right.
Result<BodyDescription> DrawPane::beltNow() const {
    constexpr double thickShare = 0.05, speedShare = 0.8; // of the field's height; speed per second
    const double height = model_.world().scene().fieldHeightMetres, thick = thickShare * height;
    const Vector from = stroke_.empty() ? to_ : stroke_[0];
    const bool isClick = between(from, to_) < thick;
    auto belt = drawnWall(from, isClick ? Vector{from.x + 8.0 * thick, from.y} : to_, thick);
    belt.value.velocityMetresPerSecond.x = (!isClick && to_.x < from.x ? -1.0 : 1.0) * speedShare * height;
    return belt;
}

void DrawPane::addStroke() {
    if (tool_ == DrawTool::rain) {
        auto bodies = rainNow();
        if (!bodies || rain_.pattern().perSecond == 0) return add(std::move(bodies));
        if (prepare(bodies.value)) rain_.begin(std::move(bodies.value));
        return;
    }
    auto body = drawnNow();
    if (!body) return add(Failure{body.error});
    add(std::vector{std::move(body.value)});
}

/// Sets name, material and haptic source of new bodies; false: the scene has no materials.
bool DrawPane::prepare(std::vector<BodyDescription>& bodies) {
    if (drawing().drawn().materials.empty())
        return model_.report("The scene has no materials to draw with"), false;
    const auto names =
        drawing().freeNames(juce::String{wordsOf(tool_).name}.toLowerCase().toStdString(), bodies.size());
    const bool sounds = nth(drawing().drawn().materials, material_).frequencyHz > 0.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        bodies[k].name = names[k];
        for (auto& fixture : bodies[k].fixtures) fixture.material = material_;
        if (sounds && startsAsSource(bodies[k])) setSource(drawing().drawn(), bodies[k], true);
    }
    return true;
}

// Adds the bodies as one edit, or reports their error.
void DrawPane::add(Result<std::vector<BodyDescription>> bodies) {
    if (!bodies) return model_.report(utf8(bodies.error));
    if (!prepare(bodies.value)) return;
    std::vector<Action> actions;
    const std::vector<std::string> names{bodies.value.front().name};
    for (auto& body : bodies.value) actions.push_back(SpawnAction{std::move(body), {}});
    edit("Draw a " + juce::String{wordsOf(tool_).name}.toLowerCase(), std::move(actions));
    if (tool_ != DrawTool::conveyor) hintOnBody(model_, names.front()); // a belt is not felt
    if (drawing().find(names.front()) != nullptr) choose(names);        // keeps the body panel visible
}

void DrawPane::closePolygon() {
    addStroke();
    cancelStroke();
}

void DrawPane::addAt(DrawTool tool, Vector place) {
    const DrawTool before = tool_;
    use(tool);
    to_ = place;
    stroke_ = {place};
    constexpr double length = 0.2; // of a spring, which hangs from a place above
    if (tool == DrawTool::spring) to_.y += length * model_.world().scene().fieldHeightMetres;
    isJoint(tool) ? join() : addStroke();
    use(before);
}

void DrawPane::addInTheMiddle() {
    const auto& scene = model_.world().scene();
    const double size = 0.06 * scene.fieldHeightMetres;
    to_ = {0.5 * scene.fieldWidthMetres, 0.5 * scene.fieldHeightMetres};
    stroke_ = {to_};
    if (tool_ == DrawTool::line) stroke_ = {{to_.x - 2.0 * size, to_.y}, to_, {to_.x + 2.0 * size, to_.y}};
    if (tool_ == DrawTool::polygon)
        stroke_ = {{to_.x - size, to_.y - size}, {to_.x + size, to_.y - size}, {to_.x, to_.y + size}};
    choose({});
    addStroke(); // selects the new body
    stroke_.clear();
    if (chosen_.empty()) return;
    const auto drawn = chosen_;
    use(DrawTool::choose); // so that arrow keys move it
    choose(drawn);
}

void DrawPane::erase(const juce::MouseEvent& e) {
    if (const auto joint = jointAt(e.position); !joint.empty())
        return edit("Erase", {UnjoinAction{joint}}, e.getDistanceFromDragStart() > 2);
    for (const auto& name : view_.bodiesAt(e.position))
        if (drawing().find(name) != nullptr) return eraseAll({name}, e.getDistanceFromDragStart() > 2);
}

void DrawPane::setRainPattern(const RainPattern& pattern) {
    rain_.setPattern(pattern);
    if (onChange) onChange();
}

// The field itself is not a body. A joint to it uses a static body, or a small disc that is added there.
std::string DrawPane::fieldBody(std::vector<Action>& actions, const Vector& place) {
    for (const auto& body : drawing().drawn().bodies)
        if (body.type == BodyType::staticBody) return body.name;
    const double size = std::max(0.011, 0.01 * model_.world().scene().fieldHeightMetres);
    auto disc = drawnBall(place, {place.x + size, place.y}).value;
    disc.type = BodyType::staticBody;
    disc.name = drawing().freeName("pin");
    disc.fixtures[0].material = material_;
    actions.push_back(SpawnAction{disc, {}});
    return disc.name;
}

void DrawPane::join() {
    const Vector from = stroke_.empty() ? to_ : stroke_[0];
    const bool isPoint = tool_ == DrawTool::pin || tool_ == DrawTool::motor;
    const auto known = [&](const Vector& place) {
        auto names = view_.bodiesAt(view_.placeOfMetres(place));
        std::erase_if(names, [&](const std::string& name) { return drawing().find(name) == nullptr; });
        return names;
    };
    const auto first = known(from), second = isPoint ? first : known(to_);
    const std::size_t other = isPoint ? 1 : 0;
    if (first.empty() && (second.empty() || tool_ == DrawTool::slider))
        return model_.messages().show({"A joint holds a body: begin on one, in a pause if they move",
                                       false,
                                       {"Pause", [&model = model_] { model.setSlowness(0); }},
                                       triedLabel});
    std::vector<Action> actions;
    std::string b = first.empty() ? std::string{} : first[0],
                a = second.size() > other && second[other] != b ? second[other] : std::string{};
    if (tool_ == DrawTool::slider) a.clear(); // its axis is fixed to the field
    if (b.empty()) b = fieldBody(actions, from);
    if (a.empty()) a = fieldBody(actions, isPoint ? from : to_);
    SceneDrawing trial = drawing();
    for (const Action& action : actions) trial.take(action);
    const auto place = [&](const std::string& name) {
        const auto now = placeNow(name);
        const auto* body = trial.find(name);
        return std::pair{name, now    ? *now
                               : body ? BodyPlace{body->positionMetres, body->angleRadians}
                                      : BodyPlace{}};
    };
    const auto kind = tool_ == DrawTool::pin      ? JointKind::pin
                      : tool_ == DrawTool::motor  ? JointKind::motor
                      : tool_ == DrawTool::rope   ? JointKind::rope
                      : tool_ == DrawTool::spring ? JointKind::spring
                                                  : JointKind::slider;
    const bool isTurnedRound = tool_ == DrawTool::rope || tool_ == DrawTool::spring; // the stroke begins on b
    auto made =
        joined(trial, kind, place(a), place(b), isTurnedRound ? to_ : from, isTurnedRound ? from : to_);
    if (!made) return model_.report(utf8(made.error));
    actions.insert(actions.end(), made.value.begin(), made.value.end());
    model_.messages().withdraw(triedLabel);
    edit(wordsOf(tool_).name, std::move(actions));
}

juce::Rectangle<float> DrawPane::chosenArea() const {
    juce::Rectangle<float> area;
    for (const std::string& name : chosen_) {
        const auto* body = drawing().find(name);
        const auto place = body ? placeNow(name) : std::nullopt;
        if (!place) continue;
        const Reach reach = reachOf(*body);
        for (const double x : {reach.least.x, reach.most.x})
            for (const double y : {reach.least.y, reach.most.y}) {
                const auto at = view_.placeOfMetres(detail::Motion{{}, *place}({x, y}));
                area = area.getUnion(juce::Rectangle<float>{1.0f, 1.0f}.withCentre(at));
            }
    }
    return area;
}

std::optional<DrawPane::Handles> DrawPane::handles() const {
    const auto* body = chosen_.size() == 1 ? drawing().find(chosen_[0]) : nullptr;
    const auto place = body ? placeNow(chosen_[0]) : std::nullopt;
    if (!place) return std::nullopt;
    const Reach reach = reachOf(*body);
    const auto on = [&](double x, double y) {
        return view_.placeOfMetres(detail::Motion{{}, *place}({x, y}));
    };
    const double above = reach.most.y + 26.0 / static_cast<double>(view_.pixelsPerMetre());
    return Handles{{on(reach.least.x, reach.least.y), on(reach.most.x, reach.least.y),
                    on(reach.most.x, reach.most.y), on(reach.least.x, reach.most.y)},
                   on(0.5 * (reach.least.x + reach.most.x), above),
                   on(0.0, 0.0)};
}

void DrawPane::grip(const juce::MouseEvent& e) {
    if (const auto marks = handles()) {
        if (marks->turn.getDistanceFrom(e.position) < handlePixels) return void(grip_ = Grip::turn);
        for (const auto& corner : marks->corners)
            if (corner.getDistanceFrom(e.position) < handlePixels) return void(grip_ = Grip::size);
    }
    const auto under = view_.bodiesAt(e.position);
    const auto known =
        std::ranges::find_if(under, [&](const std::string& name) { return drawing().find(name) != nullptr; });
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
    const auto& body = *drawing().find(chosen_[0]);
    const auto place = placeNow(chosen_[0]);
    if (!place || stroke_.empty()) return body;
    const auto local = [&](const Vector& p) {
        const Vector in = detail::Motion{*place, {}}(p);
        return Vector{std::abs(in.x), std::abs(in.y)};
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
                const double angle =
                    place->angleRadians + angleOf(place->metres, to_) - angleOf(place->metres, stroke_[0]);
                place->angleRadians = snaps_ ? turnStep * std::round(angle / turnStep) : angle;
            } else
                place->metres = snapped(
                    {place->metres.x + to_.x - stroke_[0].x, place->metres.y + to_.y - stroke_[0].y}, grid());
            places.emplace(name, *place);
        }
    return places;
}

void DrawPane::nudge(Vector byMetres, double byRadians) {
    std::map<std::string, BodyPlace> places;
    for (const std::string& name : chosen_)
        if (auto place = placeNow(name))
            places.emplace(name, BodyPlace{{place->metres.x + byMetres.x, place->metres.y + byMetres.y},
                                           place->angleRadians + byRadians});
    edit(byRadians != 0.0 ? "Turn" : "Move", movedTo(drawing(), places));
}

void DrawPane::scaleChosen(double factor) {
    changeChosen("Size",
                 [factor](const Scene&, BodyDescription& body) { body = scaledBody(body, factor, factor); });
}

void DrawPane::paste(const Copied& copy, Vector beside) {
    std::vector<std::string> names;
    edit("Paste", pasted(drawing(), copy, beside, names));
    use(DrawTool::choose);
    choose(names);
}

void DrawPane::pasteAt(Vector place) {
    const Vector& from = copied_.bodies.front().positionMetres;
    paste(copied_, {place.x - from.x, place.y - from.y});
}

// Bodies that the script still needs are erased with their script inputs; the world then restarts.
void DrawPane::eraseAll(const std::vector<std::string>& names, bool continuesEdit) {
    auto actions = erased(drawing(), names);
    SceneDrawing trial = drawing();
    trial.take(actions);
    const bool isNeeded =
        std::ranges::any_of(names, [&](const std::string& name) { return trial.find(name) != nullptr; });
    if (!isNeeded) return edit("Erase", std::move(actions), continuesEdit);
    Mix mix = model_.mix();
    mix.scene = std::make_shared<const Scene>(without(drawing().drawn(), names));
    model_.edit("Erase", mix, continuesEdit, true);
}

bool DrawPane::handleToolKey(const juce::KeyPress& key) {
    if (key.getModifiers().isAnyModifierKeyDown()) return false;
    for (const auto& words : drawTools)
        if (key.getKeyCode() ==
                juce::CharacterFunctions::toUpperCase(static_cast<juce::juce_wchar>(words.key)) ||
            key.getTextCharacter() == static_cast<juce::juce_wchar>(words.key))
            return use(words.tool), true;
    if (key.getTextCharacter() == 'g') return setSnapping(!snaps_), true;
    return false;
}

bool DrawPane::handleKey(const juce::KeyPress& key) {
    using juce::KeyPress;
    const auto command = juce::ModifierKeys::commandModifier;
    if (handleToolKey(key)) return true;
    if (key == KeyPress{'a', command, 0}) return chooseAll(), true;
    if (tool_ == DrawTool::hand) return false;
    if (key == KeyPress::returnKey && tool_ == DrawTool::polygon && !stroke_.empty())
        return closePolygon(), true;
    if (key == KeyPress::returnKey && (isStroke(tool_) || tool_ == DrawTool::polygon))
        return addInTheMiddle(), true;
    const double step = model_.world().scene().fieldHeightMetres / gridsPerField;
    const Vector beside{2.0 * step, 2.0 * step};
    if (key == KeyPress{'v', command, 0} && hasCopy()) return paste(copied_, beside), true;
    if (key == KeyPress::tabKey || tool_ != DrawTool::choose || chosen_.empty()) return false;
    if (key == KeyPress::deleteKey || key == KeyPress::backspaceKey) return eraseAll(chosen_), true;
    if (key == KeyPress{'c', command, 0}) return copy(chosen_), true;
    if (key == KeyPress{'d', command, 0}) return paste(copied(drawing(), chosen_), beside), true;
    if (key == KeyPress::leftKey) return nudge({-step, 0.0}, 0.0), true;
    if (key == KeyPress::rightKey) return nudge({step, 0.0}, 0.0), true;
    if (key == KeyPress::upKey) return nudge({0.0, step}, 0.0), true;
    if (key == KeyPress::downKey) return nudge({0.0, -step}, 0.0), true;
    if (key.getModifiers().isCommandDown()) return false; // zoom has Ctrl and the same signs
    if (key.getTextCharacter() == '[') return nudge({}, turnStep), true;
    if (key.getTextCharacter() == ']') return nudge({}, -turnStep), true;
    if (key.getTextCharacter() == '+') return scaleChosen(1.1), true;
    if (key.getTextCharacter() == '-') return scaleChosen(1.0 / 1.1), true;
    return false;
}

// Rotates and moves the point with the body from its drawn to its current pose.
Vector DrawPane::carried(const Vector& point, const std::string& name) const {
    const auto* body = drawing().find(name);
    const auto place = placeNow(name);
    if (body == nullptr || !place) return point;
    return detail::Motion{detail::placeOf(*body), *place}(point);
}

juce::Line<float> DrawPane::lineNow(const JointDescription& joint) const {
    const auto pose = describedPose(joint);
    const bool isBetween = std::holds_alternative<DistanceJoint>(joint.joint);
    return {view_.placeOfMetres(carried(pose.aMetres, joint.bodyA)),
            view_.placeOfMetres(carried(pose.bMetres, isBetween ? joint.bodyB : joint.bodyA))};
}

std::string DrawPane::jointAt(juce::Point<float> place) const {
    constexpr float near = 8.0f;
    for (const auto& joint : drawing().drawn().joints) {
        juce::Point<float> on;
        if (lineNow(joint).getDistanceFromPoint(place, on) < near) return joint.name;
    }
    return {};
}

void DrawPane::drawJoints(juce::Graphics& g) const {
    g.setColour(shade(*this, Shade::text).withAlpha(tool_ == DrawTool::hand ? 0.45f : 0.9f));
    for (const auto& joint : drawing().drawn().joints) {
        if (!placeNow(joint.bodyA) || !placeNow(joint.bodyB)) continue;
        const auto line = lineNow(joint);
        g.strokePath(jointOutline<juce::Path>(joint.joint, line.getStart(), line.getEnd()),
                     juce::PathStrokeType{jointPixels});
    }
}

// Draws arrows along the moving side of each belt.
void DrawPane::drawBelts(juce::Graphics& g) const {
    constexpr float apart = 26.0f;
    g.setColour(shade(*this, Shade::ground));
    for (const auto& body : drawing().drawn().bodies) {
        const double speed = body.velocityMetresPerSecond.x;
        const auto place = placeNow(body.name);
        if (body.type != BodyType::staticBody || speed == 0.0 || !place) continue;
        const Reach reach = reachOf(body);
        const auto on = [&](double x, double y) {
            return view_.placeOfMetres(detail::Motion{{}, *place}({x, y}));
        };
        juce::Line<float> line{on(reach.least.x, 0.0), on(reach.most.x, 0.0)};
        if (speed * std::cos(place->angleRadians) < 0.0) line = line.reversed();
        const float high = 0.3f * on(0.0, reach.least.y).getDistanceFrom(on(0.0, reach.most.y));
        for (float at = 0.5f * apart; at < line.getLength(); at += apart) {
            juce::Path arrow;
            arrow.addTriangle(-high, -high, -high, high, high, 0.0f);
            g.fillPath(arrow, juce::AffineTransform::rotation(line.getAngle() -
                                                              0.5f * juce::MathConstants<float>::pi)
                                  .translated(line.getPointAlongLine(at)));
        }
    }
}

void DrawPane::drawOutline(juce::Graphics& g, const BodyDescription& body, const BodyPlace& place,
                           juce::Colour colour, bool isFilled) const {
    const float scale = view_.pixelsPerMetre();
    for (const auto& fixture : body.fixtures) {
        const auto where =
            juce::AffineTransform::rotation(static_cast<float>(-fixture.angleRadians))
                .translated(static_cast<float>(fixture.offsetMetres.x) * scale,
                            static_cast<float>(-fixture.offsetMetres.y) * scale)
                .followedBy(juce::AffineTransform::rotation(static_cast<float>(-place.angleRadians)))
                .translated(view_.placeOfMetres(place.metres));
        const auto path = shapeOutline<juce::Path>(fixture.shape, scale);
        g.setColour(colour.withAlpha(0.3f));
        if (isFilled && !std::holds_alternative<ChainShape>(fixture.shape)) g.fillPath(path, where);
        g.setColour(colour);
        g.strokePath(path, juce::PathStrokeType{1.8f}, where);
    }
}

void DrawPane::drawChosen(juce::Graphics& g) const {
    const juce::Graphics::ScopedSaveState saved{g};
    for (const auto& badge : view_.badges()) g.excludeClipRegion(badge.getSmallestIntegerContainer());
    const auto accent = shade(*this, Shade::accent);
    const bool goes = isDrawing_ && (grip_ == Grip::move || grip_ == Grip::turn);
    const auto moved = goes ? movedNow() : std::map<std::string, BodyPlace>{};
    for (const std::string& name : chosen_) {
        const auto* body = drawing().find(name);
        const auto place = placeNow(name);
        if (body == nullptr || !place) continue;
        drawOutline(g, *body, *place, accent, false);
        if (const auto next = moved.find(name); next != moved.end())
            drawOutline(g, *body, next->second, accent, true);
    }
    if (isDrawing_ && grip_ == Grip::size && chosen_.size() == 1)
        if (const auto place = placeNow(chosen_[0])) drawOutline(g, sizedNow(), *place, accent, true);
    const auto marks = handles();
    if (!marks || tool_ != DrawTool::choose) return;
    const auto handle = [&](juce::Point<float> at, bool isRound) {
        const auto area = juce::Rectangle<float>{10.0f, 10.0f}.withCentre(at);
        g.setColour(shade(*this, Shade::well));
        isRound ? g.fillEllipse(area) : g.fillRect(area);
        g.setColour(accent);
        isRound ? g.drawEllipse(area, 1.8f) : g.drawRect(area, 1.8f);
    };
    for (const auto& corner : marks->corners) handle(corner, false);
    handle(marks->turn, true);
}

void DrawPane::drawStroke(juce::Graphics& g) const {
    if (!isDrawing_ || stroke_.empty()) return;
    const auto accent = shade(*this, Shade::accent);
    const auto from = view_.placeOfMetres(stroke_[0]), to = view_.placeOfMetres(to_);
    g.setColour(accent);
    if (tool_ == DrawTool::choose)
        return grip_ == Grip::around ? g.drawRect(juce::Rectangle<float>{from, to}, 1.2f) : void();
    if (tool_ == DrawTool::polygon || tool_ == DrawTool::line) {
        juce::Path path;
        path.startNewSubPath(from);
        for (const Vector& place : stroke_) path.lineTo(view_.placeOfMetres(place));
        path.lineTo(to);
        return g.strokePath(path, juce::PathStrokeType{2.0f});
    }
    if (tool_ == DrawTool::spring)
        return g.strokePath(coilOutline<juce::Path>(from, to, 6.0f, 6), juce::PathStrokeType{2.0f});
    if (tool_ == DrawTool::rope || tool_ == DrawTool::slider) return g.drawLine({from, to}, 2.0f);
    if (tool_ == DrawTool::rain) {
        for (const auto& body : rainNow().value)
            drawOutline(g, body, {body.positionMetres, 0.0}, accent, true);
        return;
    }
    if (const auto body = drawnNow())
        drawOutline(g, body.value, {body.value.positionMetres, body.value.angleRadians}, accent, true);
}

void DrawPane::paint(juce::Graphics& g) {
    drawBelts(g);
    drawJoints(g);
    if (drawing().drawn().bodies.empty() && !isDrawing_) {
        ink(g, *this, Shade::muted, text::medium);
        g.drawText("Nothing is here yet: choose a tool, or press B and draw a ball",
                   juce::Rectangle<float>{view_.placeOfShare({0.0, 1.0}), view_.placeOfShare({1.0, 0.0})},
                   juce::Justification::centred, true);
    }
    if (tool_ == DrawTool::hand) return;
    drawChosen(g);
    drawStroke(g);
}

} // namespace physvib
