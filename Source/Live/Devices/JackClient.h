// SPDX-License-Identifier: MIT
// A client of the JACK server, and the names of other clients' ports.
#pragma once
#include "Live/Devices/JackLibrary.h"
#include <string>
#include <vector>

namespace physvib {

/// M: a call waits for the server, and hangs as long as the server does. JACK serves one opening or closing
/// of a process after the other, so several threads may each have a client.
class JackClient {
public:
    /// Never starts a server: without one it is not connected(). JACK appends a number to a name that another
    /// client has.
    JackClient(const JackLibrary& jack, const char* name)
        : jack_{jack}
        , client_{jack.client_open(name, JackNoStartServer, nullptr)} {}
    ~JackClient() {
        if (client_ != nullptr) jack_.client_close(client_);
    }
    JackClient(const JackClient&) = delete;
    JackClient& operator=(const JackClient&) = delete;

    bool connected() const noexcept { return client_ != nullptr; }
    jack_client_t* get() const noexcept { return client_; }

    /// Full names ("system:playback_1") of the audio ports that take samples (JackPortIsInput) or give them
    /// (JackPortIsOutput), in the server's order.
    std::vector<std::string> ports(JackPortFlags direction) const {
        std::vector<std::string> names;
        const char** const all = jack_.get_ports(client_, nullptr, JACK_DEFAULT_AUDIO_TYPE, direction);
        for (const char** name = all; name != nullptr && *name != nullptr; ++name) names.emplace_back(*name);
        if (all != nullptr) jack_.free(static_cast<void*>(all));
        return names;
    }

    /// Of those, the ones of one client.
    std::vector<std::string> portsOf(const std::string& owner, JackPortFlags direction) const {
        std::vector<std::string> names = ports(direction);
        std::erase_if(names, [&](const std::string& name) { return !name.starts_with(owner + ":"); });
        return names;
    }

private:
    const JackLibrary& jack_;
    jack_client_t* client_;
};

} // namespace physvib
