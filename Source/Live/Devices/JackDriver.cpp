// SPDX-License-Identifier: MIT
// Lists JACK's clients by their ports.
#include "Live/Devices/JackDriver.h"
#include "Live/Devices/JackDevice.h"
#include <algorithm>

namespace physvib {
namespace {

// "physvib", or "physvib-01" and so on: another device of this program, or another run of it.
bool isOurs(const std::string& client) {
    return client == "physvib" ||
           (client.starts_with("physvib-") && client.find_first_not_of("0123456789", 8) == std::string::npos);
}

std::vector<std::string> ownersOf(const std::vector<std::string>& ports) {
    std::vector<std::string> owners;
    for (const std::string& port : ports) {
        const std::string owner = port.substr(0, port.find(':'));
        if (!isOurs(owner) && std::ranges::find(owners, owner) == owners.end()) owners.push_back(owner);
    }
    return owners;
}

} // namespace

void JackDriver::scan() {
    inputs_.clear();
    outputs_.clear();
    const JackClient client{jack_, "physvib-scan"};
    const auto held = client.hold();
    if (!held) return;
    inputs_ = ownersOf(client.ports(JackPortIsOutput)); // what gives samples is an input here
    outputs_ = ownersOf(client.ports(JackPortIsInput));
}

std::unique_ptr<AudioDevice> JackDriver::create(const std::string& name, bool withInputs) {
    if (std::ranges::find(outputs_, name) == outputs_.end()) return nullptr;
    return std::make_unique<JackDevice>(jack_, name, withInputs);
}

} // namespace physvib
