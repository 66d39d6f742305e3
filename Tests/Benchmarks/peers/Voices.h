// SPDX-License-Identifier: GPL-3.0-or-later
// What every peer plays: the lines of a voices file, "frequency_hz decay_per_s amplitude gain_1 ... gain_N".
// A program is called as PROGRAM VOICES SECONDS OUT and writes 48 kHz, interleaved 32-bit floats, in blocks
// of 64 frames. It keeps only the first 2 s: what is timed is making samples, not writing them.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

constexpr int rate = 48000, block = 64, channels = 4;

struct Voice {
    double frequencyHz, decayPerSecond, amplitude, gains[channels];
};

inline std::vector<Voice> readVoices(const char* path) {
    std::vector<Voice> voices;
    std::ifstream file{path};
    for (std::string line; std::getline(file, line);) {
        std::istringstream numbers{line};
        Voice v;
        numbers >> v.frequencyHz >> v.decayPerSecond >> v.amplitude;
        for (double& gain : v.gains) numbers >> gain;
        voices.push_back(v);
    }
    return voices;
}

/// Calls render(float* const* channels, long firstFrame) block by block.
template <class Render>
int play(char** arguments, Render render) {
    const long blocks = static_cast<long>(std::atof(arguments[2]) * rate / block);
    std::FILE* out = std::fopen(arguments[3], "wb");
    if (out == nullptr) return 1;
    std::vector<float> memory(channels * block), mixed(channels * block);
    float* at[channels];
    for (int j = 0; j < channels; ++j) at[j] = memory.data() + j * block;
    for (long b = 0; b < blocks; ++b) {
        render(at, b * block);
        if (b * block >= 2 * rate) continue;
        for (int k = 0; k < block; ++k)
            for (int j = 0; j < channels; ++j) mixed[static_cast<std::size_t>(k * channels + j)] = at[j][k];
        std::fwrite(mixed.data(), sizeof(float), mixed.size(), out);
    }
    return std::fclose(out);
}
