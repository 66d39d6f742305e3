// SPDX-License-Identifier: MIT
// Applies edits to a scene, and computes each action's inverse before it acts; and creates bodies from drawn
// points (make...() of BodyEdits.h: convex hulls and simplified polylines).
#include "Scene/Drawing/SceneDrawing.h"
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/BodyLists.h"
#include "Scene/World/InputCheck.h"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>

namespace physvib {

namespace {

/// The actions make(index, fixture) for all fixtures of the body.
template <class Make>
std::vector<Action> fixtureActions(const BodyDescription* body, Make make) {
    std::vector<Action> undo;
    for (std::size_t i = 0; body != nullptr && i < body->fixtures.size(); ++i)
        undo.push_back(make(static_cast<int>(i), body->fixtures[i]));
    return undo;
}

} // namespace

std::optional<BodyPose> poseWithinLimits(BodyPose pose) {
    if (std::abs(pose.angleRadians) > sceneLimits::maxAngleRadians)
        pose.angleRadians = std::remainder(pose.angleRadians, 2.0 * std::numbers::pi);
    const bool isNear =
        std::max(std::abs(pose.xMetres), std::abs(pose.yMetres)) <= sceneLimits::maxPositionMetres;
    return isNear ? std::optional{pose} : std::nullopt;
}

SceneDrawing::SceneDrawing(Scene scene)
    : drawn_{std::move(scene)}
    , sceneWithAllBodies_{drawn_} {}

std::string SceneDrawing::check(const std::vector<Action>& actions) const {
    return InputCheck{sceneWithAllBodies_}.accept(actions);
}

void SceneDrawing::apply(std::span<const Action> actions) {
    editScene(drawn_, actions);
    for (const Action& action : actions)
        if (isAnyOf<SpawnAction, ChangeAction, RemoveAction, JoinAction, UnjoinAction>(action))
            sceneWithAllBodies_.inputs.push_back({0.0, action});
        else if (isLasting(action))
            recordEdit(sceneWithAllBodies_, action);
}

const BodyDescription* SceneDrawing::find(std::string_view body) const noexcept {
    return findNamed(drawn_.bodies, body);
}

std::vector<std::string> SceneDrawing::unusedNames(const std::string& stem, std::size_t count) const {
    std::set<std::string> usedNames;
    for (const BodyDescription& body : allBodies(sceneWithAllBodies_)) usedNames.insert(body.name);
    for (const JointDescription& joint : drawn_.joints) usedNames.insert(joint.name);
    for (const LiveInput& input : sceneWithAllBodies_.inputs)
        if (const auto* join = std::get_if<JoinAction>(&input.action)) usedNames.insert(join->joint.name);
    std::vector<std::string> names;
    for (int n = 1; names.size() < count; ++n)
        if (std::string name = stem + " " + std::to_string(n); !usedNames.contains(name))
            names.push_back(std::move(name));
    return names;
}

std::vector<Action> SceneDrawing::undoActions(const Action& action, const CurrentPose& findPose) const {
    if (const auto* removal = std::get_if<RemoveAction>(&action)) {
        const BodyDescription* const present = find(removal->body);
        if (present == nullptr) return {};
        ChangeAction undo{*present, false};
        if (const auto pose = findPose ? findPose(removal->body) : std::nullopt) {
            undo.body.positionMetres = {pose->xMetres, pose->yMetres};
            undo.body.angleRadians = pose->angleRadians;
        }
        return {undo};
    }
    if (const BodyDescription* added = bodyAddedBy(action)) {
        const BodyDescription* const present = find(added->name);
        const auto* change = std::get_if<ChangeAction>(&action);
        if (present == nullptr) return {RemoveAction{added->name}};
        return {ChangeAction{*present, change != nullptr && change->stays}};
    }
    if (const auto* join = std::get_if<JoinAction>(&action)) return {UnjoinAction{join->joint.name}};
    if (const auto* unjoin = std::get_if<UnjoinAction>(&action)) {
        const Scene presentScene = sceneNow(drawn_, findPose);
        const auto* joint = findNamed(presentScene.joints, unjoin->joint);
        if (joint == nullptr) return {};
        std::vector<Action> undo; // bodies that have moved restart where they are now
        for (const BodyDescription& body : presentScene.bodies)
            if ((body.name == joint->bodyA || body.name == joint->bodyB) && body != *find(body.name))
                undo.push_back(ChangeAction{body, false});
        undo.push_back(JoinAction{*joint});
        return undo;
    }
    if (const auto* material = std::get_if<MaterialAction>(&action))
        return fixtureActions(find(material->body), [&](int i, const FixtureDescription& f) {
            return MaterialAction{material->body, i, f.material};
        });
    if (const auto* camera = std::get_if<CameraAction>(&action))
        return fixtureActions(find(camera->body), [&](int i, const FixtureDescription& f) {
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

void SceneEdit::perform(bool isForward, const SceneDrawing& drawing, const CurrentPose& findPose,
                        const std::function<void(std::span<const Action>)>& execute) {
    const auto& actions = isForward ? actions_ : inverses_;
    std::vector<Action> inverses; // in reverse order
    // a joint that is removed and joined again keeps its drawn place, so the present pose is not used
    const bool removesJoints = std::ranges::none_of(actions, isAnyOf<JoinAction>);
    for (std::span<const Action> remaining{actions}; !remaining.empty();) {
        const auto group = remaining.first(independentActions(remaining));
        remaining = remaining.subspan(group.size());
        for (const Action& action : group) {
            const auto undo = drawing.undoActions(action, removesJoints ? findPose : CurrentPose{});
            inverses.insert(inverses.end(), undo.rbegin(), undo.rend());
        }
        execute(group);
    }
    (isForward ? inverses_ : actions_).assign(inverses.rbegin(), inverses.rend());
}

SceneEdit SceneEdit::mergedWith(const SceneEdit& next) const {
    SceneEdit merged{next.actions_};
    merged.inverses_ = inverses_;
    return merged;
}

namespace {

constexpr double minWidthMetres = 2.0 * sceneLimits::minSizeMetres;
constexpr std::size_t maxLineCorners = sceneLimits::maxChainVertices / 2;

using detail::distance;

double cross(const Vector& o, const Vector& a, const Vector& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

Failure tooSmallFailure(const char* what) {
    return Failure{std::string{what} + ": expected at least " +
                   std::to_string(sceneLimits::minSizeMetres).substr(0, 4) + " m across"};
}

BodyDescription makeBody(Shape shape, const Vector& position, BodyType type) {
    return {{}, type, {{std::move(shape), {}}}, position, 0.0, {}};
}

/// Corners of the convex hull, counter-clockwise (Andrew's monotone chain); empty for less than three points.
std::vector<Vector> convexHull(std::vector<Vector> points) {
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

/// Removes corners, each time the one whose triangle with its neighbours has the smallest area, until at most
/// `maxCorners` remain and no edge is too short.
void reduceCorners(std::vector<Vector>& hull, std::size_t maxCorners) {
    const auto isShort = [&] {
        for (std::size_t i = 0; i < hull.size(); ++i)
            if (distance(hull[i], hull[(i + 1) % hull.size()]) < sceneLimits::minSizeMetres) return true;
        return false;
    };
    while (hull.size() > 3 && (hull.size() > maxCorners || isShort())) {
        std::size_t smallestCorner = 0;
        double minArea = HUGE_VAL;
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const double area = std::abs(
                cross(hull[(i + hull.size() - 1) % hull.size()], hull[i], hull[(i + 1) % hull.size()]));
            if (area < minArea) minArea = area, smallestCorner = i;
        }
        hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(smallestCorner));
    }
}

Vector computeCentroid(const std::vector<Vector>& outline) {
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

std::vector<Vector> relativeTo(std::vector<Vector> places, const Vector& origin) {
    for (Vector& place : places) place = {place.x - origin.x, place.y - origin.y};
    return places;
}

double distanceToLine(const Vector& p, const Vector& a, const Vector& b) {
    const double length = distance(a, b);
    return length > 0.0 ? std::abs(cross(a, b, p)) / length : distance(a, p);
}

/// Simplifies the points from `first` to `last` (Douglas-Peucker): if the point farthest from the chord is
/// off by more than `tolerance`, both parts are simplified; else only `last` is appended to `corners`.
void appendCorners(const std::vector<Vector>& path, std::size_t first, std::size_t last, double tolerance,
                   std::vector<Vector>& corners) {
    std::size_t farthest = first;
    double maxDistance = tolerance;
    for (std::size_t i = first + 1; i < last; ++i)
        if (const double deviation = distanceToLine(path[i], path[first], path[last]);
            deviation > maxDistance)
            maxDistance = deviation, farthest = i;
    if (farthest != first) {
        appendCorners(path, first, farthest, tolerance, corners);
        appendCorners(path, farthest, last, tolerance, corners);
    } else
        corners.push_back(path[last]);
}

} // namespace

Result<BodyDescription> makeBall(const Vector& centre, const Vector& rim) {
    const double radius = distance(centre, rim);
    if (2.0 * radius < minWidthMetres) return tooSmallFailure("ball");
    return makeBody(CircleShape{radius}, centre, BodyType::dynamicBody);
}

Result<std::vector<BodyDescription>> makeRain(const Vector& corner, const Vector& opposite, int count) {
    constexpr double radiusShare = 0.35; // ball radius divided by the distance of two centres
    const double left = std::min(corner.x, opposite.x), bottom = std::min(corner.y, opposite.y),
                 width = std::abs(opposite.x - corner.x), height = std::abs(opposite.y - corner.y);
    const auto columns = std::max(
        1, static_cast<int>(std::lround(std::sqrt(count * width / std::max(height, minWidthMetres)))));
    const int rows = (count + columns - 1) / columns;
    const Vector step{width / columns, height / rows};
    const double radius = radiusShare * std::min(step.x, step.y);
    std::vector<BodyDescription> balls;
    for (int k = 0; k < count; ++k) {
        const Vector centre{left + (k % columns + 0.5) * step.x, bottom + (k / columns + 0.5) * step.y};
        auto ball = makeBall(centre, {centre.x + radius, centre.y});
        if (!ball) return Failure{"a rain: expected a larger place for " + std::to_string(count) + " balls"};
        balls.push_back(std::move(ball.value));
    }
    return balls;
}

Result<BodyDescription> makeBox(const Vector& corner, const Vector& opposite) {
    const double width = std::abs(opposite.x - corner.x), height = std::abs(opposite.y - corner.y);
    if (std::min(width, height) < minWidthMetres) return tooSmallFailure("box");
    return makeBody(BoxShape{width, height}, {0.5 * (corner.x + opposite.x), 0.5 * (corner.y + opposite.y)},
                    BodyType::dynamicBody);
}

Result<BodyDescription> makePolygon(const std::vector<Vector>& corners) {
    auto hull = convexHull(corners);
    if (hull.size() < 3) return Failure{"polygon: expected at least 3 corners that are not in a line"};
    reduceCorners(hull, sceneLimits::maxPolygonVertices);
    const Vector origin = computeCentroid(hull);
    return makeBody(PolygonShape{relativeTo(hull, origin)}, origin, BodyType::dynamicBody);
}

Result<BodyDescription> makeWall(const Vector& from, const Vector& to, double thicknessMetres) {
    const double length = distance(from, to);
    if (std::min(length, thicknessMetres) < sceneLimits::minSizeMetres) return tooSmallFailure("wall");
    BodyDescription wall = makeBody(BoxShape{length, thicknessMetres},
                                    {0.5 * (from.x + to.x), 0.5 * (from.y + to.y)}, BodyType::staticBody);
    wall.angleRadians = portable::atan2(to.y - from.y, to.x - from.x);
    return wall;
}

Result<BodyDescription> makeLine(const std::vector<Vector>& path, double toleranceMetres) {
    std::vector<Vector> spaced;
    for (const Vector& place : path)
        if (spaced.empty() || distance(spaced.back(), place) >= minWidthMetres) spaced.push_back(place);
    if (spaced.size() < 2) return tooSmallFailure("line");
    std::vector<Vector> corners;
    for (double tolerance = std::max(toleranceMetres, 1e-6);; tolerance *= 2.0) {
        corners = {spaced[0]};
        appendCorners(spaced, 0, spaced.size() - 1, tolerance, corners);
        if (corners.size() <= maxLineCorners) break;
    }
    const Vector origin = corners[0];
    corners = relativeTo(corners, origin);
    // the chain also leads back, because it collides on one side only
    for (std::size_t i = corners.size() - 1; i-- > 0;) corners.push_back(corners[i]);
    return makeBody(ChainShape{corners, false}, origin, BodyType::staticBody);
}

bool startsAsSource(const BodyDescription& body) { return body.type == BodyType::dynamicBody; }

Vector snapToGrid(const Vector& place, double gridMetres) {
    if (gridMetres <= 0.0) return place;
    return {gridMetres * std::round(place.x / gridMetres), gridMetres * std::round(place.y / gridMetres)};
}

} // namespace physvib
