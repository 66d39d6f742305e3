// SPDX-License-Identifier: MIT
// Sizes, masses and places.
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/BodyMass.h"
#include "Scene/World/ShapeGeometry.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace physvib {
namespace {

Vector turned(const Vector& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// From one place of a body to another.
class Motion {
public:
    Motion(const BodyPlace& from, const BodyPlace& to)
        : from_{from}
        , to_{to} {}
    double angle() const { return to_.angleRadians - from_.angleRadians; }
    Vector way(const Vector& axis) const { return turned(axis, angle()); }
    Vector operator()(const Vector& place) const {
        const Vector at = turned({place.x - from_.metres.x, place.y - from_.metres.y}, angle());
        return {to_.metres.x + at.x, to_.metres.y + at.y};
    }

private:
    BodyPlace from_, to_;
};

BodyPlace placeOf(const BodyDescription& body) { return {body.positionMetres, body.angleRadians}; }

double sized(double metres, double factor) { return std::clamp(metres * factor, 2.0 * sceneLimits::minSizeMetres, sceneLimits::maxSizeMetres); }

class Scale {
public:
    Scale(double x, double y) : x_{x}, y_{y} {}
    void operator()(CircleShape& circle) const { circle.radiusMetres = sized(circle.radiusMetres, std::max(x_, y_)); }
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

/// Corners of a shape, or of the square around a circle.
std::vector<Vector> cornersOf(const Shape& shape) {
    if (const auto* circle = std::get_if<CircleShape>(&shape)) return {{-circle->radiusMetres, -circle->radiusMetres}, {circle->radiusMetres, circle->radiusMetres}};
    if (const auto* box = std::get_if<BoxShape>(&shape)) {
        const double x = 0.5 * box->widthMetres, y = 0.5 * box->heightMetres;
        return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    }
    if (const auto* polygon = std::get_if<PolygonShape>(&shape)) return polygon->verticesMetres;
    return std::get<ChainShape>(shape).verticesMetres;
}

/// As near as a seed puts it beside its start.
bool isNear(const BodyDescription& a, const BodyDescription& b) {
    constexpr double near = 2.0e-3;
    return std::hypot(a.positionMetres.x - b.positionMetres.x, a.positionMetres.y - b.positionMetres.y) < near && std::abs(a.angleRadians - b.angleRadians) < near;
}

bool isLine(const BodyDescription& body) {
    return std::ranges::any_of(body.fixtures, [](const FixtureDescription& f) { return std::holds_alternative<ChainShape>(f.shape); });
}

BodyMoments ownMoments(const Scene& scene, BodyDescription body) {
    body.massKg = 0.0;
    return bodyMoments(body, scene);
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
            const Vector at = turned(corner, std::holds_alternative<CircleShape>(fixture.shape) ? 0.0 : fixture.angleRadians);
            const Vector p{fixture.offsetMetres.x + at.x, fixture.offsetMetres.y + at.y};
            reach = {{std::min(reach.least.x, p.x), std::min(reach.least.y, p.y)}, {std::max(reach.most.x, p.x), std::max(reach.most.y, p.y)}};
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
    return (body.massKg > 0.0 ? body.massKg : ownMoments(scene, body).massKg) / area;
}

void setDensity(const Scene&, BodyDescription& body, double kgPerSquareMetre) {
    const double mass = kgPerSquareMetre * areaOf(body);
    body.massKg = mass > 0.0 ? std::clamp(mass, sceneLimits::minMassKg, sceneLimits::maxMassKg) : 0.0;
}

void setSource(const Scene& scene, BodyDescription& body, bool isSource) {
    for (FixtureDescription& fixture : body.fixtures) fixture.isCamera = isSource;
    if (!isSource || body.type == BodyType::dynamicBody || body.massKg > 0.0) return;
    const double mass = ownMoments(scene, body).massKg;
    body.massKg = mass > 0.0 ? std::clamp(mass, sceneLimits::minMassKg, sceneLimits::maxMassKg) : 1.0; // a line has none of its own
}

void setMoving(const Scene& scene, BodyDescription& body, bool moves) {
    if (isLine(body)) return;
    body.type = moves ? BodyType::dynamicBody : BodyType::staticBody;
    const bool isSource = std::ranges::any_of(body.fixtures, &FixtureDescription::isCamera);
    if (isSource && !moves && body.massKg <= 0.0) body.massKg = std::clamp(ownMoments(scene, body).massKg, sceneLimits::minMassKg, sceneLimits::maxMassKg);
}

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
            return place == places.end() || body == nullptr ? std::nullopt : std::optional{Motion{placeOf(*body), place->second}};
        };
        const auto a = motionOf(joint.bodyA), b = motionOf(joint.bodyB);
        if (!a && !b) continue;
        JointDescription next = joint;
        const Motion& any = a ? *a : *b;
        std::visit([&](auto& kind) {
            if constexpr (requires { kind.anchorMetres; }) kind.anchorMetres = any(kind.anchorMetres);
            else {
                if (a) kind.anchorAMetres = (*a)(kind.anchorAMetres);
                if (b) kind.anchorBMetres = (*b)(kind.anchorBMetres);
            }
            if constexpr (requires { kind.axis; })
                if (a) kind.axis = a->way(kind.axis);
        }, next.joint);
        for (const std::string& other : {joint.bodyA, joint.bodyB})
            if (const BodyDescription* body = drawing.find(other); body != nullptr && body->type != BodyType::staticBody) putAt(other, nullptr);
        before.push_back(UnjoinAction{joint.name});
        after.push_back(JoinAction{std::move(next)});
    }
    before.insert(before.end(), changes.begin(), changes.end());
    before.insert(before.end(), after.begin(), after.end());
    return before;
}

