// SPDX-License-Identifier: MIT
// The functions of physvib-live.h that play one hit at once.
#include "Api/C/Calls.h"
#include "Api/Live/physvib-live.h"
#include <string>

using namespace physvib::api;

int physvib_live_impact(physvib_live live, double x, double y, double strength) {
    return physvib_live_impact_of(live, nullptr, x, y, strength);
}

int physvib_live_impact_of(physvib_live live, const char* material, double x, double y, double strength) {
    return guarded([&] {
        physvib_event event;
        if (const int code = physvib_event_of(material, x, y, strength, &event); code != PHYSVIB_OK)
            return fail(code, std::string{physvib_error()}); // the other library's text
        event.time_ns = physvib_live_now_ns(live);
        if (event.time_ns < 0) return static_cast<int>(event.time_ns); // an error
        return physvib_live_strike(live, &event, 1);
    });
}
