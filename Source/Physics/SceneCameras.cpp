// SPDX-License-Identifier: MIT
// Which fixtures may ever have a camera, and what these need.
#include "Physics/PlacedBodies.h"
#include "Physics/SceneCast.h"
#include "Physics/SceneReferences.h"
#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace physvib {

namespace {

using detail::itemPath;

class Cameras {
public:
    explicit Cameras(const Scene& scene)
        : scene_(scene) {
        for (const ScriptInput& input : scene.script) note(input.action);
        for (const LiveInput& input : scene.inputs) note(input.action);
    }

    /// Of every repetition: each has a name of its own for camera and material actions.
    std::string check(const PlacedBody& placed) const {
        const SpawnAction spawn{*placed.body, {}};
        for (int k = 0; k < placed.times; ++k) {
            const BodyDescription body = spawnedBody(spawn, k, placed.times);
            for (int i = 0; i < static_cast<int>(body.fixtures.size()); ++i)
                if (mayBeCamera(body, i))
                    if (auto fault = checkCamera(body, i, placed.path); !fault.empty()) return fault;
        }
        return {};
    }

private:
    void note(const Action& action) {
        if (const auto* camera = std::get_if<CameraAction>(&action))
            if (camera->isOn) switchedOn_.emplace(camera->body, camera->fixture);
        if (const auto* change = std::get_if<MaterialAction>(&action))
            changes_[change->body].push_back(change);
    }

    static const FixtureDescription& fixtureOf(const BodyDescription& body, int index) {
        return body.fixtures[static_cast<std::size_t>(index)];
    }

    bool isSilent(int material) const {
        const Material& made = scene_.materials[static_cast<std::size_t>(material)];
        return made.frequencyHz <= 0.0 || made.decayPerSecond <= 0.0;
    }

    bool mayBeCamera(const BodyDescription& body, int fixture) const {
        return fixtureOf(body, fixture).isCamera || switchedOn_.contains({body.name, everyFixture}) ||
               switchedOn_.contains({body.name, fixture});
    }

    std::string checkCamera(const BodyDescription& body, int index, const std::string& path) const {
        const std::string place = itemPath(path + ".fixtures", static_cast<std::size_t>(index));
        const Voice voice = fixtureOf(body, index).voice;
        if (body.type != BodyType::dynamicBody && body.massKg <= 0.0)
            return path + ".mass_kg: a camera body that is not dynamic has no mass in Box2D, expected one "
                          "above 0";
        if (voice != Voice::own)
            if (auto fault = checkOthers(place); !fault.empty()) return fault;
        if (voice != Voice::other && mayBeSilent(body, index))
            return place +
                   ".material: a camera's material vibrates, expected one with frequency_hz and decay_per_s";
        return {};
    }

    bool mayBeSilent(const BodyDescription& body, int index) const {
        if (isSilent(fixtureOf(body, index).material)) return true;
        const auto changes = changes_.find(body.name);
        if (changes == changes_.end()) return false;
        return std::ranges::any_of(changes->second, [&](const MaterialAction* change) {
            const bool isMeant = change->fixture == everyFixture || change->fixture == index;
            return isMeant && isSilent(change->material);
        });
    }

    // Anything may strike it.
    std::string checkOthers(const std::string& camera) const {
        for (std::size_t i = 0; i < scene_.materials.size(); ++i)
            if (isSilent(static_cast<int>(i)))
                return itemPath("materials", i) + ": expected frequency_hz and decay_per_s, for " + camera +
                       " has the voice of what strikes it";
        return {};
    }

    const Scene& scene_;
    std::set<std::pair<std::string_view, int>> switchedOn_;
    std::map<std::string_view, std::vector<const MaterialAction*>> changes_;
};

} // namespace

std::string checkCameras(const Scene& scene) {
    const Cameras cameras(scene);
    for (const PlacedBody& placed : placedBodies(scene))
        if (std::string fault = cameras.check(placed); !fault.empty()) return fault;
    return {};
}

} // namespace physvib
