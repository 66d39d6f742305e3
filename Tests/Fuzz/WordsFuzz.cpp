// SPDX-License-Identifier: MIT
// Fuzz target of the reader of words that participants read.
#include "Fuzzing.h"
#include "Lab/Files/Translation.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto words = readTranslation(fuzz::asText(data, size), "f");
    if (!words) {
        fuzz::demandClearRefusal(words, words.value.texts.empty());
        return 0;
    }
    for (const auto& [english, text] : words.value.texts)
        fuzz::demand(words.value.translate(english) == text, "a text that is not found");
    return 0;
}
