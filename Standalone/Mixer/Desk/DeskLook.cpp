// SPDX-License-Identifier: GPL-3.0-or-later
// Collects what was played for display in the window.
#include "Mixer/Desk/Desk.h"

namespace physvib {

DeskMoment Desk::look() {
    const WorldRunner& world = session().world();
    signals_.follow(world.take(),
                    1e-9 * static_cast<double>(world.sceneNs()) - device_.outputLatencySeconds(),
                    world.slowness());
    const float loudest = signals_.read(now_, mix_.count(), isSilent_);
    now_.session = session().status();
    now_.device = output().status();
    exposure_.update();
    now_.dailyExposure = exposure_.daily();
    takePlayed();
    now_.hits.clear();
    now_.hits.swap(hits_);
    recording_.look(now_.device);
    lanes_.look();
    now_.meters.limiterGain = now_.session.render.limiterGain;
    now_.meters.guardGain = now_.device.guardGain;
    now_.meters.enchanters = mix_.count();
    for (std::size_t j = 0; j < static_cast<std::size_t>(mix_.count()); ++j)
        now_.meters.isConnected[j] = mix_.strips[j].output >= 0;
    now_.masterPeak = loudest * masterGain(mix_);
    now_.sessionNs = session().world().readPoses(now_.poses);
    now_.aheadNs = static_cast<std::int64_t>(1e9 * device_.outputLatencySeconds());
    watchOutput();
    if (const auto words = world_.tooMuch(now_.session.sessionNs, now_.sessionNs, now_.poses);
        words.isNotEmpty())
        report(words);
    script_.look();
    if (inputs_.haveCome()) ++edits_; // events from messages are part of the saved session
    return now_;
}

void Desk::takePlayed() {
    rig_.takePlayed([this](const PlayedEvent& played) {
        hits_.push_back(played.event);
        recent_.add(played.event);
        recording_.take(played);
    });
}

} // namespace physvib
