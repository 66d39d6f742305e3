// SPDX-License-Identifier: MIT
// Editor operations on bodies with their joints: move, remove, copy, paste; and new empty scenes.
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/BodyMass.h"
#include <algorithm>
#include <limits>
#include <set>

namespace physvib {
using detail::Motion;
using detail::placeOf;

namespace {

auto isIn(const std::vector<std::string>& names) {
    return [&names](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
}

} // namespace

Action changed(BodyDescription body) { return ChangeAction{std::move(body), true}; }

std::vector<Action> movedTo(const SceneDrawing& drawing, const std::map<std::string, BodyPlace>& places) {
    std::vector<Action> before, changes, after;
    std::set<std::string> put;
    const auto putAt = [&](const std::string& name, const BodyPlace* place) {
        const BodyDescription* body = drawing.find(name);
        if (body == nullptr || !put.insert(name).second) return;
        BodyDescription next = *body;
        if (place != nullptr) next.positionMetres = place->metres, next.angleRadians = place->angleRadians;
        changes.push_back(ChangeAction{std::move(next), false});
    };
    for (const auto& [name, place] : places) putAt(name, &place);
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
        const Motion& any = a ? *a : *b;
        std::visit(
            [&](auto& kind) {
                if constexpr (requires { kind.anchorMetres; })
                    kind.anchorMetres = any(kind.anchorMetres);
                else {
                    if (a) kind.anchorAMetres = (*a)(kind.anchorAMetres);
                    if (b) kind.anchorBMetres = (*b)(kind.anchorBMetres);
                }
                if constexpr (requires { kind.axis; })
                    if (a) kind.axis = a->way(kind.axis);
            },
            next.joint);
        for (const std::string& other : {joint.bodyA, joint.bodyB})
            if (const BodyDescription* body = drawing.find(other);
                body != nullptr && body->type != BodyType::staticBody)
                putAt(other, nullptr);
        before.push_back(UnjoinAction{joint.name});
        after.push_back(JoinAction{std::move(next)});
    }
    before.insert(before.end(), changes.begin(), changes.end());
    before.insert(before.end(), after.begin(), after.end());
    return before;
}

std::vector<Action> erased(const SceneDrawing& drawing, const std::vector<std::string>& names) {
    std::vector<Action> actions;
    const auto isMeant = isIn(names);
    for (const JointDescription& joint : drawing.drawn().joints)
        if (isMeant(joint.name) || isMeant(joint.bodyA) || isMeant(joint.bodyB))
            actions.push_back(UnjoinAction{joint.name});
    for (const std::string& name : names)
        if (drawing.find(name) != nullptr) actions.push_back(RemoveAction{name});
    return actions;
}

Scene without(Scene scene, const std::vector<std::string>& names) {
    auto gone = names;
    const auto isGone = isIn(gone);
    std::erase_if(scene.joints, [&](const JointDescription& joint) {
        const bool goes = isGone(joint.name) || isGone(joint.bodyA) || isGone(joint.bodyB);
        if (goes) gone.push_back(joint.name);
        return goes;
    });
    std::erase_if(scene.bodies, [&](const BodyDescription& body) { return isGone(body.name); });
    std::erase_if(scene.script, [&](const ScriptInput& input) {
        return std::visit(
            [&](const auto& action) {
                if constexpr (requires { isGone(action.body); })
                    return isGone(action.body);
                else if constexpr (requires { isGone(action.joint); })
                    return isGone(action.joint);
                else
                    return false;
            },
            input.action);
    });
    return scene;
}

Copied copied(const SceneDrawing& drawing, const std::vector<std::string>& names) {
    Copied copy;
    const auto isMeant = isIn(names);
    for (const BodyDescription& body : drawing.drawn().bodies)
        if (isMeant(body.name)) copy.bodies.push_back(body);
    for (const JointDescription& joint : drawing.drawn().joints)
        if (isMeant(joint.bodyA) && isMeant(joint.bodyB)) copy.joints.push_back(joint);
    return copy;
}

std::vector<Action> pasted(const SceneDrawing& drawing, const Copied& copy, const Vector& beside,
                           std::vector<std::string>& names) {
    SceneDrawing trial = drawing;
    std::vector<Action> actions;
    std::map<std::string, std::string> renamed;
    const auto add = [&](Action action) { trial.take(action), actions.push_back(std::move(action)); };
    const auto stemOf = [](const std::string& name) {
        return name.substr(0, std::min(name.find_last_not_of("0123456789 ") + 1, name.size()));
    };
    const auto shifted = [&](Vector& place) { place = {place.x + beside.x, place.y + beside.y}; };
    for (BodyDescription body : copy.bodies) {
        const std::string stem = stemOf(body.name), name = trial.freeName(stem.empty() ? "body" : stem);
        renamed[body.name] = body.name = name;
        names.push_back(name);
        shifted(body.positionMetres);
        add(SpawnAction{std::move(body), {}});
    }
    for (JointDescription joint : copy.joints) {
        joint.name = trial.freeName("joint");
        joint.bodyA = renamed[joint.bodyA];
        joint.bodyB = renamed[joint.bodyB];
        std::visit(
            [&](auto& kind) {
                if constexpr (requires { kind.anchorMetres; })
                    shifted(kind.anchorMetres);
                else
                    shifted(kind.anchorAMetres), shifted(kind.anchorBMetres);
            },
            joint.joint);
        add(JoinAction{std::move(joint)});
    }
    return actions;
}

Scene emptied(Scene scene) {
    scene.bodies.clear();
    scene.joints.clear();
    scene.script.clear();
    scene.scriptPeriodSeconds = 0.0;
    scene.inputs.clear();
    scene.variables.clear();
    return scene;
}

Scene newScene(const Scene& like, SceneGround ground) {
    Scene scene = emptied(like);
    scene.name = "new scene";
    scene.description.clear();
    if (ground == SceneGround::empty || scene.materials.empty()) return scene;
    const double w = scene.fieldWidthMetres, h = scene.fieldHeightMetres,
                 thick = std::max(2.0 * sceneLimits::minSizeMetres, 0.05 * std::min(w, h));
    const auto felt =
        std::ranges::find_if(scene.materials, [](const Material& m) { return m.frequencyHz > 0.0; });
    const bool isFelt = felt != scene.materials.end();
    const auto wall = [&](const char* name, double x, double y, double width, double height) {
        BodyDescription body{name, BodyType::staticBody, {{BoxShape{width, height}, {}}}, {x, y}, 0.0, {}};
        if (isFelt) {
            body.fixtures[0].material = static_cast<int>(felt - scene.materials.begin());
            setSource(scene, body, true);
        }
        scene.bodies.push_back(std::move(body));
    };
    wall("floor", 0.5 * w, -0.5 * thick, w + 2.0 * thick, thick);
    if (ground == SceneGround::floor) return scene;
    wall("ceiling", 0.5 * w, h + 0.5 * thick, w + 2.0 * thick, thick);
    wall("left wall", -0.5 * thick, 0.5 * h, thick, h);
    wall("right wall", w + 0.5 * thick, 0.5 * h, thick, h);
    return scene;
}

namespace {

double sized(double metres, double factor) {
    return std::clamp(metres * factor, 2.0 * sceneLimits::minSizeMetres, sceneLimits::maxSizeMetres);
}

class Scale {
public:
    Scale(double x, double y)
        : x_{x}
        , y_{y} {}
    void operator()(CircleShape& circle) const {
        circle.radiusMetres = sized(circle.radiusMetres, std::max(x_, y_));
    }
    void operator()(BoxShape& box) const {
        box.widthMetres = sized(box.widthMetres, x_);
        box.heightMetres = sized(box.heightMetres, y_);
    }
    template <class Outline>
    void operator()(Outline& outline) const {
        for (Vector& v : outline.verticesMetres) v = {v.x * x_, v.y * y_};
    }

private:
    double x_, y_;
};

/// Corners of a shape, or of a circle's bounding square.
std::vector<Vector> cornersOf(const Shape& shape) {
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

double areaOf(const BodyDescription& body) {
    double area = 0.0;
    for (const FixtureDescription& fixture : body.fixtures) area += momentsOf(fixture.shape).areaSquareMetres;
    return area;
}

} // namespace

Reach reachOf(const BodyDescription& body) {
    constexpr double far = std::numeric_limits<double>::max();
    Reach reach{{far, far}, {-far, -far}};
    for (const FixtureDescription& fixture : body.fixtures)
        for (const Vector& corner : cornersOf(fixture.shape)) {
            const Vector at = detail::turned(
                corner, std::holds_alternative<CircleShape>(fixture.shape) ? 0.0 : fixture.angleRadians);
            const Vector p{fixture.offsetMetres.x + at.x, fixture.offsetMetres.y + at.y};
            reach = {{std::min(reach.least.x, p.x), std::min(reach.least.y, p.y)},
                     {std::max(reach.most.x, p.x), std::max(reach.most.y, p.y)}};
        }
    return reach;
}

BodyDescription scaledBody(BodyDescription body, double factorX, double factorY) {
    for (FixtureDescription& fixture : body.fixtures) {
        std::visit(Scale{factorX, factorY}, fixture.shape);
        fixture.offsetMetres = {fixture.offsetMetres.x * factorX, fixture.offsetMetres.y * factorY};
    }
    return body;
}

double densityOf(const Scene& scene, const BodyDescription& body) {
    const double area = areaOf(body);
    if (area <= 0.0) return 0.0;
    return massKg(body, scene) / area;
}

void setDensity(BodyDescription& body, double kgPerSquareMetre) {
    const double mass = kgPerSquareMetre * areaOf(body);
    body.massKg = mass > 0.0 ? std::clamp(mass, sceneLimits::minMassKg, sceneLimits::maxMassKg) : 0.0;
}

void setSource(const Scene& scene, BodyDescription& body, bool isSource) {
    for (FixtureDescription& fixture : body.fixtures) fixture.isCamera = isSource;
    if (isSource && massKg(body, scene) <= 0.0) body.massKg = 1.0; // a line has no mass of its own
}

bool isSource(const BodyDescription& body) {
    return std::ranges::any_of(body.fixtures, &FixtureDescription::isCamera);
}

void setMoving(BodyDescription& body, bool moves) {
    if (isLine(body)) return;
    body.type = moves ? BodyType::dynamicBody : BodyType::staticBody;
    if (!moves) body.velocityMetresPerSecond = {}; // or it would be a belt
}

} // namespace physvib
