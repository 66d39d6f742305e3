// SPDX-License-Identifier: GPL-3.0-or-later
// Posts events at an actuator or anywhere on the field.
#include "Mixer/Desk/DeskStrikes.h"
#include "Core/Samples.h"
#include "Scene/ActuatorFile.h"
#include <cmath>

namespace physvib {

namespace {

constexpr double strikeAmplitude = 0.5; // of pulses and auditions, before strip, ceiling and master

} // namespace

DeskStrikes::DeskStrikes(Session& session, const AudioOutput& output, const Mix& mix, const DeskWorld& world,
                         std::function<void()> onStrike,
                         std::function<void(const Result<std::string>&)> onClip)
    : session_{session}
    , mix_{mix}
    , world_{world}
    , onStrike_{std::move(onStrike)}
    , onClip_{onClip}
    , clips_{session, output, std::move(onClip)} {}

EnchanterPlace DeskStrikes::onField(double shareX, double shareY) const {
    return {shareX * world_.scene().fieldWidthMetres, shareY * world_.scene().fieldHeightMetres};
}

// Place on the field at which only this actuator plays.
EnchanterPlace DeskStrikes::placeOf(int enchanter) const {
    const auto& layout = mix_.layout.geometry;
    const auto& place = layout.places[static_cast<std::size_t>(enchanter)];
    const double wide = mix_.scene->fieldWidthMetres;
    return {place.xMetres / layout.extentWidthMetres * wide,
            place.yMetres / layout.extentHeightMetres * mix_.scene->fieldHeightMetres,
            place.zMetres / layout.extentWidthMetres * wide};
}

bool DeskStrikes::strike(std::vector<CollisionEvent> strikes, const EnchanterPlace& at) {
    for (auto& s : strikes) {
        s.x = at.xMetres;
        s.y = at.yMetres;
        s.z = at.zMetres;
    }
    const bool isStruck{session_.submit({Strikes{strikes}})};
    onStrike_();
    return isStruck;
}

std::string DeskStrikes::audition(int material, double shareX, double shareY) {
    const auto index = static_cast<std::size_t>(material);
    const auto& materials = world_.scene().materials;
    if (index >= materials.size() || materials[index].frequencyHz <= 0.0)
        return "expected a material that sounds";
    const Material& heard = materials[index];
    CollisionEvent hit;
    hit.frequencyHz = heard.frequencyHz;
    hit.decayPerSecond = heard.decayPerSecond;
    hit.amplitude = strikeAmplitude;
    return strike({hit}, onField(shareX, shareY)) ? std::string{} : heard.name + ": cannot be played";
}

void DeskStrikes::testPulse(int enchanter) {
    CollisionEvent pulse;
    const auto profile = findActuator(mix_.layout.enchanters[static_cast<std::size_t>(enchanter)].actuator);
    // resonance of the thesis' actuators
    pulse.frequencyHz = profile && profile.value.resonanceHz ? *profile.value.resonanceHz : 205.0;
    pulse.decayPerSecond = 30.0;
    pulse.amplitude = strikeAmplitude;
    strike({pulse}, placeOf(enchanter));
}

void DeskStrikes::testSweep(int enchanter) {
    std::vector<CollisionEvent> tones;
    constexpr int count = 40;
    for (int k = 0; k < count; ++k) {
        CollisionEvent tone;
        tone.timeNs = k * std::int64_t{60'000'000};
        // 40 to 400 Hz, the main range of vibration perception
        tone.frequencyHz = 40.0 * std::pow(10.0, static_cast<double>(k) / (count - 1));
        tone.durationNs = softEndNs(tone.frequencyHz, 60'000'000);
        tone.amplitude = 0.3;
        tones.push_back(tone);
    }
    strike(std::move(tones), placeOf(enchanter));
}

void DeskStrikes::feelAt(const juce::StringArray& files, double shareX, double shareY) {
    feel(files, onField(shareX, shareY), false);
}

void DeskStrikes::feelOn(const juce::StringArray& files, int enchanter) {
    feel(files, placeOf(enchanter), true);
}

void DeskStrikes::feel(const juce::StringArray& files, const EnchanterPlace& at, bool isAlone) {
    if (files.size() != 1)
        return onClip_(Failure{"Expected one clip, found " + std::to_string(files.size()) + " files"});
    clips_.feel(juce::File{files[0]}, at, isAlone);
}

} // namespace physvib
