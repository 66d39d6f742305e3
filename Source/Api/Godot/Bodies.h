// SPDX-License-Identifier: MIT
// HapticBody and HapticMaterial, which describe a body of Godot to PhysVib. For Godot's main thread.
#pragma once
#include "Api/Godot/Classes.h"

#include <physvib/physvib.h>

#include <vector>

namespace physvib::godot {

/// Child of a physics body, which makes that body a haptic source, or at least reports its contacts.
class HapticBody final : public Instance {
public:
    explicit HapticBody(GDExtensionObjectPtr object);
    ~HapticBody() override;
    void onNotification(int what) override;
    void onPropertyChanged() override;
    std::vector<std::string> warnings() const override;

    /// Instance id of Godot's physics body; 0: there is none.
    std::uint64_t parentBodyId() const { return parentId; }
    /// RID of the physics server's space that contains the body.
    std::uint64_t spaceRid() const { return space; }
    bool isFelt() const;
    /// Sets vibration, gain and part, not the mass. `defaultMaterial`: the HapticMaterial if it has none of
    /// its own; nil: the built-in one. Reports an unknown preset, with the body's path.
    void applyTo(physvib_body& body, const Variant& defaultMaterial) const;

private:
    std::uint64_t parentId = 0, space = 0;
};

/// Sets vibration and grains from a HapticMaterial of `node`; nil: sets nothing. An unknown preset is
/// reported, and then frequency and decay of the material apply.
void applyMaterial(physvib_body& body, const Variant& material, const Variant& node);
/// RID of the physics space of a 2D or 3D node that is in a scene tree.
std::uint64_t readSpaceRid(const Variant& node, bool is3d);

/// Nodes of a class in a scene, which may be its root.
std::vector<Variant> findNodes(const Variant& scene, const char* kind);
/// All HapticBody nodes that are in a scene tree now.
const std::vector<HapticBody*>& hapticBodies();

extern const ClassTable hapticBodyClass, hapticMaterialClass;

} // namespace physvib::godot
