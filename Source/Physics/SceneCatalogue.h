// SPDX-License-Identifier: MIT
// The scenes that come with PhysVib.
#pragma once
#include "Physics/Scene.h"
#include <string_view>
#include <vector>

namespace physvib {

/// All built-in scenes, in the order of their listing. Built on first use; any thread.
const std::vector<Scene>& builtInScenes();

/// The built-in scene of that name; nullptr if there is none. Any thread.
const Scene* findBuiltInScene(std::string_view name);

} // namespace physvib
