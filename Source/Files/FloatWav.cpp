// SPDX-License-Identifier: MIT
// A head, then blocks of all channels side by side.
#include "Files/FloatWav.h"
#include <bit>
#include <cstring>

namespace physvib {

static_assert(std::endian::native == std::endian::little, "samples are written as they are");

FloatWav::FloatWav(const std::filesystem::path& path, int channels, int sampleRateHz, std::int64_t frames)
    : file_{path}
    , channels_{channels} {
    const std::string head = wavHead(channels, sampleRateHz, static_cast<std::uint32_t>(frames * channels * 4));
    file_.writeAt(0, head);
    at_ = std::ssize(head);
}

bool FloatWav::write(const float* const* channels, int frames) {
    bytes_.resize(static_cast<std::size_t>(frames) * static_cast<std::size_t>(channels_) * sizeof(float));
    char* to = bytes_.data();
    for (int n = 0; n < frames; ++n)
        for (int j = 0; j < channels_; ++j, to += sizeof(float)) std::memcpy(to, channels[j] + n, sizeof(float));
    const bool isWritten = file_.writeAt(at_, bytes_);
    at_ += std::ssize(bytes_);
    return isWritten;
}

} // namespace physvib
