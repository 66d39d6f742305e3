// SPDX-License-Identifier: MIT
// Fuzz target of the reader of actuator profiles.
#include "Fuzzing.h"
#include "Scene/ActuatorFile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto profile = fuzz::tried(data, size, readActuator, actuatorJson);
    fuzz::demand(!profile || !profile->resonanceHz || *profile->resonanceHz > 0.0,
                 "a resonance that is none");
    return 0;
}
