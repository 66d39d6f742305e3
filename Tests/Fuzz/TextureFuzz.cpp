// SPDX-License-Identifier: MIT
// Fuzz target of the reader of autoregressive textures.
#include "Formats/TextureModels.h"
#include "Fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto read = readTextureModels(fuzz::asText(data, size), "f");
    if (!read) return fuzz::demandClearRefusal(read, read.value.models.empty()), 0;
    fuzz::demand(!read.value.models.empty(), "no model");
    for (const TextureModel& model : read.value.models)
        fuzz::demand(!model.coefficients.empty() && model.variance >= 0.0, "a model without coefficients");
    fuzz::demand(!read.value.nearest(0.1, 1.0).coefficients.empty(), "nothing is near");
    return 0;
}
