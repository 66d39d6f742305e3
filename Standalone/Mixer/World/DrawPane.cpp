// SPDX-License-Identifier: GPL-3.0-or-later
// What the tools draw, select, change and erase by mouse, keys and menu commands; and painting of the layer.
#include "Mixer/World/DrawPane.h"
#include "Mixer/Widgets/MixerWidgets.h"
#include "Pictures/ShapeOutline.h"
#include "Scene/Drawing/BodyEdits.h"

namespace physvib {

namespace {

/// Index of the material for a new body. Tools that draw moving bodies use the material of the last moving
/// body that vibrates; other tools, or a scene without such a body, use the first material that vibrates, or
/// the first one if none does.
int defaultMaterial(const Scene& scene, DrawTool tool) {
    const auto vibrates = [](const Material& m) { return m.frequencyHz > 0.0; };
    if (tool != DrawTool::wall && tool != DrawTool::line && tool != DrawTool::conveyor)
        for (auto body = scene.bodies.rbegin(); body != scene.bodies.rend(); ++body) {
            const int material = body->fixtures[0].material;
            if (body->type == BodyType::dynamicBody && vibrates(nth(scene.materials, material)))
                return material;
        }
    const auto first = std::ranges::find_if(scene.materials, vibrates);
    return first == scene.materials.end() ? 0 : static_cast<int>(first - scene.materials.begin());
}

double distance(const Vector& a, const Vector& b) { return std::hypot(b.x - a.x, b.y - a.y); }

constexpr float handlePixels = 9.0f;
constexpr double newBodyShare = 0.06; // size of a body drawn by a click, share of the height of the field
double angleOf(const Vector& a, const Vector& b) { return std::atan2(b.y - a.y, b.x - a.x); }

} // namespace

DrawPane::DrawPane(MixerModel& model, WorldView& view)
    : model_{model}
    , view_{view}
    , rain_{model} {
    setTitle("Drawing");
    setInterceptsMouseClicks(false, false);
}

void DrawPane::setTool(DrawTool tool) {
    tool_ = tool;
    cancelStroke();
    setInterceptsMouseClicks(tool != DrawTool::hand, false);
    setMouseCursor(tool == DrawTool::select ? juce::MouseCursor::NormalCursor
                                            : juce::MouseCursor::CrosshairCursor);
    if (tool != DrawTool::select) selected_.clear();
    if (!isMaterialChosen_) material_ = defaultMaterial(drawing().drawn(), tool);
    if (onChange) onChange();
}

void DrawPane::cancelStroke() {
    stroke_.clear();
    isDrawing_ = false;
    grip_ = Grip::none;
    repaint();
}

// Applies to the next body: the one that was just drawn keeps its material.
void DrawPane::setMaterial(int material) {
    material_ = material;
    isMaterialChosen_ = true;
    if (tool_ == DrawTool::select) setSelectedMaterial(material);
    if (onChange) onChange();
}

void DrawPane::setSelectedMaterial(int material) {
    changeSelected("Material", [material](const Scene& scene, BodyDescription& body) {
        const auto vibrates = [&scene](int m) { return nth(scene.materials, m).frequencyHz > 0.0; };
        if (!vibrates(material)) // a source must vibrate
            setSource(scene, body, false);
        else if (!vibrates(body.fixtures[0].material) && startsAsSource(body)) // as if it were drawn anew
            setSource(scene, body, true);
        for (auto& fixture : body.fixtures) fixture.material = material;
    });
}

void DrawPane::setSnapping(bool isSnapping) {
    isSnapping_ = isSnapping;
    if (onChange) onChange();
}

void DrawPane::setRainCount(int count) {
    rainCount_ = count;
    if (onChange) onChange();
}

void DrawPane::select(std::vector<std::string> names) {
    selected_ = std::move(names);
    // the palette shows what the selection is made of
    if (const auto* body = selected_.empty() ? nullptr : drawing().find(selected_[0]))
        material_ = body->fixtures[0].material;
    if (onChange) onChange();
    repaint();
}

void DrawPane::selectAll() {
    std::vector<std::string> names;
    for (const auto& body : drawing().drawn().bodies) names.push_back(body.name);
    setTool(DrawTool::select);
    select(std::move(names));
}

void DrawPane::mixChanged() {
    const auto oldCount = selected_.size();
    std::erase_if(selected_, [&](const std::string& name) { return drawing().find(name) == nullptr; });
    if (materialScene_ != model_.mix().scene) {
        materialScene_ = model_.mix().scene;
        isMaterialChosen_ = false;
        material_ = defaultMaterial(drawing().drawn(), tool_);
    }
    if (oldCount != selected_.size() && onChange) onChange();
    repaint();
}

void DrawPane::changeSelected(const juce::String& name,
                              const std::function<void(const Scene&, BodyDescription&)>& change,
                              bool continuesEdit) {
    std::vector<Action> actions;
    for (const std::string& bodyName : selected_)
        if (const auto* body = drawing().find(bodyName)) {
            BodyDescription changedBody = *body;
            change(drawing().drawn(), changedBody);
            if (changedBody != *body) actions.push_back(changeAction(std::move(changedBody)));
        }
    edit(name, std::move(actions), continuesEdit);
}

void DrawPane::edit(const juce::String& name, std::vector<Action> actions, bool continuesEdit) {
    if (const auto error = model_.world().edit(name, std::move(actions), continuesEdit); !error.empty())
        model_.report(name + ": " + utf8(error));
}

std::optional<BodyPlace> DrawPane::currentPlace(const std::string& name) const {
    const auto shownPose = view_.poseOfBody(name);
    const auto pose = shownPose ? poseWithinLimits(*shownPose) : std::nullopt;
    return pose ? std::optional{BodyPlace{{pose->xMetres, pose->yMetres}, pose->angleRadians}} : std::nullopt;
}

/// True if the current tool draws shapes, and `pixel` is so far outside the field that none can start there.
bool DrawPane::isOutsideField(juce::Point<float> pixel) const {
    constexpr float edge = 10.0f;
    return (isStrokeTool(tool_) || tool_ == DrawTool::polygon) &&
           !juce::Rectangle<float>{view_.pixelOfShare({0.0, 1.0}), view_.pixelOfShare({1.0, 0.0})}
                .expanded(edge)
                .contains(pixel);
}

void DrawPane::mouseDown(const juce::MouseEvent& e) {
    if (e.mods.isPopupMenu()) return onMenu ? onMenu(e.position) : void();
    model_.messages().withdraw(attemptLabel); // the last attempt is over
    pointerMetres_ = snappedMetres(e);
    if (tool_ != DrawTool::select) select({});
    if (isOutsideField(e.position)) return;
    if (tool_ == DrawTool::polygon) {
        stroke_.push_back(pointerMetres_);
        isDrawing_ = true;
        return repaint();
    }
    isDrawing_ = true;
    if (tool_ == DrawTool::eraser) return model_.undoManager().beginNewTransaction(), eraseAt(e);
    if (tool_ == DrawTool::select) beginGrip(e);
    stroke_ = {tool_ == DrawTool::select ? view_.metresAt(e.position) : pointerMetres_};
    repaint();
}

void DrawPane::mouseMove(const juce::MouseEvent& e) {
    pointerMetres_ = snappedMetres(e);
    if (tool_ != DrawTool::select)
        setMouseCursor(isOutsideField(e.position) ? juce::MouseCursor::NormalCursor
                                                  : juce::MouseCursor::CrosshairCursor);
    if (tool_ == DrawTool::polygon && !stroke_.empty()) repaint();
}

void DrawPane::mouseDrag(const juce::MouseEvent& e) {
    if (!isDrawing_) return;
    if (tool_ == DrawTool::eraser) return eraseAt(e);
    pointerMetres_ = tool_ == DrawTool::select ? view_.metresAt(e.position) : snappedMetres(e);
    if (tool_ == DrawTool::line) stroke_.push_back(pointerMetres_);
    repaint();
}

void DrawPane::mouseUp(const juce::MouseEvent& e) {
    if (!isDrawing_ || tool_ == DrawTool::polygon) return;
    const bool hasMoved = e.getDistanceFromDragStart() > 2;
    if (isStrokeTool(tool_))
        addStroke();
    else if (isJointTool(tool_))
        addJoint();
    else if (tool_ == DrawTool::select && hasMoved) {
        if (grip_ == Grip::size)
            edit("Size", {changeAction(resizedBody())});
        else if (grip_ == Grip::move || grip_ == Grip::turn)
            edit(grip_ == Grip::turn ? "Turn" : "Move", moveActions(drawing(), movedPlaces()));
        else if (grip_ == Grip::marquee && !stroke_.empty()) {
            std::vector<std::string> names = e.mods.isShiftDown() ? selected_ : std::vector<std::string>{};
            for (const auto& body : drawing().drawn().bodies)
                if (const auto place = currentPlace(body.name);
                    place && (place->metres.x - stroke_[0].x) * (place->metres.x - pointerMetres_.x) < 0.0 &&
                    (place->metres.y - stroke_[0].y) * (place->metres.y - pointerMetres_.y) < 0.0)
                    if (std::ranges::find(names, body.name) == names.end()) names.push_back(body.name);
            select(names);
        }
    }
    cancelStroke();
}

void DrawPane::mouseDoubleClick(const juce::MouseEvent&) {
    if (tool_ == DrawTool::polygon) closePolygon();
}

Result<BodyDescription> DrawPane::strokeBody() const {
    const double height = model_.world().scene().fieldHeightMetres, size = newBodyShare * height;
    const Vector start = stroke_.empty() ? pointerMetres_ : stroke_[0];
    const bool isClick = distance(start, pointerMetres_) * static_cast<double>(view_.pixelsPerMetre()) < 4.0;
    switch (tool_) {
    case DrawTool::ball: return makeBall(start, isClick ? Vector{start.x + size, start.y} : pointerMetres_);
    case DrawTool::box:
        return isClick ? makeBox({start.x - 1.1 * size, start.y - 0.8 * size},
                                 {start.x + 1.1 * size, start.y + 0.8 * size})
                       : makeBox(start, pointerMetres_);
    case DrawTool::line: return makeLine(stroke_, 0.004 * height);
    case DrawTool::conveyor: return strokeBelt();
    case DrawTool::wall:
        return makeWall(isClick ? Vector{start.x - 2.0 * size, start.y} : start,
                        isClick ? Vector{start.x + 2.0 * size, start.y} : pointerMetres_, 0.03 * height);
    default: return makePolygon(stroke_);
    }
}

// A click gives a rain of the default size within the field. After a drag no side is shorter than half of
// that, because the balls of a flat rain would be too small.
Result<std::vector<BodyDescription>> DrawPane::strokeRain() const {
    const auto& scene = model_.world().scene();
    const Vector start = stroke_.empty() ? pointerMetres_ : stroke_[0];
    const bool isClick = distance(start, pointerMetres_) * static_cast<double>(view_.pixelsPerMetre()) < 4.0;
    const auto side = [isClick](double a, double b, double field) { // centre and half length
        const double half = 0.5 * std::abs(b - a), minHalf = (isClick ? 0.15 : 0.075) * field;
        return half < minHalf ? std::pair{std::clamp(0.5 * (a + b), minHalf, field - minHalf), minHalf}
                              : std::pair{0.5 * (a + b), half};
    };
    const auto [x, halfWidth] = side(start.x, pointerMetres_.x, scene.fieldWidthMetres);
    const auto [y, halfHeight] = side(start.y, pointerMetres_.y, scene.fieldHeightMetres);
    return makeRain({x - halfWidth, y - halfHeight}, {x + halfWidth, y + halfHeight}, rainCount_);
}

// The belt is a wall whose surface moves in the direction of the drag; after a click, to the right.
Result<BodyDescription> DrawPane::strokeBelt() const {
    constexpr double thicknessShare = 0.05, speedShare = 0.8; // of the field's height; speed per second
    const double height = model_.world().scene().fieldHeightMetres, thickness = thicknessShare * height;
    const Vector start = stroke_.empty() ? pointerMetres_ : stroke_[0];
    const bool isClick = distance(start, pointerMetres_) < thickness;
    auto belt =
        makeWall(start, isClick ? Vector{start.x + 8.0 * thickness, start.y} : pointerMetres_, thickness);
    belt.value.velocityMetresPerSecond.x =
        (!isClick && pointerMetres_.x < start.x ? -1.0 : 1.0) * speedShare * height;
    return belt;
}

void DrawPane::addStroke() {
    if (tool_ == DrawTool::rain) {
        auto bodies = strokeRain();
        if (!bodies || rain_.pattern().bodiesPerSecond == 0) return add(std::move(bodies));
        if (prepareBodies(bodies.value)) rain_.start(std::move(bodies.value));
        return;
    }
    auto body = strokeBody();
    if (!body) return add(Failure{body.error});
    add(std::vector{std::move(body.value)});
}

/// Sets name, material and haptic source of new bodies; false: the scene has no materials.
bool DrawPane::prepareBodies(std::vector<BodyDescription>& bodies) {
    if (drawing().drawn().materials.empty())
        return model_.report("The scene has no materials to draw with"), false;
    const auto names =
        drawing().unusedNames(juce::String{toolInfo(tool_).name}.toLowerCase().toStdString(), bodies.size());
    const bool vibrates = nth(drawing().drawn().materials, material_).frequencyHz > 0.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        bodies[k].name = names[k];
        for (auto& fixture : bodies[k].fixtures) fixture.material = material_;
        if (vibrates && startsAsSource(bodies[k])) setSource(drawing().drawn(), bodies[k], true);
    }
    return true;
}

