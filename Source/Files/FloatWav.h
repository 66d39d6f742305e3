// SPDX-License-Identifier: MIT
// A WAVE file of 32-bit floats whose length is known before its samples.
#pragma once
#include "Files/Disk/AtomicFile.h"
#include "Files/WavHead.h"
#include <cstdint>
#include <filesystem>
#include <string>

namespace physvib {

/// Whether a plain WAVE file can hold so much. Any thread.
constexpr bool fitsWav(int channels, std::int64_t frames) noexcept { return frames <= wavMostBytes / (4 * channels); }

/// Takes all samples in their order, then its place; see AtomicFile. M only.
class FloatWav {
public:
    /// A file of so many frames of each channel, which fit.
    FloatWav(const std::filesystem::path& path, int channels, int sampleRateHz, std::int64_t frames);

    /// Empty, or one line with the file and the reason.
    const std::string& error() const noexcept { return file_.error(); }

    /// The next frames of each channel. False after the first error.
    bool write(const float* const* channels, int frames);

    /// Puts the file in its place. Returns error(); after one there is no file.
    [[nodiscard]] const std::string& commit() { return file_.commit(); }

private:
    AtomicFile file_;
    int channels_;
    std::int64_t at_ = 0; // bytes
    std::string bytes_;   // of one block
};

} // namespace physvib
