// SPDX-License-Identifier: GPL-3.0-or-later
// What a desk tells of a moment, and which device it plays on.
#pragma once
#include "Host/Devices/AudioOutput.h"
#include "Host/Devices/ChannelMeters.h"
#include "Host/Devices/SinkTable.h"
#include "Live/Session/SessionSetup.h"
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

/// What has happened since the last look.
struct DeskMoment {
    std::vector<BodyPose> poses;
    std::int64_t sessionNs = 0; ///< of the poses
    std::int64_t aheadNs = 0;   ///< they are felt so much later
    std::vector<CollisionEvent> hits;
    ChannelMeters meters;
    std::array<float, limits::maxEnchanters> holds{}; ///< highest peaks of the last moments
    float masterPeak = 0.0f;                          ///< behind the master level
    double dailyExposure = 0.0;                       ///< A(8) of all that the mixer has played today, m/s^2
    SessionStatus session;
    AudioOutputStatus device;
};

/// The device that is wanted.
struct DeviceChoice {
    std::string name;     ///< type:name
    int sampleRateHz = 0; ///< 0: as it stands
    int blockFrames = 0;
    std::vector<SinkName> sinks{}; ///< beside it
    std::vector<int> monitor{}; ///< its outputs for the left and the right ear, from 0; empty: nobody listens
    double monitorDb = safeContactDb; ///< as ListeningSettings::contactDb
    int marker = -1;                  ///< its output for marks, from 0; -1: none

    /// Of the wanted one of that kind; empty: none is.
    std::string placeOf(const SinkKind& kind) const {
        for (const SinkName& sink : sinks)
            if (sink.kind == kind.name) return sink.where;
        return {};
    }
    /// From now on that one of that kind; empty: none.
    void want(const SinkKind& kind, const std::string& where) {
        std::erase_if(sinks, [&](const SinkName& sink) { return sink.kind == kind.name; });
        if (!where.empty()) sinks.push_back({std::string{kind.name}, where});
    }
};

} // namespace physvib
