// SPDX-License-Identifier: MIT
// Lists ALSA's devices: those that `aplay -L` lists, by their descriptions.
#pragma once
#include "Live/Devices/AlsaLibrary.h"
#include "Live/Devices/AudioDevice.h"

namespace physvib {

/// "ALSA". A scan opens no device but "default" and "pulse", and these only if ALSA does not list them. A
/// description that several devices have gets a number: "Audio (1)", "Audio (2)". What ends in JACK is left
/// out: a second client of the server in this process, which outlives it and is used when JACK has freed it.
class AlsaDriver final : public AudioDriver {
public:
    /// `isJackThere`: a JACK server runs. What ends in PulseAudio is then created by its name, but not
    /// listed.
    AlsaDriver(const AlsaLibrary& alsa, bool (*isJackThere)())
        : alsa_{alsa}
        , isJackThere_{isJackThere} {}
    std::string name() const override { return "ALSA"; }
    void scan() override;
    std::vector<std::string> deviceNames(bool inputs) override;
    std::unique_ptr<AudioDevice> create(const std::string& name, bool withInputs) override;

private:
    struct Listed {
        std::string id, name, end; // see endOf()
    };
    using List = std::vector<Listed>;

    void addHint(const void* hint);
    /// The type of the last in a device's chain of plug-ins: "hw", "jack", "pulse"; empty: not known. Opens
    /// no device. A chain may be a circle.
    std::string endOf(const std::string& id, int mostPlugins = 16) const;
    std::string configText(snd_config_t* node) const;
    void addUnlisted(const std::string& id, const std::string& name);
    std::string hintText(const void* hint, const char* kind) const;
    static std::string idOf(const List& list, const std::string& name);

    const AlsaLibrary& alsa_;
    bool (*isJackThere_)();
    List inputs_, outputs_;
};

} // namespace physvib
