// SPDX-License-Identifier: MIT
// Applies edits to a scene, and finds each action's inverse before it acts.
// Creates bodies from drawn points: convex hulls, and simplified polylines.
#include "Scene/Drawing/SceneDrawing.h"
#include "Core/PortableMath.h"
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>

namespace physvib {

namespace {

/// One action per fixture, with its present value.
template <class Make>
std::vector<Action> ofFixtures(const BodyDescription* body, Make make) {
    std::vector<Action> back;
    for (std::size_t i = 0; body != nullptr && i < body->fixtures.size(); ++i)
        back.push_back(make(static_cast<int>(i), body->fixtures[i]));
    return back;
}

} // namespace

std::optional<BodyPose> drawable(BodyPose pose) {
    if (std::abs(pose.angleRadians) > sceneLimits::maxAngleRadians)
        pose.angleRadians = std::remainder(pose.angleRadians, 2.0 * std::numbers::pi);
    const bool isNear =
        std::max(std::abs(pose.xMetres), std::abs(pose.yMetres)) <= sceneLimits::maxPositionMetres;
    return isNear ? std::optional{pose} : std::nullopt;
}

SceneDrawing::SceneDrawing(Scene scene)
    : drawn_{std::move(scene)}
    , cast_{drawn_} {}

std::string SceneDrawing::check(const std::vector<Action>& actions) const {
    return InputCheck{cast_}.take(actions);
}

void SceneDrawing::take(std::span<const Action> actions) {
    editScene(drawn_, actions);
    for (const Action& action : actions)
        if (isAnyOf<SpawnAction, ChangeAction, RemoveAction, JoinAction, UnjoinAction>(action))
            cast_.inputs.push_back({0.0, action});
        else if (isLasting(action))
            describeEdit(cast_, action);
}

const BodyDescription* SceneDrawing::find(std::string_view body) const noexcept {
    return findNamed(drawn_.bodies, body);
}

std::vector<std::string> SceneDrawing::freeNames(const std::string& stem, std::size_t count) const {
    std::set<std::string> taken;
    for (const BodyDescription& body : sceneCast(cast_)) taken.insert(body.name);
    for (const JointDescription& joint : drawn_.joints) taken.insert(joint.name);
    for (const LiveInput& input : cast_.inputs)
        if (const auto* join = std::get_if<JoinAction>(&input.action)) taken.insert(join->joint.name);
    std::vector<std::string> names;
    for (int n = 1; names.size() < count; ++n)
        if (std::string name = stem + " " + std::to_string(n); !taken.contains(name))
            names.push_back(std::move(name));
    return names;
}

std::vector<Action> SceneDrawing::undoOf(const Action& action, const PoseNow& now) const {
    if (const auto* removal = std::get_if<RemoveAction>(&action)) {
        const BodyDescription* const there = find(removal->body);
        if (there == nullptr) return {};
        ChangeAction back{*there, false};
        if (const auto pose = now ? now(removal->body) : std::nullopt) {
            back.body.positionMetres = {pose->xMetres, pose->yMetres};
            back.body.angleRadians = pose->angleRadians;
        }
        return {back};
    }
    if (const BodyDescription* put = bodyPutBy(action)) {
        const BodyDescription* const there = find(put->name);
        const auto* change = std::get_if<ChangeAction>(&action);
        if (there == nullptr) return {RemoveAction{put->name}};
        return {ChangeAction{*there, change != nullptr && change->stays}};
    }
    if (const auto* join = std::get_if<JoinAction>(&action)) return {UnjoinAction{join->joint.name}};
    if (const auto* unjoin = std::get_if<UnjoinAction>(&action)) {
        const Scene here = sceneNow(drawn_, now);
        const auto* joint = findNamed(here.joints, unjoin->joint);
        if (joint == nullptr) return {};
        std::vector<Action> back; // what it held was drawn elsewhere, and goes on alone
        for (const BodyDescription& body : here.bodies)
            if ((body.name == joint->bodyA || body.name == joint->bodyB) && body != *find(body.name))
                back.push_back(ChangeAction{body, false});
        back.push_back(JoinAction{*joint});
        return back;
    }
    if (const auto* material = std::get_if<MaterialAction>(&action))
        return ofFixtures(find(material->body), [&](int i, const FixtureDescription& f) {
            return MaterialAction{material->body, i, f.material};
        });
    if (const auto* camera = std::get_if<CameraAction>(&action))
        return ofFixtures(find(camera->body), [&](int i, const FixtureDescription& f) {
            return CameraAction{camera->body, i, f.isCamera};
        });
    if (const auto* sound = std::get_if<SoundAction>(&action)) {
        const Material& old = drawn_.materials[static_cast<std::size_t>(sound->material)];
        return {SoundAction{sound->material, old.frequencyHz, old.decayPerSecond}};
    }
    if (const auto* texture = std::get_if<TextureAction>(&action)) {
        const Material& old = drawn_.materials[static_cast<std::size_t>(texture->material)];
        return {
            TextureAction{texture->material, old.grainMetres, old.roughness, old.grainPattern, old.rolling}};
    }
    return {};
}

void SceneEdit::run(bool isForth, const SceneDrawing& drawing, const PoseNow& now,
                    const std::function<void(std::span<const Action>)>& act) {
    const auto& actions = isForth ? forth_ : back_;
    std::vector<Action> opposite; // from the end
    // a joint that is changed stays where it was drawn
    const bool isErased = std::ranges::none_of(actions, isAnyOf<JoinAction>);
    for (std::span<const Action> left{actions}; !left.empty();) {
        const auto run = left.first(takenTogether(left));
        left = left.subspan(run.size());
        for (const Action& action : run) {
            const auto back = drawing.undoOf(action, isErased ? now : PoseNow{});
            opposite.insert(opposite.end(), back.rbegin(), back.rend());
        }
        act(run);
    }
    (isForth ? back_ : forth_).assign(opposite.rbegin(), opposite.rend());
}

SceneEdit SceneEdit::followedBy(const SceneEdit& next) const {
    SceneEdit both{next.forth_};
    both.back_ = back_;
    return both;
}

namespace {

constexpr double smallest = 2.0 * sceneLimits::minSizeMetres; // across
constexpr std::size_t mostLineCorners = sceneLimits::maxChainVertices / 2;

double distance(const Vector& a, const Vector& b) { return portable::hypot(b.x - a.x, b.y - a.y); }
double cross(const Vector& o, const Vector& a, const Vector& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

Failure tooSmall(const char* what) {
    return Failure{std::string{what} + ": expected at least " +
                   std::to_string(sceneLimits::minSizeMetres).substr(0, 4) + " m across"};
}

BodyDescription bodyOf(Shape shape, const Vector& at, BodyType type) {
    return {{}, type, {{std::move(shape), {}}}, at, 0.0, {}};
}

/// Counter-clockwise.
std::vector<Vector> hullOf(std::vector<Vector> points) {
    std::ranges::sort(
        points, [](const Vector& a, const Vector& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<Vector> hull;
    const auto chain = [&hull](auto first, auto last) {
        const std::size_t begin = hull.size();
        for (; first != last; ++first) {
            while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), *first) <= 0.0)
                hull.pop_back();
            hull.push_back(*first);
        }
        hull.pop_back(); // the other chain begins with this point
    };
    if (points.size() < 3) return {};
    chain(points.begin(), points.end());
    chain(points.rbegin(), points.rend());
    return hull;
}

/// Removes the corner with the smallest area until at most `most` are left and no edge is too short.
void thin(std::vector<Vector>& hull, std::size_t most) {
    const auto isShort = [&] {
        for (std::size_t i = 0; i < hull.size(); ++i)
            if (distance(hull[i], hull[(i + 1) % hull.size()]) < sceneLimits::minSizeMetres) return true;
        return false;
    };
    while (hull.size() > 3 && (hull.size() > most || isShort())) {
        std::size_t least = 0;
        double leastArea = HUGE_VAL;
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const double area = std::abs(
                cross(hull[(i + hull.size() - 1) % hull.size()], hull[i], hull[(i + 1) % hull.size()]));
            if (area < leastArea) leastArea = area, least = i;
        }
        hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(least));
    }
}

