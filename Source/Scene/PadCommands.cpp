// SPDX-License-Identifier: MIT
// Simulates the motor commands of an event list offline, in time order.
#include "Scene/PadCommands.h"
#include "Io/Text/NumberText.h"

namespace physvib {
namespace {

class OfflinePad {
public:
    OfflinePad(const PadLaw& law, const PhantomPanner& panner)
        : motors_{law}
        , grips_{PadMotors::gripsOf(panner)}
        , leadNs_{static_cast<std::int64_t>(1e9 * law.leadSeconds)} {}

    void take(const CollisionEvent& event) {
        runUntil(event.timeNs - leadNs_);
        motors_.strike(event, grips_);
    }
    void take(const RenderControl& control) {
        if (control.panner != nullptr) grips_ = PadMotors::gripsOf(*control.panner);
        if (control.kind != RenderControl::Kind::stopAll) return;
        runUntil(control.timeNs);
        motors_.stop(control.timeNs);
    }
    std::vector<PadCommand> finish(std::int64_t endNs) {
        runUntil(endNs);
        keep({endNs, 0.0, 0.0});
        return std::move(commands_);
    }
    std::uint64_t lost() const { return motors_.lost(); }

private:
    void runUntil(std::int64_t ns) {
        while (motors_.dueNs() < ns) keep(motors_.next(1.0));
    }
    void keep(const PadCommand& command) {
        if (!commands_.back().isSame(command)) commands_.push_back(command);
    }

    PadMotors motors_;
    PhantomPanner grips_;
    std::int64_t leadNs_;
    std::vector<PadCommand> commands_{PadCommand{}};
};

} // namespace

std::vector<PadCommand> padCommands(const PadLaw& law, std::span<const CollisionEvent> events,
                                    std::span<const RenderControl> controls, const PhantomPanner& panner,
                                    std::int64_t endNs, std::uint64_t* lost) {
    OfflinePad pad{law, panner};
    auto control = controls.begin();
    for (const CollisionEvent& event : events) {
        if (event.timeNs >= endNs) break;
        for (; control != controls.end() && control->timeNs <= event.timeNs; ++control) pad.take(*control);
        pad.take(event);
    }
    for (; control != controls.end() && control->timeNs <= endNs; ++control) pad.take(*control);
    auto commands = pad.finish(endNs);
    if (lost) *lost = pad.lost();
    return commands;
}

std::string motorsCsv(const std::vector<PadCommand>& commands, const Provenance& provenance) {
    std::string text = provenanceComment(provenance) + "time_s,low,high\n";
    for (const PadCommand& command : commands)
        text += fixedNumber(static_cast<double>(command.timeNs) * 1e-9, 9) + ',' +
                fixedNumber(command.low, 2) + ',' + fixedNumber(command.high, 2) + '\n';
    return text;
}

} // namespace physvib
