// SPDX-License-Identifier: MIT
// Sets up an ALSA device, and moves samples.
#include "Live/Devices/AlsaDevice.h"
#include "Live/Pads/SharedLibrary.h"
#include <algorithm>

namespace physvib {
namespace {

constexpr unsigned int usualRatesHz[] = {44100, 48000, 88200, 96000, 176400, 192000,
                                         32000, 22050, 16000, 11025, 8000};
constexpr unsigned int mostChannels = 256; // mixing devices claim 10,000
constexpr int longestWaitMs = 100;

// ALSA tells the size of its structures at run time only.
struct HardwareParameters {
    explicit HardwareParameters(const AlsaLibrary& alsa)
        : bytes(alsa.pcm_hw_params_sizeof()) {}
    snd_pcm_hw_params_t* get() { return reinterpret_cast<snd_pcm_hw_params_t*>(bytes.data()); }
    std::vector<char> bytes;
};

} // namespace

int AlsaPcm::openAs(const std::string& id) {
    close();
    return alsa_.pcm_open(&pcm_, id.c_str(), direction_, SND_PCM_NONBLOCK);
}

void AlsaPcm::close() {
    if (pcm_ != nullptr) alsa_.pcm_close(pcm_);
    pcm_ = nullptr;
}

AlsaRange AlsaPcm::range() const {
    AlsaPcm other{alsa_, id_, direction_};
    HardwareParameters parameters{alsa_};
    unsigned int least = 0, most = 0;
    if (const int fault = other.openAs(id_); fault < 0)
        return {.isMissing = fault != -EBUSY && fault != -EAGAIN && fault != -EACCES && fault != -EPERM};
    if (alsa_.pcm_hw_params_any(other.pcm_, parameters.get()) < 0 ||
        alsa_.pcm_hw_params_get_channels_min(parameters.get(), &least) < 0 ||
        alsa_.pcm_hw_params_get_channels_max(parameters.get(), &most) < 0)
        return {};
    most = std::min(most, mostChannels);
    const auto* rate = std::ranges::find_if(usualRatesHz, [&](unsigned int hz) {
        return alsa_.pcm_hw_params_test_rate(other.pcm_, parameters.get(), hz, 0) == 0;
    });
    return {static_cast<int>(std::min(least, most)), static_cast<int>(most), false,
            rate != std::end(usualRatesHz) ? static_cast<int>(*rate) : 0};
}

bool AlsaPcm::hasFloats() const {
    HardwareParameters parameters{alsa_};
    return alsa_.pcm_hw_params_any(pcm_, parameters.get()) >= 0 &&
           alsa_.pcm_hw_params_test_format(pcm_, parameters.get(), SND_PCM_FORMAT_FLOAT) == 0;
}

std::string AlsaPcm::open(int channels, int& rateHz, int& blockFrames) {
    int fault = openAs(id_);
    if (fault >= 0 && !hasFloats()) fault = openAs("plug:'" + id_ + "'");
    if (fault == -EBUSY) return "is busy: another program has it open";
    if (fault < 0) return alsa_.strerror(fault);
    std::string error = configure(channels, rateHz, blockFrames);
    if (!error.empty()) close();
    return error;
}

std::string AlsaPcm::configure(int channels, int& rateHz, int& blockFrames) {
    auto rate = static_cast<unsigned int>(rateHz);
    auto period = static_cast<snd_pcm_uframes_t>(blockFrames);
    int fault = chooseHardware(channels, rate, period);
    if (fault >= 0) fault = chooseSoftware(period);
    if (fault >= 0) fault = alsa_.pcm_prepare(pcm_);
    if (fault < 0) return alsa_.strerror(fault);
    channels_ = channels;
    rateHz = static_cast<int>(rate);
    blockFrames = static_cast<int>(period);
    return {};
}

int AlsaPcm::chooseHardware(int channels, unsigned int& rateHz, snd_pcm_uframes_t& periodFrames) {
    HardwareParameters parameters{alsa_};
    auto* const p = parameters.get();
    unsigned int periods = 4;
    int direction = 0;
    for (const int fault :
         {alsa_.pcm_hw_params_any(pcm_, p),
          alsa_.pcm_hw_params_set_access(pcm_, p, SND_PCM_ACCESS_RW_INTERLEAVED),
          alsa_.pcm_hw_params_set_format(pcm_, p, SND_PCM_FORMAT_FLOAT),
          alsa_.pcm_hw_params_set_rate_near(pcm_, p, &rateHz, nullptr),
          alsa_.pcm_hw_params_set_channels(pcm_, p, static_cast<unsigned int>(channels)),
          alsa_.pcm_hw_params_set_periods_near(pcm_, p, &periods, &direction),
          alsa_.pcm_hw_params_set_period_size_near(pcm_, p, &periodFrames, &direction),
          alsa_.pcm_hw_params(pcm_, p), alsa_.pcm_hw_params_get_buffer_size(p, &bufferFrames_),
          alsa_.pcm_hw_params_get_period_size(p, &periodFrames, &direction),
          alsa_.pcm_hw_params_get_periods(p, &periods, &direction)})
        if (fault < 0) return fault;
    latencyFrames_ = static_cast<int>(periodFrames) * (static_cast<int>(periods) - 1); // as JACK estimates it
    return 0;
}

// Playing begins with the first block. After a gap the device goes on by itself, with silence.
int AlsaPcm::chooseSoftware(snd_pcm_uframes_t periodFrames) {
    std::vector<char> bytes(alsa_.pcm_sw_params_sizeof());
    auto* const p = reinterpret_cast<snd_pcm_sw_params_t*>(bytes.data());
    snd_pcm_uframes_t boundary = 0;
    for (const int fault :
         {alsa_.pcm_sw_params_current(pcm_, p), alsa_.pcm_sw_params_get_boundary(p, &boundary),
          alsa_.pcm_sw_params_set_silence_threshold(pcm_, p, 0),
          alsa_.pcm_sw_params_set_silence_size(pcm_, p, boundary),
          alsa_.pcm_sw_params_set_start_threshold(pcm_, p, periodFrames),
          alsa_.pcm_sw_params_set_stop_threshold(pcm_, p, boundary), alsa_.pcm_sw_params(pcm_, p)})
        if (fault < 0) return fault;
    return 0;
}

void AlsaPcm::begin() {
    if (direction_ == SND_PCM_STREAM_CAPTURE) alsa_.pcm_start(pcm_);
}

// A device that plays on through gaps does not report them: more room than its buffer has means one.
void AlsaPcm::countGap() noexcept {
    const auto room = alsa_.pcm_avail_update(pcm_);
    const bool isLate = room > 0 && static_cast<snd_pcm_uframes_t>(room) > bufferFrames_;
    if (isLate && !isLate_) ++xruns_;
    isLate_ = isLate;
}

AlsaPcm::Moved AlsaPcm::move(float* samples, int frames, int& done) noexcept {
    done = 0;
    if (alsa_.pcm_wait(pcm_, longestWaitMs) == 0) return Moved::none;
    countGap();
    const auto count = static_cast<snd_pcm_uframes_t>(frames);
    const auto moved = direction_ == SND_PCM_STREAM_PLAYBACK ? alsa_.pcm_writei(pcm_, samples, count)
                                                             : alsa_.pcm_readi(pcm_, samples, count);
    if (moved == -EAGAIN) return Moved::none;
    if (moved >= 0) return done = static_cast<int>(moved), Moved::some;
    if (moved == -EPIPE) ++xruns_;
    if (alsa_.pcm_recover(pcm_, static_cast<int>(moved), 1) < 0) return Moved::failed;
    begin();
    return Moved::none;
}

// Loads all of ALSA's functions, or none.

namespace {

struct LoadedAlsa {
    AlsaLibrary alsa;
    bool isWhole = true;
};

void ignoreAlsaMessage(const char*, int, const char*, int, const char*, ...) {}

// What is loaded with the program comes first: a test replaces the clock of a device that way.
void* alsaFunction(void* library, const char* name) {
    void* const loadedBefore = functionIn(nullptr, name);
    return loadedBefore != nullptr ? loadedBefore : functionIn(library, name);
}

LoadedAlsa loadAlsa() {
    LoadedAlsa loaded;
    void* const library = openLibrary("libasound.so.2");
    if (library == nullptr) return {{}, false};
#define PHYSVIB_ALSA_FIND(name)                                                                              \
    loaded.alsa.name = reinterpret_cast<decltype(loaded.alsa.name)>(alsaFunction(library, "snd_" #name));    \
    loaded.isWhole = loaded.isWhole && loaded.alsa.name != nullptr;
    PHYSVIB_ALSA_FUNCTIONS(PHYSVIB_ALSA_FIND)
#undef PHYSVIB_ALSA_FIND
    // A machine without a sound card would get sixty lines on stderr for one look at its devices.
    if (loaded.isWhole) loaded.alsa.lib_error_set_handler(ignoreAlsaMessage);
    return loaded;
}

} // namespace

const AlsaLibrary* alsaLibrary() {
    static const LoadedAlsa loaded = loadAlsa();
    return loaded.isWhole ? &loaded.alsa : nullptr;
}

} // namespace physvib