// Adds the bodies as one edit, or reports their error.
void DrawPane::add(Result<std::vector<BodyDescription>> bodies) {
    if (!bodies) return model_.report(utf8(bodies.error));
    if (!prepareBodies(bodies.value)) return;
    std::vector<Action> actions;
    const std::vector<std::string> names{bodies.value.front().name};
    for (auto& body : bodies.value) actions.push_back(SpawnAction{std::move(body), {}});
    edit("Draw a " + juce::String{toolInfo(tool_).name}.toLowerCase(), std::move(actions));
    if (tool_ != DrawTool::conveyor) hintOnBody(model_, names.front()); // a belt is not felt
    if (drawing().find(names.front()) != nullptr) select(names);        // keeps the body panel visible
}

void DrawPane::closePolygon() {
    addStroke();
    cancelStroke();
}

void DrawPane::addAt(DrawTool tool, Vector place) {
    const DrawTool previousTool = tool_;
    setTool(tool);
    pointerMetres_ = place;
    stroke_ = {place};
    constexpr double length = 0.2; // of an upward spring, as a share of the field's height
    if (tool == DrawTool::spring) pointerMetres_.y += length * model_.world().scene().fieldHeightMetres;
    isJointTool(tool) ? addJoint() : addStroke();
    setTool(previousTool);
}