std::vector<Action> erased(const SceneDrawing& drawing, const std::vector<std::string>& names) {
    std::vector<Action> actions;
    const auto isMeant = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
    for (const JointDescription& joint : drawing.drawn().joints)
        if (isMeant(joint.name) || isMeant(joint.bodyA) || isMeant(joint.bodyB)) actions.push_back(UnjoinAction{joint.name});
    for (const std::string& name : names)
        if (drawing.find(name) != nullptr) actions.push_back(RemoveAction{name});
    return actions;
}

Copied copied(const SceneDrawing& drawing, const std::vector<std::string>& names) {
    Copied copy;
    const auto isMeant = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
    for (const BodyDescription& body : drawing.drawn().bodies)
        if (isMeant(body.name)) copy.bodies.push_back(body);
    for (const JointDescription& joint : drawing.drawn().joints)
        if (isMeant(joint.bodyA) && isMeant(joint.bodyB)) copy.joints.push_back(joint);
    return copy;
}

std::vector<Action> pasted(const SceneDrawing& drawing, const Copied& copy, const Vector& beside, std::vector<std::string>& names) {
    SceneDrawing trial = drawing;
    std::vector<Action> actions;
    std::map<std::string, std::string> renamed;
    const auto add = [&](Action action) { trial.take(action), actions.push_back(std::move(action)); };
    const auto stemOf = [](const std::string& name) { return name.substr(0, std::min(name.find_last_not_of("0123456789 ") + 1, name.size())); };
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
        std::visit([&](auto& kind) {
            if constexpr (requires { kind.anchorMetres; }) shifted(kind.anchorMetres);
            else shifted(kind.anchorAMetres), shifted(kind.anchorBMetres);
        }, joint.joint);
        add(JoinAction{std::move(joint)});
    }
    return actions;
}

Result<std::vector<Action>> joined(const SceneDrawing& drawing, JointKind kind, const std::pair<std::string, BodyPlace>& a, const std::pair<std::string, BodyPlace>& b, const Vector& from, const Vector& to) {
    constexpr double motorRadiansPerSecond = 3.0, motorGravities = 3.0;
    std::vector<Action> actions;
    double heaviest = 0.0;
    for (const auto& [name, place] : {a, b}) {
        const BodyDescription* body = drawing.find(name);
        if (body == nullptr) return Failure{"a joint: expected two bodies"};
        if (body->type == BodyType::dynamicBody) heaviest = std::max(heaviest, massKg(*body, drawing.drawn()) * lengthMetres(body->fixtures[0].shape));
        BodyDescription here = *body;
        here.positionMetres = place.metres;
        here.angleRadians = place.angleRadians;
        if (isNear(here, *body)) continue;
        here.velocityMetresPerSecond = {};
        here.spinRadiansPerSecond = 0.0;
        actions.push_back(ChangeAction{std::move(here), false});
    }
    if (a.first == b.first) return Failure{"a joint: expected two bodies, found " + a.first + " twice"};
    if (heaviest <= 0.0) return Failure{"a joint: expected a body that moves"};
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (kind != JointKind::pin && kind != JointKind::motor && length < sceneLimits::minSizeMetres) return Failure{"a rope or slider: expected two places"};
    JointDescription joint;
    joint.name = drawing.freeName("joint");
    joint.bodyA = a.first;
    joint.bodyB = b.first;
    if (kind == JointKind::rope) {
        DistanceJoint rope{from, to, 0.0, 0.0, true};
        joint.collide = true;
        joint.joint = rope;
    } else if (kind == JointKind::slider) {
        SliderJoint slider;
        slider.anchorMetres = from;
        slider.axis = {(to.x - from.x) / length, (to.y - from.y) / length};
        slider.travelMetres = Interval{0.0, length};
        joint.joint = slider;
    } else {
        RevoluteJoint pin;
        pin.anchorMetres = from;
        const Vector& g = drawing.drawn().gravityMetresPerSecond2;
        if (kind == JointKind::motor) pin.motorRadiansPerSecond = motorRadiansPerSecond, pin.maxTorqueNewtonMetres = std::min(sceneLimits::maxTorqueNewtonMetres, motorGravities * std::max(1.0, std::hypot(g.x, g.y)) * heaviest);
        joint.joint = pin;
    }
    actions.push_back(JoinAction{std::move(joint)});
    return actions;
}

