// SPDX-License-Identifier: GPL-3.0-or-later
// Access from an LV2 window to the plug-in instance that it shows.
#pragma once
#include <cstdint>
#include <memory>

namespace physvib {

class Lv2Controls;
class PluginProcessor;

struct Lv2Parts {
    PluginProcessor* processor = nullptr;
    std::shared_ptr<Lv2Controls> controls{};
    std::uint32_t firstControl = 0; ///< the first parameter's port
};

/// By the handle that the host has of an instance that lives. Any thread.
Lv2Parts lv2PartsOf(void* instance) noexcept;

} // namespace physvib