void DrawPane::addAtCentre() {
    const auto& scene = model_.world().scene();
    const double size = newBodyShare * scene.fieldHeightMetres;
    pointerMetres_ = {0.5 * scene.fieldWidthMetres, 0.5 * scene.fieldHeightMetres};
    stroke_ = {pointerMetres_};
    if (tool_ == DrawTool::line)
        stroke_ = {{pointerMetres_.x - 2.0 * size, pointerMetres_.y},
                   pointerMetres_,
                   {pointerMetres_.x + 2.0 * size, pointerMetres_.y}};
    if (tool_ == DrawTool::polygon)
        stroke_ = {{pointerMetres_.x - size, pointerMetres_.y - size},
                   {pointerMetres_.x + size, pointerMetres_.y - size},
                   {pointerMetres_.x, pointerMetres_.y + size}};
    select({});
    addStroke(); // selects the new body
    stroke_.clear();
    if (selected_.empty()) return;
    const auto drawn = selected_;
    setTool(DrawTool::select); // so that arrow keys move it
    select(drawn);
}

void DrawPane::eraseAt(const juce::MouseEvent& e) {
    if (const auto joint = jointAt(e.position); !joint.empty())
        return edit("Erase", {UnjoinAction{joint}}, true);
    for (const auto& name : view_.bodiesAt(e.position))
        if (drawing().find(name) != nullptr) return eraseBodies({name}, true);
}