Scene sceneNow(const Scene& drawn, const PoseNow& now) {
    Scene scene = drawn;
    std::map<std::string, Motion> motions;
    for (BodyDescription& body : scene.bodies) {
        const auto pose = now ? now(body.name) : std::nullopt;
        if (!pose) continue;
        const BodyPlace here{{pose->xMetres, pose->yMetres}, pose->angleRadians};
        motions.emplace(body.name, Motion{placeOf(body), here});
        body.positionMetres = here.metres;
        body.angleRadians = here.angleRadians;
    }
    for (JointDescription& joint : scene.joints) {
        const auto a = motions.find(joint.bodyA), b = motions.find(joint.bodyB);
        if (a == motions.end() || b == motions.end()) continue;
        std::visit([&](auto& kind) {
            if constexpr (requires { kind.anchorAMetres; }) {
                kind.anchorAMetres = a->second(kind.anchorAMetres);
                kind.anchorBMetres = b->second(kind.anchorBMetres);
                return;
            } else {
                const Vector onA = a->second(kind.anchorMetres), onB = b->second(kind.anchorMetres);
                const double angle = b->second.angle() - a->second.angle();
                kind.anchorMetres = onA;
                if constexpr (requires { kind.axis; }) {
                    kind.axis = a->second.way(kind.axis);
                    const double length = std::hypot(kind.axis.x, kind.axis.y), way = ((onB.x - onA.x) * kind.axis.x + (onB.y - onA.y) * kind.axis.y) / length;
                    if (kind.travelMetres) kind.travelMetres = Interval{kind.travelMetres->lower - way, kind.travelMetres->upper - way};
                }
                if constexpr (requires { kind.limitsRadians; })
                    if (kind.limitsRadians) kind.limitsRadians = Interval{kind.limitsRadians->lower - angle, kind.limitsRadians->upper - angle};
            }
        }, joint.joint);
    }
    return scene;
}

Scene newScene(const Scene& like, SceneGround ground) {
    Scene scene = like;
    scene.name = "new scene";
    scene.description.clear();
    scene.bodies.clear();
    scene.joints.clear();
    scene.script.clear();
    scene.scriptPeriodSeconds = 0.0;
    scene.inputs.clear();
    scene.variables.clear();
    if (ground == SceneGround::empty || scene.materials.empty()) return scene;
    const double w = scene.fieldWidthMetres, h = scene.fieldHeightMetres, thick = std::max(2.0 * sceneLimits::minSizeMetres, 0.05 * std::min(w, h));
    const auto wall = [&](const char* name, double x, double y, double width, double height) {
        BodyDescription body;
        body.name = name;
        body.type = BodyType::staticBody;
        body.positionMetres = {x, y};
        body.fixtures.resize(1);
        body.fixtures[0].shape = BoxShape{width, height};
        scene.bodies.push_back(std::move(body));
    };
    wall("floor", 0.5 * w, -0.5 * thick, w + 2.0 * thick, thick);
    if (ground == SceneGround::floor) return scene;
    wall("ceiling", 0.5 * w, h + 0.5 * thick, w + 2.0 * thick, thick);
    wall("left wall", -0.5 * thick, 0.5 * h, thick, h);
    wall("right wall", w + 0.5 * thick, 0.5 * h, thick, h);
    return scene;
}

} // namespace physvib
