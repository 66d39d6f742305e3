// SPDX-License-Identifier: MIT
// Fuzz target of the reader of couplings, and of the drives that follow from them.
#include "Fuzzing.h"
#include "Lab/Study/Coupling.h"
#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto coupling = readCoupling(fuzz::asText(data, size), "f");
    if (!coupling) {
        fuzz::demandClearRefusal(coupling,
                                 coupling.value.frequenciesHz.empty() && coupling.value.matrices.empty());
        return 0;
    }
    const std::size_t enchanters = coupling.value.enchanters();
    fuzz::demand(enchanters > 0 && coupling.value.frequenciesHz.size() == coupling.value.matrices.size(),
                 "not one matrix per frequency");
    for (const CouplingMatrix& matrix : coupling.value.matrices)
        fuzz::demand(matrix.size == enchanters, "matrices of several sizes");
    if (enchanters > 4) return 0; // larger ones take longer and have nothing new
    const double most = maxDrive(compensationMatrix(coupling.value.matrices.front()));
    fuzz::demand(std::isfinite(most) && most <= std::pow(10.0, maxExtraDriveDb / 20.0),
                 "a drive above its limit");
    return 0;
}
