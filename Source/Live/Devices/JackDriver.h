// SPDX-License-Identifier: MIT
// Lists the clients of the JACK server as devices.
#pragma once
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/JackLibrary.h"

namespace physvib {

/// "JACK". A scan sees the server that runs then, whichever ran before.
class JackDriver final : public AudioDriver {
public:
    explicit JackDriver(const JackLibrary& jack)
        : jack_{jack} {}
    std::string name() const override { return "JACK"; }
    void scan() override;
    std::vector<std::string> deviceNames(bool inputs) override { return inputs ? inputs_ : outputs_; }
    std::unique_ptr<AudioDevice> create(const std::string& name, bool withInputs) override;

private:
    const JackLibrary& jack_;
    std::vector<std::string> inputs_, outputs_;
};

} // namespace physvib