Vector centroidOf(const std::vector<Vector>& outline) {
    Vector sum;
    double area = 0.0;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
        const double part = cross(outline[0], outline[i], outline[i + 1]);
        sum.x += part * (outline[0].x + outline[i].x + outline[i + 1].x) / 3.0;
        sum.y += part * (outline[0].y + outline[i].y + outline[i + 1].y) / 3.0;
        area += part;
    }
    return area > 0.0 ? Vector{sum.x / area, sum.y / area} : outline[0];
}

std::vector<Vector> from(std::vector<Vector> places, const Vector& origin) {
    for (Vector& place : places) place = {place.x - origin.x, place.y - origin.y};
    return places;
}

double offLine(const Vector& p, const Vector& a, const Vector& b) {
    const double length = distance(a, b);
    return length > 0.0 ? std::abs(cross(a, b, p)) / length : distance(a, p);
}

/// Douglas-Peucker: keeps the point farthest from the chord, and recurses into both parts.
void keepCorners(const std::vector<Vector>& way, std::size_t first, std::size_t last, double tolerance,
                 std::vector<Vector>& kept) {
    std::size_t farthest = first;
    double most = tolerance;
    for (std::size_t i = first + 1; i < last; ++i)
        if (const double off = offLine(way[i], way[first], way[last]); off > most) most = off, farthest = i;
    if (farthest != first) {
        keepCorners(way, first, farthest, tolerance, kept);
        keepCorners(way, farthest, last, tolerance, kept);
    } else
        kept.push_back(way[last]);
}

} // namespace

