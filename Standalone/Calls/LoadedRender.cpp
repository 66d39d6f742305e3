// SPDX-License-Identifier: GPL-3.0-or-later
// Looks up actuator profiles, and derives equalisation, voltage scales, frequency remapping and compensation
// of coupling from them, with notes and warnings.
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

/// One profile per actuator of the layout; none with --actuator none.
Result<std::vector<ActuatorProfile>> findProfiles(const RenderJob& o, const LayoutDescription& layout) {
    std::vector<ActuatorProfile> profiles;
    if (o.actuator == "none") return profiles;
    for (const ActuatorDescription& actuator : layout.actuators) {
        const bool isNamedByLayout = o.actuator == "layout";
        const std::string& name = isNamedByLayout ? actuator.actuator : o.actuator;
        auto profile = name == "none" ? Result<ActuatorProfile>{ActuatorProfile{}} : findActuator(name);
        if (!profile)
            return Failure{(isNamedByLayout ? o.layout + ": actuator " + actuator.label : "--actuator") +
                           ": " + profile.error};
        profiles.push_back(std::move(profile.value));
    }
    return profiles;
}

std::string hertzText(double frequencyHz) { return fixedNumber(frequencyHz, 0) + " Hz"; }

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
bool isNearlyEqual(double g, double other) { return std::abs(g - other) <= 0.005 * std::max(g, other); }

} // namespace

Result<LayoutDescription> calibratedLayout(const RenderJob& o, LayoutDescription layout) {
    if (o.actuator == "none" || o.actuator == "layout") return layout;
    const auto profile = findActuator(o.actuator);
    if (!profile) return Failure{"--actuator: " + profile.error};
    if (!profile.value.fullScaleG) return layout;
    for (ActuatorDescription& actuator : layout.actuators) actuator.fullScaleG = *profile.value.fullScaleG;
    return layout;
}

std::vector<std::string> calibrationWarnings(const RenderJob& o, const LayoutDescription& layout) {
    std::vector<std::string> warnings;
    if (o.actuator != "layout") return warnings;
    const auto profiles = findProfiles(o, layout);
    for (std::size_t j = 0; j < profiles.value.size(); ++j) {
        const auto& measured = profiles.value[j].fullScaleG;
        const ActuatorDescription& actuator = layout.actuators[j];
        if (measured && !isNearlyEqual(*measured, actuator.fullScaleG))
            warnings.push_back(o.layout + ": actuator " + actuator.label +
                               ": levels are printed with full_scale_g " + numberText(actuator.fullScaleG) +
                               " of the layout; " + actuator.actuator + " was measured as " +
                               numberText(*measured));
    }
    return warnings;
}

Result<ActuatorChoice> chooseActuators(const RenderJob& o, const LayoutDescription& layout) {
    auto profiles = findProfiles(o, layout);
    if (!profiles) return Failure{profiles.error};
    ActuatorChoice choice;
    for (std::size_t j = 0; j < profiles.value.size() && o.isEqualised; ++j) {
        const ActuatorProfile& p = profiles.value[j];
        if (p.name.empty()) continue;
        if (const std::string error = equaliserError(p); !error.empty())
            return Failure{"--actuator " + o.actuator + ": " + p.name + ": " + error};
        choice.equalised[j] = {p.resonator(), *p.band};
        if (p.band->highHz >= 0.5 * o.sampleRateHz)
            return Failure{"--actuator " + o.actuator + ": " + p.name +
                           ": expected a band below half of the sample rate"};
    }
    if (o.interfaceVolts > 0.0)
        if (auto error = scaleVoltages(profiles.value, o.interfaceVolts, choice); !error.empty())
            return Failure{error};
    if (!o.isRemapped) return choice;
    const auto band = commonBand(profiles.value);
    if (!band) return Failure{band.error};
    choice.remap.band = band.value;
    return choice;
}

std::vector<std::string> levelNotes(const ActuatorChoice& choice, int sampleRateHz) {
    std::vector<std::string> notes;
    for (auto entry = choice.equalised.begin(); entry != choice.equalised.end(); ++entry) {
        if (!entry->isKnown() || std::find(choice.equalised.begin(), entry, *entry) != entry) continue;
        const double level = ActuatorEqualiser{*entry, sampleRateHz}.flatLevel();
        notes.push_back("equalised from " + hertzText(entry->band.lowHz) + " to " +
                        hertzText(entry->band.highHz) + ": flat up to " + fixedNumber(toDecibels(level), 1) +
                        " dB of the level at " + hertzText(entry->resonator.resonanceHz) +
                        "; above it the limiter holds the drive");
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
            warnings.push_back("--remap: " + hertzText(*low) + " and " + hertzText(*high) + " end at " +
                               hertzText(remap(*low)) + " and " + hertzText(remap(*high)) +
                               ", nearer than one JND of " + fixedNumber(100.0 * frequencyJnd, 0) +
                               " % (Pongrac 2008)");
    }
    const auto profiles = findProfiles(o, layout);
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

std::string percentText(double share) { return fixedNumber(100.0 * share, 1) + " %"; }

std::string couplingNote(const MeasuredCoupling& measured) {
    const CouplingResidual r = couplingResidual(measured);
    return "coupling: what is felt differs from what is wanted by " + percentText(r.compensated) +
           ", without compensation by " + percentText(r.uncompensated) + "; by " +
           percentText(r.mismatchedCompensated) + " and " + percentText(r.mismatchedUncompensated) +
           " where it is off by up to 2 dB and 20 degrees; strongest drive " +
           fixedNumber(toDecibels(r.maxDrive), 1) + " dB";
}

} // namespace

Result<CouplingChoice> chooseCoupling(const std::string& path, const LayoutDescription& layout) {
    const auto measured = loadCoupling(path);
    if (!measured) return Failure{measured.error};
    if (const std::size_t found = measured.value.enchanters(), expected = layout.actuators.size();
        found != expected)
        return Failure{path + ": expected as many actuators as the layout has, " + std::to_string(expected) +
                       ", found " + std::to_string(found)};
    return CouplingChoice{CouplingDrives{measured.value}, couplingNote(measured.value)};
}

} // namespace physvib