void DrawPane::setRainPattern(const RainPattern& pattern) {
    rain_.setPattern(pattern);
    if (onChange) onChange();
}

// The field itself is not a body. A joint to it uses a static body, or a small disc that is added there.
std::string DrawPane::findOrAddAnchor(std::vector<Action>& actions, const Vector& place) {
    for (const auto& body : drawing().drawn().bodies)
        if (body.type == BodyType::staticBody) return body.name;
    const double size = std::max(0.011, 0.01 * model_.world().scene().fieldHeightMetres);
    auto disc = makeBall(place, {place.x + size, place.y}).value;
    disc.type = BodyType::staticBody;
    disc.name = drawing().unusedName("pin");
    disc.fixtures[0].material = material_;
    actions.push_back(SpawnAction{disc, {}});
    return disc.name;
}

void DrawPane::addJoint() {
    const Vector start = stroke_.empty() ? pointerMetres_ : stroke_[0];
    const bool hasOnePoint = tool_ == DrawTool::pin || tool_ == DrawTool::motor;
    const auto drawnBodiesAt = [&](const Vector& place) {
        auto names = view_.bodiesAt(view_.pixelOfMetres(place));
        std::erase_if(names, [&](const std::string& name) { return drawing().find(name) == nullptr; });
        return names;
    };
    const auto first = drawnBodiesAt(start), second = hasOnePoint ? first : drawnBodiesAt(pointerMetres_);
    const std::size_t index = hasOnePoint ? 1 : 0;
    if (first.empty() && (second.empty() || tool_ == DrawTool::slider))
        return model_.messages().show({"A joint holds a body: begin on one, in a pause if they move",
                                       false,
                                       {"Pause", [&model = model_] { model.setSlowness(0); }},
                                       attemptLabel});
    std::vector<Action> actions;
    std::string bodyB = first.empty() ? std::string{} : first[0],
                bodyA = second.size() > index && second[index] != bodyB ? second[index] : std::string{};
    if (tool_ == DrawTool::slider) bodyA.clear(); // its axis is fixed to the field
    if (bodyB.empty()) bodyB = findOrAddAnchor(actions, start);
    if (bodyA.empty()) bodyA = findOrAddAnchor(actions, hasOnePoint ? start : pointerMetres_);
    SceneDrawing draft = drawing();
    for (const Action& action : actions) draft.apply(action);
    const auto namedPlace = [&](const std::string& name) {
        const auto shownPlace = currentPlace(name);
        const auto* body = draft.find(name);
        return std::pair{name, shownPlace ? *shownPlace
                               : body     ? BodyPlace{body->positionMetres, body->angleRadians}
                                          : BodyPlace{}};
    };
    const auto kind = tool_ == DrawTool::pin      ? JointKind::pin
                      : tool_ == DrawTool::motor  ? JointKind::motor
                      : tool_ == DrawTool::rope   ? JointKind::rope
                      : tool_ == DrawTool::spring ? JointKind::spring
                                                  : JointKind::slider;
    const bool isReversed = tool_ == DrawTool::rope || tool_ == DrawTool::spring; // stroke begins on bodyB
    auto joint = joinActions(draft, kind, namedPlace(bodyA), namedPlace(bodyB),
                             isReversed ? pointerMetres_ : start, isReversed ? start : pointerMetres_);
    if (!joint) return model_.report(utf8(joint.error));
    actions.insert(actions.end(), joint.value.begin(), joint.value.end());
    model_.messages().withdraw(attemptLabel);
    edit(toolInfo(tool_).name, std::move(actions));
}

