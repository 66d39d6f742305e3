// SPDX-License-Identifier: MIT
// One direction of an ALSA device: its parameters, and interleaved samples to or from it.
#pragma once
#include "Live/Devices/AlsaLibrary.h"
#include <atomic>
#include <string>
#include <vector>

namespace physvib {

/// What a device offers in one direction; no channels if it cannot be asked.
struct AlsaRange {
    int minChannels = 0, maxChannels = 0;
    bool isMissing = false; ///< it cannot be opened, and not because another program has it or because of
                            ///< rights
    int rateHz = 0;         ///< the first usual rate from 44.1 kHz on that it has; 0: none
};

class AlsaPcm {
public:
    AlsaPcm(const AlsaLibrary& alsa, std::string id, snd_pcm_stream_t direction)
        : alsa_{alsa}
        , id_{std::move(id)}
        , direction_{direction} {}
    ~AlsaPcm() { close(); }
    AlsaPcm(const AlsaPcm&) = delete;
    AlsaPcm& operator=(const AlsaPcm&) = delete;

    /// Opens the device for a moment. M; may wait for the driver.
    AlsaRange range() const;

    /// Near `rateHz` and `blockFrames`, which become what the device chose; floats, which ALSA converts where
    /// the device has other samples. Returns empty or one line. M; may wait for the driver.
    std::string open(int channels, int& rateHz, int& blockFrames);
    void close();
    bool isOpen() const noexcept { return pcm_ != nullptr; }
    bool hasName() const noexcept { return !id_.empty(); }
    int channels() const noexcept { return channels_; }
    int latencyFrames() const noexcept { return latencyFrames_; }

    /// Starts recording; playing starts with the first block. Device thread.
    void begin();

    enum class Moved { some, none, failed };
    /// Moves interleaved `frames` after waiting at most 100 ms; returns how many in `done`. Device thread.
    Moved move(float* samples, int frames, int& done) noexcept;
    int xruns() const noexcept { return xruns_; } ///< any thread

private:
    int openAs(const std::string& id);
    std::string configure(int channels, int& rateHz, int& blockFrames);
    int chooseHardware(int channels, unsigned int& rateHz, snd_pcm_uframes_t& periodFrames);
    int chooseSoftware(snd_pcm_uframes_t periodFrames);
    bool hasFloats() const;
    void countGap() noexcept;

    const AlsaLibrary& alsa_;
    const std::string id_;
    const snd_pcm_stream_t direction_;
    snd_pcm_t* pcm_ = nullptr;
    int channels_ = 0, latencyFrames_ = 0;
    snd_pcm_uframes_t bufferFrames_ = 0;
    std::atomic<int> xruns_{0};
    bool isLate_ = false; // since the last block that came in time
};

} // namespace physvib
