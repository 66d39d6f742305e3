// SPDX-License-Identifier: MIT
// Opens and closes clients of JACK, one at a time in the process, as JACK's library does itself.
#include "Live/Devices/JackClient.h"
#include <atomic>
#include <chrono>
#include <cstdint>
#include <utility>

namespace physvib {
namespace {

std::shared_timed_mutex openingJack;
std::atomic<unsigned int> serversLost{0};

std::vector<std::shared_ptr<void>>& keptForJack() {
    static std::vector<std::shared_ptr<void>> kept;
    return kept;
}

// The server's number comes by value, because the client's object may have gone. The first of its clients
// counts the loss for all.
void onJackShutdown(void* server) {
    auto lost = static_cast<unsigned int>(reinterpret_cast<std::uintptr_t>(server));
    serversLost.compare_exchange_strong(lost, lost + 1);
}

} // namespace

JackClient::JackClient(const JackLibrary& jack, const char* name)
    : jack_{jack} {
    std::vector<std::shared_ptr<void>> freed;
    const std::lock_guard lock{openingJack};
    jack_status_t status{};
    client_ = jack_.client_open(name, JackNoStartServer, &status);
    // The server may have gone this very moment: opening may then have freed clients whose loss JACK had no
    // time to report.
    if (client_ == nullptr && (status & JackServerFailed) != 0) ++serversLost;
    if (client_ == nullptr) return;
    server_ = serversLost;
    const std::uintptr_t number = server_;
    jack_.on_shutdown(client_, onJackShutdown, reinterpret_cast<void*>(number));
    freed.swap(keptForJack()); // opening freed their clients
}

JackClient::~JackClient() {
    if (const auto held = hold()) jack_.client_close(client_);
}

bool JackClient::isAlive() const noexcept { return client_ != nullptr && serversLost == server_; }

JackClient::Held JackClient::hold() const {
    if (!isAlive()) return {};
    Held held{openingJack};
    return isAlive() ? std::move(held) : Held{};
}

JackClient::Held JackClient::holdSoon() const {
    if (!isAlive()) return {};
    Held held{openingJack, std::chrono::milliseconds{50}};
    return held && isAlive() ? std::move(held) : Held{};
}

void JackClient::keepUntilFreed(std::shared_ptr<void> callbacks) {
    const std::lock_guard lock{openingJack};
    keptForJack().push_back(std::move(callbacks));
}

std::vector<std::string> JackClient::ports(JackPortFlags direction) const {
    std::vector<std::string> names;
    const char** const all = jack_.get_ports(client_, nullptr, JACK_DEFAULT_AUDIO_TYPE, direction);
    for (const char** name = all; name != nullptr && *name != nullptr; ++name) names.emplace_back(*name);
    if (all != nullptr) jack_.free(static_cast<void*>(all));
    return names;
}

std::vector<std::string> JackClient::portsOf(const std::string& owner, JackPortFlags direction) const {
    std::vector<std::string> names = ports(direction);
    std::erase_if(names, [&](const std::string& name) { return !name.starts_with(owner + ":"); });
    return names;
}

} // namespace physvib