juce::Rectangle<float> DrawPane::selectionBounds() const {
    juce::Rectangle<float> area;
    for (const std::string& name : selected_) {
        const auto* body = drawing().find(name);
        const auto place = body ? currentPlace(name) : std::nullopt;
        if (!place) continue;
        const LocalBounds box = localBounds(*body);
        for (const double x : {box.min.x, box.max.x})
            for (const double y : {box.min.y, box.max.y}) {
                const auto corner = view_.pixelOfMetres(detail::Motion{{}, *place}({x, y}));
                area = area.getUnion(juce::Rectangle<float>{1.0f, 1.0f}.withCentre(corner));
            }
    }
    return area;
}

std::optional<DrawPane::Handles> DrawPane::handles() const {
    const auto* body = selected_.size() == 1 ? drawing().find(selected_[0]) : nullptr;
    const auto place = body ? currentPlace(selected_[0]) : std::nullopt;
    if (!place) return std::nullopt;
    const LocalBounds box = localBounds(*body);
    const auto toPixels = [&](double x, double y) {
        return view_.pixelOfMetres(detail::Motion{{}, *place}({x, y}));
    };
    const double turnHandleY = box.max.y + 26.0 / static_cast<double>(view_.pixelsPerMetre());
    return Handles{{toPixels(box.min.x, box.min.y), toPixels(box.max.x, box.min.y),
                    toPixels(box.max.x, box.max.y), toPixels(box.min.x, box.max.y)},
                   toPixels(0.5 * (box.min.x + box.max.x), turnHandleY)};
}

void DrawPane::beginGrip(const juce::MouseEvent& e) {
    if (const auto handleAreas = handles()) {
        if (handleAreas->turn.getDistanceFrom(e.position) < handlePixels) return void(grip_ = Grip::turn);
        for (const auto& corner : handleAreas->corners)
            if (corner.getDistanceFrom(e.position) < handlePixels) return void(grip_ = Grip::size);
    }
    const auto bodiesBelow = view_.bodiesAt(e.position);
    const auto grippedBody = std::ranges::find_if(
        bodiesBelow, [&](const std::string& name) { return drawing().find(name) != nullptr; });
    if (grippedBody == bodiesBelow.end()) {
        if (!e.mods.isShiftDown()) select({});
        return void(grip_ = Grip::marquee);
    }
    auto newSelection = selected_;
    const auto entry = std::ranges::find(newSelection, *grippedBody);
    if (e.mods.isShiftDown())
        entry == newSelection.end() ? newSelection.push_back(*grippedBody) : void(newSelection.erase(entry));
    else if (entry == newSelection.end())
        newSelection = {*grippedBody};
    select(newSelection);
    grip_ = Grip::move;
}

