// SPDX-License-Identifier: GPL-3.0-or-later
// The commands `physvib scenes`, `actuators` and `devices`, which print one line per entry.
#include "CommandLine/Command.h"
#include "CommandLine/DeviceList.h"
#include "Io/Text/NumberText.h"
#include "Live/Session/BoardLink.h"
#include "Scene/ActuatorFile.h"
#include "Scene/SceneFile.h"

namespace physvib {
namespace {

int listScenes() {
    for (const Scene& scene : builtInScenes()) {
        std::cout << scene.name << "  " << scene.description;
        for (const SceneVariable& variable : scene.variables) {
            std::cout << "  --set " << variable.name << '=';
            for (const std::string& choice : variable.choices)
                std::cout << (&choice == &variable.choices.front() ? "" : "|") << choice;
        }
        std::cout << '\n';
    }
    return exitDone;
}

int listActuators() {
    const auto textOrEmpty = [](const std::optional<double>& value) {
        return value ? numberText(*value) : std::string{};
    };
    std::string text =
        "actuator,resonance_hz,q,band_low_hz,band_high_hz,drive_limit_v,rise_time_s,full_scale_g,source\n";
    for (const ActuatorProfile& p : builtInActuators()) {
        text += p.name + ',' + textOrEmpty(p.resonanceHz) + ',' + textOrEmpty(p.q) + ',' +
                (p.band ? numberText(p.band->lowHz) + ',' + numberText(p.band->highHz) : ",") + ',';
        text += textOrEmpty(p.driveLimitVolts) + ',' + textOrEmpty(p.riseSeconds) + ',' +
                textOrEmpty(p.fullScaleG) + ",\"" + p.source + "\"\n";
    }
    std::cout << text;
    return exitDone;
}

int listDevices() {
    printDevices(std::cout, availableDevices());
    for (const auto& port : listSerialPorts()) std::cout << port.path << "  " << port.description << '\n';
    return exitDone;
}

Command listOf(const char* name, const char* description, int (*list)()) {
    return {name, description, [list](OptionTable&) { return list; }};
}

} // namespace

Command scenesCommand() { return listOf("scenes", "list the built-in scenes", listScenes); }
Command actuatorsCommand() {
    return listOf("actuators", "list the built-in actuator profiles; what is not known is empty",
                  listActuators);
}
Command devicesCommand() { return listOf("devices", "list the audio devices and serial ports", listDevices); }

} // namespace physvib
