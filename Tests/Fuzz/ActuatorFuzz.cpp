// SPDX-License-Identifier: MIT
// Fuzz target of the reader of actuator profiles.
#include "Fuzzing.h"
#include "Scene/ActuatorFile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto read = [](std::string_view text) { return readActuator(text, "f"); };
    const auto profile = read(fuzz::asText(data, size));
    if (!profile) {
        fuzz::demandClearRefusal(profile, profile.value == ActuatorProfile{});
        return 0;
    }
    fuzz::demand(!profile.value.resonanceHz || *profile.value.resonanceHz > 0.0, "a resonance that is none");
    fuzz::demandRoundTrip(actuatorJson(profile.value), read, actuatorJson);
    return 0;
}
