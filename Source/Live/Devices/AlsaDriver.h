// SPDX-License-Identifier: MIT
// Lists ALSA's devices: those that `aplay -L` lists, by their descriptions.
#pragma once
#include "Live/Devices/AlsaLibrary.h"
#include "Live/Devices/AudioDevice.h"

namespace physvib {

/// "ALSA". A scan opens no device but "default" and "pulse", and these only if ALSA does not list them. A
/// description that several devices have gets a number: "Audio (1)", "Audio (2)".
class AlsaDriver final : public AudioDriver {
public:
    explicit AlsaDriver(const AlsaLibrary& alsa)
        : alsa_{alsa} {}
    std::string name() const override { return "ALSA"; }
    void scan() override;
    std::vector<std::string> deviceNames(bool inputs) override;
    std::unique_ptr<AudioDevice> create(const std::string& name, bool withInputs) override;

private:
    struct Listed {
        std::string id, name;
    };
    using List = std::vector<Listed>;

    void addHint(const void* hint);
    void addUnlisted(const std::string& id, const std::string& name);
    std::string hintText(const void* hint, const char* kind) const;
    static std::string idOf(const List& list, const std::string& name);

    const AlsaLibrary& alsa_;
    List inputs_, outputs_;
};

} // namespace physvib
