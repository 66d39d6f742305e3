// SPDX-License-Identifier: GPL-3.0-or-later
// Looks up actuator profiles and derives equalisation, voltage scales and the frequency remapping.
#include "Calls/LoadedRender.h"
#include "Core/Units.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Coupling.h"
#include "Scene/ActuatorFile.h"
#include <algorithm>
#include <cmath>
#include <set>

namespace physvib {
namespace {

/// Just noticeable relative difference of vibration frequency (Pongrac 2008; other studies found 20 to 30 %).
constexpr double frequencyJnd = 0.18;

/// One profile per actuator; empty with --actuator none.
Result<std::vector<ActuatorProfile>> profilesOf(const RenderJob& o, const LayoutDescription& layout) {
    std::vector<ActuatorProfile> profiles;
    if (o.actuator == "none") return profiles;
    for (const EnchanterDescription& enchanter : layout.enchanters) {
        const bool isNamedThere = o.actuator == "layout";
        const std::string& name = isNamedThere ? enchanter.actuator : o.actuator;
        auto profile = name == "none" ? Result<ActuatorProfile>{ActuatorProfile{}} : findActuator(name);
        if (!profile)
            return Failure{(isNamedThere ? o.layout + ": actuator " + enchanter.label : "--actuator") + ": " +
                           profile.error};
        profiles.push_back(std::move(profile.value));
    }
    return profiles;
}

std::string hertz(double frequencyHz) { return fixedNumber(frequencyHz, 0) + " Hz"; }

/// Frequency band that all actuators have in common.
Result<FrequencyBand> commonBand(const std::vector<ActuatorProfile>& profiles) {
    FrequencyBand common;
    for (const ActuatorProfile& p : profiles) {
        if (p.name.empty()) continue; // no actuator at this place
        if (!p.band) return Failure{p.name + ": band_hz is not known: nothing to remap into"};
        common = common.isKnown() ? FrequencyBand{std::max(common.lowHz, p.band->lowHz),
                                                  std::min(common.highHz, p.band->highHz)}
                                  : *p.band;
        if (!common.isKnown()) return Failure{"--remap: the layout's actuators have no band in common"};
    }
    return common;
}

/// Scales the output so that a sample of 1 drives the actuator at its voltage limit, on an interface with
/// `interfaceVolts` at full scale. Returns an error or an empty string.
std::string scaleVoltages(const std::vector<ActuatorProfile>& profiles, double interfaceVolts,
                          ActuatorChoice& choice) {
    for (std::size_t j = 0; j < profiles.size(); ++j) {
        const ActuatorProfile& p = profiles[j];
        if (!p.driveLimitVolts)
            return (p.name.empty() ? "a place without an actuator profile" : p.name) +
                   ": drive_limit_v is not known: no voltage to scale to";
        if (*p.driveLimitVolts > interfaceVolts)
            return p.name + ": expected an interface of at least " + numberText(*p.driveLimitVolts) +
                   " V, found --interface-volts " + numberText(interfaceVolts);
        choice.voltageScale[j] = *p.driveLimitVolts / interfaceVolts;
    }
    return {};
}

/// True if two values are equal within the rounding of files.
bool isAlmost(double g, double other) { return std::abs(g - other) <= 0.005 * std::max(g, other); }

} // namespace

Result<LayoutDescription> calibratedLayout(const RenderJob& o, LayoutDescription layout) {
    if (o.actuator == "none" || o.actuator == "layout") return layout;
    const auto profile = findActuator(o.actuator);
    if (!profile) return Failure{"--actuator: " + profile.error};
    if (!profile.value.fullScaleG) return layout;
    for (EnchanterDescription& enchanter : layout.enchanters)
        enchanter.fullScaleG = *profile.value.fullScaleG;
    return layout;
}

std::vector<std::string> calibrationWarnings(const RenderJob& o, const LayoutDescription& layout) {
    std::vector<std::string> warnings;
    if (o.actuator != "layout") return warnings;
    const auto profiles = profilesOf(o, layout);
    for (std::size_t j = 0; j < profiles.value.size(); ++j) {
        const auto& measured = profiles.value[j].fullScaleG;
        const EnchanterDescription& enchanter = layout.enchanters[j];
        if (measured && !isAlmost(*measured, enchanter.fullScaleG))
            warnings.push_back(o.layout + ": actuator " + enchanter.label +
                               ": levels are printed with full_scale_g " + numberText(enchanter.fullScaleG) +
                               " of the layout; " + enchanter.actuator + " was measured as " +
                               numberText(*measured));
    }
    return warnings;
}

Result<ActuatorChoice> chooseActuators(const RenderJob& o, const LayoutDescription& layout) {
    auto profiles = profilesOf(o, layout);
    if (!profiles) return Failure{profiles.error};
    ActuatorChoice choice;
    for (std::size_t j = 0; j < profiles.value.size() && o.isEqualised; ++j) {
        const ActuatorProfile& p = profiles.value[j];
        if (p.name.empty()) continue;
        if (const std::string fault = equaliserFault(p); !fault.empty())
            return Failure{"--actuator " + o.actuator + ": " + p.name + ": " + fault};
        choice.equalised[j] = {p.resonator(), *p.band};
        if (p.band->highHz >= 0.5 * o.sampleRateHz)
            return Failure{"--actuator " + o.actuator + ": " + p.name +
                           ": expected a band below half of the sample rate"};
    }
    if (o.interfaceVolts > 0.0)
        if (auto fault = scaleVoltages(profiles.value, o.interfaceVolts, choice); !fault.empty())
            return Failure{fault};
    if (!o.isRemapped) return choice;
    const auto band = commonBand(profiles.value);
    if (!band) return Failure{band.error};
    choice.remap.band = band.value;
    return choice;
}

std::vector<std::string> levelNotes(const ActuatorChoice& choice, int sampleRateHz) {
    std::vector<std::string> notes;
    for (auto at = choice.equalised.begin(); at != choice.equalised.end(); ++at) {
        if (!at->isKnown() || std::find(choice.equalised.begin(), at, *at) != at) continue;
        const double level = ActuatorEqualiser{*at, sampleRateHz}.flatLevel();
        notes.push_back("equalised from " + hertz(at->band.lowHz) + " to " + hertz(at->band.highHz) +
                        ": flat up to " + fixedNumber(toDecibels(level), 1) + " dB of the level at " +
                        hertz(at->resonator.resonanceHz) + "; above it the limiter holds the drive");
    }
    return notes;
}

std::vector<std::string> remapWarnings(const FrequencyRemap& remap, std::span<const CollisionEvent> before,
                                       const LayoutDescription& layout, const RenderJob& o) {
    std::vector<std::string> warnings;
    if (!remap.band.isKnown()) return warnings;
    std::set<double> frequencies, decays;
    for (const CollisionEvent& e : before) frequencies.insert(e.frequencyHz), decays.insert(e.decayPerSecond);
    for (auto low = frequencies.begin(), high = low; high != frequencies.end(); low = high) {
        if (++high == frequencies.end()) break;
        const double ratio = remap(*high) / remap(*low);
        if (ratio < 1.0 + frequencyJnd)
            warnings.push_back("--remap: " + hertz(*low) + " and " + hertz(*high) + " end at " +
                               hertz(remap(*low)) + " and " + hertz(remap(*high)) +
                               ", nearer than one JND of " + fixedNumber(100.0 * frequencyJnd, 0) +
                               " % (Pongrac 2008)");
    }
    const auto profiles = profilesOf(o, layout);
    for (std::size_t j = 0; !o.isEqualised && profiles && j < profiles.value.size(); ++j) {
        const Resonator r = profiles.value[j].resonator();
        if (!r.isKnown() || decays.empty() || *decays.rbegin() <= r.ringDownPerSecond()) continue;
        warnings.push_back("--remap: " + profiles.value[j].name + " rings down with " +
                           fixedNumber(r.ringDownPerSecond(), 1) + " /s; a decay of up to " +
                           fixedNumber(*decays.rbegin(), 1) + " /s is felt as that");
        break;
    }
    return warnings;
}

namespace {

std::string percent(double share) { return fixedNumber(100.0 * share, 1) + " %"; }

std::string noteOf(const MeasuredCoupling& measured) {
    const CouplingResidual r = residualOf(measured);
    return "coupling: what is felt differs from what is wanted by " + percent(r.compensated) +
           ", without compensation by " + percent(r.plain) + "; by " + percent(r.mismatchedCompensated) +
           " and " + percent(r.mismatchedPlain) +
           " where it is off by up to 2 dB and 20 degrees; strongest drive " +
           fixedNumber(toDecibels(r.strongestDrive), 1) + " dB";
}

} // namespace

Result<CouplingChoice> chooseCoupling(const std::string& path, const LayoutDescription& layout) {
    const auto measured = loadCoupling(path);
    if (!measured) return Failure{measured.error};
    if (const std::size_t found = measured.value.enchanters(), wanted = layout.enchanters.size();
        found != wanted)
        return Failure{path + ": expected as many actuators as the layout has, " + std::to_string(wanted) +
                       ", found " + std::to_string(found)};
    return CouplingChoice{CouplingDrives{measured.value}, noteOf(measured.value)};
}

} // namespace physvib
