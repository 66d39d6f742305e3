// SPDX-License-Identifier: MIT
// Loads ALSA's library (LGPL) at run time, when devices are first looked for.
#pragma once
#include <alsa/asoundlib.h>

namespace physvib {

// clang-format off: one list, not a staircase
#define PHYSVIB_ALSA_FUNCTIONS(use)                                                                          \
    use(lib_error_set_handler) use(strerror) use(device_name_hint) use(device_name_get_hint)                 \
        use(device_name_free_hint) use(config_update_ref) use(config_unref) use(config_search) use(          \
            config_search_definition) use(config_get_string) use(config_delete) use(pcm_open) use(pcm_close) \
            use(pcm_hw_params_sizeof) use(pcm_hw_params_any) use(pcm_hw_params_get_channels_min) use(        \
                pcm_hw_params_get_channels_max) use(pcm_hw_params_test_rate) use(pcm_hw_params_test_format)  \
                use(pcm_hw_params_set_access) use(pcm_hw_params_set_format) use(pcm_hw_params_set_rate_near) \
                    use(pcm_hw_params_set_channels) use(pcm_hw_params_set_periods_near)                      \
                        use(pcm_hw_params_set_period_size_near) use(pcm_hw_params)                           \
                            use(pcm_hw_params_get_buffer_size) use(pcm_hw_params_get_period_size)            \
                                use(pcm_hw_params_get_periods) use(pcm_sw_params_sizeof)                     \
                                    use(pcm_sw_params_current) use(pcm_sw_params_get_boundary)               \
                                        use(pcm_sw_params_set_silence_threshold)                             \
                                            use(pcm_sw_params_set_silence_size)                              \
                                                use(pcm_sw_params_set_start_threshold)                       \
                                                    use(pcm_sw_params_set_stop_threshold) use(pcm_sw_params) \
                                                        use(pcm_prepare) use(pcm_start) use(pcm_wait)        \
                                                            use(pcm_avail_update) use(pcm_writei)            \
                                                                use(pcm_readi) use(pcm_recover)
// clang-format on

struct AlsaLibrary {
#define PHYSVIB_ALSA_MEMBER(name) decltype(&::snd_##name) name = nullptr;
    PHYSVIB_ALSA_FUNCTIONS(PHYSVIB_ALSA_MEMBER)
#undef PHYSVIB_ALSA_MEMBER
};

/// Loads ALSA at the first call, for the life of the process, and keeps it from printing. Null: it is missing
/// or too old. Any thread.
const AlsaLibrary* alsaLibrary();

} // namespace physvib
