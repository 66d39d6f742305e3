// SPDX-License-Identifier: MIT
// Handles, checks and conversions that the functions of physvib-live.h share.
#pragma once
#include "Api/C/Convert.h"
#include "Api/C/Handles.h"
#include "Api/Live/Live.h"
#include "Api/Live/physvib-live.h"
#include "Core/Units.h"
#include <vector>

namespace physvib::api {

inline Handles<Live, 3>& lives() {
    static auto* const all = new Handles<Live, 3>; // never destroyed: threads may outlive main
    return *all;
}

inline std::uintptr_t nameOf(physvib_live live) noexcept { return reinterpret_cast<std::uintptr_t>(live); }

/// The open devices. Any thread.
std::vector<std::uintptr_t> openLives();

/// Calls `call(live)`, or returns the error for an unknown handle.
template <class Call>
auto in(physvib_live name, Call call) noexcept -> decltype(call(std::declval<Live&>())) {
    return guarded([&]() -> decltype(call(std::declval<Live&>())) {
        const auto live = lives().use(nameOf(name));
        if (!live) return unknownHandle();
        if (!live->isOfThisProcess())
            return fail(PHYSVIB_ERROR_DEVICE, "live: the process that opened it plays on; expected a device "
                                              "that the child opens itself");
        return call(*live);
    });
}

inline bool isLevel(double db) noexcept { return db >= -90.0 && db <= 0.0; } // not NaN
inline float gainOf(double db) noexcept { return static_cast<float>(fromDecibels(db)); }

/// Reads renderer settings; null: the defaults. Sets the error and returns false if they are invalid.
inline bool takeRenderer(const physvib_renderer_settings* from, RendererSettings& to) {
    physvib_renderer_settings taken;
    if (from == nullptr)
        physvib_renderer_settings_init(&taken, sizeof taken);
    else if (!take(from, taken, physvib_renderer_settings_init))
        return false;
    const std::string_view fault = convert(taken, to);
    return fault.empty() || (nothingThere(fault), false);
}

} // namespace physvib::api
