// SPDX-License-Identifier: MIT
// Fuzz target of the reader of designs: every task is a call that renders, reads below its folder, and does
// nothing else.
#include "Fuzzing.h"
#include "Lab/Files/SweepFile.h"
#include "Lab/Study/Protocol.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto design = readSweep(fuzz::asText(data, size), "f");
    if (!design) {
        fuzz::demandClearRefusal(design, design.value.scenes.empty());
        return 0;
    }
    const std::uint64_t tasks = design.value.size();
    fuzz::demand(tasks >= 1, "a design without a task");
    for (const std::uint64_t at : {std::uint64_t{0}, tasks / 3, tasks / 2, tasks - 1}) {
        const std::string call = design.value.task(at).call;
        fuzz::demand(callFault(call).empty(), "a call that may do anything", call);
    }
    return 0;
}
