// SPDX-License-Identifier: MIT
// Which body, of which material, a fixture number in an event means; for tests of whole scenes.
#pragma once
#include "Scene/World/BodyLists.h"
#include <string>
#include <vector>

namespace physvib {

/// The fixtures of a scene by their numbers in events.
class SceneHits {
public:
    /// `scene` outlives it.
    explicit SceneHits(const Scene& scene)
        : scene_(scene)
        , cast_(allBodies(scene)) {
        for (const BodyDescription& body : cast_)
            for (const FixtureDescription& fixture : body.fixtures) materials_.push_back(fixture.material);
    }

    const std::string& bodyOf(int fixture) const { return cast_.at(bodyOfFixture(cast_, fixture)).name; }
    const Material& materialOf(int fixture) const {
        const int material = materials_.at(static_cast<std::size_t>(fixture));
        return scene_.materials.at(static_cast<std::size_t>(material));
    }
    int fixtures() const { return static_cast<int>(materials_.size()); }
    const std::vector<BodyDescription>& cast() const { return cast_; }

private:
    const Scene& scene_;
    std::vector<BodyDescription> cast_;
    std::vector<int> materials_;
};

} // namespace physvib
