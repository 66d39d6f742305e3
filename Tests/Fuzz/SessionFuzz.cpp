// SPDX-License-Identifier: MIT
// Fuzz target of the session reader.
#include "Fuzzing.h"
#include "Live/Documents/SessionFile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto session = fuzz::tried(
        data, size, readSession, [](const SavedSession& saved) { return sessionJson(saved); },
        [](const SavedSession& empty) { return empty.log.runs.empty(); });
    fuzz::demand(!session || isValid(session->panner.layout()), "not valid");
    return 0;
}