BodyDescription DrawPane::resizedBody() const {
    const auto& body = *drawing().find(selected_[0]);
    const auto place = currentPlace(selected_[0]);
    if (!place || stroke_.empty()) return body;
    const auto toExtent = [&](const Vector& p) {
        const Vector offset = detail::Motion{*place, {}}(p);
        return Vector{std::abs(offset.x), std::abs(offset.y)};
    };
    const Vector startExtent = toExtent(stroke_[0]), newExtent = toExtent(pointerMetres_);
    const auto factor = [](double a, double b) { return a > 1e-6 ? std::clamp(b / a, 0.05, 20.0) : 1.0; };
    return scaledBody(body, factor(startExtent.x, newExtent.x), factor(startExtent.y, newExtent.y));
}

std::map<std::string, BodyPlace> DrawPane::movedPlaces() const {
    std::map<std::string, BodyPlace> places;
    if (stroke_.empty()) return places;
    for (const std::string& name : selected_)
        if (auto place = currentPlace(name)) {
            if (grip_ == Grip::turn) {
                const double angle = place->angleRadians + angleOf(place->metres, pointerMetres_) -
                                     angleOf(place->metres, stroke_[0]);
                place->angleRadians = isSnapping_ ? turnStep * std::round(angle / turnStep) : angle;
            } else
                place->metres = snapToGrid({place->metres.x + pointerMetres_.x - stroke_[0].x,
                                            place->metres.y + pointerMetres_.y - stroke_[0].y},
                                           gridMetres());
            places.emplace(name, *place);
        }
    return places;
}

void DrawPane::nudge(Vector shiftMetres, double turnRadians) {
    std::map<std::string, BodyPlace> places;
    for (const std::string& name : selected_)
        if (auto place = currentPlace(name))
            places.emplace(name, BodyPlace{{place->metres.x + shiftMetres.x, place->metres.y + shiftMetres.y},
                                           place->angleRadians + turnRadians});
    edit(turnRadians != 0.0 ? "Turn" : "Move", moveActions(drawing(), places));
}

void DrawPane::scaleSelected(double factor) {
    changeSelected(
        "Size", [factor](const Scene&, BodyDescription& body) { body = scaledBody(body, factor, factor); });
}

void DrawPane::paste(const CopiedBodies& copy, Vector shiftMetres) {
    std::vector<std::string> names;
    edit("Paste", pasteActions(drawing(), copy, shiftMetres, names));
    setTool(DrawTool::select);
    select(names);
}

void DrawPane::pasteAt(Vector place) {
    const Vector& origin = clipboard_.bodies.front().positionMetres;
    paste(clipboard_, {place.x - origin.x, place.y - origin.y});
}

// Bodies that the script still needs are erased with their script inputs; the world then restarts.
void DrawPane::eraseBodies(const std::vector<std::string>& names, bool continuesEdit) {
    auto actions = removeActions(drawing(), names);
    SceneDrawing draft = drawing();
    draft.apply(actions);
    const bool isNeeded =
        std::ranges::any_of(names, [&](const std::string& name) { return draft.find(name) != nullptr; });
    if (!isNeeded) return edit("Erase", std::move(actions), continuesEdit);
    Mix mix = model_.mix();
    mix.scene = std::make_shared<const Scene>(sceneWithout(drawing().drawn(), names));
    model_.edit("Erase", mix, continuesEdit, true);
}

bool DrawPane::handleToolKey(const juce::KeyPress& key) {
    if (key.getModifiers().isAnyModifierKeyDown()) return false;
    for (const auto& info : drawTools)
        if (key.getKeyCode() ==
                juce::CharacterFunctions::toUpperCase(static_cast<juce::juce_wchar>(info.key)) ||
            key.getTextCharacter() == static_cast<juce::juce_wchar>(info.key))
            return setTool(info.tool), true;
    if (key.getTextCharacter() == 'g') return setSnapping(!isSnapping_), true;
    return false;
}

