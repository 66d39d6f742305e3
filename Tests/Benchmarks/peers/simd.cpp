// SPDX-License-Identifier: GPL-3.0-or-later
// What one would write second: each voice turns as a complex number, consecutive samples in the lanes of the
// widest vectors there are. The sums of a block stay in registers; single precision drifts.
#include "Voices.h"
#include <cmath>
#include <complex>

#ifdef __AVX512F__
constexpr int lanes = 16;
#else
constexpr int lanes = 8;
#endif
constexpr int groups = block / lanes;
using Lanes = float __attribute__((vector_size(lanes * sizeof(float))));

struct Turning {
    Lanes real, imaginary;         // of the next samples
    float turnReal, turnImaginary; // by so many samples
    float gains[channels];
};

Turning turningOf(const Voice& v) {
    const std::complex<double> step =
        std::exp(std::complex{-v.decayPerSecond, 2 * M_PI * v.frequencyHz} / double(rate));
    Turning made{};
    std::complex<double> at = v.amplitude;
    for (int k = 0; k < lanes; ++k, at *= step) {
        made.real[k] = float(at.real());
        made.imaginary[k] = float(at.imag());
    }
    const std::complex<double> turn = std::pow(step, lanes);
    made.turnReal = float(turn.real());
    made.turnImaginary = float(turn.imag());
    for (int j = 0; j < channels; ++j) made.gains[j] = float(v.gains[j]);
    return made;
}

int main(int, char** arguments) {
    std::vector<Turning> voices;
    for (const Voice& v : readVoices(arguments[1])) voices.push_back(turningOf(v));
    return play(arguments, [&](float* const* out, long) {
        Lanes sums[channels][groups]{};
        for (Turning& v : voices) {
            Lanes real = v.real, imaginary = v.imaginary;
            for (int g = 0; g < groups; ++g) {
                for (int j = 0; j < channels; ++j) sums[j][g] += v.gains[j] * imaginary;
                const Lanes turned = real * v.turnReal - imaginary * v.turnImaginary;
                imaginary = real * v.turnImaginary + imaginary * v.turnReal;
                real = turned;
            }
            v.real = real;
            v.imaginary = imaginary;
        }
        for (int j = 0; j < channels; ++j)
            for (int k = 0; k < block; ++k) out[j][k] = sums[j][k / lanes][k % lanes];
    });
}
