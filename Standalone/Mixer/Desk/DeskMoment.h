// SPDX-License-Identifier: GPL-3.0-or-later
// Snapshot of the mixer for display, how it begins, and the choice of its device.
#pragma once
#include "Live/Devices/AudioOutput.h"
#include "Live/Devices/DeviceMeters.h"
#include "Live/Devices/SinkTable.h"
#include "Live/Session/SessionSetup.h"
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

/// Changes since the last look.
struct DeskMoment {
    std::vector<BodyPose> poses;
    std::int64_t sessionNs = 0; ///< of the poses
    std::int64_t aheadNs = 0;   ///< output latency after that time
    std::vector<CollisionEvent> hits;
    ChannelMeters meters;
    std::array<float, limits::maxEnchanters> holds{}; ///< peak hold values
    float masterPeak = 0.0f;                          ///< after the master level
    double dailyExposure = 0.0;                       ///< A(8) of the mixer's output today, m/s^2
    SessionStatus session;
    AudioOutputStatus device;
};

/// How a session begins.
struct DeskStart {
    bool isSilent = false; ///< nothing is felt until the silence is lifted
    bool isPaused = false; ///< the world stands still
};

/// The requested device.
struct DeviceChoice {
    std::string name;     ///< type:name
    int sampleRateHz = 0; ///< 0: device default
    int blockFrames = 0;
    std::vector<SinkName> sinks{};    ///< additional sinks
    std::vector<int> monitor{};       ///< its outputs for left and right ear, from 0; empty: no monitor
    double monitorDb = safeContactDb; ///< as ListeningSettings::contactDb
    int marker = -1;                  ///< its marker output, from 0; -1: none
    bool isHeadphones = false;        ///< its first two outputs, L and R, are the ears, in place of actuators

    static constexpr int ears = 2;
    /// Outputs of listeners and measuring devices, which are not given to actuators.
    std::vector<int> inUse() const {
        std::vector<int> outputs = monitor;
        outputs.push_back(marker);
        return outputs;
    }
    /// As the mixer's strips name an output, from 0.
    std::string nameOf(int output) const {
        if (isHeadphones && output < ears) return output == 0 ? "L" : "R";
        return "out " + std::to_string(output + 1);
    }

    /// Address of the requested sink of that kind; empty: none.
    std::string placeOf(const SinkKind& kind) const {
        for (const SinkName& sink : sinks)
            if (sink.kind == kind.name) return sink.where;
        return {};
    }
    /// Sets the sink of that kind; empty: none.
    void want(const SinkKind& kind, const std::string& where) {
        std::erase_if(sinks, [&](const SinkName& sink) { return sink.kind == kind.name; });
        if (!where.empty()) sinks.push_back({std::string{kind.name}, where});
    }
};

} // namespace physvib