bool DrawPane::handleKey(const juce::KeyPress& key) {
    using juce::KeyPress;
    const auto command = juce::ModifierKeys::commandModifier;
    model_.dispatchPendingMessages(); // of a key just before: bodies are where it has moved them
    if (handleToolKey(key)) return true;
    if (key == KeyPress{'a', command, 0}) return selectAll(), true;
    if (tool_ == DrawTool::hand) return false;
    if (key == KeyPress::returnKey && tool_ == DrawTool::polygon && !stroke_.empty())
        return closePolygon(), true;
    if (key == KeyPress::returnKey && (isStrokeTool(tool_) || tool_ == DrawTool::polygon))
        return addAtCentre(), true;
    const double step = model_.world().scene().fieldHeightMetres / gridCellsPerField;
    const Vector shiftMetres{2.0 * step, 2.0 * step};
    if (key == KeyPress{'v', command, 0} && hasCopy()) return paste(clipboard_, shiftMetres), true;
    if (key == KeyPress::tabKey || tool_ != DrawTool::select || selected_.empty()) return false;
    if (key == KeyPress::deleteKey || key == KeyPress::backspaceKey) return eraseBodies(selected_), true;
    if (key == KeyPress{'c', command, 0}) return copy(selected_), true;
    if (key == KeyPress{'d', command, 0}) return paste(copyBodies(drawing(), selected_), shiftMetres), true;
    if (key == KeyPress::leftKey) return nudge({-step, 0.0}, 0.0), true;
    if (key == KeyPress::rightKey) return nudge({step, 0.0}, 0.0), true;
    if (key == KeyPress::upKey) return nudge({0.0, step}, 0.0), true;
    if (key == KeyPress::downKey) return nudge({0.0, -step}, 0.0), true;
    if (key.getModifiers().isCommandDown()) return false; // Ctrl with the same signs zooms
    if (key.getTextCharacter() == '[') return nudge({}, turnStep), true;
    if (key.getTextCharacter() == ']') return nudge({}, -turnStep), true;
    if (key.getTextCharacter() == '+') return scaleSelected(1.1), true;
    if (key.getTextCharacter() == '-') return scaleSelected(1.0 / 1.1), true;
    return false;
}

// Rotates and moves the point with the body from its drawn to its current pose.
Vector DrawPane::atCurrentPose(const Vector& point, const std::string& name) const {
    const auto* body = drawing().find(name);
    const auto place = currentPlace(name);
    if (body == nullptr || !place) return point;
    return detail::Motion{detail::placeOf(*body), *place}(point);
}

juce::Line<float> DrawPane::jointLine(const JointDescription& joint) const {
    const auto pose = jointPose(joint);
    const bool joinsTwoPoints = std::holds_alternative<DistanceJoint>(joint.joint);
    return {view_.pixelOfMetres(atCurrentPose(pose.aMetres, joint.bodyA)),
            view_.pixelOfMetres(atCurrentPose(pose.bMetres, joinsTwoPoints ? joint.bodyB : joint.bodyA))};
}

std::string DrawPane::jointAt(juce::Point<float> pixel) const {
    constexpr float hitPixels = 8.0f;
    for (const auto& joint : drawing().drawn().joints) {
        juce::Point<float> nearestPoint;
        if (jointLine(joint).getDistanceFromPoint(pixel, nearestPoint) < hitPixels) return joint.name;
    }
    return {};
}

void DrawPane::drawJoints(juce::Graphics& g) const {
    g.setColour(shade(*this, Shade::text).withAlpha(tool_ == DrawTool::hand ? 0.45f : 0.9f));
    for (const auto& joint : drawing().drawn().joints) {
        if (!currentPlace(joint.bodyA) || !currentPlace(joint.bodyB)) continue;
        const auto line = jointLine(joint);
        g.strokePath(jointOutline<juce::Path>(joint.joint, line.getStart(), line.getEnd()),
                     juce::PathStrokeType{jointPixels});
    }
}

// Draws arrows along the moving side of each belt.
void DrawPane::drawBelts(juce::Graphics& g) const {
    constexpr float spacing = 26.0f;
    g.setColour(shade(*this, Shade::background));
    for (const auto& body : drawing().drawn().bodies) {
        const double speed = body.velocityMetresPerSecond.x;
        const auto place = currentPlace(body.name);
        if (body.type != BodyType::staticBody || speed == 0.0 || !place) continue;
        const LocalBounds box = localBounds(body);
        const auto toPixels = [&](double x, double y) {
            return view_.pixelOfMetres(detail::Motion{{}, *place}({x, y}));
        };
        juce::Line<float> line{toPixels(box.min.x, 0.0), toPixels(box.max.x, 0.0)};
        if (speed * std::cos(place->angleRadians) < 0.0) line = line.reversed();
        const float size = 0.3f * toPixels(0.0, box.min.y).getDistanceFrom(toPixels(0.0, box.max.y));
        for (float offset = 0.5f * spacing; offset < line.getLength(); offset += spacing) {
            juce::Path arrow;
            arrow.addTriangle(-size, -size, -size, size, size, 0.0f);
            g.fillPath(arrow, juce::AffineTransform::rotation(line.getAngle() -
                                                              0.5f * juce::MathConstants<float>::pi)
                                  .translated(line.getPointAlongLine(offset)));
        }
    }
}

