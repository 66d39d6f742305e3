// SPDX-License-Identifier: MIT
// Finds the fixtures that may become haptic sources, and checks that they have mass and sound.
#include "Scene/SceneValidation.h"
#include "Scene/World/BodyMass.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <compare>
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
        for (const ScriptInput& input : scene.script)
            if (!std::holds_alternative<SpawnAction>(input.action)) note(input.action);
        for (const LiveInput& input : scene.inputs) note(input.action);
        bearers_.clear();
    }

    /// Checks every repetition, because each has its own name in camera and material actions.
    std::string check(const PlacedBody& placed) {
        const SpawnAction spawn{*placed.body, {}};
        if (placed.isLive) count(placed.body->name);
        for (int k = 0; k < placed.times; ++k) {
            const BodyDescription body = spawnedBody(spawn, k, placed.times);
            for (int i = 0; i < static_cast<int>(body.fixtures.size()); ++i)
                if (mayBeCamera(body, i))
                    if (auto fault = checkCamera(body, i, placed.path); !fault.empty()) return fault;
        }
        return {};
    }

private:
    // A body that had a name; a name may pass to another body, to which earlier actions do not apply.
    struct Bearer {
        std::string_view name;
        int number; // index among live-spawned bodies of that name; earlier actions count for the first
        auto operator<=>(const Bearer&) const = default;
    };
    void count(std::string_view name) { ++bearers_[name]; }
    Bearer bearer(std::string_view name) const {
        const auto found = bearers_.find(name);
        return {name, found == bearers_.end() ? 1 : found->second};
    }

    void note(const Action& action) {
        if (const BodyDescription* body = bodyPutBy(action)) count(body->name);
        if (const auto* camera = std::get_if<CameraAction>(&action))
            if (camera->isOn) switchedOn_.emplace(bearer(camera->body), camera->fixture);
        if (const auto* change = std::get_if<MaterialAction>(&action))
            changes_[bearer(change->body)].push_back(change);
    }

    static const FixtureDescription& fixtureOf(const BodyDescription& body, int index) {
        return body.fixtures[static_cast<std::size_t>(index)];
    }

    bool isSilent(int material) const {
        const Material& made = scene_.materials[static_cast<std::size_t>(material)];
        return made.frequencyHz <= 0.0 || made.decayPerSecond <= 0.0;
    }

    bool mayBeCamera(const BodyDescription& body, int fixture) const {
        return fixtureOf(body, fixture).isCamera || switchedOn_.contains({bearer(body.name), everyFixture}) ||
               switchedOn_.contains({bearer(body.name), fixture});
    }

    std::string checkCamera(const BodyDescription& body, int index, const std::string& path) const {
        const std::string place = itemPath(path + ".fixtures", static_cast<std::size_t>(index));
        const Voice voice = fixtureOf(body, index).voice;
        if (massKg(body, scene_) <= 0.0) return path + ".mass_kg: expected above 0, as a line has none";
        if (voice != Voice::own)
            if (auto fault = checkOthers(place); !fault.empty()) return fault;
        if (voice != Voice::other && mayBeSilent(body, index))
            return place +
                   ".material: a camera's material vibrates, expected one with frequency_hz and decay_per_s";
        return {};
    }

    bool mayBeSilent(const BodyDescription& body, int index) const {
        if (isSilent(fixtureOf(body, index).material)) return true;
        const auto changes = changes_.find(bearer(body.name));
        if (changes == changes_.end()) return false;
        return std::ranges::any_of(changes->second, [&](const MaterialAction* change) {
            const bool isMeant = change->fixture == everyFixture || change->fixture == index;
            return isMeant && isSilent(change->material);
        });
    }

    // Any material may collide with it.
    std::string checkOthers(const std::string& camera) const {
        for (std::size_t i = 0; i < scene_.materials.size(); ++i)
            if (isSilent(static_cast<int>(i)))
                return itemPath("materials", i) + ": expected frequency_hz and decay_per_s, for " + camera +
                       " has the voice of what strikes it";
        return {};
    }

    const Scene& scene_;
    std::map<std::string_view, int> bearers_;
    std::set<std::pair<Bearer, int>> switchedOn_;
    std::map<Bearer, std::vector<const MaterialAction*>> changes_;
};

} // namespace

std::string checkCameras(const Scene& scene) {
    Cameras cameras(scene);
    for (const PlacedBody& placed : placedBodies(scene))
        if (std::string fault = cameras.check(placed); !fault.empty()) return fault;
    return {};
}

} // namespace physvib
