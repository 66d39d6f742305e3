// SPDX-License-Identifier: MIT
// HapticBody and HapticMaterial: what a body of Godot is to PhysVib. For Godot's main thread.
#pragma once

#include "Api/Godot/Classes.h"

#include <physvib/physvib.h>

#include <vector>

namespace physvib::godot {

/// A child of a physics body: that body is felt, or at least observed.
class HapticBody final : public Instance {
public:
    explicit HapticBody(GDExtensionObjectPtr object);
    ~HapticBody() override;
    void notified(int what) override;
    void changed() override;
    std::vector<std::string> warnings() const override;

    /// Of Godot's physics body; 0: there is none.
    std::uint64_t bodyId() const { return parentId; }
    /// Of the physics server, in which the body is.
    std::uint64_t spaceId() const { return space; }
    bool isFelt() const;
    /// Sets vibration, gain and part, not the mass. `standard`: the HapticMaterial if it has none of its own;
    /// nil: the built-in one. Reports an unknown preset, with the body's path.
    void describe(physvib_body& body, const Value& standard) const;

private:
    std::uint64_t parentId = 0, space = 0;
};

/// Sets vibration and grains by a HapticMaterial of `node`; nil: none. An unknown preset is reported, and the
/// material's two numbers count.
void describeMaterial(physvib_body& body, const Value& material, const Value& node);
/// RID of the space of a node of the plane or of space that is in a scene tree.
std::uint64_t spaceOf(const Value& node, bool isSpace);

/// Those of a class in a scene.
std::vector<Value> nodesIn(const Value& scene, const char* kind);
/// Those that are in a scene tree now.
const std::vector<HapticBody*>& hapticBodies();

extern const Class hapticBodyClass, hapticMaterialClass;

} // namespace physvib::godot
