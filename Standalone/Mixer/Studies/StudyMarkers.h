// SPDX-License-Identifier: GPL-3.0-or-later
// Sends study events as markers of the Lab Streaming Layer, to synchronise recordings of EEG, force or gaze.
// liblsl is optional and looked up when a study starts; without it no markers are sent.
#pragma once
#include <juce_core/juce_core.h>
#include <memory>
#include <string>

namespace physvib {

/// One stream: name "physvib-PROTOCOL", type "Markers", one text channel with irregular rate. Message thread
/// only.
class StudyMarkers {
public:
    explicit StudyMarkers(const std::string& protocol);
    ~StudyMarkers();
    StudyMarkers(const StudyMarkers&) = delete;
    StudyMarkers& operator=(const StudyMarkers&) = delete;

    bool isOpen() const noexcept; ///< liblsl was found and the stream was created

    /// Sends a line at a time relative to now (negative: in the past), on LSL's clock.
    void push(const std::string& words, double secondsFromNow = 0.0);

private:
    struct Outlet;
    std::unique_ptr<Outlet> outlet_; // null without liblsl
};

} // namespace physvib
