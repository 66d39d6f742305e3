// SPDX-License-Identifier: GPL-3.0-or-later
// Gives an ALSA null device the one thing it lacks, a clock: loaded before the program, it lets each write
// wait until a sound card would have had room for it.
#include <alsa/asoundlib.h>
#include <chrono>
#include <dlfcn.h>
#include <thread>

extern "C" snd_pcm_sframes_t snd_pcm_writei(snd_pcm_t* pcm, const void* samples, snd_pcm_uframes_t frames) {
    using Clock = std::chrono::steady_clock;
    static const auto original =
        reinterpret_cast<decltype(&snd_pcm_writei)>(dlsym(RTLD_NEXT, "snd_pcm_writei"));
    static Clock::time_point due = Clock::now();
    snd_pcm_hw_params_t* parameters = nullptr;
    snd_pcm_hw_params_alloca(&parameters);
    unsigned int rateHz = 0;
    if (snd_pcm_hw_params_current(pcm, parameters) == 0 &&
        snd_pcm_hw_params_get_rate(parameters, &rateHz, nullptr) == 0 && rateHz > 0) {
        due += std::chrono::nanoseconds{1'000'000'000} * frames / rateHz;
        std::this_thread::sleep_until(due);
    }
    return original(pcm, samples, frames);
}
