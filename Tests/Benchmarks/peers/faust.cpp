// SPDX-License-Identifier: GPL-3.0-or-later
// What Faust made of the same voices (-DGENERATED="file"), one resonator each, struck by an impulse.
#include "Voices.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <faust/dsp/dsp.h>
#include <faust/gui/UI.h>
#include <faust/gui/meta.h>
#include GENERATED

int main(int, char** arguments) {
    static Generated voices;
    voices.init(rate);
    return play(arguments, [&](float* const* out, long) {
        float* at[channels];
        std::copy_n(out, channels, at);
        voices.compute(block, nullptr, at);
    });
}
