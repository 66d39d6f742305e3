// SPDX-License-Identifier: MIT
// HapticBody and HapticMaterial: what a body of Godot is to PhysVib. For Godot's main thread.
#pragma once

#include "Api/Godot/Classes.h"

#include <physvib/physvib.h>

#include <vector>

namespace physvib::godot {

/// A child of a physics body: that body is felt, or is told of at least.
class HapticBody final : public Instance {
public:
    explicit HapticBody(GDExtensionObjectPtr object);
    ~HapticBody() override;
    void notified(int what) override;
    std::vector<std::string> warnings() const override;

    /// Of Godot's physics body; 0: there is none.
    std::uint64_t bodyId() const { return parentId; }
    /// Sets vibration, gain and part, not the mass. False: its material has errors, which were reported.
    bool describe(physvib_body& body) const;

private:
    std::uint64_t parentId = 0;
};

/// Those that are in a scene tree now.
const std::vector<HapticBody*>& hapticBodies();

extern const Class hapticBodyClass, hapticMaterialClass;

} // namespace physvib::godot