Result<BodyDescription> drawnBall(const Vector& centre, const Vector& rim) {
    const double radius = distance(centre, rim);
    if (2.0 * radius < smallest) return tooSmall("ball");
    return bodyOf(CircleShape{radius}, centre, BodyType::dynamicBody);
}

Result<std::vector<BodyDescription>> drawnRain(const Vector& corner, const Vector& opposite, int count) {
    constexpr double filled = 0.35; // radius by the distance of two centres
    const double left = std::min(corner.x, opposite.x), bottom = std::min(corner.y, opposite.y),
                 width = std::abs(opposite.x - corner.x), height = std::abs(opposite.y - corner.y);
    const auto columns =
        std::max(1, static_cast<int>(std::lround(std::sqrt(count * width / std::max(height, smallest)))));
    const int rows = (count + columns - 1) / columns;
    const Vector step{width / columns, height / rows};
    const double radius = filled * std::min(step.x, step.y);
    std::vector<BodyDescription> balls;
    for (int k = 0; k < count; ++k) {
        const Vector centre{left + (k % columns + 0.5) * step.x, bottom + (k / columns + 0.5) * step.y};
        auto ball = drawnBall(centre, {centre.x + radius, centre.y});
        if (!ball) return Failure{"a rain: expected a larger place for " + std::to_string(count) + " balls"};
        balls.push_back(std::move(ball.value));
    }
    return balls;
}

Result<BodyDescription> drawnBox(const Vector& corner, const Vector& opposite) {
    const double width = std::abs(opposite.x - corner.x), height = std::abs(opposite.y - corner.y);
    if (std::min(width, height) < smallest) return tooSmall("box");
    return bodyOf(BoxShape{width, height}, {0.5 * (corner.x + opposite.x), 0.5 * (corner.y + opposite.y)},
                  BodyType::dynamicBody);
}

Result<BodyDescription> drawnPolygon(const std::vector<Vector>& corners) {
    auto hull = hullOf(corners);
    if (hull.size() < 3) return Failure{"polygon: expected at least 3 corners that are not in a line"};
    thin(hull, sceneLimits::maxPolygonVertices);
    const Vector at = centroidOf(hull);
    return bodyOf(PolygonShape{from(hull, at)}, at, BodyType::dynamicBody);
}

Result<BodyDescription> drawnWall(const Vector& from, const Vector& to, double thicknessMetres) {
    const double length = distance(from, to);
    if (std::min(length, thicknessMetres) < sceneLimits::minSizeMetres) return tooSmall("wall");
    BodyDescription wall = bodyOf(BoxShape{length, thicknessMetres},
                                  {0.5 * (from.x + to.x), 0.5 * (from.y + to.y)}, BodyType::staticBody);
    wall.angleRadians = portable::atan2(to.y - from.y, to.x - from.x);
    return wall;
}

Result<BodyDescription> drawnLine(const std::vector<Vector>& way, double toleranceMetres) {
    std::vector<Vector> apart;
    for (const Vector& place : way)
        if (apart.empty() || distance(apart.back(), place) >= smallest) apart.push_back(place);
    if (apart.size() < 2) return tooSmall("line");
    std::vector<Vector> corners;
    for (double tolerance = std::max(toleranceMetres, 1e-6);; tolerance *= 2.0) {
        corners = {apart[0]};
        keepCorners(apart, 0, apart.size() - 1, tolerance, corners);
        if (corners.size() <= mostLineCorners) break;
    }
    const Vector at = corners[0];
    corners = from(corners, at);
    // and back: a chain collides on one side only
    for (std::size_t i = corners.size() - 1; i-- > 0;) corners.push_back(corners[i]);
    return bodyOf(ChainShape{corners, false}, at, BodyType::staticBody);
}

bool startsAsSource(const BodyDescription& body) { return body.type == BodyType::dynamicBody; }

Vector snapped(const Vector& place, double gridMetres) {
    if (gridMetres <= 0.0) return place;
    return {gridMetres * std::round(place.x / gridMetres), gridMetres * std::round(place.y / gridMetres)};
}

} // namespace physvib
