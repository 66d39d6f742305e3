// SPDX-License-Identifier: MIT
// Loads JACK's client library (LGPL) at run time, when devices are first looked for.
#pragma once
#include <jack/jack.h>

namespace physvib {

#define PHYSVIB_JACK_FUNCTIONS(use)                                                                          \
    use(client_open) use(client_close) use(activate) use(deactivate) use(set_process_callback)               \
        use(set_xrun_callback) use(on_shutdown) use(set_error_function) use(set_info_function)               \
            use(get_sample_rate) use(get_buffer_size) use(get_ports) use(free) use(connect)                  \
                use(port_register) use(port_get_buffer) use(port_name) use(port_connected)                   \
                    use(port_get_connections) use(port_by_name) use(port_get_latency_range)

struct JackLibrary {
#define PHYSVIB_JACK_MEMBER(name) decltype(&::jack_##name) name = nullptr;
    PHYSVIB_JACK_FUNCTIONS(PHYSVIB_JACK_MEMBER)
#undef PHYSVIB_JACK_MEMBER
};

/// Loads JACK at the first call, for the life of the process, and keeps it from printing. Null: it is missing
/// or too old. Any thread.
const JackLibrary* jackLibrary();

} // namespace physvib
