// SPDX-License-Identifier: MIT
// A client of the JACK server that may go away, and the names of other clients' ports.
#pragma once
#include "Live/Devices/JackLibrary.h"
#include <memory>
#include <string>
#include <vector>

namespace physvib {

/// M: opening and closing wait for the server, and hang as long as it does.
///
/// When a server has gone, JACK's library frees all clients of the process as soon as any of them is opened
/// anew. So a client that has lost its server is neither closed nor used any more.
class JackClient {
public:
    /// Never starts a server. JACK appends a number to a name that another client has.
    JackClient(const JackLibrary& jack, const char* name);
    ~JackClient();
    JackClient(const JackClient&) = delete;
    JackClient& operator=(const JackClient&) = delete;

    /// Whether it has a server. Any thread.
    bool isAlive() const noexcept;
    jack_client_t* get() const noexcept { return client_; }

    /// Full names ("system:playback_1") of the audio ports that take samples (JackPortIsInput) or give them
    /// (JackPortIsOutput), in the server's order. Only while it is alive.
    std::vector<std::string> ports(JackPortFlags direction) const;

    /// Of those, the ones of one client.
    std::vector<std::string> portsOf(const std::string& owner, JackPortFlags direction) const;

    /// Keeps what JACK may still call for a client that has lost its server, until JACK has freed that
    /// client.
    static void keepUntilFreed(std::shared_ptr<void> callbacks);

private:
    const JackLibrary& jack_;
    jack_client_t* client_ = nullptr;
    unsigned int server_ = 0; // which of the servers that the process has seen, from 0
};

} // namespace physvib