void DrawPane::drawOutline(juce::Graphics& g, const BodyDescription& body, const BodyPlace& place,
                           juce::Colour colour, bool isFilled) const {
    const float scale = view_.pixelsPerMetre();
    for (const auto& fixture : body.fixtures) {
        const auto transform =
            juce::AffineTransform::rotation(static_cast<float>(-fixture.angleRadians))
                .translated(static_cast<float>(fixture.offsetMetres.x) * scale,
                            static_cast<float>(-fixture.offsetMetres.y) * scale)
                .followedBy(juce::AffineTransform::rotation(static_cast<float>(-place.angleRadians)))
                .translated(view_.pixelOfMetres(place.metres));
        const auto path = shapeOutline<juce::Path>(fixture.shape, scale);
        g.setColour(colour.withAlpha(0.3f));
        if (isFilled && !std::holds_alternative<ChainShape>(fixture.shape)) g.fillPath(path, transform);
        g.setColour(colour);
        g.strokePath(path, juce::PathStrokeType{1.8f}, transform);
    }
}

void DrawPane::drawSelection(juce::Graphics& g) const {
    const juce::Graphics::ScopedSaveState saved{g};
    for (const auto& badge : view_.badges()) g.excludeClipRegion(badge.getSmallestIntegerContainer());
    const auto accent = shade(*this, Shade::accent);
    const bool isMoving = isDrawing_ && (grip_ == Grip::move || grip_ == Grip::turn);
    const auto newPlaces = isMoving ? movedPlaces() : std::map<std::string, BodyPlace>{};
    for (const std::string& name : selected_) {
        const auto* body = drawing().find(name);
        const auto place = currentPlace(name);
        if (body == nullptr || !place) continue;
        drawOutline(g, *body, *place, accent, false);
        if (const auto newPlace = newPlaces.find(name); newPlace != newPlaces.end())
            drawOutline(g, *body, newPlace->second, accent, true);
    }
    if (isDrawing_ && grip_ == Grip::size && selected_.size() == 1)
        if (const auto place = currentPlace(selected_[0]))
            drawOutline(g, resizedBody(), *place, accent, true);
    const auto handleAreas = handles();
    if (!handleAreas || tool_ != DrawTool::select) return;
    const auto drawHandle = [&](juce::Point<float> centre, bool isRound) {
        const auto area = juce::Rectangle<float>{10.0f, 10.0f}.withCentre(centre);
        g.setColour(shade(*this, Shade::well));
        isRound ? g.fillEllipse(area) : g.fillRect(area);
        g.setColour(accent);
        isRound ? g.drawEllipse(area, 1.8f) : g.drawRect(area, 1.8f);
    };
    for (const auto& corner : handleAreas->corners) drawHandle(corner, false);
    drawHandle(handleAreas->turn, true);
}

void DrawPane::drawStroke(juce::Graphics& g) const {
    if (!isDrawing_ || stroke_.empty()) return;
    const auto accent = shade(*this, Shade::accent);
    const auto start = view_.pixelOfMetres(stroke_[0]), end = view_.pixelOfMetres(pointerMetres_);
    g.setColour(accent);
    if (tool_ == DrawTool::select)
        return grip_ == Grip::marquee ? g.drawRect(juce::Rectangle<float>{start, end}, 1.2f) : void();
    if (tool_ == DrawTool::polygon || tool_ == DrawTool::line) {
        juce::Path path;
        path.startNewSubPath(start);
        for (const Vector& place : stroke_) path.lineTo(view_.pixelOfMetres(place));
        path.lineTo(end);
        return g.strokePath(path, juce::PathStrokeType{2.0f});
    }
    if (tool_ == DrawTool::spring)
        return g.strokePath(coilOutline<juce::Path>(start, end, 6.0f, 6), juce::PathStrokeType{2.0f});
    if (tool_ == DrawTool::rope || tool_ == DrawTool::slider) return g.drawLine({start, end}, 2.0f);
    if (tool_ == DrawTool::rain) {
        for (const auto& body : strokeRain().value)
            drawOutline(g, body, {body.positionMetres, 0.0}, accent, true);
        return;
    }
    if (const auto body = strokeBody())
        drawOutline(g, body.value, {body.value.positionMetres, body.value.angleRadians}, accent, true);
}

void DrawPane::paint(juce::Graphics& g) {
    drawBelts(g);
    drawJoints(g);
    if (drawing().drawn().bodies.empty() && !isDrawing_) {
        setInk(g, *this, Shade::muted, text::medium);
        g.drawText("Nothing is here yet: choose a tool, or press B and draw a ball",
                   juce::Rectangle<float>{view_.pixelOfShare({0.0, 1.0}), view_.pixelOfShare({1.0, 0.0})},
                   juce::Justification::centred, true);
    }
    if (tool_ == DrawTool::hand) return;
    drawSelection(g);
    drawStroke(g);
}

} // namespace physvib
