// SPDX-License-Identifier: GPL-3.0-or-later
// What happens in a study as markers of the Lab Streaming Layer, for whoever records EEG, force or gaze
// beside it. liblsl is looked for when a study begins and never needed: without it there are no markers, and
// everything else is as it is.
#pragma once
#include <juce_core/juce_core.h>
#include <memory>
#include <string>

namespace physvib {

/// One stream: name "physvib-PROTOCOL", type "Markers", one channel of text at no fixed rate. M only.
class StudyMarkers {
public:
    explicit StudyMarkers(const std::string& protocol);
    ~StudyMarkers();
    StudyMarkers(const StudyMarkers&) = delete;
    StudyMarkers& operator=(const StudyMarkers&) = delete;

    bool isOpen() const noexcept; ///< liblsl is there and has made the stream

    /// A line, at the time so far from now (below 0: it was), by LSL's clock.
    void push(const std::string& words, double secondsFromNow = 0.0);

private:
    struct Outlet;
    std::unique_ptr<Outlet> outlet_; // none: no liblsl
};

} // namespace physvib
