// SPDX-License-Identifier: GPL-3.0-or-later
// What one would write first: sin times exp, per voice and sample. REAL is float or double; compilers do what
// flags let them.
#include "Voices.h"
#include <cmath>

#ifndef REAL
#define REAL double
#endif

// On its own and without aliases, so that the compiler can use its vector library.
__attribute__((noinline)) void add(const Voice& v, int first, float* __restrict a, float* __restrict b,
                                   float* __restrict c, float* __restrict d) {
    const REAL turn = REAL(2 * M_PI * v.frequencyHz / rate), decay = REAL(v.decayPerSecond / rate),
               amplitude = REAL(v.amplitude);
    const float g0 = float(v.gains[0]), g1 = float(v.gains[1]), g2 = float(v.gains[2]),
                g3 = float(v.gains[3]);
    for (int k = 0; k < block; ++k) {
        const REAL t = REAL(first + k);
        const float x = float(amplitude * std::sin(turn * t) * std::exp(-decay * t));
        a[k] += g0 * x;
        b[k] += g1 * x;
        c[k] += g2 * x;
        d[k] += g3 * x;
    }
}

int main(int, char** arguments) {
    const auto voices = readVoices(arguments[1]);
    return play(arguments, [&](float* const* out, long first) {
        for (int j = 0; j < channels; ++j)
            for (int k = 0; k < block; ++k) out[j][k] = 0.0f;
        // struck anew every 2 s: the vector library is slow for large angles
        const int since = int(first % (2 * rate));
        for (const Voice& v : voices) add(v, since, out[0], out[1], out[2], out[3]);
    });
}
