// SPDX-License-Identifier: MIT
// Editor operations on bodies with their joints: move, remove, copy, paste, scale; density, haptic sources
// and body types; and new empty scenes.
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneLimits.h"
#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace physvib {
using detail::Motion;
using detail::placeOf;

namespace {

auto isOneOf(const std::vector<std::string>& names) {
    return [&names](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
}

} // namespace

Action changeAction(BodyDescription body) { return ChangeAction{std::move(body), true}; }

// A moved body takes its joints' anchors along: a joint is removed, its bodies restart, then it is joined.
std::vector<Action> moveActions(const SceneDrawing& drawing, const std::map<std::string, BodyPlace>& places) {
    std::vector<Action> actions, changes, joins;
    std::set<std::string> restarted;
    const auto restartAt = [&](const std::string& name, const BodyPlace* place) {
        const BodyDescription* body = drawing.find(name);
        if (body == nullptr || !restarted.insert(name).second) return;
        BodyDescription next = *body;
        if (place != nullptr) next.positionMetres = place->metres, next.angleRadians = place->angleRadians;
        changes.push_back(ChangeAction{std::move(next), false});
    };
    for (const auto& [name, place] : places) restartAt(name, &place);
    for (const JointDescription& joint : drawing.drawn().joints) {
        const auto motionOf = [&](const std::string& name) -> std::optional<Motion> {
            const auto place = places.find(name);
            const BodyDescription* body = drawing.find(name);
            return place == places.end() || body == nullptr
                       ? std::nullopt
                       : std::optional{Motion{placeOf(*body), place->second}};
        };
        const auto a = motionOf(joint.bodyA), b = motionOf(joint.bodyB);
        if (!a && !b) continue;
        JointDescription next = joint;
        const Motion& motion = a ? *a : *b;
        std::visit(
            [&](auto& kind) {
                if constexpr (requires { kind.anchorMetres; })
                    kind.anchorMetres = motion(kind.anchorMetres);
                else {
                    if (a) kind.anchorAMetres = (*a)(kind.anchorAMetres);
                    if (b) kind.anchorBMetres = (*b)(kind.anchorBMetres);
                }
                if constexpr (requires { kind.axis; })
                    if (a) kind.axis = a->rotate(kind.axis);
            },
            next.joint);
        for (const std::string& bodyName : {joint.bodyA, joint.bodyB})
            if (const BodyDescription* body = drawing.find(bodyName);
                body != nullptr && body->type != BodyType::staticBody)
                restartAt(bodyName, nullptr);
        actions.push_back(UnjoinAction{joint.name});
        joins.push_back(JoinAction{std::move(next)});
    }
    actions.insert(actions.end(), changes.begin(), changes.end());
    actions.insert(actions.end(), joins.begin(), joins.end());
    return actions;
}

std::vector<Action> removeActions(const SceneDrawing& drawing, const std::vector<std::string>& names) {
    std::vector<Action> actions;
    const auto isSelected = isOneOf(names);
    for (const JointDescription& joint : drawing.drawn().joints)
        if (isSelected(joint.bodyA) || isSelected(joint.bodyB)) actions.push_back(UnjoinAction{joint.name});
    for (const std::string& name : names)
        if (drawing.find(name) != nullptr) actions.push_back(RemoveAction{name});
    return actions;
}

Scene sceneWithout(Scene scene, const std::vector<std::string>& names) {
    std::vector<std::string> jointNames;
    const auto isRemoved = isOneOf(names), isJointRemoved = isOneOf(jointNames);
    std::erase_if(scene.joints, [&](const JointDescription& joint) {
        const bool isAffected = isRemoved(joint.bodyA) || isRemoved(joint.bodyB);
        if (isAffected) jointNames.push_back(joint.name);
        return isAffected;
    });
    std::erase_if(scene.bodies, [&](const BodyDescription& body) { return isRemoved(body.name); });
    std::erase_if(scene.script, [&](const ScriptInput& input) {
        return std::visit(
            [&](const auto& action) {
                if constexpr (requires { isRemoved(action.body); })
                    return isRemoved(action.body);
                else if constexpr (requires { isJointRemoved(action.joint); })
                    return isJointRemoved(action.joint);
                else
                    return false;
            },
            input.action);
    });
    return scene;
}

CopiedBodies copyBodies(const SceneDrawing& drawing, const std::vector<std::string>& names) {
    CopiedBodies copy;
    const auto isSelected = isOneOf(names);
    for (const BodyDescription& body : drawing.drawn().bodies)
        if (isSelected(body.name)) copy.bodies.push_back(body);
    for (const JointDescription& joint : drawing.drawn().joints)
        if (isSelected(joint.bodyA) && isSelected(joint.bodyB)) copy.joints.push_back(joint);
    return copy;
}

std::vector<Action> pasteActions(const SceneDrawing& drawing, const CopiedBodies& copy, const Vector& shift,
                                 std::vector<std::string>& names) {
    SceneDrawing trial = drawing;
    std::vector<Action> actions;
    std::map<std::string, std::string> newNames;
    const auto add = [&](Action action) { trial.apply(action), actions.push_back(std::move(action)); };
    const auto stemOf = [](const std::string& name) {
        return name.substr(0, std::min(name.find_last_not_of("0123456789 ") + 1, name.size()));
    };
    const auto shiftPlace = [&](Vector& place) { place = {place.x + shift.x, place.y + shift.y}; };
    for (BodyDescription body : copy.bodies) {
        const std::string stem = stemOf(body.name), name = trial.unusedName(stem.empty() ? "body" : stem);
        newNames[std::exchange(body.name, name)] = name;
        names.push_back(name);
        shiftPlace(body.positionMetres);
        add(SpawnAction{std::move(body), {}});
    }
    for (JointDescription joint : copy.joints) {
        joint.name = trial.unusedName("joint");
        joint.bodyA = newNames[joint.bodyA];
        joint.bodyB = newNames[joint.bodyB];
        std::visit(
            [&](auto& kind) {
                if constexpr (requires { kind.anchorMetres; })
                    shiftPlace(kind.anchorMetres);
                else
                    shiftPlace(kind.anchorAMetres), shiftPlace(kind.anchorBMetres);
            },
            joint.joint);
        add(JoinAction{std::move(joint)});
    }
    return actions;
}

Scene sceneWithoutBodies(Scene scene) {
    scene.bodies.clear();
    scene.joints.clear();
    scene.script.clear();
    scene.scriptPeriodSeconds = 0.0;
    scene.inputs.clear();
    scene.variables.clear();
    return scene;
}

Scene newScene(const Scene& original, SceneGround ground) {
    Scene scene = sceneWithoutBodies(original);
    scene.name = "new scene";
    scene.description.clear();
    if (ground == SceneGround::empty || scene.materials.empty()) return scene;
    const double w = scene.fieldWidthMetres, h = scene.fieldHeightMetres,
                 wallMetres = std::max(2.0 * sceneLimits::minSizeMetres, 0.05 * std::min(w, h));
    const auto vibrating =
        std::ranges::find_if(scene.materials, [](const Material& m) { return m.frequencyHz > 0.0; });
    const bool canVibrate = vibrating != scene.materials.end();
    const auto addWall = [&](const char* name, double x, double y, double width, double height) {
        BodyDescription body{name, BodyType::staticBody, {{BoxShape{width, height}, {}}}, {x, y}, 0.0, {}};
        if (canVibrate) {
            body.fixtures[0].material = static_cast<int>(vibrating - scene.materials.begin());
            setSource(scene, body, true);
        }
        scene.bodies.push_back(std::move(body));
    };
    addWall("floor", 0.5 * w, -0.5 * wallMetres, w + 2.0 * wallMetres, wallMetres);
    if (ground == SceneGround::floor) return scene;
    addWall("ceiling", 0.5 * w, h + 0.5 * wallMetres, w + 2.0 * wallMetres, wallMetres);
    addWall("left wall", -0.5 * wallMetres, 0.5 * h, wallMetres, h);
    addWall("right wall", w + 0.5 * wallMetres, 0.5 * h, wallMetres, h);
    return scene;
}

namespace {

double clampedSize(double metres, double factor) {
    return std::clamp(metres * factor, 2.0 * sceneLimits::minSizeMetres, sceneLimits::maxSizeMetres);
}

/// Visitor that scales a shape by a factor along x and y.
class Scale {
public:
    Scale(double x, double y)
        : x_{x}
        , y_{y} {}
    void operator()(CircleShape& circle) const {
        circle.radiusMetres = clampedSize(circle.radiusMetres, std::max(x_, y_));
    }
    void operator()(BoxShape& box) const {
        box.widthMetres = clampedSize(box.widthMetres, x_);
        box.heightMetres = clampedSize(box.heightMetres, y_);
    }
    template <class Outline>
    void operator()(Outline& outline) const {
        for (Vector& v : outline.verticesMetres) v = {v.x * x_, v.y * y_};
    }

private:
    double x_, y_;
};

/// Corners of a shape, or of a circle's bounding square.
std::vector<Vector> shapeCorners(const Shape& shape) {
    if (const auto* circle = std::get_if<CircleShape>(&shape))
        return {{-circle->radiusMetres, -circle->radiusMetres}, {circle->radiusMetres, circle->radiusMetres}};
    if (const auto* box = std::get_if<BoxShape>(&shape)) {
        const double x = 0.5 * box->widthMetres, y = 0.5 * box->heightMetres;
        return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    }
    if (const auto* polygon = std::get_if<PolygonShape>(&shape)) return polygon->verticesMetres;
    return std::get<ChainShape>(shape).verticesMetres;
}

bool isLine(const BodyDescription& body) {
    return std::ranges::any_of(body.fixtures, [](const FixtureDescription& f) {
        return std::holds_alternative<ChainShape>(f.shape);
    });
}

double bodyArea(const BodyDescription& body) {
    double area = 0.0;
    for (const FixtureDescription& fixture : body.fixtures) area += momentsOf(fixture.shape).areaSquareMetres;
    return area;
}

} // namespace

LocalBounds localBounds(const BodyDescription& body) {
    constexpr double unbounded = std::numeric_limits<double>::max();
    LocalBounds bounds{{unbounded, unbounded}, {-unbounded, -unbounded}};
    for (const FixtureDescription& fixture : body.fixtures)
        for (const Vector& corner : shapeCorners(fixture.shape)) {
            const Vector turned = detail::rotated(
                corner, std::holds_alternative<CircleShape>(fixture.shape) ? 0.0 : fixture.angleRadians);
            const Vector p{fixture.offsetMetres.x + turned.x, fixture.offsetMetres.y + turned.y};
            bounds = {{std::min(bounds.min.x, p.x), std::min(bounds.min.y, p.y)},
                      {std::max(bounds.max.x, p.x), std::max(bounds.max.y, p.y)}};
        }
    return bounds;
}

BodyDescription scaledBody(BodyDescription body, double factorX, double factorY) {
    for (FixtureDescription& fixture : body.fixtures) {
        std::visit(Scale{factorX, factorY}, fixture.shape);
        fixture.offsetMetres = {fixture.offsetMetres.x * factorX, fixture.offsetMetres.y * factorY};
    }
    return body;
}

double densityOf(const Scene& scene, const BodyDescription& body) {
    const double area = bodyArea(body);
    if (area <= 0.0) return 0.0;
    return massKg(body, scene) / area;
}

void setDensity(BodyDescription& body, double kgPerSquareMetre) {
    const double mass = kgPerSquareMetre * bodyArea(body);
    body.massKg = mass > 0.0 ? std::clamp(mass, sceneLimits::minMassKg, sceneLimits::maxMassKg) : 0.0;
}

void setSource(const Scene& scene, BodyDescription& body, bool isSource) {
    for (FixtureDescription& fixture : body.fixtures) fixture.isCamera = isSource;
    if (isSource && massKg(body, scene) <= 0.0) body.massKg = 1.0; // because a line has no mass
}

bool isSource(const BodyDescription& body) {
    return std::ranges::any_of(body.fixtures, &FixtureDescription::isCamera);
}

void setMoving(BodyDescription& body, bool moves) {
    if (isLine(body)) return;
    body.type = moves ? BodyType::dynamicBody : BodyType::staticBody;
    if (!moves) body.velocityMetresPerSecond = {}; // a static body with a velocity would be a belt
}

} // namespace physvib
